#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# Makes the reference pictures of tests/images/ anew, by path tracing: two halves of each scene with
# different seeds, whose difference measures the noise of their mean. Writes them and README.md here.
#     tests/images/references/make.sh [path of the program, default build/bin/exphoton]
# About 7 minutes of one core. The pictures do not depend on the number of threads.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
top=$(cd "$here/../../.." && pwd)
program=$(realpath "${1:-$top/build/bin/exphoton}")
threads=${THREADS:-1}
seeds=([0]=101 [1]=202)
size=(--set Film.xresolution=64 --set Film.yresolution=48)
depth=(--set SurfaceIntegrator.maxdepth=200)
cd "$top"
rows=$(mktemp)
trap 'rm -f "$rows"' EXIT

# reference NAME FILE SAMPLES: scenes/FILE.pbrt twice, to NAME-a.exr and NAME-b.exr.
reference() {
  local name=$1 scene=scenes/$2.pbrt samples=$3 letters=(a b) half seconds=()
  for half in 0 1; do
    local TIMEFORMAT='%U'
    seconds[half]=$({ time "$program" render "$scene" "${size[@]}" "${depth[@]}" \
      --spp "$samples" --seed "${seeds[half]}" --nthreads "$threads" --float --reproducible \
      --quiet -o "$here/$name-${letters[half]}.exr" >&2; } 2>&1)
  done
  "$program" compare "$here/$name-a.exr" "$here/$name-b.exr" |
    awk -v name="$name" -v scene="$scene" -v samples="$samples" \
      -v seconds="${seconds[0]} + ${seconds[1]}" '
      /^MSE/ { mse = $2 } /^relMSE/ { rel = $2 } /^mean of reference/ { mean = $4 }
      /^relative mean/ { error = $4 }
      END { printf "| `%s` | `%s` | %d | %s | %.5g | %.2e | %.2e | %+.3f %% |\n",
            name, scene, samples, seconds, mean, mse / 4, rel / 4, error }' >>"$rows" || true
  tail -n 1 "$rows" >&2
}

reference skylight-room skylight-room/emitters 1024
reference cornell-caustic cornell-caustic/path 4096
reference glossy-room glossy-room/path 2048
reference glossy-floor-room glossy-floor-room/path 16384
reference furnace furnace/path 1024
reference veach-mis veach-mis/path 2048
reference moving-spheres moving-spheres/path 1024

{
  cat <<'TEXT'
# References

Pictures of our scenes by path tracing, for the tests in [tests/images](../images): two halves of each, `NAME-a.exr` and
`NAME-b.exr`, that differ in the seed alone. Tests compare with the mean of both, and take its variance in each pixel from their
difference, ((a - b) / 2)². Written by [make.sh](make.sh), which is how to remake them:

TEXT
  echo "    ./dev build && tests/images/references/make.sh"
  echo
  echo "For half a (seed ${seeds[0]}) and half b (seed ${seeds[1]}) of each scene it calls"
  echo
  echo "    exphoton render SCENE ${size[*]} \\"
  echo "        ${depth[*]} --spp SAMPLES --seed SEED \\"
  echo "        --float --reproducible -o NAME-a.exr"
  cat <<'TEXT'

Everything else is what the scene says: its sampler, filter, materials. `skylight-room` is taken from its variant `emitters.pbrt`,
in which an area light replaces the sunlit patch on the wall; path tracing does not converge on the sun itself.

| name | scene | samples a pixel, each half | seconds (CPU) | mean | noise of the mean of both: MSE | relMSE | b - a in the mean |
| --- | --- | --- | --- | --- | --- | --- | --- |
TEXT
  cat "$rows"
  cat <<'TEXT'

Noise is mean((a - b)²) / 4, with the definitions of `exphoton compare`. Against the relMSE of `exphotonmap` at 4 samples a pixel and 20000
caustic photons it is 1 % or less in `skylight-room` (.017), `glossy-room` (.033) and `veach-mis` (.018); about 10 % in
`cornell-caustic` (.026), where path tracing finds caustics by chance, and 20 % in `furnace` (.0003), where hardly any error is left to
measure. Tests therefore add the reference's noise to the half-width of every interval.
TEXT
} >"$here/README.md"
