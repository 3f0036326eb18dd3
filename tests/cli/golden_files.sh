# golden_files.sh: tests of how `petri test` finds and creates goldens and .err files. Part of run.sh.

mkdir -p made/below
printf '!counter state=:c rate=2\n' >made/turns.fl
petri test --new made/turns.fl
check "--new creates a golden" status_is 0
check "--new names the file" out_is "created made/turns.golden"
check "a new golden begins with the options of its run" [ "$(head -n 1 made/turns.golden)" = "# run --frames 61 --every 20 --print state,log" ]
petri test made/turns.golden
check "a golden is an operand like its script" out_is "ok made/turns.fl
1 passed, 0 failed"
petri test made/turns.golden made/turns.fl made
check "a script and its golden are one test" last_line_is out "1 passed, 0 failed"
petri test --new made/turns.fl --frames 2
check "--new does not overwrite a golden" status_is 1
check "--new says how to update a golden that exists" has err "petri test --update made/turns.fl"

# The first line is read again as the shell would, so that each option arrives in the run as it was given.
printf '!n a=A b=B c=frame\n' >"made/below/it's.fl"
petri test --new "made/below/it's.fl" -D "A=x y's" --define 'B=$HOME' --frames 3
check "without a state, a new golden has the tree" has "made/below/it's.golden" '!n a="x y'"'"'s" b='"'"'$HOME'"'"' c=2'
petri test "made/below/it's.golden"
check "options with blanks and quotes survive in the golden" last_line_is out "1 passed, 0 failed"
petri test --new made/turns.fl --print
check "--new checks the options of the run" status_is 2
printf '!n a=frame\n' >made/plain.fl
petri test --new made/plain.fl --state made/s
check "--new refuses options that write files" status_is 1
check "--new writes nothing if it refuses" [ ! -e made/plain.golden ]
check "--new does not run a script with refused options" [ ! -e made/s ]
petri test --new
check "--new without a script is a wrong command line" status_is 2
petri test --new --help
check "--new has its own help" has out "usage: petri test --new"
petri test --new made/plain.fl --print hash --every 2 --frames 3 --fps 25
check "--new keeps the options in their order" [ "$(head -n 1 made/plain.golden)" = "# run --print hash --every 2 --frames 3 --fps 25" ]
petri test --new samples/none.fl
check "--new of a missing script fails" status_is 1

# scripts that are rejected
printf '!n a=1\n!n b=*\n' >made/wrong.fl
petri test --new made/wrong.fl
check "--new of a script with an error creates an .err file" out_is "created made/wrong.err"
check "an .err file has the line and the messages" [ "$(cat made/wrong.err)" = "line 2
wrong.fl:2:6: error: unexpected '*' [syntax]
    !n b=*
         ^" ]
petri test made/wrong.err
check "an .err file is an operand like its script" last_line_is out "1 passed, 0 failed"
printf '!n a=1\n!n b=+\n' >made/wrong.fl
petri test made/wrong.fl
check "another message in the same line fails" status_is 1
check "another message is reported" has out "    -wrong.fl:2:6: error: unexpected '*' [syntax]"
petri test --update made/wrong.fl
check "--update records the message" out_is "ok made/wrong.fl (updated)
1 passed, 0 failed"
petri test --update made/wrong.fl
check "--update of an .err file that agrees changes nothing" lacks out updated
printf '\n!n a=1\n!n b=+\n' >made/wrong.fl
petri test --update made/wrong.fl
check "--update records the line of the error" [ "$(head -n 1 made/wrong.err)" = "line 3" ]
sed -i '1s/.*/line */; 2,$d' made/wrong.err
petri test made/wrong.fl
check "an .err file with only a line accepts any message" last_line_is out "1 passed, 0 failed"
petri test --update made/wrong.fl
check "--update keeps 'line *'" [ "$(head -n 1 made/wrong.err)" = "line *" ]
printf '!n\n' >made/wrong.fl
petri test --update made/wrong.fl
check "--update does not record that a script is accepted" status_is 1
check "a script that is accepted leaves its .err file alone" has made/wrong.err "unexpected"

# test files whose script is gone
mv made/turns.fl made/moved.fl
mv made/wrong.fl made/mended.fl
petri test made
check "test files without a script fail" status_is 1
check "a golden without a script is reported" has out "made/turns.golden:1: error: no such script: made/turns.fl"
check "an .err file without a script is reported" has out "made/wrong.err:1: error: no such script: made/wrong.fl"
check "the last line has the number of scripts without a test" last_line_is out \
    "2 passed, 2 failed, 2 scripts without a test"
petri test made/wrong.err
check "an .err file without a script fails if it is named" status_is 1
petri run made/mended.fl --new
check "other commands have no option --new" status_is 2
