# inject.sh: tests in which each file system call fails in turn. Part of ../cli/run.sh.
#
# For every N, strace makes the N-th call fail. Afterwards, the file must be the old or the new one, the run must report
# the error, and the next run must succeed. EINTR must have no effect.

cat >w.fl <<'END'
!physics state=:c dimensions=2
    for i in ..30
        !particle id=i velocity=1;i
END
printf '!n a=1\n' >g.fl
printf '# run --frames 1 --print tree\nold\n' >old.golden

# The values of N. Unless PETRI_INJECT=all, fewer are used for files that are written by the same code.
tried='1 2 3 4 5 6 7 8 9 10'
# prepare: creates the files that exist before a run: the old file and, if needed, a script or a state.
prepare() {
    mkdir -p target
    rm -f target/* target/.petri*
    cp "$old" "target/$file"
    case $what in
    golden) cp g.fl target ;;
    resumed*) cp old.state target/s ;;
    esac
}
# sweep NAME FILE OLD GOOD COMMAND...: runs COMMAND, which replaces FILE, with each failure. OLD is a copy of FILE from
# before the run. The command `GOOD FILE` succeeds if FILE is complete and new.
sweep() {
    what=$1 file=$2 old=$3 good=$4
    shift 4
    for call in openat openat2 newfstatat close read write fsync flock linkat renameat fchmod ftruncate; do
        # Calls that every program makes many times fail only for files in the test's folder.
        case $call in
        openat | newfstatat | close) paths="-P $work/target -P $work/target/$file" ;;
        *) paths= ;;
        esac
        for error in ENOSPC EIO EINTR; do
            case $error$call in
            EIOwrite | EIOfsync | ENOSPC* | EINTR*) ;;
            *) continue ;;
            esac
            for n in $tried; do
                prepare
                # The leak sanitizer does not work under strace.
                # shellcheck disable=SC2086
                ASAN_OPTIONS="$ASAN_OPTIONS:detect_leaks=0" timeout 100 strace -f -qq -o trace $paths -e trace=$call -e inject=$call:error=$error:when=$n \
                    "$petri" "$@" >out 2>err </dev/null
                status=$?
                grep -q INJECTED trace || break
                judge "$what: $call $n fails with $error"
            done
        done
    done
    case $what in resumed*) prepare ;; esac
    rm -f target/.petri*
    timeout 100 "$petri" "$@" >out 2>err </dev/null
    status=$?
    check "$what: the run after the failures succeeds" eval 'status_is 0 && $good "target/$file"'
}
# judge NAME: checks the file after a failed call. It must have the old contents and the error must be reported, or it
# must have the new contents.
judge() {
    now=damaged
    ! $good "target/$file" || now=new
    ! cmp -s "$old" "target/$file" || now=old
    reported=yes
    ! empty err || ! empty out || grep -q 'write(2,.*INJECTED' trace || reported=no
    check "$1: the file is the old or the new one (now: $now)" eval '[ $now = new ] || { [ $now = old ] && [ "$status" -ne 0 ] && [ $reported = yes ]; }'
    # The dynamic loader does not retry after EINTR. For close and newfstatat, no retry is needed.
    if [ $error = EINTR ] && [ $call != close ] && [ $call != newfstatat ] && lacks err "shared libraries"; then
        check "$1: EINTR does not affect the run" eval '[ $now = new ] && status_is 0'
    fi
}

good_state() { tail -n 1 "$1" | grep -q '^end [0-9a-f]*$'; }
good_csv() { [ "$(wc -l <"$1")" -eq 61 ]; }
good_golden() { grep -qx '!n a=1' "$1"; }
good_png() { tail -c 8 "$1" | grep -q IEND; }
# If the process of a sweep's run fails, the row of that run contains an error.
good_table() { [ "$(sed 's/,0,,\(the process\|crashed\).*/,1,2,/; s/^1,1,1,2,/1,1,1,1,/' "$1")" = "run,A,frame,x,error
1,1,1,1,
2,2,1,2," ]; }
is_good() { cmp -s "$1" "good.${1##*.}"; }
good_film() { grep -q moov "$1"; }

if command -v strace >/dev/null && strace -qq -o trace true 2>/dev/null; then
    petri run w.fl --frames 2 --state old.state
    sweep state a.state old.state good_state run w.fl --frames 2 --threads 1 --quiet --state target/a.state
    echo old >old.csv
    sweep trajectory a.csv old.csv good_csv run w.fl --frames 2 --threads 1 --trajectory target/a.csv
    [ "${PETRI_INJECT:-}" = all ] || tried="1 3"
    kinds=$tried
    [ "${PETRI_INJECT:-}" = all ] || tried="1 5" # the fifth read is that of the trajectory
    # A resumed run extends its trajectory.
    resume_run() { petri run w.fl --frames "$1" --threads 1 --state old.state --trajectory "old.$2"; }
    for format in csv h5; do
        [ $format = csv ] || [ -x "$(dirname "$petri")/petri-hdf5" ] || continue
        rm -f old.state old.$format
        resume_run 2 $format
        cp old.state first.state
        cp old.$format first.$format
        resume_run 1 $format
        cp old.$format good.$format
        cp first.state old.state
        sweep resumed_$format a.$format first.$format is_good run w.fl --frames 1 --threads 1 --state target/s --trajectory target/a.$format
    done
    if [ -x "$(dirname "$petri")/petri-hdf5" ]; then
        petri run w.fl --frames 2 --trajectory good.h5
        sweep h5md a.h5 old.csv is_good run w.fl --frames 2 --threads 1 --trajectory target/a.h5
    fi
    tried=$kinds
    echo 'let A=A or 1' >runs.fl
    sweep golden g.golden old.golden good_golden test --update target/g.fl
    [ "${PETRI_INJECT:-}" = all ] || tried="1 3 7" # the seventh read is that of a result
    sweep table t.csv old.csv good_table sweep runs.fl --jobs 1 -D 'A=1;2' --frames 2 --metric x=A -o target/t.csv
    tried=$kinds
    petri render w.fl --frames 1 -o old.png
    if [ "$status" -eq 0 ]; then
        sweep picture a.png old.csv good_png render w.fl --frames 1 --threads 1 -o target/a.png
        if command -v ffmpeg >/dev/null && [ "${PETRI_INJECT:-}" = all ]; then
            sweep film a.mp4 old.csv good_film render w.fl --frames 2 --threads 1 -o target/a.mp4
        fi
    fi
fi
