#!/usr/bin/env bash
# Installs into an empty prefix, runs the program from there, and builds the example plugin against
# the installation. With --package it unpacks the Debian package instead.
# Usage: install.sh SOURCE_DIR BUILD_DIR [--package]
set -euo pipefail
source_dir=$1 build_dir=$2 mode=${3:-}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
fail() { printf 'install.sh: %s\n' "$*" >&2; exit 1; }

if [ "$mode" = --package ]; then
  (cd "$build_dir" && cpack -G DEB -B "$scratch/package" >"$scratch/log" 2>&1) ||
    { cat log >&2; fail "cpack failed"; }
  dpkg-deb --field package/*.deb Depends | grep -q 'libc6' || fail "the package has no dependencies"
  dpkg-deb -x package/*.deb root
  prefix=$scratch/root/usr
else
  prefix=$scratch/prefix
  cmake --install "$build_dir" --prefix "$prefix" >log || { cat log >&2; fail "no installation"; }
fi

for file in bin/exphoton lib/libexphoton.so lib/exphoton/plugins/integrators/exphotonmap.so \
  lib/exphoton/plugins/filters/gaussian.so include/exphoton/core/plugin.h \
  lib/cmake/exphoton/exphotonConfig.cmake share/exphoton/scenes/furnace/path.pbrt \
  share/doc/exphoton/guide/getting-started.md share/doc/exphoton/copyright \
  share/man/man1/exphoton.1 share/bash-completion/completions/exphoton; do
  [ -e "$prefix/$file" ] || [ -e "$prefix/$file.gz" ] || fail "$file is missing"
done

# Nothing may lead back to the build folder or the sources.
while IFS= read -r file; do
  ! readelf -d "$file" | grep -E 'R(UN)?PATH' | grep -q "$build_dir" || fail "RPATH of $file"
done < <(find "$prefix" -name '*.so' -o -name exphoton -type f -path '*/bin/*')
! grep -rq "$source_dir" "$prefix/lib/cmake" || fail "the CMake package names the sources"

# As many plugins as the build has.
built=$(cd "$build_dir/plugins" && find . -name '*.so' | sort)
installed=$(cd "$prefix/lib/exphoton/plugins" && find . -name '*.so' | sort)
[ "$built" = "$installed" ] || fail "plugins differ: $(diff <(echo "$built") <(echo "$installed"))"

run() { env -i PATH=/usr/bin:/bin HOME="$scratch" "$prefix/bin/exphoton" "$@"; }
scene=$prefix/share/exphoton/scenes/furnace/path.pbrt
run render "$scene" --quick --quiet -o picture.exr || fail "the installed program does not render"
"$build_dir/bin/exphoton" render "$source_dir/scenes/furnace/path.pbrt" --quick --quiet -o built.exr
run compare built.exr picture.exr >log || { cat log; fail "the pictures differ"; }

# The program uses the plugins of the prefix: without one it fails.
mv "$prefix/lib/exphoton/plugins/integrators/path.so" .
! run render "$scene" --quick --quiet -o none.exr 2>log || fail "the plugins are not the prefix's"
grep -q 'path' log || fail "the message does not name the plugin"
mv path.so "$prefix/lib/exphoton/plugins/integrators/"

# Completion and manual know every command.
for command in render explain plugins check-plugin info convert import denoise compare study report; do
  grep -q "^\.B $command$" <(zcat -f "$prefix"/share/man/man1/exphoton.1*) ||
    fail "the manual lacks $command"
done
words=$(
  PATH=$prefix/bin:$PATH
  . "$prefix/share/bash-completion/completions/exphoton"
  COMP_WORDS=(exphoton compare --max) COMP_CWORD=2
  _exphoton
  echo "${COMPREPLY[*]}"
)
case " $words " in *" --max-mean "*) ;; *) fail "completion gives: $words" ;; esac
[ "$mode" != --package ] || exit 0

# A plugin of another project.
mkdir project
cp "$source_dir/tests/plugin/example/openness.cpp" project/
cat >project/CMakeLists.txt <<'TEXT'
cmake_minimum_required(VERSION 3.25)
project(my_plugins LANGUAGES CXX)
find_package(exphoton REQUIRED)
exphoton_add_plugin(openness integrator)
TEXT
cmake -S project -B project/build -DCMAKE_PREFIX_PATH="$prefix" >log || { cat log; fail "no CMake"; }
cmake --build project/build >log || { cat log; fail "the plugin does not build"; }
run render "$scene" --quick --quiet --integrator openness --plugin-dir project/build/plugins \
  -o openness.exr || fail "the plugin does not render"
! run render "$scene" --quick --quiet --integrator openness -o none.exr 2>log || fail "no need"
! cmake -S project -B project/wrong -DCMAKE_PREFIX_PATH=/nowhere >log 2>&1 || fail "found elsewhere"
