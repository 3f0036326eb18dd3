# bad_input.sh: tests that invalid input gives one clear message and never a crash. Part of run.sh.

petri run missing.fl
check "a missing file is one error" one_error
check "a missing file is named" has err "missing.fl"
mkdir folder.fl
petri run folder.fl
check "a folder is one error" one_error
check "a folder is reported as a directory" has err "directory"
if [ -e /proc/self/mem ]; then
    petri run /proc/self/mem # even root cannot read it
    check "a file that cannot be read is one error" one_error
fi
echo '!n' >locked.fl
chmod 000 locked.fl
if [ ! -r locked.fl ]; then
    petri run locked.fl
    check "a file without permission is one error" one_error
fi
chmod 600 locked.fl

: >empty.fl
petri run --frames 2 empty.fl
check "an empty file is a script" status_is 0
check "an empty file gives no message" empty err
printf '\177ELF\002\001\001\000\000\000\200\377\n\000' >binary.fl
petri run binary.fl
check "a binary file is one error" one_error
check "a binary file does not reach the terminal" lacks err "$(printf '\177')"
printf '!n a=1\n!n b="\377\376"\n' >utf8.fl
petri run utf8.fl
check "invalid UTF-8 is one error" one_error
check "invalid UTF-8 is reported with its position" has err "utf8.fl:2:7: error: "

printf '!n a=1\n' | iconv -t UTF-16 >utf16.fl 2>/dev/null || printf '\377\376!\0n\0\n\0' >utf16.fl
petri run utf16.fl
check "a UTF-16 file is one error" one_error
check "a UTF-16 file is reported as UTF-16" has err "'utf16.fl' is UTF-16 text: save it as UTF-8"
printf '!a\0\n!b\0\n!c\0\n' >nul.fl
petri check nul.fl
check "NUL bytes are one error" one_error
check "a file with NUL bytes is reported as binary" has err "'nul.fl' is a binary file"
printf 'root:x:0:0:root:/root:/bin/bash\ndaemon:x:1:1:/bin/sh\n# end: x\nmail:x:8:8::/\n' >passwd
petri run passwd
check "a text that is not a script is one error" one_error
check "a text that is not a script is reported as such" has err "passwd:1:5: error: is this a Flitter script? 4 of 4"
petri check passwd
check "check reports a text that is not a script once" count_is err "error: " 1
cp passwd passwd.fl
petri check passwd.fl
check "a text named as a script gives all its errors" [ "$(grep -c 'error: ' err)" -ge 4 ]
mark=$(printf '\357\273\277')
printf '%s!n a=1 b=x\n' "$mark" >mark.fl
printf '%slet m=2\n' "$mark" >mark_module.fl
printf '%s!k\n' "$mark" >mark_include.fl
printf "%simport m from 'mark_module.fl'\n%%include 'mark_include.fl'\n!n a=m x\n" "$mark" >marks.fl
petri run --frames 1 --print tree mark.fl
check "a byte-order mark is skipped" out_is "@0 time=0 beat=0
!n a=1"
check "columns are counted after a byte-order mark" has err "mark.fl:1:10: warning: "
petri run --frames 1 marks.fl
check "columns are counted after a byte-order mark in a longer script" has err "marks.fl:3:9: error: "
printf "%simport m from 'mark_module.fl'\n%%include 'mark_include.fl'\n!n a=m\n" "$mark" >marks.fl
petri run --frames 1 --print tree marks.fl
check "byte-order marks in modules and includes are skipped" out_is "@0 time=0 beat=0
!k
!n a=2"

# a module with a syntax error: its names are null, and the frames are computed
printf 'let size=\n' >broken.fl
printf 'import size from "broken.fl"\n!n a=frame size=size\n' >uses_broken.fl
for way in "run --frames 2 --print tree" "run --runtime 0.02 --realtime --print tree" "render --frame 1 -o broken.png"; do
    petri $way uses_broken.fl
    check "$way: a syntax error in a module is an error" has err "broken.fl:1:10: error: "
    check "$way: a script whose module has an error fails" status_is 1
done
petri run --frames 2 --print tree uses_broken.fl
check "frames are computed without the broken module" has out '!n a=1'
check "the run says that the module is missing" last_line_is err "petri: a module has syntax errors; its names are null"
printf 'let START=START or 1\n!o a=START\n' >start.fl
petri run --frames 1 -D START=nan start.fl
check "a definition that is not a number is called so" has err "warning: START=nan is not a number [out-of-range]"

