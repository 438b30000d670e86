# All that ./dev test runs, with each defect of a table until a test fails: run.sh --everything. This
# file is read by run.sh and is no program of its own. Two rounds, because all tests together take
# more than a quarter of an hour:
# 1. Each defect alone, with the tests of the quick programs that take at most a tenth of a second.
# 2. All defects that passed, in one build, with all other tests, to the end. Each test that fails
#    there is repeated without a defect, and then with each of the defects alone. A defect that no
#    failure repeats with is not noticed; together, two defects can only hide each other.

quick_programs=(parser plugin unit cli)
programs_of_tests=("${quick_programs[@]}" stat random images)
other_tests='^(BadInputs|CommandLines|Signals|Replay)'

# Runs tests of a program in as many parts at once as there are jobs; a time-out is a failure.
run_gtest() {  # PROGRAM FILTER SECONDS [flags of gtest]
  local program=$1 filter=$2 seconds=$3 part parts=() status=0
  shift 3
  for ((part = 0; part < jobs; ++part)); do
    (cd "$build" && GTEST_TOTAL_SHARDS=$jobs GTEST_SHARD_INDEX=$part exec timeout "$seconds" \
      "bin/test_$program" "--gtest_filter=$filter" "$@" >"$folder/part.$part" 2>&1) &
    parts+=($!)
  done
  for part in "${parts[@]}"; do wait "$part" || status=1; done
  for ((part = 0; part < jobs; ++part)); do cat "$folder/part.$part"; done
  return $status
}

# Without a defect: the quick programs must pass; notes which of their tests take long.
check_quick_programs() {
  local program output
  for program in "${quick_programs[@]}"; do
    # Done before, and nothing was built since.
    if [ "$folder/slow.$program" -nt "$build/.ninja_log" ]; then continue; fi
    output=$(run_gtest "$program" '*' 900) ||
      { echo "$program fails without a defect: $(noticed_by "$output")"; exit 1; }
    printf '%s\n' "$output" | sed -nE 's/^\[       OK \] ([^ ,]+).* \(([0-9]+) ms\)$/\2 \1/p' |
      awk '$1 > 100 { print $2 }' | paste -s -d : >"$folder/slow.$program"
  done
}

# The quick tests, until one fails; prints what that says.
run_quick_tests() {
  local program output
  for program in "${quick_programs[@]}"; do
    output=$(run_gtest "$program" "*-$(cat "$folder/slow.$program")" 300 --gtest_brief=1 \
      --gtest_fail_fast) || { printf '%s\n' "$output"; return 1; }
  done
}

# What failed, of the output of a program of gtest: a filter. All, where it did not reach its end.
failures_of() {  # OUTPUT
  if [ "$(grep -cE '^\[=+\] .* ran[.]' <<<"$1")" != "$jobs" ]; then
    echo '*'
  else
    { grep -oE '^\[  FAILED  \] [^ ,]+[.][^ ,]+' <<<"$1" || true; } | cut -c 14- | sort -u | paste -s -d :
  fi
}

# All other tests to their end; fills failures, by program.
declare -A failures
run_other_tests() {
  local program output slow
  failures=()
  for program in "${programs_of_tests[@]}"; do
    slow='*'
    if [ -f "$folder/slow.$program" ]; then slow=$(cat "$folder/slow.$program"); fi
    [ "$slow" ] || continue
    output=$(run_gtest "$program" "$slow" 3600 --gtest_brief=1) ||
      failures[$program]=$(failures_of "$output")
  done
  output=$(cd "$build" && timeout 3600 bin/hardcases --quiet --jobs "$jobs" 2>&1) ||
    failures[hardcases]=$(awk '$2 == "FAIL" { print $1 }' <<<"$output" | paste -s -d ,)
  output=$(ctest --test-dir "$build" -R "$other_tests" -LE long 2>&1) || failures[ctest]=yes
}

# Those that failed before, until one fails again; prints what it says.
repeat_failures() {
  local program output
  for program in "${programs_of_tests[@]}"; do
    [ "${failures[$program]:-}" ] || continue
    output=$(run_gtest "$program" "${failures[$program]}" 900 --gtest_brief=1 --gtest_fail_fast) ||
      { printf '%s\n' "$output"; return 1; }
  done
  if [ "${failures[hardcases]:-}" ]; then
    output=$(cd "$build" && timeout 900 bin/hardcases --quiet --jobs "$jobs" \
      --only "${failures[hardcases]}" 2>&1) || { printf '%s\n' "$output"; return 1; }
  fi
  if [ "${failures[ctest]:-}" ]; then
    output=$(ctest --test-dir "$build" -R "$other_tests" -LE long 2>&1) ||
      { printf '%s\n' "$output"; return 1; }
  fi
}

build_all() { ninja -C "$build" -j "$jobs" >"$folder/build.log" 2>&1; }

# The second round, of the defects with these indices.
try_together() {  # INDEX ...
  local i output program
  [ $# -gt 0 ] || return 0
  echo "$# passed the quick tests; all of them together with the others"
  for i in "$@"; do put_in "$i" || echo "${names[i]}: cannot be put in with the others"; done
  if ! build_all; then
    echo "together they do not compile: $(grep -m 1 error "$folder/build.log")"; missed=1
    take_out
    return
  fi
  run_other_tests
  take_out
  for program in "${!failures[@]}"; do echo "  $program: ${failures[$program]}"; done
  output=$(repeat_failures) ||
    { echo "fails without a defect: $(noticed_by "$output")"; missed=1; return; }
  for i in "$@"; do
    if ! { put_in "$i" && build_all; }; then
      echo "${names[i]}: cannot be built"; missed=1
    elif output=$(repeat_failures); then
      echo "${names[i]}: NOT NOTICED by anything"; missed=1
    else
      echo "${names[i]}: $(noticed_by "$output")"; noticed=$((noticed + 1))
    fi
    take_out
  done
}
