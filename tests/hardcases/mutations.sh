#!/usr/bin/env bash
# Puts ten deliberate defects into a copy of the sources, one at a time, and runs the cases that must
# notice: a suite that stays green with a defect in is no suite. Prints what caught each.
#   tests/hardcases/mutations.sh [NAME ...]
#   tests/hardcases/mutations.sh --texts    only looks whether the texts to replace are still there
# Works in build-mutations/, a clone with its own build; the sources here are not touched.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
copy=${MUTATION_COPY:-$top/build-mutations/src}
build=${MUTATION_BUILD:-$top/build-mutations/build}
jobs=${JOBS:-$(nproc)}

# name | file | text | what stands there instead | targets | cases
mutations=$(cat <<'TABLE'
density-as-probability|core/lights/light_distribution.cpp|choice.index, choice.probability,|choice.index, choice.probability * Real(lights_.size()),|exphoton|37
cosine-dropped|lights/area.cpp|Power() * stretched, sample.pdf,|Power() * stretched * (2 * Dot(w, Vector3(sample.point.ng))) * 2, sample.pdf,|exphoton|T1
cone-widened|integrators/photon/cone.h|return 2 * oneMinusCos_;|return 2 * (1 - Real(.999) * (1 - oneMinusCos_));|exphoton test_unit|81
mask-dropped|core/scattering/bsdf.cpp|value.pdf /= Real(Count(mask));|value.pdf /= Real(count_);|exphoton|34
k-for-k-minus-1|integrators/photon/photon_map.cpp|return {found.index.first(last), found.distance2.first(last), farthest2};|return {found.index, found.distance2, farthest2};|exphoton test_stat|68
reach-unlimited|integrators/photon/radiance_map.cpp|reach_(settings.radianceReach)|reach_(settings.radianceReach * 1000000)|exphoton|77
no-double-fallback|core/geometry/triangle_decide.h|const double du = c.x * b.y - c.y * b.x, dv = a.x * c.y - a.y * c.x, dw = b.x * a.y - b.y * a.x;|const double du = double(float(c.x) * float(b.y) - float(c.y) * float(b.x)), dv = double(float(a.x) * float(c.y) - float(a.y) * float(c.x)), dw = double(float(b.x) * float(a.y) - float(b.y) * float(a.x)); if (!(du * dw * dv != 0)) return std::nullopt;|exphoton test_unit|7
absolute-epsilon|core/geometry/ray.cpp|ray.o = OffsetRayOrigin(point, w);|ray.o = OffsetRayOrigin(point, w) + w * Real(1e-3);|exphoton|I1
stop-in-mid-batch|integrators/photon/photon_tracer.cpp|haul.paths = harvest.paths;|haul.paths = harvest.paths; if (std::int64_t(haul.photons.Size()) > targets.counts[m]) haul.paths = std::max(std::int64_t(1), haul.paths * (targets.counts[m] - 1) / targets.counts[m]);|exphoton|54
order-of-threads|integrators/photon/photon_chunk.cpp|for (std::size_t c = 0; c < chunks.size(); ++c) {|for (std::size_t k = 0, c; c = threads.Count() > 1 ? chunks.size() - 1 - k : k, k < chunks.size(); ++k) {|exphoton|I6
TABLE
)

if [ "${1:-}" = --texts ]; then
  missing=0
  while IFS='|' read -r name file text _; do
    grep -qF -- "$text" "$top/$file" || { echo "$name: its text is not in $file"; missing=1; }
  done <<<"$mutations"
  exit $missing
fi
if [ ! -d "$copy" ]; then
  git clone -q "$top" "$copy"
  cmake -S "$copy" -B "$build" -G Ninja -DEXPHOTON_OPTIMIZE=-O2 -DEXPHOTON_TESTS=ON >/dev/null
fi
ninja -C "$build" -j "$jobs" exphoton hardcases test_unit test_stat >/dev/null
missed=0
while IFS='|' read -r name file text instead targets cases; do
  [ $# = 0 ] || [[ " $* " == *" $name "* ]] || continue
  cp "$copy/$file" "$copy/$file.whole"
  TEXT=$text INSTEAD=$instead awk '
    BEGIN { text = ENVIRON["TEXT"]; instead = ENVIRON["INSTEAD"] }
    { at = index($0, text)
      if (at && !done) { $0 = substr($0, 1, at - 1) instead substr($0, at + length(text)); done = 1 }
      print }
    END { exit !done }' "$copy/$file.whole" >"$copy/$file" ||
    { mv "$copy/$file.whole" "$copy/$file"; echo "$name: its text is not in $file"; missed=1; continue; }
  if ! output=$(ninja -C "$build" -j "$jobs" $targets 2>&1); then
    echo "$name: does not compile"; printf '%s\n' "$output" | grep error | head -3; missed=1
  elif output=$("$build/bin/hardcases" --tests --only "$cases" --quiet); then
    echo "$name: NOT CAUGHT by case $cases"; missed=1
  else
    echo "$name: caught by case $cases: $(printf '%s\n' "$output" | grep '^      [^ ]' | head -1 | sed 's/^ *//')"
  fi
  mv "$copy/$file.whole" "$copy/$file"
  touch "$copy/$file"
done <<<"$mutations"
exit $missed
