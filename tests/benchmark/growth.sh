#!/usr/bin/env bash
# Measures how cost grows: CPU seconds and memory of whole renders against triangles, photons,
# lights, gather rays and pixels, one thread, each axis with the others fixed; and the exponent that
# fits best (least squares of the logarithms, over the upper half of the axis, where what grows
# dominates). Usage: growth.sh PROGRAM [AXIS...], axes: triangles photons lights gather pixels.
set -euo pipefail
program=$1
shift
axes=("$@")
[ ${#axes[@]} -gt 0 ] || axes=(triangles photons lights gather pixels)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
largest=${LARGEST:-1000000}  # triangles and photons

room='Material "matte" "color Kd" [.7 .6 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3 4 6 5 4 7 6 0 5 1 0 4 5 2 7 3 2 6 7 1 6 2 1 5 6 0 3 7 0 7 4]
  "point P" [-4 -2 -1 4 -2 -1 4 -2 8 -4 -2 8 -4 3 -1 4 3 -1 4 3 8 -4 3 8]'
lamp='AttributeBegin AreaLightSource "area" "color L" [9 8 7] Translate 0 2 4
  Shape "sphere" "float radius" .4 AttributeEnd'
body='AttributeBegin Material "plastic" Translate 0 -1 4 Scale 1.3 1.3 1.3
  Shape "loopsubdiv" "integer indices" [0 1 2 0 3 1 0 2 3 1 3 2]
  "point P" [1 1 1 -1 -1 1 -1 1 -1 1 -1 -1] "integer nlevels"'
extended='SurfaceIntegrator "exphotonmap" "integer causticphotons" 0'

# run SIZE SAMPLES INTEGRATOR WORLD: renders, and leaves times and memory in $work/json.
run() {
  printf '%s\n' "Film \"image\" \"integer xresolution\" $1 \"integer yresolution\" $1" \
    "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" $2" 'PixelFilter "box"' \
    'Camera "perspective" "float fov" 75' "$3" WorldBegin "$4" WorldEnd >"$work/scene.pbrt"
  "$program" render "$work/scene.pbrt" --nthreads 1 --quiet --no-progress --stats-json "$work/json" \
    -o "$work/out.exr" || exit 1
}
# phase NAME: its CPU seconds in the last run, 0 where it does not occur.
phase() {
  grep -o "\"name\":\"$1\",[^}]*" "$work/json" | sed 's/.*"cpuSeconds"://' | head -n 1 | grep . || echo 0
}
memory() { grep -o '"peakMemoryBytes":[0-9]*' "$work/json" | sed 's/.*://'; }

# Column 1 is the axis; prints the rows and, below, the fitted exponents of the other columns.
fit() {
  awk '
    NR == 1 {print; columns = NF; next}
    {rows++; for (i = 1; i <= columns; ++i) v[rows, i] = $i; line = $1
     for (i = 2; i <= columns; ++i) line = line sprintf(" %.4g", $i); print line}
    END {
      line = "exponent"
      for (i = 2; i <= columns; ++i) {
        n = sx = sy = sxx = sxy = 0
        for (r = int(rows / 2) + 1; r <= rows; ++r) {
          if (v[r, i] <= 0) continue
          x = log(v[r, 1]); y = log(v[r, i]); ++n; sx += x; sy += y; sxx += x * x; sxy += x * y
        }
        d = n * sxx - sx * sx
        line = line (n > 1 && d > 0 ? sprintf(" %.2f", (n * sxy - sx * sy) / d) : " -")
      }
      print line
    }' | column -t
}

triangles() {
  local level count
  echo triangles read build path bytes
  for level in 4 5 6 7 8 9 10 11; do
    count=$((4 ** (level + 1)))
    [ $count -le $((largest * 8)) ] || break
    run 96 16 'SurfaceIntegrator "path"' "$lamp $room $body $level AttributeEnd"
    echo "$count $(phase parse) $(phase accelerator) $(phase render) $(memory)"
  done
}
photons() {
  local count
  echo photons shoot trees radiance render bytes
  for ((count = 10000; count <= largest * 10; count *= 10)); do
    run 64 4 "$extended \"integer indirectphotons\" $count \"integer maxphotonpaths\" 2000000000" \
      "$lamp $room"
    echo "$count $(phase shoot) $(phase "photon maps") $(phase radiance) $(phase render) $(memory)"
  done
}
# lamps COUNT: this number of small lamps with the same total power, on a square under the ceiling.
lamps() {
  awk -v n="$1" 'BEGIN {
    side = int(sqrt(n - 1)) + 1
    for (i = 0; i < n; ++i)
      printf "LightSource \"point\" \"color I\" [%g %g %g] \"point from\" [%g 2.5 %g]\n",
        9 / n, 8 / n, 7 / n, 7 * ((i % side) + .5) / side - 3.5, 7 * (int(i / side) + .5) / side
  }'
}
lights() {
  local count
  echo lights shoot exphotonmap path near
  for count in 1 3 10 30 100 300 1000 3000 10000; do
    run 64 4 "$extended \"integer indirectphotons\" 20000" "$(lamps $count) $room"
    local shoot extendedSeconds pathSeconds
    shoot=$(phase shoot) extendedSeconds=$(phase render)
    run 64 16 'SurfaceIntegrator "path"' "$(lamps $count) $room"
    pathSeconds=$(phase render)
    run 64 64 'SurfaceIntegrator "directlighting" "string strategy" "near"' "$(lamps $count) $room"
    echo "$count $shoot $extendedSeconds $pathSeconds $(phase render)"
  done
}
gather() {
  local count
  echo rays render
  for count in 8 16 32 64 128 256 512; do
    run 64 4 "$extended \"integer indirectphotons\" 50000 \"integer finalgathersamples\" $count" \
      "$lamp $room"
    echo "$count $(phase render)"
  done
}
pixels() {
  local side
  echo pixels render write bytes
  for side in 32 64 128 256 512 1024; do
    run $side 4 'SurfaceIntegrator "path"' "$lamp $room"
    echo "$((side * side)) $(phase render) $(phase write) $(memory)"
  done
}

for axis in "${axes[@]}"; do
  case "$axis" in
    triangles | photons | lights | gather | pixels) "$axis" | fit && echo ;;
    *) echo "growth.sh: unknown axis \"$axis\": triangles, photons, lights, gather, pixels" >&2; exit 1 ;;
  esac
done
