#!/usr/bin/env bash
# Puts deliberate defects, one at a time, into a copy of the sources and runs the tests that must
# notice each: a suite that stays green with a defect in is no suite. The defects are in the tables
# beside this file: defects.txt and blind*.txt.
#   run.sh                            all of them
#   run.sh NAME ...                   these alone
#   run.sh --everything TABLE [NAME ...]  defects of another table, each with all that ./dev test runs
#                                     until something fails (everything.sh); the table's ! line is
#                                     then a remark
#   run.sh --texts                    only looks whether the texts to replace are still there
#   run.sh --list                     prints name, file and tests of each
# A defect that keeps its test from ending has the word "endless" after the test. Any other time-out
# is reported, and does not count as noticed.
# Works in build-mutations/, a copy with its own build; the sources here are not touched. With JOBS
# above 1 the defects are tried in parts, side by side, where the system allows mounts in a namespace
# of a user.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
top=$(cd "$here/../.." && pwd)
folder=${MUTATION_FOLDER:-$top/build-mutations}
copy=$folder/src build=$folder/build clean=$folder/clean
jobs=${JOBS:-$(nproc)}
. "$here/everything.sh"

everything= part=
if [ "${1:-}" = --part ]; then part=yes; shift; fi  # try_in_parts uses this
tables=("$here"/*.txt)
if [ "${1:-}" = --texts ]; then tables+=("$here"/*.list); fi
if [ "${1:-}" = --everything ]; then
  everything=yes tables=("${2:?run.sh --everything TABLE}")
  shift 2
fi

names=() files=() texts=() insteads=() programs=() filters=() endings=()
while IFS= read -r line; do
  case "$line" in
    '' | '#'*) ;;
    '- '*) texts+=("${line:2}") ;;
    '+ '* | '+') insteads+=("${line:2}") ;;
    '! '*)
      read -r _ program filter <<<"$line"
      ending=
      if [[ "$filter" == *" endless" ]]; then filter=${filter% endless} ending=endless; fi
      programs+=("$program") filters+=("$filter") endings+=("$ending")
      ;;
    *) read -r name file <<<"$line"; names+=("$name"); files+=("$file") ;;
  esac
done < <(cat "${tables[@]}")
count=${#names[@]}
if [ "${#texts[@]} ${#insteads[@]} ${#filters[@]}" != "$count $count $count" ]; then
  echo "${tables[*]}: a defect has a line too few or too many" >&2
  exit 1
fi

if [ "${1:-}" = --texts ]; then
  missing=0
  for ((i = 0; i < count; ++i)); do
    grep -qF -- "${texts[i]}" "$top/${files[i]}" ||
      { echo "${names[i]}: its text is not in ${files[i]}"; missing=1; }
  done
  exit $missing
elif [ "${1:-}" = --list ]; then
  for ((i = 0; i < count; ++i)); do
    printf '%-26s %-44s %s %s\n' "${names[i]}" "${files[i]}" "${programs[i]}" "${filters[i]}"
  done
  exit 0
fi

chosen=()
for ((i = 0; i < count; ++i)); do
  if [ $# = 0 ] || [[ " $* " == *" ${names[i]} "* ]]; then chosen+=("$i"); fi
done
if [ ${#chosen[@]} = 0 ]; then echo "no defect of that name" >&2; exit 1; fi

# Copies all that git does not ignore, as it is now. Files that are equal keep their times, so that only changes
# are built again.
copy_sources() {
  mkdir -p "$copy"
  if [ -f "$copy/.list" ]; then
    git -C "$top" ls-files -co --exclude-standard | sort | comm -13 - "$copy/.list" | (cd "$copy" && xargs -r -d '\n' rm -f)
  fi
  git -C "$top" ls-files -co --exclude-standard | sort >"$copy/.list"
  while IFS= read -r file; do
    if [ -f "$top/$file" ] && ! cmp -s "$top/$file" "$copy/$file"; then
      mkdir -p "$copy/$(dirname "$file")"
      cp "$top/$file" "$copy/$file"
    fi
  done <"$copy/.list"
}

# One source a compilation, because each defect compiles few; and a library with a defect does not
# make its users link again. A defect in a helper library links up to twenty plugins, which gold does
# three times as fast.
configure() {
  local linker=() kind
  if command -v ld.gold >/dev/null 2>&1; then
    for kind in EXE SHARED MODULE; do linker+=("-DCMAKE_${kind}_LINKER_FLAGS=-fuse-ld=gold"); done
  fi
  [ -f "$build/build.ninja" ] ||
    cmake -S "$copy" -B "$build" -G Ninja -DEXPHOTON_OPTIMIZE=-O1 -DEXPHOTON_TESTS=ON \
      -DEXPHOTON_FILES_TOGETHER=1 -DCMAKE_LINK_DEPENDS_NO_SHARED=ON "${linker[@]}" >/dev/null
}

# target_of PROGRAM: what to build for it.
target_of() {
  case "$1" in case) echo hardcases ;; *) echo "test_$1" ;; esac
}
build_for() { ninja -C "$build" -j "$jobs" exphoton plugins "$@" >"$folder/build.log" 2>&1; }

# run_tests PROGRAM FILTER: prints what they say; fails where a test does.
run_tests() {  # and 124 where they do not end
  local command=("$build/bin/test_$1" "--gtest_filter=$2" --gtest_brief=1 --gtest_fail_fast)
  [ "$1" = case ] && command=("$build/bin/hardcases" --tests --only "$2" --quiet)
  (cd "$build" && timeout "${3:-300}" "${command[@]}" 2>&1)
}
# The first test that failed, of what run_tests or ctest printed.
noticed_by() {
  local test
  test=$(printf '%s\n' "$1" | grep -E '^\[  FAILED  \] [^ ]+[.]|^      [^ ]|\*\*\*' | head -n 1 |
    sed -E 's/^\[  FAILED  \] //; s/^ +//; s/,? (where|\().*//; s/ \.+ *\*\*\*.*//') || true
  echo "${test:-ended without a result}"
}

