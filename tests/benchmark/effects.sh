#!/usr/bin/env bash
# Measures what the plan of effects saves: CPU time with an effect against without it, in a small
# scene that needs it, and with the effect switched on for nothing against the plan in a plain
# diffuse scene. Usage: effects.sh PROGRAM [needed|idle|aimed|carried] (the first two without a name).
# Everything is measured in one run, in turn, and given as medians of ratios.
# "aimed": photons of distant lights that start towards visible points, against photons everywhere.
# "carried" counts instructions under callgrind instead: PROGRAM against MASKED, the program of a
# build with -DEXPHOTON_EFFECTS=2 (indirect light is its only effect), see docs/guide/effects.md.
set -euo pipefail
program=$1
what=${2:-all}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
repeats=${REPEATS:-7} size=${SIZE:-96}

photons='SurfaceIntegrator "exphotonmap" "integer causticphotons" 20000
  "integer indirectphotons" 10000 "integer finalgathersamples" 16'
path='SurfaceIntegrator "path"'
camera='Camera "perspective" "float fov" 90'
lamp='AttributeBegin AreaLightSource "area" "color L" [9 8 7] Translate 0 3 4
  Shape "sphere" "float radius" .6 AttributeEnd'
room='Material "matte" "color Kd" [.7 .6 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
  "point P" [-9 -2 -3 9 -2 -3 9 -2 9 -9 -2 9] "float uv" [0 0 30 0 30 30 0 30]
AttributeBegin Translate 0 0 8 Shape "disk" "float radius" 9 AttributeEnd'
sky='LightSource "infinite" "color L" [.2 .3 .4]'
glass='AttributeBegin Material "glass" Translate -.8 -.8 3.5
  Shape "sphere" "float radius" 1 AttributeEnd'
mirror='AttributeBegin Material "mirror" Translate 1 -.6 4.5
  Shape "sphere" "float radius" 1.2 AttributeEnd'
screen='AttributeBegin Material "translucent" Translate 0 0 5
  Shape "disk" "float radius" 2 AttributeEnd'
fog='Volume "homogeneous" "color sigma_a" [.02 .02 .02] "color sigma_s" [.03 .03 .03]
  "point p0" [-9 -2 0] "point p1" [9 4 8]'
moving='AttributeBegin Translate -1 -.8 4.5 ActiveTransform EndTime Translate 2 0 0
  Shape "sphere" "float radius" 1 AttributeEnd'
polished='Material "plastic" "color Kd" [.7 .6 .5] "string fresnel" "physical"'
checks='Texture "checks" "color" "checkerboard" Material "matte" "texture Kd" "checks"'

# scene NAME INTEGRATOR CAMERA WORLD: writes $work/NAME.pbrt.
scene() {
  printf '%s\n' "Film \"image\" \"integer xresolution\" $size \"integer yresolution\" $size" \
    'Sampler "lowdiscrepancy" "integer pixelsamples" 16' 'PixelFilter "box"' "$2" "$3" \
    WorldBegin "$4" WorldEnd >"$work/$1.pbrt"
}
# seconds SCENE EFFECTS: CPU seconds of a render on one thread.
seconds() {
  local TIMEFORMAT='%U'
  { time "$program" render "$work/$1.pbrt" --effects "$2" --nthreads 1 --quiet --no-progress \
    -o "$work/out.exr" 2>"$work/err"; } 2>"$work/time" || { cat "$work/err" >&2; exit 1; }
  cat "$work/time"
}
median() { sort -g | awk '{v[NR] = $1} END {print v[int((NR + 1) / 2)]}'; }

# compare LABEL SCENE WITH WITHOUT: one row; times in turn, their ratio with its extremes.
compare() {
  local r
  : >"$work/with" && : >"$work/without"
  for ((r = 0; r < repeats; ++r)); do
    seconds "$2" "$3" >>"$work/with"
    seconds "$2" "$4" >>"$work/without"
  done
  paste "$work/with" "$work/without" | awk '{print $1 / $2}' | sort -g >"$work/ratios"
  printf '%-28s %8s %8s %7.3f  (%.3f to %.3f)\n' "$1" "$(median <"$work/with")" \
    "$(median <"$work/without")" "$(median <"$work/ratios")" "$(head -n 1 "$work/ratios")" \
    "$(tail -n 1 "$work/ratios")"
}

