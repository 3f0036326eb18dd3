# petri's completion for bash. `petri complete` prints candidates, and how to complete paths (src/main/complete_command.c).
_petri() {
    local line words
    # The x keeps a last word that is still empty. Without -r, `read` removes the backslashes before blanks in names.
    # bash splits words at "=", petri does not.
    # shellcheck disable=SC2162
    read -a words <<<"${COMP_LINE:0:COMP_POINT}x"
    local word=${words[-1]%x}
    local current=${word##*=}
    local before=${word%"$current"}
    words[-1]=$word
    COMPREPLY=()
    while IFS= read -r line; do
        case $line in
        :nospace) compopt -o nospace ;;
        :files) compopt -o filenames && mapfile -t COMPREPLY < <(compgen -f -- "$current") ;;
        :folders) compopt -o filenames && mapfile -t COMPREPLY < <(compgen -d -- "$current") ;;
        :scripts) compopt -o filenames && mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(
            compgen -d -- "$current"
            compgen -f -X '!*.fl' -- "$current"
            compgen -f -X '!*.petri' -- "$current"
        ) ;;
        *)
            line=${line%%$'\t'*}
            COMPREPLY+=("${line#"$before"}")
            ;;
        esac
    done < <("${COMP_WORDS[0]/#~/$HOME}" complete "${words[@]:1}" 2>/dev/null)
}
complete -F _petri petri
