# shellcheck shell=bash
# Functions for install.sh: a folder that has only the files of a Debian package and of the packages
# that it depends on, and programs that run in it by chroot. So a dependency that the package does
# not name is missing there, although this machine has it.

# Prints the installed packages that a field Depends needs, directly and indirectly. Of
# alternatives, the first one that is installed counts.
dependencies_of() {
  dpkg-query -W -f='${Package}\t${Provides}\t${Pre-Depends}, ${Depends}\n' |
    awk -F'\t' -v wanted="$1" '
      function name(text) {
        gsub(/\([^)]*\)|:any|[ \n]/, "", text)
        return text
      }
      function add(list, groups, others, n, m, i, j, found) {
        n = split(list, groups, ",")
        for (i = 1; i <= n; ++i) {
          m = split(groups[i], others, "|")
          for (j = 1; j <= m; ++j) {
            found = name(others[j])
            if (!(found in depends) && found in provider) found = provider[found]
            if (found in depends) break
          }
          if (found in depends && !(found in taken)) {
            taken[found] = 1
            open[++last] = found
          }
        }
      }
      {
        depends[$1] = $3
        n = split($2, virtual, ",")
        for (i = 1; i <= n; ++i) provider[name(virtual[i])] = $1
      }
      END {
        add(wanted)
        for (at = 1; at <= last; ++at) {
          print open[at]
          add(depends[open[at]])
        }
      }'
}

# make_clean_root ROOT PACKAGE.deb DEPENDS: the pages of the packages are left out.
make_clean_root() {
  local root=$1 link file
  mkdir -p "$root/proc" "$root/tmp" "$root/usr"
  for link in bin sbin lib lib64; do  # links to usr/ in Debian 12
    [ ! -L "/$link" ] || { mkdir -p "$root/usr/$link" && ln -s "usr/$link" "$root/$link"; }
  done
  dependencies_of "$3" | sort >dependencies
  xargs dpkg-query -L <dependencies | grep -Ev '^/usr/share/(doc|man|locale|info)/' | sort -u |
    while IFS= read -r file; do
      [ ! -f "$file" ] || printf '%s\n' "${file#/}"
    done >files
  tar -C / -cf - --no-recursion -T files | tar -C "$root" -xf -
  dpkg-deb --fsys-tarfile "$2" | tar -C "$root" -xf -
}

# can_chroot: as root, or as root of a namespace of one's own.
can_chroot() {
  namespace=(unshare -m)
  [ "$(id -u)" = 0 ] && "${namespace[@]}" true 2>/dev/null && return
  namespace=(unshare -r -m)
  "${namespace[@]}" true 2>/dev/null
}

# in_root ROOT COMMAND ...: with /proc, because the program finds its plugins there.
in_root() {
  "${namespace[@]}" bash -c 'mount --rbind /proc "$1/proc" && cd "$1" && shift &&
    exec env -i PATH=/usr/bin:/usr/sbin HOME=/tmp chroot . "$@"' _ "$@"
}
