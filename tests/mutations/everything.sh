# All that ./dev test runs, with each defect of a table until a test fails: run.sh --everything. This
# file is read by run.sh and is no program of its own. Two rounds, because all tests together take
# more than a quarter of an hour:
# 1. Each defect alone, with the recorded results, and with the tests of the other quick programs
#    that take at most a tenth of a second.
# 2. All defects that passed, in one build, with all other tests, to the end. Each test that fails
#    there is repeated without a defect, and then with each of the defects alone. A defect that no
#    failure repeats with is not noticed; together, two defects can only hide each other.

quick_programs=(recorded parser plugin unit cli)
all_programs=("${quick_programs[@]}" stat random images hardcases ctest)
other_ctests='BadInputs CommandLines Signals Replay[.].*'

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
      awk -v limit="$([ "$program" = recorded ] && echo 600000 || echo 100)" '$1 > limit { print $2 }' |
      paste -s -d : >"$folder/slow.$program"
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

# Runs tests of a program, named with blanks between them; none named: all.
run_some() {  # PROGRAM TESTS [flags of gtest]
  local program=$1 tests=$2
  shift 2
  case "$program" in
    hardcases) (cd "$build" && timeout 3600 bin/hardcases --quiet --jobs "$jobs" \
      ${tests:+--only "${tests// /,}"} 2>&1) ;;
    ctest)
      tests=${tests:-$other_ctests}
      ctest --test-dir "$build" -LE long -R "^(${tests// /|})\$" 2>&1 ;;
    *)
      tests=${tests:-*}
      run_gtest "$program" "${tests// /:}" 3600 --gtest_brief=1 "$@" ;;
  esac
}
# What failed, of what run_some printed; all of a program of gtest that did not reach its end.
failed_in() {  # PROGRAM OUTPUT
  case "$1" in
    hardcases) awk '$2 == "FAIL" { print $1 }' <<<"$2" ;;
    ctest) sed -nE 's/.*: ([^ ]+) [.]+ *[*]{3}.*/\1/p' <<<"$2" ;;
    *)
      if [ "$(grep -cE '^\[=+\] .* ran[.]' <<<"$2")" != "$jobs" ]; then
        echo '*'
      else
        { grep -oE '^\[  FAILED  \] [^ ,]+[.][^ ,]+' <<<"$2" || true; } | cut -c 14-
      fi ;;
  esac | sort -u | paste -s -d ' '
}

# All tests that are not quick, to their end; fills failures, by program.
declare -A failures
run_other_tests() {
  local program output tests
  failures=()
  for program in "${all_programs[@]}"; do
    tests=
    if [ -f "$folder/slow.$program" ]; then
      tests=$(tr : ' ' <"$folder/slow.$program")
      [ "$tests" ] || continue
    fi
    output=$(run_some "$program" "$tests") || failures[$program]=$(failed_in "$program" "$output")
  done
}

# Without a defect: leaves out of the failures what fails all the same, and says so.
keep_failures_of_defects() {
  local program output bad
  for program in "${!failures[@]}"; do
    output=$(run_some "$program" "${failures[$program]}") && continue
    bad=$(failed_in "$program" "$output")
    echo "$program fails without a defect: $bad"
    missed=1
    [ "$bad" != '*' ] || bad=${failures[$program]}
    failures[$program]=$(tr ' ' '\n' <<<"${failures[$program]}" |
      { grep -vxF "$(tr ' ' '\n' <<<"$bad")" || true; } | paste -s -d ' ')
  done
}

# Those that failed before, until one fails again; prints what it says.
repeat_failures() {
  local program output
  for program in "${all_programs[@]}"; do
    [ "${failures[$program]:-}" ] || continue
    output=$(run_some "$program" "${failures[$program]}" --gtest_fail_fast) ||
      { printf '%s\n' "$output"; return 1; }
  done
}

build_all() { ninja -C "$build" -j "$jobs" >"$folder/build.log" 2>&1; }

# The second round, of the defects with these indices.
try_together() {  # INDEX ...
  local i output program switched=
  [ $# -gt 0 ] || return 0
  echo "$# passed the quick tests; all of them together with the others"
  build_together all
  for i in "$@"; do
    if [ "${flags[$i]:-}" ]; then
      switched+=${switched:+,}${flags[$i]}
    else
      put_in "$i" || echo "${names[i]}: cannot be put in with the others"
    fi
  done
  if ! build_all; then
    echo "together they do not compile: $(grep -m 1 error "$folder/build.log")"; missed=1
    take_out
    return
  fi
  export EXPHOTON_DEFECTS=$switched
  run_other_tests
  unset EXPHOTON_DEFECTS
  take_out
  for program in "${!failures[@]}"; do echo "  $program: ${failures[$program]}"; done
  keep_failures_of_defects
  for i in "$@"; do
    if ! switch_on "$i"; then
      missed=1
    elif output=$(repeat_failures); then
      echo "${names[i]}: NOT NOTICED by anything"; missed=1
    else
      echo "${names[i]}: $(noticed_by "$output")"; noticed=$((noticed + 1))
    fi
    switch_off "$i"
  done
}