put_in() {  # INDEX; the sources here may change meanwhile
  local original=$folder/originals/${files[$1]}
  mkdir -p "$(dirname "$original")"
  [ -f "$original" ] || cp -p "$copy/${files[$1]}" "$original"
  cp "$copy/${files[$1]}" "$folder/before"
  TEXT=${texts[$1]} INSTEAD=${insteads[$1]} awk '
    BEGIN { text = ENVIRON["TEXT"]; instead = ENVIRON["INSTEAD"] }
    { at = index($0, text)
      if (at && !done) { $0 = substr($0, 1, at - 1) instead substr($0, at + length(text)); done = 1 }
      print }
    END { exit !done }' "$folder/before" >"$copy/${files[$1]}"
}
# Takes the build without a defect for what take_out restores.
remember() {
  rm -rf "$clean"
  cp -a "$build" "$clean"
  sleep .1
  touch "$folder/stamp"
  sleep .1
}
# Restores sources and build, with their times: nothing is compiled for it.
take_out() {
  cp -a "$folder/originals/." "$copy"
  rm -rf "$folder/originals"
  (cd "$build" && find . -type f -newer "$folder/stamp" -print0) |
    while IFS= read -r -d '' file; do
      if [ -f "$clean/$file" ]; then cp -p "$clean/$file" "$build/$file"; else rm "$build/$file"; fi
    done
}

run_for() {  # INDEX
  if [ "$everything" ]; then run_quick_tests; else run_tests "${programs[$1]}" "${filters[$1]}" "${endings[$1]:+60}"; fi
}
build_with() {  # INDEX: what its tests need
  if [ "$everything" ]; then
    build_for "${quick_programs[@]/#/test_}"
  else
    build_for "$(target_of "${programs[$1]}")"
  fi
}

