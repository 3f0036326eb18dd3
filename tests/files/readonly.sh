# readonly.sh: tests of a file system that is read-only, or becomes so while a run saves its state. Part of
# ../cli/run.sh. Mounting needs root.

cat >w.fl <<'END2'
!physics state=:c dimensions=2
    for i in ..3
        !particle id=i velocity=1;i
!window size=20
    !canvas
        !rect size=4 fill=true
END2
# refused FILE COMMAND...: checks that a command that would write FILE fails, and that the message names FILE and reason.
refused() {
    target=$1
    shift
    petri "$@"
    check "$1 $target: a read-only file system is reported" eval 'status_is 1 && grep -q "cannot .*$target.*\(Read-only\|readonly\|unable to open\)" err'
}
# reads COMMAND...: checks that a command that only reads succeeds.
reads() {
    petri "$@"
    check "$1: works on a read-only file system" status_is 0
}

if [ "$(id -u)" -eq 0 ] && mkdir disk && mount -t tmpfs -o size=64m tmpfs disk 2>/dev/null; then
    cp w.fl disk
    cd disk || exit 1
    printf '!n  a=1\n' >untidy.fl
    printf '# run --frames 3 --print state\n' >w.golden
    petri test --update w.fl
    petri run w.fl --frames 3 --state w.state --trajectory w.csv
    petri sweep w.fl --seeds 2 --frames 2 --metric x=SEED --cache cache
    petri run w.fl --frames 3 --archive w.petri
    archives=$([ -e w.petri ] && echo yes)
    rm out err
    cd ..
    mount -o remount,ro disk
    cp -R disk before
    for stem in w new; do
        refused $stem.state run disk/w.fl --frames 3 --state disk/$stem.state
        refused $stem.csv run disk/w.fl --frames 3 --trajectory disk/$stem.csv
        refused $stem.xyz run disk/w.fl --frames 3 --trajectory disk/$stem.xyz
        refused $stem.petri run disk/w.fl --frames 3 --archive disk/$stem.petri
        refused $stem.csv.part sweep disk/w.fl --seeds 2 --frames 2 --metric x=SEED -o disk/$stem.csv
    done
    refused w.csv run disk/w.fl --frames 3 --state disk/w.state --trajectory disk/w.csv
    refused new sweep disk/w.fl --seeds 2 --frames 2 --metric x=SEED --cache disk/new
    refused j.xml test disk/w.fl --junit disk/j.xml
    refused untidy.fl fmt disk/untidy.fl
    refused made.fl new disk/made.fl
    if draws; then
        refused w.png render disk/w.fl --frames 1 -o disk/w.png
        refused f-%d.png render disk/w.fl --frames 2 -o disk/f-%d.png
        ! command -v ffmpeg >/dev/null || refused w.mp4 render disk/w.fl --frames 2 -o disk/w.mp4
    fi
    petri sweep disk/w.fl --seeds 4 --frames 2 --metric x=SEED --cache disk/cache
    check "a read-only cache is used" has err "2 runs computed, 2 from the cache, 0 verified"
    check "a read-only cache is reported" has err "cannot write to the cache 'disk/cache': Read-only file system"
    reads test disk/w.fl
    reads check disk/w.fl
    reads diff disk/w.state disk/w.fl
    if [ "$archives" ]; then
        reads archive info disk/w.petri
        reads archive verify disk/w.petri
        reads run disk/w.petri --frames 2
        reads archive unpack disk/w.petri unpacked
    fi
    check "no command has changed a file" diff -r before disk

    # A file system that becomes read-only, as after a defect of a disk.
    mount -o remount,rw disk
    "$petri" run w.fl --realtime --runtime 9 --state disk/late.state >out 2>err </dev/null &
    job=$!
    tries=100
    while [ ! -e disk/late.state ] && [ $tries -gt 0 ]; do
        sleep 0.1
        tries=$((tries - 1))
    done
    until mount -o remount,ro disk 2>/dev/null; do sleep 0.1; done # fails while a file is open for writing
    cp disk/late.state late.state
    tries=100
    while lacks err "Read-only" && [ $tries -gt 0 ]; do
        sleep 0.1
        tries=$((tries - 1))
    done
    check "a file system that becomes read-only is reported" has err "cannot write the state to 'disk/late.state': Read-only file system"
    check "the last state stays" cmp disk/late.state late.state
    mount -o remount,rw disk
    wait $job
    status=$?
    check "the state is saved when the file system is writable again" eval 'status_is 0 && has err "saving the state works again"'
    umount disk
fi
