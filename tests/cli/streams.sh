# streams.sh: tests of scripts from standard input, pictures to standard output, and --print log. Part of run.sh.

# petri_stdin SCRIPT ARGUMENTS...: like petri, with the script on standard input.
petri_stdin() {
    script=$1
    shift
    # shellcheck disable=SC2059 # the script may contain escapes
    printf "$script" | timeout 100 "$petri" "$@" >out 2>err
    status=$?
}
petri_stdin '!n a=1\n' run - --frames 1 --print tree
check "a script from standard input runs" out_is "@0 time=0 beat=0
!n a=1"
petri_stdin '!n a=1\n' - --frames 1 --print tree
check "a script from standard input runs without a command" has out "!n a=1"
petri_stdin '!n a=x\n' run - --frames 1
check "standard input is called <stdin> in messages" has err "<stdin>:1:6: warning: unbound name 'x'"
petri_stdin '!n a=(\n' run -
check "an error in standard input fails" status_is 1
check "an error in standard input has a position" has err "<stdin>:1:7: error: "
petri_stdin '' run - --frames 1
check "empty standard input is a script" status_is 0
mkdir -p parts
echo 'let part=5' >parts/part.fl
petri_stdin "import part from 'parts/part.fl'\n!n a=part\n" run - --frames 1 --print tree
check "standard input imports from the current folder" has out "!n a=5"
petri_stdin '!n a=x y\n' check -
check "check reads standard input" has err "<stdin>:1:9: error: "
check "check counts standard input as a file" last_line_is err "petri: 1 file checked: 1 error, 0 warnings"
petri_stdin '\377\376!\0n\0\n\0' run -
check "UTF-16 on standard input is reported" has err "'<stdin>' is UTF-16 text"
petri_stdin 'a:b:c\nd:e:f\ng:h:i\n' run -
check "a text that is not a script is one error" one_error
timeout 100 "$petri" run - >out 2>err <&-
status=$?
check "a closed standard input is one message" lines_are err 1
check "a closed standard input fails" status_is 1
for words in "view -" "repl -" "test -"; do
    # shellcheck disable=SC2086 # split into words
    petri_stdin '!n\n' $words
    check "petri $words is a wrong command line" status_is 2
    check "petri $words gives the reason in one line" lines_are err 1
done
check "test reports that standard input has no golden" has err "no golden"
echo '!n a=1' >./-
petri run ./- --frames 1 --print tree
check "a file called - can be run" has out "!n a=1"
rm ./-

# pictures
draw='!window size=8;6\n    !canvas\n        !fill color=1\n            !rect point=1;1 size=3;3\n'
printf "%b" "$draw" >drawn.fl
petri render drawn.fl --frames 1 -o file.png
petri_stdin "$draw" render - --frames 1 -o -
check "render -o - exits with 0" status_is 0
check "render -o - writes a picture" cmp -s out file.png
petri render drawn.fl --frames 1 -o - --format svg
check "--format svg writes SVG" has out "<svg"
petri render drawn.fl --frames 1 -o - --format pdf
check "--format pdf writes PDF" has out "%PDF"
if command -v ffmpeg >/dev/null 2>&1; then
    petri render drawn.fl --frames 3 -o - --format gif
    check "--format gif writes a film" [ "$(head -c 6 out)" = GIF89a ]
    petri render drawn.fl --frames 3 -o - --format mp4
    check "--format mp4 writes a film" grep -aq ftyp out
fi
petri render drawn.fl --frames 1 -o - --format bmp
check "an unknown format is a wrong command line" status_is 2
check "the message lists the known formats" has err "png, svg, pdf, mp4, m4v, mov, mkv, webm, ogg or gif"
petri render drawn.fl --frames 1 -o x.png --format svg
check "--format with a file is a wrong command line" status_is 2
petri render nowhere.fl -o -
check "a missing script writes no picture" empty out
check "render -o - leaves no temporary files" [ -z "$(ls -d "$TMPDIR"/petri.* 2>/dev/null)" ]
if script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    script -qec "$(quoted "$petri") render drawn.fl --frames 1 -o -" /dev/null >out 2>&1 </dev/null
    check "render -o - does not write to a terminal" has out "'-o -' cannot write to a terminal"
    check "the message shows how to redirect the output" has out ">FILE"
