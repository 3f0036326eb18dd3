# releases.sh: files of earlier releases (tests/archives). Part of tests/cli/run.sh.

releases=$root/tests/archives
present=$(sed -n 's/#define SPEC_VERSION "\(.*\)"/\1/p' "$root/lib/base/spec.h")
# explained SENTENCE: the last run found a difference, which this change of the specification causes.
explained() { status_is 1 && has out "the specification has changed since" && has out "$1"; }
not_explained() { status_is 1 && has out "to compare the forces"; }
# check_report REPORT SCRIPT: runs the program that checks a report without this program's code.
check_report() {
    "$CHECK_REPORT" "$@" >out 2>err
    status=$?
}

if petri run plain.fl --frames 1 --archive plain.petri && status_is 0; then
    for file in "$releases"/*/*.petri; do
        release=$(basename "$(dirname "$file")")
        archive=$release/$(basename "$file" .petri)
        petri archive verify "$file" --spec "$release"
        check "$archive is equal by the rules of $release" eval 'status_is 0 && has out "verified: "'
        petri archive verify "$file"
        case $archive in
            0.3/floor) check "$archive is explained" explained 'along it, and only a faster one bounces (lib/spec/physics.md 4.4)' ;;
            0.3/cluster) check "$archive is explained" explained 'all pairs where the tree would save nothing (lib/spec/far-field.md 5)' ;;
            *) check "$archive is equal by the present rules" status_is 0 ;;
        esac
        petri archive info "$file"
        check "$archive says its version" has out "spec        $release"
    done

    petri archive verify "$releases/0.3/floor.petri" --spec '0.3 barriers'
    check "a single rule of 0.3 suffices" status_is 0
    petri archive verify "$releases/0.3/floor.petri" --spec '0.3 theta'
    check "another rule does not" explained "only a faster one bounces"

    # A forged digest
    cp "$releases/0.3/floor.petri" forged.petri
    sqlite3 forged.petri "UPDATE digest SET digest = zeroblob(16) WHERE frame = 12" 2>err || true
    if sqlite3 forged.petri "SELECT count(*) FROM digest" >/dev/null 2>&1; then
        petri archive verify forged.petri
        check "a forged digest is no change of the specification" eval 'status_is 2 || not_explained'
    fi

    cat >ball.fl <<'END'
!physics state=:ball dimensions=2
    !constant acceleration=0;-9.8
    !barrier position=0;0 normal=0.1;1 restitution=0.5
    !particle id=0 position=0;0.2 radius=0.1 mass=1
END
    petri run ball.fl --quiet --frames 90 --archive ball.petri
    petri archive verify ball.petri --spec 0.3
    check "a run of the present version differs by the rules of 0.3" \
        has out "the run was computed by version $present of the specification, not by 0.3"
    petri archive verify ball.petri --report report.txt
    check "a verified run has a report" eval 'status_is 0 && has report.txt "spec $present" && has report.txt "frame 89 "'
    # The report can be checked without its archive and without this program's code.
    body=$(grep -c . report.txt)
    head -n $((body - 1)) report.txt >body.txt
    check "the checksum is that of the other lines" has report.txt "checksum $(sha256sum body.txt | cut -d' ' -f1)"
    check "the script's sum is that of the file" has report.txt "script ball.fl $(sha256sum ball.fl | cut -d' ' -f1)"
    petri run ball.fl --quiet --frames 90 --every 89 --print digest
    check "the digests are those of the run" eval \
        'for digest in $(sed -n "s/^= //p" out); do has report.txt "$digest"; done'
    check_report report.txt ball.fl
    check "a program without other code of petri checks the report" eval 'status_is 0 && has out "frame 89: equal"'
    sed 's/^frame 89 ./frame 89 x/' report.txt >forged.txt
    check_report forged.txt ball.fl
    check "it finds a forged digest" eval 'status_is 1 && has out "frame 89: differs"'
    for lines in 1 6 $((body - 1)); do
        head -n "$lines" report.txt >cut.txt
        check_report cut.txt ball.fl
        check "it rejects a report of $lines lines" eval 'status_is 2 && has err "does not end with its checksum"'
    done
    for i in $(seq 70); do echo "let P$i=P$i or 'text'"; done >many.fl
    sed 's/position=0;0.2/position=0;P70/' ball.fl >>many.fl
    petri run many.fl --quiet --frames 9 -D P70=3 -D P1="$(printf '%02000d' 0 | tr 0 y)" --archive many.petri
    petri archive verify many.petri --report many.txt
    check_report many.txt many.fl
    check "it sets all parameters, also long ones" eval 'status_is 0 && has out "frame 8: equal"'
    sed 's/^parameter P70=3/parameter P70 3/' many.txt >forged.txt
    check_report forged.txt many.fl
    check "it reports a parameter without a value" eval 'status_is 2 && has err "cannot set a parameter: P70 3"'
    printf '.archive given.petri\n.step 5\n.save given.state\n.step 3\n.restore given.state\n.step 5\n' >typed
    "$petri" repl ball.fl <typed >out 2>err
    petri archive verify given.petri --report given.txt
    check_report given.txt ball.fl
    check "it cannot check a run with a state that was given" eval 'status_is 2 && has err "only its archive has"'
    cp ball.petri kept.petri
    petri archive verify ball.petri --report ball.petri
    check "a report does not replace an archive" eval 'status_is 2 && has err "it is an archive" && cmp ball.petri kept.petri'
    petri archive verify "$releases/0.3/floor.petri" --spec 0.3 --report old.txt
    petri archive unpack "$releases/0.3/floor.petri" floor
    check_report old.txt floor/floor.fl
    check "it computes by the rules in the report" eval 'status_is 0 && has out "frame 39: equal"'
    petri archive verify "$releases/0.3/floor.petri" --report bad.txt
    check "a run that differs has no report" eval 'status_is 1 && ! [ -e bad.txt ]'
    petri archive verify ball.petri --sample 1 --report bad.txt
    check "a sample has no report" eval 'status_is 2 && has err "needs all frames" && ! [ -e bad.txt ]'
fi

cp "$releases/0.3/floor.state" old.state
petri archive unpack "$releases/0.3/floor.petri" unpacked
mkdir -p unpacked
[ -e unpacked/floor.fl ] || cp count.fl unpacked/floor.fl # in a build without archives
petri run unpacked/floor.fl --frames 1 --state old.state
check "a state of 0.3 continues by the present rules, which is reported" eval \
    "has err \"computed by version 0.3 of the specification; the run continues by $present\""
check "the saved state has the version" eval "sed -n 2p old.state | grep -qx 'spec $present'"
sed 's/^spec .*/spec 9.9/' old.state >new.state
petri run unpacked/floor.fl --frames 1 --state new.state
check "a state of a later version is refused" eval 'status_is 1 && has err "another version of petri"'
petri run "$(cat "$releases/0.3/floor.link")"
if has err "built without"; then
    echo "skipped: links"
else
    check "a link of 0.3 runs by its rules" eval \
        'status_is 0 && has err "matches the link exactly, by the rules of version 0.3 of the specification"'
    petri link unpacked/floor.fl --frame 60
    petri run "$(cat out)"
    check "a new link runs by the present rules" eval 'status_is 0 && has err "state matches the link exactly" && ! has err 0.3'
fi
