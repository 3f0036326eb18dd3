# new.sh: `petri new`. Part of run.sh.

petri new
check "new without a name is a usage error" status_is 2
check "… which says what is missing" has err "no name given: petri new NAME"
petri new one two
check "new with two names is a usage error" status_is 2
for name in '' . .. absent/ .fl; do
    petri new "$name"
    check "new '$name' is a usage error" status_is 2
    check "… new '$name': told what is expected" has err "not a script name"
done

petri new newdish
check "new starts a script" status_is 0
check "… named as it was told" [ -s newdish.fl ]
check "… says so" has err "created newdish.fl, a dish of drops"
check "… and how to see it" has err " view newdish.fl"
check "… and nothing on standard output" empty out
petri check --werror newdish.fl
check "petri check finds nothing to say" status_is 0
check "… but that" lines_are err 1
check "it has comments" [ "$(grep -c -e '--' newdish.fl)" -ge 8 ]
petri run newdish.fl --frames 60 --print error,state --every 59
check "it runs" status_is 0
check "… without a message" lacks err "warning"
check "… and its drops move" has out '$(:drops;0)'
petri run newdish.fl -D DROPS=3 --frames 2 --print state
check "its parameters can be set" lacks out '$(:drops;3)'
petri render newdish.fl -o newdish.png --frames 1
if [ "$status" -eq 0 ]; then
    check "its picture has the window's size" [ "$(od -An -tu1 -j18 -N6 newdish.png | tr -s ' ')" = " 2 208 0 0 2 208" ]
    # One colour would take less than a tenth of this.
    check "… and something to see" [ "$(wc -c <newdish.png)" -gt 50000 ]
fi

echo mine >mine.fl
petri new mine
check "a file that is there is left alone" status_is 1
check "… to the letter" [ "$(cat mine.fl)" = mine ]
check "… with one message" lines_are err 1
check "… which names it" has err "mine.fl already exists"
ln -s nowhere.fl link.fl
petri new link.fl
check "so is a link that leads nowhere" status_is 1
check "… and nothing is made behind it" [ ! -e nowhere.fl ]
petri new absent/newdish
check "a folder that is not there is an error" status_is 1
check "… which names the file" has err "cannot write absent/newdish.fl: "
mkdir -p folder
petri new folder/newdish.fl
check "a suffix and a folder may be given" [ -s folder/newdish.fl ]
petri new -- -newdish
check "a name may begin with a dash" [ -s ./-newdish.fl ]
check "… and is shown so that it can be typed" has err " view ./-newdish.fl"
(
    trap '' XFSZ # the disk is full
    ulimit -f 1
    exec timeout 100 "$petri" new full >out 2>err </dev/null
)
status=$?
check "a script that the disk cannot hold is an error" status_is 1
check "… which says so" has err "cannot write full.fl: File too large"
check "… and leaves no half of it" [ ! -e full.fl ]
petri help
check "help knows it" has out "  new      create a commented example"
