#compdef @program@
# Completion of @program@ for zsh, which asks the program itself.
_@program@() {
  local word
  for word in ${(f)"$($words[1] complete "${(@)words[2,CURRENT]}" 2>/dev/null)"}; do
    case $word in
      /) _files ;;
      *[.:=]) compadd -S '' -- $word ;;
      *) compadd -- $word ;;
    esac
  done
}
# A folder of functions calls this file at the first completion; `source` only tells of it.
if [[ $funcstack[1] == _@program@ ]]; then _@program@ "$@"; else compdef _@program@ @program@; fi
