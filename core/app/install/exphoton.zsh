#compdef exphoton
# Completion of exphoton for zsh: commands, options from the program's own --help, and files.
_exphoton() {
  local -a commands options
  commands=(render explain plugins check-plugin info convert import denoise compare merge cluster photons quote budget study report help)
  local command=${words[2]}
  (( ${commands[(Ie)$command]} )) || command=render
  if [[ ${words[CURRENT]} == -* ]]; then
    options=(${(f)"$(${words[1]} $command --help 2>/dev/null | sed -n 's/^  \(-[^ ,]*\(, [^ ,]*\)*\).*/\1/p' |
      grep -oE -- '(^|[ ,])--?[a-zA-Z][a-z-]*' | tr -d ' ,')"})
    compadd -a options
    return
  fi
  (( CURRENT == 2 )) && compadd -a commands
  _files
}
_exphoton "$@"
