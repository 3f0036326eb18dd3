# new.sh: tests of `petri new`. Part of run.sh.

petri new
check "new without a name is a usage error" status_is 2
check "new without a name reports what is missing" has err "no name given: petri new NAME"
petri new one two
check "new with two names is a usage error" status_is 2
for name in '' . .. absent/ .fl; do
    petri new "$name"
    check "new '$name' is a usage error" status_is 2
    check "new '$name' reports an invalid name" has err "not a script name"
done

petri new newdish
check "new creates a script" status_is 0
check "new uses the given name" [ -s newdish.fl ]
check "new reports the created file" has err "created newdish.fl, a dish of drops"
check "new shows the command to view the script" has err " view newdish.fl"
check "new prints nothing on standard output" empty out
petri check --werror newdish.fl
check "the new script passes check" status_is 0
check "the new script gives only the summary" lines_are err 1
check "the new script has comments" [ "$(grep -c -e '--' newdish.fl)" -ge 8 ]
petri run newdish.fl --frames 60 --print error,state --every 59
check "the new script runs" status_is 0
check "the new script runs without warnings" lacks err "warning"
check "the drops of the new script move" has out '$(:drops;0)'
petri run newdish.fl -D DROPS=3 --frames 2 --print state
check "the parameters of the new script can be set" lacks out '$(:drops;3)'
petri render newdish.fl -o newdish.png --frames 1
if [ "$status" -eq 0 ]; then
    check "the picture of the new script has the window's size" [ "$(od -An -tu1 -j18 -N6 newdish.png | tr -s ' ')" = " 2 208 0 0 2 208" ]
    # An image of a single colour would be smaller than a tenth of this size.
    check "the picture of the new script is not of one colour" [ "$(wc -c <newdish.png)" -gt 50000 ]
fi

echo mine >mine.fl
petri new mine
check "new does not overwrite a file" status_is 1
check "new keeps the contents of an existing file" [ "$(cat mine.fl)" = mine ]
check "an existing file gives one message" lines_are err 1
check "the message names the existing file" has err "mine.fl already exists"
ln -s nowhere.fl link.fl
petri new link.fl
check "new does not follow a link that leads nowhere" status_is 1
check "new creates no file through a link" [ ! -e nowhere.fl ]
petri new absent/newdish
check "new reports a missing folder" status_is 1
check "the message about a missing folder names the file" has err "cannot write absent/newdish.fl: "
mkdir -p folder
petri new folder/newdish.fl
check "new accepts a suffix and a folder" [ -s folder/newdish.fl ]
petri new -- -newdish
check "new accepts a name that starts with a dash" [ -s ./-newdish.fl ]
check "a name that starts with a dash is shown with ./" has err " view ./-newdish.fl"
(
    trap '' XFSZ # the disk is full
    ulimit -f 1
    exec timeout 100 "$petri" new full >out 2>err </dev/null
)
status=$?
check "new fails if the disk is full" status_is 1
check "new reports that the disk is full" has err "cannot write full.fl: File too large"
check "new leaves no partial file" [ ! -e full.fl ]
petri help
check "help lists new" has out "  new      create a commented example"
