#!/usr/bin/env bash
# Renders every scene of scenes/ with two programs, at low resolution, and compares the pictures
# byte for byte: with the scene's own integrator, and some scenes with every integrator and
# accelerator. For changes that must not change a pixel. Usage: same_pixels.sh OLD NEW (programs).
set -euo pipefail
old=$(realpath "$1") new=$(realpath "$2")
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
compared=0 different=0 input=

# same NAME [options]: one picture by both.
same() {
  local name=$1
  shift
  local program
  for program in old new; do
    "${!program}" render "$@" --quick --quiet --reproducible -o "$work/$program.exr" \
      <"${input:-/dev/null}" 2>"$work/$program.txt" || true
  done
  compared=$((compared + 1))
  if ! cmp -s "$work/old.exr" "$work/new.exr" &&
    ! "$new" compare "$work/old.exr" "$work/new.exr" >/dev/null 2>&1; then
    different=$((different + 1))
    echo "differs: $name"
    cat "$work/new.txt"
  fi
  rm -f "$work"/*.exr
}

scenes=$(grep -l WorldBegin "$top"/scenes/*/*.pbrt)
for scene in $scenes; do same "${scene#"$top"/}" "$scene"; done
for scene in "$top"/scenes/{cornell-caustic,glossy-room,skylight-room,moving-spheres}/exphotonmap.pbrt; do
  [ -f "$scene" ] || continue
  for integrator in exphotonmap photonmap path directlighting whitted; do
    same "${scene#"$top"/} $integrator" "$scene" --integrator $integrator --nthreads 1
  done
  # The changed scene comes from standard input, so that its includes are found from its folder.
  for accelerator in bvh kdtree embree; do
    sed "1i Accelerator \"$accelerator\"" "$scene" >"$work/scene.pbrt"
    cd "$(dirname "$scene")"
    input=$work/scene.pbrt same "${scene#"$top"/} $accelerator" - --spp 1
    cd "$top"
  done
done
echo "$compared pictures compared, $different differ"
[ "$different" = 0 ]
