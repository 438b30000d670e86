#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# Builds the program by another compiler with -O1, and with geometry in double. Then runs the cases
# that compare the pictures of two builds: I13 and I14. The builds stay in BUILD_DIR/other.
# Usage: other_builds.sh SOURCE_DIR BUILD_DIR COMPILER, the latter as CMake names it: GNU or Clang
set -euo pipefail
source_dir=$1 build_dir=$2 compiler=$3
fail() { printf 'other_builds.sh: %s\n' "$*" >&2; exit 1; }

# build NAME [options of CMake]: the program with its plugins linked in.
build() {
  local folder=$build_dir/other/$1 launcher=()
  ! command -v ccache >/dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  mkdir -p "$folder"
  { cmake -S "$source_dir" -B "$folder" -G Ninja -DEXPHOTON_TESTS=OFF -DEXPHOTON_STATIC=ON \
    "${launcher[@]}" "${@:2}" &&
    ninja -C "$folder" -j "${JOBS:-$(nproc)}" exphoton; } >"$folder/log" 2>&1 ||
    { tail -n 40 "$folder/log" >&2; fail "the build \"$1\" failed"; }
}

other=(-DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DEXPHOTON_FAST_BUILD=OFF)
[ "$compiler" = GNU ] || other=(-DCMAKE_CXX_COMPILER=g++ -DCMAKE_C_COMPILER=gcc)
program=${other[0]#*=} name=other
if ! command -v "$program" >/dev/null; then
  printf 'other_builds.sh: there is no %s, so the compiler is the same\n' "$program" >&2
  name=same other=()
fi
build "$name" -DEXPHOTON_OPTIMIZE=-O1 "${other[@]}"
build double -DEXPHOTON_OPTIMIZE=-O2 -DEXPHOTON_DOUBLE=ON
export EXPHOTON_OTHER=$build_dir/other/$name/bin/exphoton
export EXPHOTON_DOUBLE=$build_dir/other/double/bin/exphoton
status=0
table=$("$build_dir/bin/hardcases" --only I13,I14) || status=$?
printf '%s\n' "$table"
for id in I13 I14; do
  grep -q "^$id  *pass " <<<"$table" || fail "$id did not pass"
done
exit $status