{ printf '!n a=0' && repeat 5000000 ';1' && echo; } >long.fl
petri run --frames 1 long.fl
check "a line of 10 MB is a script" status_is 0
{ printf '!n a=0' && repeat 5000000 ';1' && echo ' ='; } >long.fl
petri run --frames 1 long.fl
check "a mistake at the end of 10 MB is one error" one_error
check "a mistake at the end of 10 MB is reported with its column" has err "long.fl:1:10000008: error: "
check "a line of 10 MB is shown in part" [ "$(wc -c <err)" -lt 2000 ]
rm -f long.fl
{ printf '!n a=' && repeat 100000 '(' && printf 1 && repeat 100000 ')' && echo; } >parentheses.fl
petri run --frames 1 parentheses.fl
check "100000 nested parentheses are one error" one_error
check "the limit of parentheses is named" has err "1000"
{ printf '!n a=' && repeat 100000 '-' && echo 1; } >signs.fl
petri run --frames 1 signs.fl
check "100000 signs are one error" one_error
awk 'BEGIN { for (i = 0; i < 3000; i++) printf "%*s!n\n", i, "" }' >deep.fl
petri run --frames 1 deep.fl
check "3000 levels of indentation are one error" one_error
check "the limit of indentation is named" has err "1000"
awk 'BEGIN { for (i = 0; i < 300; i++) printf "%*s!n\n", i, "" }' >deep.fl
petri run --frames 1 --print tree deep.fl
check "300 levels of indentation are accepted" lines_are out 301

cat >endless.fl <<'END'
func f(x)
    f(x + 1)
!n a=f(1)
END
petri run --frames 3 --print tree endless.fl
check "endless recursion ends" status_is 0
check "endless recursion is reported once" count_is err "warning: " 1
check "endless recursion evaluates to null" count_is out "!n" 3
cat >mutual.fl <<'END'
func f(x, g)
    g(x, g)
func h(x, g)
    f(x, g)
!n a=h(1, h)
END
petri run --frames 3 --print tree mutual.fl
check "endless recursion of two functions does not crash" [ "$status" -lt 2 ]
check "endless recursion of two functions is reported" grep -q . err
echo '!n a=..1e12' >range.fl
petri run --frames 2 --print tree range.fl
check "a range of 1e12 elements is reported" has err "range.fl:1:6: warning: "
check "a range of 1e12 elements evaluates to null" out_is "@0 time=0 beat=0
!n
@1 time=0.016666666666666666 beat=0.03333333333333333
!n"
echo '!n a=nowhere b=3(1)' >names.fl
petri run --frames 2 --print tree names.fl
check "an unbound name evaluates to null" has out "!n"
check "an unbound name is reported" has err "nowhere"
check "calling a number does not fail the run" status_is 0

# check
cat >three.fl <<'END'
let x = 3 +
!box size=1;2
let y = * 4
!n a=y
!other b=2;;
END
petri check three.fl
check "check exits with 1 when there are errors" status_is 1
check "check prints nothing on stdout" empty out
check "three mistakes are three errors" count_is err ": error: " 3
check "the first error has its position" has err "three.fl:1:12: error: "
check "the second error has its position" has err "three.fl:3:9: error: "
check "the third error has its position" has err "three.fl:5:12: error: "
check "the source line is shown" has err "let y = * 4"
check "a caret marks the error" grep -Eq '^ +\^' err
check "check ends with a summary" last_line_is err "petri: 1 file checked: 3 errors, 0 warnings"
petri check plain.fl count.fl
check "check of good files exits with 0" status_is 0
mkdir -p tree/below
cp plain.fl tree/a.fl
cp three.fl tree/below/b.fl
echo 'not a script =' >tree/note.txt
petri check tree
check "check searches folders" has err "tree/below/b.fl:3:9: error: "
check "check counts the scripts of folders" has err "2 files checked: 3 errors"
petri check missing
check "check of a missing path fails" status_is 1
mkdir bare
petri check bare
check "check of a folder without scripts fails" status_is 1
petri check
check "check without a path is a wrong command line" status_is 2
