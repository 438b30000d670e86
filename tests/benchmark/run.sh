#!/usr/bin/env bash
# Measures exphotonmap against photonmap at equal settings, and how its phases scale with threads.
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
repeats=${REPEATS:-3} reference_spp=${REFERENCE_SPP:-1024}

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

# pair LABEL WIDTH HEIGHT OPTIONS...: both integrators with the same settings, in turn.
pair() {
  local label=$1 integrator r
  local scale=(--set "Film.xresolution=$2" --set "Film.yresolution=$3")
  shift 3
  echo "$label: reference, path on emitters.pbrt, $reference_spp samples a pixel" >&2
  "$program" render "$scenes/emitters.pbrt" "${scale[@]}" "${quiet[@]}" --spp "$reference_spp" \
    -o "$work/reference.exr"
  rm -f "$work"/*.seconds
  for ((r = 0; r < repeats; ++r)); do
    for integrator in photonmap exphotonmap; do
      seconds "$integrator" "$scenes/$integrator.pbrt" "${scale[@]}" --nthreads 1 \
        --set SurfaceIntegrator.rrthreshold=0 "$@" >>"$work/$integrator.seconds"
    done
  done
  for integrator in photonmap exphotonmap; do
    printf '%-22s %-13s %12s %10.5f %12s\n' "$label" "$integrator" \
      "$(median <"$work/$integrator.seconds")" "$(metric "$work/$integrator.exr" relMSE)" \
      "$(metric "$work/$integrator.exr" "relative mean error")"
  done
  paste "$work/exphotonmap.seconds" "$work/photonmap.seconds" | awk '{print 100 * $1 / $2}' |
    median | awk '{printf "exphotonmap takes %.1f %% of photonmap'\''s time\n", $1}'
}

# The published room has 450x270 pixels, 8 samples, 64 gather rays, 400000 photons, 75 an estimate.
speed() {
  printf '%-22s %-13s %12s %10s %12s\n' settings integrator "CPU seconds" relMSE "mean error %"
  pair "defaults, 128x96" 128 96
  pair "as published, 450x270" 450 270 --spp 8 --set SurfaceIntegrator.finalgathersamples=64 \
    --set SurfaceIntegrator.indirectphotons=400000 --set SurfaceIntegrator.nused=75
}

# A closed room with a million photons in each of two maps: every phase takes its time.
photon_room() {
  cat <<'SCENE'
Film "image" "integer xresolution" 256 "integer yresolution" 192
Sampler "lowdiscrepancy" "integer pixelsamples" 4
Camera "perspective" "float fov" 75
SurfaceIntegrator "exphotonmap" "integer causticphotons" 0 "integer indirectphotons" 1000000
WorldBegin
AttributeBegin
  AreaLightSource "area" "color L" [9 8 7]
  Translate 0 2 4
  Shape "sphere" "float radius" .4
AttributeEnd
Material "matte" "color Kd" [.7 .6 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3 4 6 5 4 7 6 0 5 1 0 4 5 2 7 3 2 6 7 1 6 2 1 5 6 0 3 7 0 7 4]
  "point P" [-4 -2 -1 4 -2 -1 4 -2 8 -4 -2 8 -4 3 -1 4 3 -1 4 3 8 -4 3 8]
WorldEnd
SCENE
}

# Seconds by the clock that each phase takes with one thread and with two, in turn.
threads() {
  local count r phase
  photon_room >"$work/room.pbrt"
  for ((r = 0; r < repeats; ++r)); do
    for count in 1 2; do
      "$program" render "$work/room.pbrt" "${quiet[@]}" --reproducible --nthreads $count \
        --stats-json "$work/json" -o "$work/threads-$count.exr"
      for phase in shoot "photon maps" radiance render; do
        grep -o "\"name\":\"$phase\",\"seconds\":[^,]*" "$work/json" | sed 's/.*://' \
          >>"$work/$phase-$count.times"
      done
    done
  done
  cmp "$work/threads-1.exr" "$work/threads-2.exr" && echo "1 and 2 threads: the same bytes"
  printf '%-10s %10s %10s %8s\n' phase "1 thread" "2 threads" ratio
  for phase in shoot "photon maps" radiance render; do
    printf '%-10s %10.3f %10.3f %8.2f\n' "$phase" "$(median <"$work/$phase-1.times")" \
      "$(median <"$work/$phase-2.times")" \
      "$(paste "$work/$phase-1.times" "$work/$phase-2.times" | awk '{print $1 / $2}' | median)"
  done
}

case "$what" in
  all) speed; threads ;;
  speed | threads) "$what" ;;
  *) echo "run.sh: unknown benchmark \"$what\": speed, threads" >&2; exit 1 ;;
esac
