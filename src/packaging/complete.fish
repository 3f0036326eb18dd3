# petri's completion for fish. `petri complete` prints candidates, and how to complete paths (src/main/complete_command.c).
function __petri_complete
    set -l words (commandline -opc)
    set -l word (commandline -ct)
    set -l before (string match -r -- '^--[^=]*=' $word)
    set -l path (string replace -r -- '^--[^=]*=' '' $word)
    for line in ($words[1] complete $words[2..] "$word" 2>/dev/null)
        switch $line
            case :nospace
            case :files :scripts
                __fish_complete_path $path | string replace -r -- '^' "$before"
            case :folders
                __fish_complete_directories $path | string replace -r -- '^' "$before"
            case '*'
                echo $line
        end
    end
end
complete -c petri -f -a '(__petri_complete)'
