#!/usr/bin/env bash
# Measures exphotonmap against photonmap at equal settings, and how a render scales with threads.
# Usage: run.sh PROGRAM [speed|threads] (both without a name). Everything is measured in one run, in
# turn, and given as ratios: machines are noisy. Errors are against path tracing of the same room
# with its sunlit patch as emitters, rendered here first.
set -euo pipefail
program=$1
what=${2:-all}
top=$(cd "$(dirname "$0")/../.." && pwd)
scenes=$top/scenes/skylight-room
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

size=(--set Film.xresolution=128 --set Film.yresolution=96)
quiet=(--quiet --no-progress)
repeats=${REPEATS:-3}

# seconds NAME OPTIONS...: CPU seconds of a render to $work/NAME.exr
seconds() {
  local name=$1 TIMEFORMAT='%U'
  shift
  { time "$program" render "$@" "${quiet[@]}" -o "$work/$name.exr" 2>"$work/$name.err"; } \
    2>"$work/$name.time" || { cat "$work/$name.err" >&2; exit 1; }
  cat "$work/$name.time"
}
median() { sort -g | awk '{v[NR] = $1} END {print v[int((NR + 1) / 2)]}'; }
metric() { "$program" compare "$work/reference.exr" "$1" | awk -v key="$2" 'index($0, key) == 1 {
  print $(key == "relative mean error" ? 4 : 2)}'; }

# row NAME INTEGRATOR OPTIONS...: times alternate with the other rows of the same call
speed() {
  echo "reference: path on emitters.pbrt, ${REFERENCE_SPP:=1024} samples a pixel" >&2
  "$program" render "$scenes/emitters.pbrt" "${size[@]}" "${quiet[@]}" --spp "$REFERENCE_SPP" \
    -o "$work/reference.exr"
  local settings=("${size[@]}" --nthreads 1 --set SurfaceIntegrator.rrthreshold=0)
  local labels=("defaults" "the published room's")
  local options=("" "--set SurfaceIntegrator.nused=75 --set SurfaceIntegrator.finalgathersamples=64 \
    --set SurfaceIntegrator.indirectphotons=400000 --spp 8")
  local integrator i r
  printf '%-22s %-13s %12s %10s %12s\n' settings integrator "CPU seconds" relMSE "mean error %"
  for i in 0 1; do
    for ((r = 0; r < repeats; ++r)); do
      for integrator in photonmap exphotonmap; do
        # shellcheck disable=SC2086  # options are words
        seconds "$integrator" "$scenes/$integrator.pbrt" "${settings[@]}" ${options[i]} \
          >>"$work/$i-$integrator"
      done
    done
    for integrator in photonmap exphotonmap; do
      printf '%-22s %-13s %12s %10.5f %12s\n' "${labels[i]}" "$integrator" \
        "$(median <"$work/$i-$integrator")" "$(metric "$work/$integrator.exr" relMSE)" \
        "$(metric "$work/$integrator.exr" "relative mean error")"
    done
    paste "$work/$i-exphotonmap" "$work/$i-photonmap" | awk '{print 100 * $1 / $2}' | median |
      awk '{printf "exphotonmap takes %.1f %% of photonmap'\''s time\n", $1}'
  done
}

threads() {
  local count TIMEFORMAT='%R' r
  for ((r = 0; r < repeats; ++r)); do
    for count in 1 2; do
      { time "$program" render "$scenes/exphotonmap.pbrt" "${size[@]}" "${quiet[@]}" \
        --reproducible --nthreads $count -o "$work/threads-$count.exr" 2>/dev/null; } \
        2>>"$work/threads-$count.times"
    done
  done
  cmp "$work/threads-1.exr" "$work/threads-2.exr" && echo "1 and 2 threads: the same bytes"
  paste "$work/threads-1.times" "$work/threads-2.times" | awk '{print $1 / $2}' | median |
    awk '{printf "2 threads are %.2f times as fast as 1\n", $1}'
}

case "$what" in
  all) speed; threads ;;
  speed | threads) "$what" ;;
  *) echo "run.sh: unknown benchmark \"$what\": speed, threads" >&2; exit 1 ;;
esac
