#!/usr/bin/env bash
# Installs into an empty prefix, runs the program from there, and builds the example plugins against
# the installation. With --package it unpacks the Debian package instead, and runs it again in a
# folder that has only the packages that it depends on. It exits with 77 where that is not possible,
# and writes the reason into BUILD_DIR/package_test.skipped.
# Usage: install.sh SOURCE_DIR BUILD_DIR [--package [NAME]]
# NAME is a package that is taken out of the dependencies: the test must fail then.
set -euo pipefail
source_dir=$1 build_dir=$2 mode=${3:-} without=${4:-}
. "$source_dir/tests/install/clean_root.sh"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
fail() { printf 'install.sh: %s\n' "$*" >&2; exit 1; }
skip() {
  printf 'install.sh: SKIPPED: %s\n' "$*" >&2
  printf '%s\n' "$*" >"$build_dir/package_test.skipped"
  exit 77
}

if [ "$mode" = --package ]; then
  rm -f "$build_dir/package_test.skipped"
  for tool in dpkg-shlibdeps dpkg-deb cpack; do
    command -v "$tool" >/dev/null || skip "no Debian package can be made without $tool"
  done
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
  share/man/man1/exphoton.1 share/bash-completion/completions/exphoton \
  share/zsh/vendor-completions/_exphoton; do
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

# The manual and the completions of both shells know the commands that --help lists, and no other.
commands=$(run --help | sed -n '/^Commands/,/^$/s/^  exphoton \[\{0,1\}\([a-z-]*\).*/\1/p' | sort)
for command in render merge cluster photons quote budget report; do
  grep -qx -- "$command" <<<"$commands" || fail "--help does not list $command"
done
manual=$(zcat -f "$prefix"/share/man/man1/exphoton.1* |
  sed -n '/^\.SH COMMANDS/,/^\.PP/p' | grep -A 1 '^\.TP' | sed -n 's/^\.B //p' | sort) ||
  fail "the manual has no commands"
same() {  # same WHAT EXPECTED FOUND
  [ "$2" = "$3" ] || fail "the commands of $1 differ: $(diff <(echo "$2") <(echo "$3"))"
}
same 'the manual' "$commands" "$manual"
complete_in_bash() {
  PATH=$prefix/bin:$PATH
  . "$prefix/share/bash-completion/completions/exphoton"
  COMP_WORDS=(exphoton "$@") COMP_CWORD=$#
  _exphoton
  printf '%s\n' "${COMPREPLY[@]}"
}
completed=$(printf '%s\n' help "$commands" | sort)
same bash "$completed" "$(complete_in_bash "" | sort)"
same zsh "$completed" "$(sed -n 's/^ *commands=(\(.*\))$/\1/p' \
  "$prefix/share/zsh/vendor-completions/_exphoton" | tr ' ' '\n' | sort)"
for command in $commands; do
  words=$(complete_in_bash "$command" --he)
  [ "$words" = --help ] || fail "bash completes --he of $command as: $words"
done
words=$(complete_in_bash compare --max)
grep -qx -- --max-mean <<<"$words" || fail "completion gives: $words"
twice=$(complete_in_bash render -- | sort | uniq -d)
[ -z "$twice" ] || fail "bash completes options twice: $twice"

if [ "$mode" = --package ]; then
  can_chroot || skip "the package did not run without the libraries of this machine, because this \
user may neither chroot nor unshare -r"
  depends=$(dpkg-deb --field package/*.deb Depends)
  [ -z "$without" ] || depends=$(tr ',' '\n' <<<"$depends" | grep -v "^ *$without" | paste -sd,)
  make_clean_root clean package/*.deb "$depends"
  in_root clean exphoton --version >log || fail "the package does not start with its dependencies"
  in_root clean exphoton plugins >log 2>&1 || { cat log; fail "a plugin does not load"; }
  diff <(run plugins) log || fail "the package lists other plugins with its dependencies alone"
  in_root clean exphoton render /usr/share/exphoton/scenes/furnace/path.pbrt --quick --quiet \
    -o /tmp/picture.exr || fail "the package does not render"
  cp clean/tmp/picture.exr clean.exr
  run compare built.exr clean.exr >log || { cat log; fail "the picture of the package differs"; }
  # Without a library nothing runs, so the libraries of this machine are out of reach.
  find clean -name 'libOpenEXR-*' -delete
  ! in_root clean exphoton --version >log 2>&1 || fail "libraries come from elsewhere"
  exit 0
fi

# Plugins of another project.
mkdir project
cp "$source_dir"/tests/plugin/example/{openness,velvet}.cpp project/
cat >project/CMakeLists.txt <<'TEXT'
cmake_minimum_required(VERSION 3.25)
project(my_plugins LANGUAGES CXX)
find_package(exphoton REQUIRED)
exphoton_add_plugin(openness integrator)
exphoton_add_plugin(velvet material)
TEXT
cmake -S project -B project/build -DCMAKE_PREFIX_PATH="$prefix" >log || { cat log; fail "no CMake"; }
cmake --build project/build >log || { cat log; fail "the plugins do not build"; }
run render "$scene" --quick --quiet --integrator openness --plugin-dir project/build/plugins \
  -o openness.exr || fail "the plugin does not render"
! run render "$scene" --quick --quiet --integrator openness -o none.exr 2>log || fail "no need"
run check-plugin velvet --plugin-dir project/build/plugins >log || { cat log; fail "wrong velvet"; }
grep -q 'material "velvet": all .* checks passed' log || { cat log; fail "velvet is not checked"; }
! cmake -S project -B project/wrong -DCMAKE_PREFIX_PATH=/nowhere >log 2>&1 || fail "found elsewhere"
