# Completion of @program@ for bash, which asks the program itself.
_@program@() {
  local IFS=$'\n' cur=${COMP_WORDS[COMP_CWORD]} word
  [[ $cur == = ]] && cur=
  COMPREPLY=()
  for word in $("$1" complete "${COMP_WORDS[@]:1:COMP_CWORD-1}" "$cur" 2>/dev/null); do
    if [[ $word == / ]]; then
      compopt -o filenames 2>/dev/null
      COMPREPLY+=($(compgen -f -- "$cur"))
    else
      [[ $word == *[.:=] ]] && compopt -o nospace 2>/dev/null
      COMPREPLY+=("$word")
    fi
  done
}
complete -F _@program@ @program@
