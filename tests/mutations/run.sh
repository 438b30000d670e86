#!/usr/bin/env bash
# Puts deliberate defects into a copy of the sources and runs the tests that must notice each: a suite
# that stays green with a defect in is no suite. The defects are in defects.txt beside this file.
#   run.sh             all of them, several independent ones to a build
#   run.sh NAME ...    these alone; one name: one defect to the build
#   run.sh --texts     only looks whether the texts to replace are still there, each once or more
#   run.sh --list      prints name, file and tests of each
# Works in build-mutations/, a copy with its own build; the sources here are not touched.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
top=$(cd "$here/../.." && pwd)
copy=${MUTATION_COPY:-$top/build-mutations/src}
build=${MUTATION_BUILD:-$top/build-mutations/build}
jobs=${JOBS:-$(nproc)}
table=${MUTATION_TABLE:-$here/defects.txt}
batch_size=${MUTATIONS_A_BUILD:-10}

names=() files=() texts=() insteads=() programs=() filters=()
while IFS= read -r line; do
  case "$line" in
    '' | '#'*) ;;
    '- '*) texts+=("${line:2}") ;;
    '+ '* | '+') insteads+=("${line:2}") ;;
    '! '*) read -r _ program filter <<<"$line"; programs+=("$program"); filters+=("$filter") ;;
    *) read -r name file <<<"$line"; names+=("$name"); files+=("$file") ;;
  esac
done <"$table"
count=${#names[@]}
if [ "${#texts[@]} ${#insteads[@]} ${#filters[@]}" != "$count $count $count" ]; then
  echo "defects.txt: a defect has a line too few or too many" >&2
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

# A copy of what git knows of, as it is now. Times are kept, so that only changes are built again.
mkdir -p "$copy"
if [ -f "$copy/.list" ]; then
  git -C "$top" ls-files | sort | comm -13 - "$copy/.list" | (cd "$copy" && xargs -r -d '\n' rm -f)
fi
git -C "$top" ls-files | sort >"$copy/.list"
while IFS= read -r file; do
  if [ -f "$top/$file" ] && ! cmp -s "$top/$file" "$copy/$file"; then
    mkdir -p "$copy/$(dirname "$file")"
    cp "$top/$file" "$copy/$file"
  fi
done <"$copy/.list"
if [ ! -f "$build/build.ninja" ]; then
  launcher=()
  command -v ccache >/dev/null 2>&1 && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  cmake -S "$copy" -B "$build" -G Ninja -DEXPHOTON_OPTIMIZE=-O1 -DEXPHOTON_TESTS=ON \
    "${launcher[@]}" >/dev/null
fi

targets=(exphoton plugins test_unit test_stat test_parser test_cli hardcases)
build_all() { ninja -C "$build" -j "$jobs" "${targets[@]}" 2>&1; }

# run_tests PROGRAM FILTER: prints what they say; fails where a test does.
run_tests() {
  local command=("$build/bin/test_$1" "--gtest_filter=$2" --gtest_brief=1)
  [ "$1" = case ] && command=("$build/bin/hardcases" --tests --only "$2" --quiet)
  timeout 300 "${command[@]}" 2>&1
}
# The first test that failed.
noticed_by() {
  printf '%s\n' "$1" | grep -E '^\[  FAILED  \] [^ ]+[.]|^      [^ ]' | head -1 |
    sed -E 's/^\[  FAILED  \] //; s/^ +//; s/,? (where|\().*//'
}
put_in() {  # INDEX; the sources here may change meanwhile
  cp "$copy/${files[$1]}" "$build/original.$1"
  TEXT=${texts[$1]} INSTEAD=${insteads[$1]} awk '
    BEGIN { text = ENVIRON["TEXT"]; instead = ENVIRON["INSTEAD"] }
    { at = index($0, text)
      if (at && !done) { $0 = substr($0, 1, at - 1) instead substr($0, at + length(text)); done = 1 }
      print }
    END { exit !done }' "$build/original.$1" >"$copy/${files[$1]}"
}
take_out() { cat "$build/original.$1" >"$copy/${files[$1]}"; }

chosen=()
for ((i = 0; i < count; ++i)); do
  if [ $# = 0 ] || [[ " $* " == *" ${names[i]} "* ]]; then chosen+=("$i"); fi
done
if [ ${#chosen[@]} = 0 ]; then echo "no defect of that name" >&2; exit 1; fi
missed=0 noticed=0

echo "building without a defect"
build_all >"$build/mutation.log" || { tail -20 "$build/mutation.log"; exit 1; }
declare -A passes
for i in "${chosen[@]}"; do
  key="${programs[i]} ${filters[i]}"
  [ -n "${passes[$key]:-}" ] && continue
  passes[$key]=yes
  if ! output=$(run_tests "${programs[i]}" "${filters[i]}"); then
    echo "$key: fails without a defect: $(noticed_by "$output")"; passes[$key]=no; missed=1
  elif [[ "$output" == *"] 0 tests from"* ]]; then
    echo "$key: there is no such test"; passes[$key]=no; missed=1
  fi
done

# Fills builds: no two defects of one hold the same file or the same tests.
while [ ${#chosen[@]} -gt 0 ]; do
  batch=() rest=() used=" "
  for i in "${chosen[@]}"; do
    suite="${programs[i]}:${filters[i]%%.*}"
    if [ ${#batch[@]} -lt "$batch_size" ] && [[ "$used" != *" ${files[i]} "* ]] &&
      [[ "$used" != *" $suite "* ]]; then
      batch+=("$i") used+="${files[i]} $suite "
    else
      rest+=("$i")
    fi
  done
  chosen=("${rest[@]}")
  for i in "${batch[@]}"; do
    put_in "$i" || { echo "${names[i]}: its text is not in ${files[i]}"; missed=1; }
  done
  # One that does not compile must not hide the others.
  while [ ${#batch[@]} -gt 0 ] && ! build_all >"$build/mutation.log"; do
    kept=()
    for i in "${batch[@]}"; do
      if grep -F -- "${files[i]}" "$build/mutation.log" | grep -q 'error'; then
        echo "${names[i]}: does not compile"; missed=1
        take_out "$i"
      else
        kept+=("$i")
      fi
    done
    [ ${#kept[@]} -lt ${#batch[@]} ] || { tail -20 "$build/mutation.log"; exit 1; }
    batch=("${kept[@]}")
  done
  for i in "${batch[@]}"; do
    if [ "${passes[${programs[i]} ${filters[i]}]}" = no ]; then
      continue
    elif output=$(run_tests "${programs[i]}" "${filters[i]}"); then
      echo "${names[i]}: NOT NOTICED by ${programs[i]} ${filters[i]}"; missed=1
    else
      echo "${names[i]}: $(noticed_by "$output")"; noticed=$((noticed + 1))
    fi
  done
  for i in "${batch[@]}"; do take_out "$i"; done
done
echo "$noticed noticed, of $count in the table; $((SECONDS / 60)) min $((SECONDS % 60)) s"
exit $missed
