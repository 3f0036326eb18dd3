#compdef petri
# petri's completion for zsh. `petri complete` prints candidates, and how to complete paths (src/main/complete_command.c).
_petri() {
    local line kind
    local -a candidates suffix
    for line in ${(f)"$(${~words[1]} complete "${(@Q)words[2,CURRENT-1]}" "${(Q)PREFIX}" 2>/dev/null)"}; do
        case $line in
        :nospace) suffix=(-S '') ;;
        :*) kind=$line ;;
        *) candidates+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}") ;;
        esac
    done
    _describe petri candidates "$suffix[@]"
    compset -P '--*='
    case $kind in
    :files) _files ;;
    :folders) _files -/ ;;
    :scripts) _files -g '*.(fl|petri)' ;;
    esac
}
if [[ $funcstack[1] == _petri ]]; then
    _petri "$@"
else
    compdef _petri petri
fi
