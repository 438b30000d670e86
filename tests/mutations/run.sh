#!/usr/bin/env bash
# Puts deliberate defects, one at a time, into a copy of the sources and runs the tests that must
# notice each: a suite that stays green with a defect in is no suite. The defects are in the tables
# beside this file: defects.txt and blind*.txt.
#   run.sh                            all of them
#   run.sh NAME ...                   these alone
#   run.sh --everything TABLE [NAME ...]  defects of another table, each with all that ./dev test runs
#                                     until something fails (everything.sh); the table's ! line is
#                                     then a remark
#   run.sh --reach TABLE              defects of another table, each with the quick tests, recorded
#                                     scenes and commands that reach its line (reach.py)
#   run.sh --soak LIST [NAME ...]     the defects that LIST names, each with the random scenes until they
#                                     find it (soak.sh)
#   run.sh --texts                    only looks whether the texts to replace are still there
#   run.sh --list                     prints name, file and tests of each
# A defect that keeps its test from ending has the word "endless" after the test. Any other time-out
# is reported, and does not count as noticed.
# Works in build-mutations/, a copy with its own build; the sources here are not touched. Nearly all
# defects are compiled into one build, where an environment variable switches one of them on
# (together.py). The others are compiled one after the other.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
top=$(cd "$here/../.." && pwd)
folder=${MUTATION_FOLDER:-$top/build-mutations}
copy=$folder/src build=$folder/build clean=$folder/clean
jobs=${JOBS:-$(nproc)}
. "$here/everything.sh"
. "$here/soak.sh"

everything= reach= soak=
tables=("$here"/*.txt)
others=("$here"/*.list)  # these are in the build as well, so that it serves every run
if [ "${1:-}" = --texts ]; then
  tables+=("${others[@]}") others=()
elif [ "${1:-}" = --everything ]; then
  everything=yes others=("${tables[@]}" "${others[@]}") tables=("$(realpath "${2:?run.sh --everything TABLE}")")
  shift 2
elif [ "${1:-}" = --reach ]; then
  reach=yes others=() tables=("$(realpath "${2:?run.sh --reach TABLE}")")
  shift 2
elif [ "${1:-}" = --soak ]; then
  soak=yes others=()
  read_soak_list "${2:?run.sh --soak LIST}" "${@:3}"
fi

names=() files=() texts=() insteads=() programs=() filters=() endings=()
while IFS= read -r line; do
  case "$line" in
    '# end of the tables') count=${#names[@]} ;;
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
done < <(
  cat "${tables[@]}" && echo '# end of the tables' &&
    for table in "${others[@]}"; do [ "$table" = "${tables[0]}" ] || cat "$table"; done
)
all=${#names[@]}
if [ "${#texts[@]} ${#insteads[@]} ${#filters[@]}" != "$all $all $all" ]; then
  echo "${tables[*]} ${others[*]}: a defect has a line too few or too many" >&2
  exit 1
fi

# Prints "Suite.Name" of all tests that are written in the sources.
written_tests() {
  find "$top/tests" -name '*.cpp' -exec cat {} + | tr '\n' ' ' |
    grep -oE '(TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P)\( *[A-Za-z0-9_]+, *[A-Za-z0-9_]+\)' |
    sed -E 's/.*\( *//; s/, */./; s/\)//'
}
# Prints names of tests in the tables that are not in the sources. Names with a wildcard in suite or
# name are left out.
missing_tests() {
  comm -23 <(
    for ((i = 0; i < count; ++i)); do
      [ "${programs[i]}" = case ] || tr ':' '\n' <<<"${filters[i]%%-*}"
    done | sed -E 's|^[^./]*/([^.]*\.)|\1|; s|/.*||' | grep -E '^[A-Za-z0-9_]+[.][A-Za-z0-9_]+$' | sort -u
  ) <(written_tests | sort -u)
}

if [ "$soak" ]; then keep_listed; fi
if [ "${1:-}" = --texts ]; then
  missing=0
  if [ -n "$(missing_tests)" ]; then
    echo "the tables name tests that do not exist: $(missing_tests | paste -s -d ' ')"
    missing=1
  fi
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

if [ "$soak" ]; then set --; fi
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

# A library with a defect does not make its users link again. A defect in a helper library links up
# to twenty plugins, which gold does three times as fast.
configure() {
  local linker=() kind
  if command -v ld.gold >/dev/null 2>&1; then
    for kind in EXE SHARED MODULE; do linker+=("-DCMAKE_${kind}_LINKER_FLAGS=-fuse-ld=gold"); done
  fi
  touch -a "$folder/defects.h"
  [ -f "$build/build.ninja" ] ||
    cmake -S "$copy" -B "$build" -G Ninja "-DEXPHOTON_OPTIMIZE=${MUTATION_OPTIMIZE:--O1}" -DEXPHOTON_TESTS=ON \
      -DEXPHOTON_FILES_TOGETHER=12 -DCMAKE_LINK_DEPENDS_NO_SHARED=ON "${linker[@]}" \
      "-DCMAKE_CXX_FLAGS=-w -Wno-narrowing -include $folder/defects.h" >/dev/null
}

