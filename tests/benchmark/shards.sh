#!/usr/bin/env bash
# shards.sh PROGRAM: what shards cost. It renders a picture with photons from a file, by one process
# with two threads and by two shards of one thread at the same time, in turn, and prints the ratio
# of the wall times. Then it renders a picture of 3840 x 2160 pixels (32,400 tiles) in 8 shards and
# prints time and memory of the merge.
#   REPEATS=5   pairs of renders
set -euo pipefail
program=$(realpath "$1")
scene=$(realpath "$(dirname "$0")/../../scenes/cornell-caustic/exphotonmap.pbrt")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
options=("$scene" --quiet --no-progress --reproducible --resolution 256x192 --spp 16
  --photons photons.expm)
now() { date +%s.%N; }

"$program" photons "$scene" -o photons.expm --quiet --no-progress
echo "pair   one process, s   two shards, s   ratio"
ratios=()
for pair in $(seq "${REPEATS:-5}"); do
  rm -rf parts
  a=$(now)
  "$program" "${options[@]}" --nthreads 2 -o one.exr
  b=$(now)
  "$program" "${options[@]}" --nthreads 1 --shard 1/2 -o parts/ &
  "$program" "${options[@]}" --nthreads 1 --shard 2/2 -o parts/
  wait
  c=$(now)
  "$program" merge parts/ -o merged.exr --quiet --reproducible
  cmp one.exr merged.exr
  ratio=$(awk "BEGIN {print ($c - $b) / ($b - $a)}")
  ratios+=("$ratio")
  awk "BEGIN {printf \"%4d %16.2f %15.2f %7.3f\n\", $pair, $b - $a, $c - $b, $ratio}"
done
printf '%s\n' "${ratios[@]}" | sort -n |
  awk '{r[NR] = $1} END {printf "median ratio %.3f (%.3f to %.3f)\n", r[int((NR + 1) / 2)], r[1], r[NR]}'

large=("$scene" --quiet --no-progress --reproducible --resolution 3840x2160 --spp 1
  --integrator directlighting)
rm -rf parts
"$program" "${large[@]}" -o one.exr --stats-json one.json
for shard in $(seq 8); do "$program" "${large[@]}" --shard "$shard/8" -o parts/; done
/usr/bin/env python3 - "$program" <<'P'
import json, os, resource, subprocess, sys, time
begin = time.time()
subprocess.run([sys.argv[1], "merge", "parts/", "-o", "merged.exr", "--quiet", "--reproducible"], check=True)
seconds = time.time() - begin
used = resource.getrusage(resource.RUSAGE_CHILDREN)
one = json.loads(open("one.json").readline())
print(f"merge of 3840 x 2160 pixels in 8 parts: {seconds:.1f} s, {used.ru_utime + used.ru_stime:.1f} CPU s, "
      f"{used.ru_maxrss / 1024:.0f} MB")
print("parts:", sum(os.path.getsize("parts/" + name) for name in os.listdir("parts")) // 2**20, "MB")
P
cmp one.exr merged.exr
