# complete.sh: tests of `petri complete`, which the completion scripts of shells call. Part of run.sh. tests/install/
# manual.sh tests it with the shells.

# completes RESULT WORD...: succeeds if the candidates for the last WORD are RESULT, separated by blanks.
completes() {
    result=$1
    shift
    petri complete "$@"
    status_is 0 && [ "$(cut -f 1 out | tr '\n' ' ')" = "${result:+$result }" ]
}
empty_words() { petri complete; status_is 2; }
mkdir -p completed
printf '%s\n' 'let DROPS=DROPS or 5    -- 1..9: how many' 'let DRAG=DRAG or 1' >completed/dish.fl
printf '%s\n' 'let DROPS=DROPS or 5' 'print(' >completed/broken.fl

check "the first word is a command or a script" completes "render repl :scripts" re
check "commands have their summaries" has out "repl	step through a script interactively"
check "complete is not offered" completes ":scripts" comp
check "no words are a usage error" empty_words
check "short options" completes "-D" run -D
check "an option of the command" completes "--trajectory" run --traj
check "options have their help" has out "--trajectory	write all particles to FILE.xyz"
check "only options of the command" completes "" check --traj
check "options of run after a script" completes "--trajectory" dish.fl --traj
check "options of run as the first word" completes "--trajectory" --traj
check "a value" completes "never" run --neighbours n
check "a value after an equals sign" completes "--neighbours=never" run --neighbours=n
check "all values" completes "auto always never" run --color ''
check "a list of values" completes "tree,hash :nospace" run --print tree,h
check "a list of values after an equals sign" completes "--print=tree,hash :nospace" run --print=tree,h
check "any value" completes "" run --frames 1
check "an operand after a value" completes ":scripts" run --frames 1 ''
check "a file" completes ":files" render -o ''
check "a file in the word of its option" completes ":files" render -oout
check "a folder" completes ":folders" run --allow-read ''
check "an operand that starts with a dash" completes ":scripts" run -- --q
check "the socket of view --send" completes ":files" view --send ''
check "the actions of archive" completes "verify info cite unpack" archive ''
check "an action has its summary" has out "cite	print how to cite an archived run"
check "an action that was begun" completes "unpack" archive un
check "an option of an action" completes "--sample" archive verify --sam
check "only options of the action" completes "" archive info --sam
check "an operand of an action" completes ":scripts" archive info ''
check "old names are not offered" completes ":scripts" veri
check "an option of an old name" completes "--sample" verify --sam
check "an unknown option before the word" completes "never" run --no-such --neighbours n
check "topics of help" completes "electrostatic" help electro
check "words of the language are topics" completes "tempo template" help temp
check "parameters of the script" completes ":nospace DROPS= DRAG=" run completed/dish.fl -D ''
check "parameters have their range and comment" has out "DROPS=	DROPS = 5  (1..9): how many"
check "parameters in the word of the option" completes ":nospace -DDROPS=" run completed/dish.fl -DDRO
check "parameters for a sweep" completes ":nospace --define=DRAG=" sweep completed/dish.fl --define=DRA
check "no parameters without a script" completes "" run -D ''
check "no parameters of a script with errors" completes "" run completed/broken.fl -D ''
petri help
check "help does not list complete" lacks out "  complete"