fi
if [ -c /dev/full ]; then
    timeout 100 "$petri" render drawn.fl --frames 1 -o - >/dev/full 2>err </dev/null
    status=$?
    check "a full device fails" status_is 1
fi

# only logs
printf 'debug(frame) if frame%%%%2==1\n!n a=sqrt(1;2, 3) if frame==3\n' | sed 's/%%/%/' >speaks.fl
petri run --frames 5 --print log speaks.fl
check "--print log omits frames without logs" out_is "@1 time=0.016666666666666666 beat=0.03333333333333333
> 1
@3 time=0.05 beat=0.1
> 3"
petri run --frames 5 --print error speaks.fl
check "--print error omits frames without errors" [ "$(sed -n 's/^@\([0-9]*\).*/\1/p' out)" = 3 ]
check "--print error prints errors" grep -q '^? ' out
petri run --frames 5 --print log,error --every 3 speaks.fl
check "--print log,error omits frames with neither" [ "$(grep -c '^@' out)" = 1 ]
petri run --frames 5 --print tree,log speaks.fl
check "--print tree,log prints all frames" [ "$(grep -c '^@' out)" = 5 ]
petri run --frames 5 --print log plain.fl
check "--print log without logs prints nothing" empty out
printf '# run --frames 5 --print log\n' >speaks.golden
petri test --update speaks.fl
petri test speaks.fl
check "a golden can have only logs" has out "1 passed"

# --show without a terminal.
cat >two.fl <<'END'
!physics state=:cells dimensions=2
    !particle id=0 position=1;2
    !particle id=1 position=5;2
    !anchor id=2 position=0
!physics state=:dust dimensions=2
    !particle id=0 position=1;2
END
petri run two.fl --frames 3 --print digest
digest=$(sed -n '$s/.* //p' out)
petri run two.fl --frames 3
check "without --show, nothing is reported" eval 'empty out && empty err'
petri run two.fl --show --frames 3
check "--show without a terminal prints nothing to standard output" eval 'status_is 0 && empty out'
check "--show without a terminal reports the frames" has err "petri: 3 frames in "
check "--show without a terminal reports the systems" eval 'has err "petri: system :cells: 2 particles" && has err "petri: system :dust: 1 particle"'
check "--show without a terminal reports the digest" has err "petri: digest of the state after frame 2: $digest"
check "--show without a terminal suggests a command" grep -q '^petri: to watch the script: .* view two.fl$' err
petri run two.fl --show --frames 3 --quiet
check "--quiet suppresses these reports" empty err

# A stopped terminal (Ctrl-S) accepts no output. One signal still ends the run, which saves its state.
printf '%%pragma fps 60\n!counter state=:c rate=1\n!n a=frame b="%s"\n' "$(repeat 200 x)" >chatter.fl
cat >stopped.py <<'END'
import os, pty, select, signal, sys, termios, time

def drain(fd, seconds):
    end = time.time() + seconds
    while time.time() < end:
        if select.select([fd], [], [], 0.05)[0]:
            try:
                if not os.read(fd, 65536):
                    return
            except OSError:
                return

pid, fd = pty.fork()
if pid == 0:
    os.execv(sys.argv[1], sys.argv[1:])
drain(fd, 1)
os.write(fd, b'\x13')
drain(fd, 1)
os.kill(pid, int(os.environ['SIGNAL']))
for _ in range(3000):
    ended, status = os.waitpid(pid, os.WNOHANG)
    if ended:
        break
    time.sleep(0.01)
else:
    os.kill(pid, signal.SIGKILL)
    _, status = os.waitpid(pid, 0)
print(os.waitstatus_to_exitcode(status))
END
for number in 2 15; do
    rm -f chatter.state
    SIGNAL=$number python3 stopped.py "$petri" run chatter.fl --frames 100000000 --print tree --state chatter.state >out 2>err
    check "signal $number ends a run on a stopped terminal" out_is "$((128 + number))"
    check "a run on a stopped terminal saves its state after signal $number" [ -s chatter.state ]
done
