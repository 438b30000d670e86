# Completion of exphoton for bash. Options come from the program's own --help.
_exphoton() {
  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} program=${COMP_WORDS[0]}
  local commands="render explain plugins check-plugin info convert import denoise compare merge cluster photons quote budget study report help"
  COMPREPLY=()
  case "$word" in
    -*)
      case " $commands " in *" $command "*) ;; *) command=render ;; esac
      local options
      options=$("$program" "$command" --help 2>/dev/null | sed -n 's/^  \(-[^ ,]*\(, [^ ,]*\)*\).*/\1/p' |
        grep -oE -- '(^|[ ,])--?[a-zA-Z][a-z-]*' | tr -d ' ,')
      mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
      return
      ;;
  esac
  if [ "$COMP_CWORD" = 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")
  elif [ "$command" = plugins ]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" plugins 2>/dev/null |
      sed -n 's/^  \([a-z0-9]*\)  .*/\1/p')" -- "$word")
  fi
}
complete -o default -F _exphoton exphoton
