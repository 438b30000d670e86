#!/usr/bin/env bash
# Measures what the build costs, in a scratch folder without ccache: CPU seconds of a clean build of
# the program (with "tests": of everything that ./dev test builds), the ten slowest files, and the
# seconds until a change of one plugin, or of a core header that every plugin sees, is built.
# Fails where a limit of docs/development/CONTRIBUTING.md is exceeded. Usage: build_time.sh SOURCES [tests]
set -euo pipefail
top=$1
what=${2:-program}
jobs=${JOBS:-$(nproc)}
plugin_limit=2 program_limit=180 tests_limit=540 touch_limit=5 header_limit=120
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# exceeds VALUE LIMIT
exceeds() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }'; }
# limit NAME SECONDS LIMIT: prints a row and remembers a failure.
limit() {
  local verdict=ok
  if exceeds "$2" "$3"; then
    verdict="TOO SLOW"
    failed=1
  fi
  printf '%-56s %8.1f s   limit %4d s   %s\n' "$1" "$2" "$3" "$verdict"
}

# The launcher appends "CPU-seconds file" for each compilation.
cat >"$work/launcher" <<'TEXT'
#!/usr/bin/env bash
export TIMEFORMAT='%U %S'
source=${*: -1}
{ time "$@" 2>&3; } 3>&2 2>"$BUILD_LOG.$$" && status=0 || status=$?
read -r user sys < <(tail -n 1 "$BUILD_LOG.$$")
rm -f "$BUILD_LOG.$$"
awk -v u="$user" -v s="$sys" -v f="$source" 'BEGIN { printf "%.2f %s\n", u + s, f }' >>"$BUILD_LOG"
exit $status
TEXT
chmod +x "$work/launcher"

configure() { # FOLDER TESTS
  cmake -S "$top" -B "$1" -G Ninja -DEXPHOTON_TESTS="$2" \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$work/launcher" >/dev/null
}
# Runs ninja and sets cpu and wall to what it and all that it started took.
run_ninja() {
  local before
  cpu_of_children
  before=$children
  wall=$EPOCHREALTIME
  ninja -C "$1" -j "$jobs" "${@:2}" >"$work/ninja.out" 2>&1 ||
    { tail -n 40 "$work/ninja.out" >&2; exit 1; }
  wall=$(awk -v a="$wall" -v b="$EPOCHREALTIME" 'BEGIN { print b - a }')
  cpu_of_children
  cpu=$(awk -v a="$before" -v b="$children" 'BEGIN { print b - a }')
}
# Sets children to the CPU seconds of the finished children of this shell. The second line of `times` holds them; a pipe
# would ask a subshell, which has no children yet.
cpu_of_children() {
  times >"$work/times"
  children=$(tail -n 1 "$work/times" |
    awk '{ for (i = 1; i <= NF; ++i) { split($i, t, "m"); s += t[1] * 60 + t[2] } print s }')
}

export BUILD_LOG=$work/files CCACHE_DISABLE=1
configure "$work/build" $([ "$what" = tests ] && echo ON || echo OFF)
if [ "$what" = tests ]; then
  run_ninja "$work/build"
  limit "clean build of the program and the tests, CPU time" "$cpu" $tests_limit
else
  run_ninja "$work/build" exphoton
  limit "clean build of the program, CPU time" "$cpu" $program_limit
fi
echo
echo "The ten slowest files, CPU seconds:"
sort -rg "$BUILD_LOG" | head -n 10 | sed "s#$work/build/#build/#; s#$top/##; s/^/  /"
echo

# What a plugin adds: its own file, compiled and linked again alone. The slowest of all kinds.
slowest=0 slowest_name=
for source in "$top"/{integrators,accelerators,shapes,lights,materials,samplers}/*.cpp \
  "$top"/{materials/textures,materials/volumes,integrators/volumeintegrators,samplers/filters,core/cameras}/*.cpp; do
  seconds=$(awk -v f="$source" '$2 == f { print $1 }' "$BUILD_LOG" | tail -n 1)
  if exceeds "${seconds:-0}" "$slowest"; then
    slowest=$seconds
    slowest_name=${source#"$top"/}
  fi
done
limit "the slowest plugin ($slowest_name), CPU time" "$slowest" $plugin_limit

# touched NAME SOURCE LIMIT [TARGET]: builds again as if SOURCE had changed, without changing it.
touched() {
  local source=$2 stamp
  stamp=$(stat -c %Y "$source")
  touch "$source"
  run_ninja "$work/build" "${@:4}"
  touch -d "@$stamp" "$source"
  limit "$1" "$wall" "$3"
}
touched "a change of lights/point.cpp, by the clock" "$top/lights/point.cpp" $touch_limit exphoton
touched "a change of core/geometry/shape.h, by the clock" "$top/core/geometry/shape.h" \
  $header_limit exphoton
exit $failed
