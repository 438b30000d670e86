# Sourced by run.sh: `run.sh --soak LIST [NAME ...]` asks how soon the random scenes find a defect.
# LIST has a name of a defect in each line, or several with a + between them, which are put in
# together. The rest of a line is a remark. Prints the number of scenes until the soak finds the
# defect, and the property that it breaks.
#   SOAK_SCENES  most scenes for a defect (default 300)
#   SOAK_SEED    the first seed (default 9000001)
#   SOAK_ONLY    properties, which are tried one after the other, each alone (default: all together)
#   SOAK_SECONDS the time for a property (default 900)
soak_scenes=${SOAK_SCENES:-300}
soak_seed=${SOAK_SEED:-9000001}

# Fills soak_lines with the lines of the list that are chosen: "name" or "name+name".
read_soak_list() {  # LIST NAME ...
  local list=$1 word rest
  shift
  soak_lines=()
  while read -r word rest; do
    case "$word" in '' | '#'* | '-' | '+' | '!') continue ;; esac
    if [ $# = 0 ] || [[ " $* " == *" $word "* ]]; then soak_lines+=("$word"); fi
  done <"$list"
}

# Leaves only the defects of the list, so that nothing else is compiled.
keep_listed() {
  local i word wanted=" " kept=()
  for word in "${soak_lines[@]}"; do wanted+="${word//+/ } "; done
  for ((i = 0; i < count; ++i)); do
    if [[ "$wanted" == *" ${names[i]} "* ]]; then kept+=("$i"); fi
  done
  for word in $wanted; do
    [[ " ${names[*]} " == *" $word "* ]] || { echo "no defect is called $word" >&2; exit 1; }
  done
  keep names "${kept[@]}"
  keep files "${kept[@]}"
  keep texts "${kept[@]}"
  keep insteads "${kept[@]}"
  all=${#names[@]}
}
keep() {  # ARRAY INDEX ...
  local -n array=$1
  local chosen=() i
  shift
  for i in "$@"; do chosen+=("${array[i]}"); done
  array=("${chosen[@]}")
}

soak_one() {  # LINE: the switches of its defects, and the result of the soak
  local line=$1 i switches= result property only
  for ((i = 0; i < all; ++i)); do
    [[ "+$line+" == *"+${names[i]}+"* ]] || continue
    if [ -z "${flags[$i]:-}" ]; then echo "$line: does not compile with the others"; return; fi
    switches+=${switches:+,}${flags[$i]}
  done
  for property in ${SOAK_ONLY:-all}; do
    [ "$property" = all ] && only=() || only=(--only "$property")
    result=$(cd "$build" && EXPHOTON_DEFECTS=$switches timeout "${SOAK_SECONDS:-900}" bin/soak \
      --seed "$soak_seed" --scenes "$soak_scenes" --until-failure "${only[@]}" 2>&1 | tail -n 1) || true
    echo "$line: ${SOAK_ONLY:+$property: }${result:-did not end, or crashed}"
    case "$result" in "found after"*) return ;; esac
  done
}

run_soak() {
  copy_sources
  configure
  echo "building with ${#names[@]} defects"
  build_together exphoton plugins soak
  local line
  for line in "${soak_lines[@]}"; do
    while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
    soak_one "$line" &
  done
  wait
  echo "$((SECONDS / 60)) min $((SECONDS % 60)) s"
}
