#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# Draws which groups of files in integrators/photon/ include which, as the Mermaid diagram of
# architecture.md. Usage: photon_dependencies.sh [--check] [TOP]: writes the diagram into the page;
# --check only compares. Fails where an include does not go to a lower level.
set -euo pipefail
check=
[ "${1:-}" = --check ] && { check=yes; shift; }
top=${1:-$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)}
page=$top/docs/development/architecture.md

# Each line: level, group, its files. A file belongs to the first group that names it.
groups='7 integrator photon_integrator photon_pass photon_budget photon_stats
6 certificate certificate/
5 files files/
5 gather gather/
4 radiance radiance/
1 photon maps/photon.h maps/photon_distance.h maps/photon_time.h maps/rest_pose.h maps/signed_power.h
3 maps maps/
2 shooting shooting/
1 settings photon_settings'

edges() {
  cd "$top/integrators/photon"
  find . -name '*.h' -o -name '*.cpp' -o -name '*.inl' | sort | xargs awk -v table="$groups" '
    BEGIN {
      count = split(table, line, "\n")
    }
    function group_of(file,   i, j, n, word) {
      for (i = 1; i <= count; ++i) {
        n = split(line[i], word, " ")
        for (j = 3; j <= n; ++j)
          if (index(file, word[j]) == 1) { level[word[2]] = word[1]; return word[2] }
      }
      print "no group holds " file > "/dev/stderr"
      failed = 1
    }
    /^#include "integrators\/photon\// {
      split($0, part, "\"")
      to = group_of(substr(part[2], length("integrators/photon/") + 1))
      from = group_of(substr(FILENAME, 3))
      if (from == to) next
      if (level[to] >= level[from]) {
        print FILENAME " (" from ") includes " part[2] " (" to "), which is not below it" > "/dev/stderr"
        failed = 1
      }
      seen[level[from] " " from " --> " to] = 1
    }
    END {
      for (edge in seen) print edge
      exit failed
    }' | sort -k1,1nr -k2 | cut -d' ' -f2-
}

diagram() {
  echo '```mermaid'
  echo 'flowchart TD'
  while read -r level group files; do
    echo "    $group[\"<b>$group</b><br>${files// /, }\"]"
  done < <(sort -k1,1nr -k2 <<<"$groups")
  local found
  found=$(edges) || return 1
  sed 's/^/    /' <<<"$found"
  echo '```'
}

begin='<!-- photon_dependencies.sh: begin -->'
end='<!-- photon_dependencies.sh: end -->'
drawn=$(diagram)
now=$(sed -n "/^$begin\$/,/^$end\$/p" "$page" | sed '1d;$d')
[ "$drawn" = "$now" ] && exit 0
if [ "$check" ]; then
  echo "architecture.md does not show the includes: run docs/development/photon_dependencies.sh" >&2
  diff <(echo "$now") <(echo "$drawn") >&2
  exit 1
fi
new=$(mktemp)
awk -v begin="$begin" -v end="$end" -v drawn="$drawn" '
  $0 == end { skip = 0 }
  !skip { print }
  $0 == begin { print drawn; skip = 1 }' "$page" >"$new"
cat "$new" >"$page"
rm "$new"
