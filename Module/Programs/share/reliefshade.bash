# Completion for reliefshade. Options and their choices are those that the program's help lists.
_reliefshade()
{
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} help choices
  help=$("$1" --help 2>/dev/null)
  COMPREPLY=()
  if [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$(grep -oE -- '^ +-[^ ]+' <<< "$help" | tr ',' ' ')" -- "$cur"))
    return
  fi
  # "--offset vertical|normal": words between bars, without what stands in brackets.
  choices=$(grep -E -- "^ +$prev [a-z0-9-]+\|" <<< "$help" | awk '{ print $2 }' | sed 's/\[[^]]*\]//g')
  if [[ $prev == -* && -n $choices ]]; then
    COMPREPLY=($(compgen -W "${choices//|/ }" -- "$cur"))
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$cur")
  fi
}
complete -F _reliefshade reliefshade
