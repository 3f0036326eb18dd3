# replace.sh: tests that regular files are replaced atomically, and that other files are written to directly. Part of
# ../cli/run.sh.

nothing_beside() { [ -z "$(find . -name '*.tmp')" ]; }
mode_of() { ls -ld "$1" | cut -c1-10; }
mkdir g
printf '!n a=frame\n' >g/t.fl
printf '# run --frames 1 --print tree\n@0 time=0 beat=0\n!n a=0\n' >g/t.golden

for device in null full; do
    before=$(ls -l /dev/$device)
    petri test --junit /dev/$device g
    check "--junit /dev/$device keeps the device" [ "$before" = "$(ls -l /dev/$device)" ]
done
check "--junit reports a full device" eval 'status_is 1 && has err "cannot write /dev/full: No space left on device"'
petri test --junit /dev/stdout g
check "--junit /dev/stdout writes to standard output" eval 'status_is 0 && has out "<testsuite" && has out "1 passed"'
timeout 100 "$petri" test --junit /dev/stdout g 2>err </dev/null | cat >out
check "--junit /dev/stdout writes to a pipe" eval 'has out "<testsuite" && has out "1 passed"'
mkfifo pipe
cat pipe >got &
petri test --junit pipe g
wait
check "--junit writes to a named pipe" eval '[ -p pipe ] && has got "<testsuite"'
mkdir folder
petri test --junit folder g
check "--junit to a folder is an error" eval 'status_is 1 && has err "Is a directory" && [ -d folder ]'
echo old >real
chmod 640 real
ln -s real link
petri test --junit link g
check "a symbolic link is kept" eval '[ -L link ] && has real "<testsuite"'
check "permissions are kept" [ "$(mode_of real)" = -rw-r----- ]
ln -s nowhere dangling
petri test --junit dangling g
check "a dangling symbolic link is kept and its target is created" eval '[ -L dangling ] && has nowhere "<testsuite"'
ln -s round round
petri test --junit round g
check "links in a circle are reported" eval 'status_is 1 && has err "Too many levels of symbolic links"'
(umask 077 && timeout 100 "$petri" test --junit private g >out 2>err)
check "new files get the permissions of the umask" [ "$(mode_of private)" = -rw------- ]
if [ "$(id -u)" -eq 0 ] && chown 12:34 real 2>/dev/null; then
    petri test --junit real g
    check "root keeps the owner" eval 'ls -ln real | grep -q " 12 *34 "'
fi

cp g/t.golden kept
printf '!n a=1\n' >g/t.fl
chmod 600 g/t.golden
mv g/t.golden g/recorded
ln -s recorded g/t.golden
petri test --update g/t.fl
check "goldens are updated through links" eval '[ -L g/t.golden ] && has g/recorded "!n a=1" && [ "$(mode_of g/recorded)" = -rw------- ]'
printf '!n a=2\n' >g/t.fl
(
    ulimit -f 0
    exec timeout 100 "$petri" test --update g/t.fl >out 2>err </dev/null
)
check "a full disk does not change a golden" has g/recorded "!n a=1"

petri run g/t.fl --frames 3 --state link.state
ln -s s.state link2.state
petri run g/t.fl --frames 3 --state link2.state
check "a state is written through a link" eval '[ -L link2.state ] && has s.state petri-state'
chmod 600 s.state
petri run g/t.fl --frames 3 --state link2.state
check "a state keeps its permissions" [ "$(mode_of s.state)" = -rw------- ]
printf '!physics state=:c dimensions=2\n    !particle id=1 velocity=1\n' >p.fl
mkfifo run.csv
cat run.csv >got &
petri run p.fl --frames 3 --trajectory run.csv
wait
check "a trajectory can be written to a pipe" eval 'status_is 0 && [ -p run.csv ] && lines_are got 4'
petri new g/t
check "petri new does not overwrite a file" eval 'status_is 1 && has g/t.fl "!n a=2"'
check "replaced files leave no temporary files" nothing_beside
# When the next file is written, temporary files of a killed run are removed, but no other files.
mkdir left
: >left/.petri-0123456789abcdef.tmp
: >left/.petri-mine.tmp
echo old >left/results
petri test --junit left/results g
check "temporary files of a killed run are removed, and no others" eval '[ "$(ls -A left | tr "\n" " ")" = ".petri-mine.tmp results " ]'
rm left/.petri-mine.tmp