missed=0 noticed=0
left=()  # indices of defects for the second round
declare -A passes targets
# What is tested must pass without a defect, and be there.
check_tests() {  # INDEX
  local key="${programs[$1]} ${filters[$1]}" output
  [ -z "${passes[$key]:-}" ] || return 0
  passes[$key]=yes
  if ! output=$(run_tests "${programs[$1]}" "${filters[$1]}"); then
    echo "$key: fails without a defect: $(noticed_by "$output")"; passes[$key]=no; missed=1
  elif [[ "$output" == *"] 0 tests from"* ]]; then
    echo "$key: there is no such test"; passes[$key]=no; missed=1
  fi
}
# The same for all chosen ones: their tests together, which takes less time. Where one fails, each
# filter for itself.
check_all_tests() {
  local i program all
  for program in "${!targets[@]}"; do
    program=${program#test_}
    [ "$program" != hardcases ] || continue
    all=
    for i in "${chosen[@]}"; do
      [ "${programs[i]}" = "$program" ] || continue
      [[ ":$all:" == *":${filters[i]}:"* ]] || all+=${all:+:}${filters[i]}
    done
    (cd "$build" && timeout 3600 "bin/test_$program" "--gtest_filter=$all" --gtest_brief=1) \
      >"$folder/part.0" 2>&1 || continue
    for i in "${chosen[@]}"; do
      [ "${programs[i]}" = "$program" ] || continue
      [ -z "$("$build/bin/test_$program" "--gtest_filter=${filters[i]}" --gtest_list_tests)" ] ||
        passes["$program ${filters[i]}"]=yes
    done
  done
  for i in "${chosen[@]}"; do check_tests "$i"; done
}
prepare() {
  rm -rf "$folder/originals"
  copy_sources
  configure
  echo "building without a defect"
  for i in "${chosen[@]}"; do targets[$(target_of "${programs[i]}")]=yes; done
  if [ "$everything" ]; then
    build_all
  else
    build_for "${!targets[@]}"
  fi || { tail -20 "$folder/build.log"; exit 1; }
  if [ "$everything" ]; then
    check_quick_programs
  else
    check_all_tests
  fi
  remember
}

# Says which test notices a defect that is alone in the code.
try() {  # INDEX
  local name=${names[$1]} output
  if ! put_in "$1"; then
    echo "$name: its text is not in ${files[$1]}"; missed=1
  elif ! build_with "$1"; then
    echo "$name: does not compile: $(grep -m 1 error "$folder/build.log")"; missed=1
  elif output=$(run_for "$1"); then
    if [ "$everything" ]; then
      left+=("$1")
    else
      echo "$name: NOT NOTICED"; missed=1
      echo "    by ${programs[$1]} ${filters[$1]}"
    fi
  elif [ $? = 124 ] && [ "${endings[$1]}" != endless ]; then
    echo "$name: the tests did not end"; missed=1
    echo "    ${programs[$1]} ${filters[$1]}"
  else
    echo "$name: $(noticed_by "$output")"; noticed=$((noticed + 1))
  fi
  take_out
}

# Tries the defects with these indices, each part of them with a copy of the build of its own. A
# part sees its copy at the place of the original, so that nothing is compiled again for it.
try_in_parts() {  # INDEX ...
  local number index=0 processes=() counts
  for ((number = 0; number < jobs; ++number)); do
    local names_of_part=()
    for ((index = number + 1; index <= $#; index += jobs)); do
      names_of_part+=("${names[${!index}]}")
    done
    [ ${#names_of_part[@]} -gt 0 ] || continue
    rm -rf "$folder/part$number"
    mkdir "$folder/part$number"
    cp -a "$copy" "$build" "$folder/stamp" "$folder/part$number"
    cp -al "$clean" "$folder/part$number"
    unshare -rm bash -c 'mount --bind "$0" "$1" && shift && JOBS=1 exec "$@"' \
      "$folder/part$number" "$folder" "$here/run.sh" --part "${names_of_part[@]}" &
    processes+=($!)
  done
  for number in "${processes[@]}"; do wait "$number" || missed=1; done
  for counts in "$folder"/part*/noticed; do noticed=$((noticed + $(cat "$counts"))); done
  rm -rf "$folder"/part*/
}

if [ "$part" ]; then
  rm -rf "$folder/originals"
  for i in "${chosen[@]}"; do try "$i"; done
  echo "$noticed" >"$folder/noticed"
  exit $missed
fi
prepare
wanted=()
for i in "${chosen[@]}"; do
  [ "${passes[${programs[i]} ${filters[i]}]:-yes}" = no ] || wanted+=("$i")
done
if [ ! "$everything" ] && [ "$jobs" -gt 1 ] && unshare -rm true 2>/dev/null; then
  try_in_parts "${wanted[@]}"
else
  for i in "${wanted[@]}"; do try "$i"; done
fi
if [ "$everything" ]; then try_together "${left[@]}"; fi
times >"$folder/times"
read -r user system < <(tail -n 1 "$folder/times")
echo "$noticed noticed, of ${#chosen[@]}; $((SECONDS / 60)) min $((SECONDS % 60)) s," \
  "CPU time $user and $system in the system"
exit $missed