# Builds the targets with all defects that can be compiled together; fills flags, by index.
declare -A flags
build_together() {  # TARGET ...
  local i flag
  for ((i = 0; i < all; ++i)); do
    printf '%s %s %s\n- %s\n+ %s\n' "$i" "${names[i]}" "${files[i]}" "${texts[i]}" "${insteads[i]}"
  done | JOBS=$jobs python3 -B "$here/together.py" "$folder" "$@" || exit 1
  while read -r i flag; do flags[$i]=$flag; done <"$folder/flags"
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
# The first test that failed, of what run_tests or ctest printed; a crash ends a program before it
# prints one.
noticed_by() {  # OUTPUT [STATUS]
  local test
  test=$(printf '%s\n' "$1" | grep -E '^\[  FAILED  \] [^ ]+[.]|^      [^ ]|\*\*\*' | head -n 1 |
    sed -E 's/^\[  FAILED  \] //; s/^ +//; s/,? (where|\().*//; s/ \.+ *\*\*\*.*//') || true
  if [ -z "$test" ] && [ "${2:-0}" -gt 128 ]; then test="a crash (signal $(($2 - 128)))"; fi
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
  [ -d "$folder/originals" ] || return 0
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
declare -A passes targets  # by program and filter; by target
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
    run_gtest "$program" "$all" 3600 --gtest_brief=1 >/dev/null || continue
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
  echo "building with the defects"
  for i in "${chosen[@]}"; do targets[$(target_of "${programs[i]}")]=yes; done
  if [ "$everything" ]; then
    build_together exphoton plugins "${quick_programs[@]/#/test_}"
  else
    build_together exphoton plugins "${!targets[@]}"
  fi
  echo "${#flags[@]} of $all defects are in one build; testing without a defect"
  if [ "$everything" ]; then
    check_quick_programs
  else
    check_all_tests
  fi
}

# Puts a defect in, alone; take_out undoes it.
switch_on() {  # INDEX
  if [ "${flags[$1]:-}" ]; then
    export EXPHOTON_DEFECTS=${flags[$1]}
  elif ! put_in "$1"; then
    echo "${names[$1]}: its text is not in ${files[$1]}"
    return 1
  elif ! build_with "$1"; then
    echo "${names[$1]}: does not compile: $(grep -m 1 error "$folder/build.log")"
    return 1
  fi
}
switch_off() {  # INDEX
  if [ "${flags[$1]:-}" ]; then unset EXPHOTON_DEFECTS; else take_out; fi
}

# Says which test notices a defect. Succeeds if one does; 2: it is left for the second round.
try() {  # INDEX
  local name=${names[$1]} output status=0 result=1
  if switch_on "$1"; then
    output=$(run_for "$1") || status=$?
    if [ $status = 0 ] && [ "$everything" ]; then
      result=2
    elif [ $status = 0 ]; then
      echo "$name: NOT NOTICED"
      echo "    by ${programs[$1]} ${filters[$1]}"
    elif [ $status = 124 ] && [ "${endings[$1]}" != endless ]; then
      echo "$name: the tests did not end"
      echo "    ${programs[$1]} ${filters[$1]}"
    else
      echo "$name: $(noticed_by "$output" "$status")"
      result=0
    fi
  fi
  switch_off "$1"
  return $result
}
count_result() {  # STATUS of try, INDEX
  case "$1" in
    0) noticed=$((noticed + 1)) ;;
    2) left+=("$2") ;;
    *) missed=1 ;;
  esac
}

# Tries the defects of the one build, as many at once as there are jobs. Each has a folder for
# temporary files of its own.
try_side_by_side() {  # INDEX ...
  local i status
  : >"$folder/results"
  for i in "$@"; do
    while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
    {
      export TMPDIR=$folder/temporary/$i
      mkdir -p "$TMPDIR"
      status=0
      try "$i" || status=$?
      echo "$status $i" >>"$folder/results"
      rm -rf "$TMPDIR"
    } &
  done
  wait
  while read -r status i; do count_result "$status" "$i"; done <"$folder/results"
}

if [ "$soak" ]; then
  run_soak
  exit 0
fi
if [ "$reach" ]; then
  copy_sources
  configure
  build_together exphoton plugins test_recorded test_unit test_parser test_plugin test_cli
  for i in "${!flags[@]}"; do echo "${flags[$i]} ${names[i]}"; done | sort -n >"$folder/names"
  exec python3 -B "$here/reach.py" "$folder"
fi

prepare
in_build=() alone=()
for i in "${chosen[@]}"; do
  if [ "${passes[${programs[i]} ${filters[i]}]:-yes}" = no ]; then
    missed=1
  elif [ "${flags[$i]:-}" ] && [ ! "$everything" ]; then
    in_build+=("$i")
  else
    alone+=("$i")
  fi
done
try_side_by_side "${in_build[@]}"
echo "$((SECONDS / 60)) min $((SECONDS % 60)) s; ${#alone[@]} defects one after the other"
remember
for i in "${alone[@]}"; do
  status=0
  try "$i" || status=$?
  count_result "$status" "$i"
done
if [ "$everything" ]; then try_together "${left[@]}"; fi
times >"$folder/times"
read -r user system < <(tail -n 1 "$folder/times")
echo "$noticed noticed, of ${#chosen[@]}; $((SECONDS / 60)) min $((SECONDS % 60)) s," \
  "CPU time $user and $system in the system"
exit $missed