needed() {
  scene caustics "$photons" "$camera" "$lamp $glass $mirror $room"
  scene indirect "$photons" "$camera" "$lamp $room"
  scene transmission "$photons" "$camera" "$lamp $screen $room"
  scene glossy "$photons" "$camera" "$lamp $polished ${room#*\]}"
  scene specular "$path" "$camera" "$lamp $glass $mirror $room"
  scene media "$path" "$camera" "$lamp $fog $room"
  printf '%s\n' 'VolumeIntegrator "single"' >"$work/march"
  cat "$work/march" "$work/media.pbrt" >"$work/single.pbrt"
  scene filtering "$path" "$camera" "$lamp $checks ${room#*\]}"
  scene lens "$path" "$camera \"float lensradius\" .1 \"float focaldistance\" 4" "$lamp $room"
  scene environment "$path" "$camera" "$sky $lamp $room"
  scene motion "$path" "$camera" "$lamp $moving $room"
  printf '%-28s %8s %8s %7s\n' "needed by the scene" on off on/off
  local effect
  for effect in caustics indirect transmission glossy specular media; do
    compare "$effect" "$effect" auto "$effect=off"
  done
  compare "media, single scattering" single auto media=off
  for effect in filtering lens motion environment; do
    compare "$effect" "$effect" auto "$effect=off"
  done
}

idle() {
  scene photons "$photons" "$camera" "$lamp $room"
  scene path "$path" "$camera" "$lamp $room"
  local effect integrator
  for integrator in photons path; do
    printf '%-28s %8s %8s %7s\n' "for nothing, $integrator" on plan on/plan
    if [ "$integrator" = photons ]; then  # caustic photons are shot only where mirrors count, too
      compare "caustics, specular" "$integrator" caustics=on,specular=on auto
      compare transmission "$integrator" transmission=on auto
    fi
    for effect in specular glossy media filtering lens motion environment; do
      compare "$effect" "$integrator" "$effect=on" auto
    done
    compare "all" "$integrator" all auto
    compare "none (noise)" "$integrator" auto auto
  done
}

# instructions PROGRAM SCENE SPP: retired by a run of the program.
instructions() {
  valgrind --tool=callgrind --callgrind-out-file="$work/callgrind" "$1" render "$work/$2.pbrt" \
    --spp "$3" --nthreads 1 --quiet --no-progress -o "$work/out.exr" 2>&1 |
    awk '/Collected/ {print $NF}'
}
# Camera rays alone are the difference of two runs, with 16 and with 4 samples a pixel.
carried() {
  size=${SIZE:-24}
  scene photons "$photons" "$camera" "$lamp $room"
  scene path "$path" "$camera" "$lamp $room"
  local integrator spp which
  printf '%-28s %14s %14s %9s\n' "instructions" "all effects" "indirect only" more
  for integrator in photons path; do
    for spp in 4 16; do
      for which in "$program" "${MASKED:?names the program without the effects}"; do
        instructions "$which" "$integrator" "$spp"
      done
    done | paste - - - - | awk -v name="$integrator" '
      function row(label, a, b) {
        printf "%-28s %14d %14d %+8.3f%%\n", name ", " label, a, b, 100 * (a / b - 1)
      }
      {row("whole run", $3, $4); row("12 samples a pixel", $3 - $1, $4 - $2)}'
  done
}

# A hut on plains of several sizes, under sun and sky, open towards the camera.
hut() {
  printf '%s\n' 'LightSource "distant" "point from" [-3 -6 5] "point to" [0 0 0] "color L" [10 9 8]' \
    'LightSource "infinite" "color L" [.5 .7 1] Material "matte" "color Kd" [.45 .42 .38]' \
    "Shape \"disk\" \"float radius\" $1" 'Material "matte" "color Kd" [.8 .78 .75]' \
    'Shape "trianglemesh" "integer indices" [0 1 2 0 2 3 2 3 4 2 4 5 0 3 4 0 4 6 1 2 5 1 5 7]' \
    '  "point P" [-3 -3 3 3 -3 3 3 3 3 -3 3 3 -3 3 0 3 3 0 -3 -3 0 3 -3 0]'
}
# error SCENE: its relMSE against $work/path.exr and the error of its mean, of the last render.
errors() {
  "$program" compare "$work/path.exr" "$work/out.exr" | awk '
    /^relMSE/ {a = $2} /^relative mean/ {b = $4} END {printf "%9.4f %+7.2f %%", a, b}' || true
}
aimed() {
  local look='LookAt 0 -9 2  0 0 1.5  0 0 1' radius aim
  printf '%-8s %-4s %8s %9s %9s\n' plain aim seconds relMSE mean
  for radius in 10 100 1000; do
    scene path 'SurfaceIntegrator "path" "integer maxdepth" 40' "$look $camera" "$(hut $radius)"
    "$program" render "$work/path.pbrt" --spp "${REFERENCE_SPP:-1024}" --quiet --no-progress --float \
      -o "$work/path.exr"
    for aim in off on; do
      scene hut "SurfaceIntegrator \"exphotonmap\" \"string photonaim\" \"$aim\"" "$look $camera" \
        "$(hut $radius)"
      printf '%-8s %-4s %8s %s\n' "$radius m" $aim "$(seconds hut auto)" "$(errors || true)"
    done
  done
}

case "$what" in
  all) needed; idle ;;
  needed | idle | aimed | carried) "$what" ;;
  *) echo "effects.sh: unknown part \"$what\": needed, idle, aimed, carried" >&2; exit 1 ;;
esac
