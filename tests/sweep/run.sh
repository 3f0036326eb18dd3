#!/bin/sh
# run.sh: tests of `petri sweep`: the runs of a sweep, the table after interruptions and crashes, shards, plans, plots.
# usage: tests/sweep/run.sh PATH-OF-PETRI draws|none yaml|none
# shellcheck disable=SC2016 # dollars are for petri
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
scratch
unset NO_COLOR

sweep() {
    timeout 100 "$petri" sweep "$@" >out 2>err </dev/null
    status=$?
}
out_is() { [ "$(cat out)" = "$1" ]; }
same() { cmp "$1" "$2"; }
# refused NAME TEXT ARGS...: checks that the command line is rejected with a message that contains TEXT.
refused() {
    check_name=$1 text=$2
    shift 2
    sweep "$@"
    check "$check_name" status_is 2
    check "$check_name: the message gives the reason" has err "$text"
}

# --- runs that explode

cat >spring.fl <<'END'
let K=K or 100
!physics state=:s dimensions=1
    !anchor id=:wall
    !particle id=:weight position=10
    !distance from=:wall to=:weight fixed=8 strength=K
END
sweep spring.fl -D 'K=100;30000;200' --frames 60 --metric energy
check "a run that explodes has no result" has out "2,30000,29,,"
check "the table says why" has out "in frame 30 at particle :weight; the largest force on it is this !distance"
check "other runs are not affected" has out "3,200,59,"
check "a sweep with a failed run exits with 1" status_is 1
sweep spring.fl -D 'K=30000;100000;30000' --frames 60 --metric energy --jobs 1
check "each run that explodes is marked, also after others in the same process" [ "$(grep -c ',29,,.*millionfold' out)" -eq 3 ]
sweep spring.fl -D 'K=15000;100;20000;15000' --frames 20 --every 9 --metric energy --summary s.csv -o t.csv --jobs 1
check "every row of an unstable run is marked and keeps its values" \
    [ "$(grep -c '^[134],[0-9]*,[0-9]*,[0-9.e+]\{3,\},".*is unstable: with strength=' t.csv)" -eq 12 ]
check "failed and unstable runs are counted" eval 'status_is 1 && has err "3 of 4 runs failed or are unstable; see the column"'
check "unstable runs are not in the summary" [ "$(cut -d, -f1 s.csv | sort -u | tr '\n' ' ')" = '100 K ' ]
check "the command of an unstable run computes its frames" [ "$(grep -c 'K=15000 --frames 20$' t.csv.runs)" -eq 2 ]

# --- archives

cat >archived.fl <<'END'
%pragma fps 25
import scale from 'scale.fl'
let A=A or 1 B=B or 2*A SEED=SEED or 1
!counter state=:n rate=A
END
echo 'let scale=3' >scale.fl
if "$petri" run archived.fl -D SEED=5 --frames 10 --archive run.petri 2>err; then
    sweep archived.fl -D SEED=5 -D 'A=1;2' --frames 4 --metric b=B --metric time=time --metric scale=scale --metric n='$:n' --every 3
    sed 's/,5,/,/; s/,SEED//' out >expected
    rm archived.fl scale.fl
    sweep run.petri -D 'A=1;2' --frames 4 --metric b=B --metric time=time --metric scale=scale --metric n='$:n' --every 3 --jobs 2
    check "the script of an archive runs with its own and with other parameters" same expected out
    sweep run.petri -D 'A=1;2' --frames 4 --metric seed=SEED -o table.csv
    grep ' -D A=2 ' table.csv.runs >again
    sh ./again >out
    check "each run of an archive's script can be repeated" out_is 'run,A,frame,seed,error
1,2,3,5,'
    sed 2d table.csv >expected
    sed 's/^1,/2,/' out | cmp -s - expected
    check "the repeated run has the same result" [ $? -eq 0 ]
    refused "--cache needs a script" "cannot use '--cache' with an archive" run.petri -D A=1..2 --metric a=A --cache store
    head -c 3000 run.petri >cut.petri
    sweep cut.petri -D A=1..2 --metric a=A
    check "a damaged archive is an error" eval 'status_is 1 && has err "cannot read"'
else
    check "a build without SQLite says what is missing" has err "built without SQLite"
fi

# --- the runs

cat >sum.fl <<'END'
let A=A or 1 B=B or 2 SEED=SEED or 1 V=V or (1;2)
END
sweep sum.fl -D 'A=1;5..20|5' -D B=2 --frames 3 --metric total=A+B
check "lists may contain ranges; a single value is a constant" out_is 'run,A,B,frame,total,error
1,1,2,2,3,
2,5,2,2,7,
3,10,2,2,12,
4,15,2,2,17,
5,20,2,2,22,'
sweep sum.fl -D A=0.1..0.3\|0.1 --seeds 2 --frames 1 --metric a=A --metric s=SEED
check "steps are decimal, seeds change fastest" out_is 'run,A,SEED,frame,a,s,error
1,0.1,1,0,0.1,1,
2,0.1,2,0,0.1,2,
3,0.2,1,0,0.2,1,
4,0.2,2,0,0.2,2,
5,0.3,1,0,0.3,1,
6,0.3,2,0,0.3,2,'
cat >orbit.fl <<'END'
let SPEED=SPEED or 1
!physics state=:sun dimensions=2 resolution=1/1000
    !particle id=:a position=1;0 velocity=0;SPEED mass=2
    !anchor id=:centre mass=1
    !gravity strength=1
!physics state=:other dimensions=1
    !particle id=:b velocity=3
END
sweep orbit.fl -D 'SPEED=1;2' --frames 61 --every 60 --metric energy --metric kinetic_energy --metric potential_energy \
    --metric momentum --metric angular_momentum
check "quantities need no expression" [ "$(sed -n 2p out)" = "1,1,0,3.5,5.5,-2,3;2,2," ]
check "energy is conserved" eval "awk -F, 'NR > 1 && NR % 2 { d = \$4 - e; if (d * d > 1e-6) exit 1 } { e = \$4 }' out"
check "angular momentum is conserved" eval "awk -F, 'NR > 1 && NR % 2 { d = \$8 - l; if (d * d > 1e-12) exit 1 } { l = \$8 }' out"
refused "an unknown quantity is rejected" "expects NAME=EXPR, energy, kinetic_energy" sum.fl -D A=1 --metric enery

sweep sum.fl -D 'V=(3;4)' --frames 1 --metric length=len\(V\) --metric 'text="a,b"' --metric 'nothing=null'
check "parentheses make a vector; cells are quoted if necessary" out_is "run,V,frame,length,text,nothing,error
1,3;4,0,2,\"'a,b'\",,"
sweep sum.fl -D 'V=(3;4);(5;6;7)' --frames 1 --metric length=len\(V\)
check "a list may contain vectors in parentheses" [ "$(tail -n 2 out)" = '1,3;4,0,2,
2,5;6;7,0,3,' ]
sweep sum.fl -D A=1..3 -D B=1..3 --where 'A < B' --frames 1 --metric total=A+B
check "--where selects combinations" [ "$(tail -n 3 out)" = '1,1,2,0,3,
2,1,3,0,4,
3,2,3,0,5,' ]
sweep sum.fl -D A=1..2 --frames 8 --every 3 --until 'frame >= A*4' --metric total=A+frame
check "--every adds rows and --until ends runs" out_is 'run,A,frame,total,error
1,1,0,1,
1,1,3,4,
1,1,4,5,
2,2,0,2,
2,2,3,5,
2,2,6,8,
2,2,7,9,'
sweep sum.fl -D A=1..9 -D B=10..20\|1 --sample latin:11 --frames 1 --metric b=B
check "--sample latin:N makes N runs" lines_are out 12
check "a Latin sample uses each of eleven steps once" [ "$(cut -d, -f5 out | tail -n 11 | sort -n | uniq | wc -l)" -eq 11 ]
slices=$(tail -n 11 out | cut -d, -f2 | awk '{ print int(($1 - 1) / 8 * 11) }' | sort -n | uniq | wc -l)
check "a Latin sample uses each slice of a range once" [ "$slices" -eq 11 ]
cp out first
sweep sum.fl -D A=1..9 -D B=10..20\|1 --sample latin:11 --frames 1 --metric b=B --jobs 3
check "a sample does not depend on the number of processes" same out first
sweep sum.fl -D A=1..9 -D B=10..20\|1 --sample latin:11:7 --frames 1 --metric b=B
check "a different seed gives a different sample" [ "$(cmp -s out first; echo $?)" -eq 1 ]

# --- summary and plots

sweep sum.fl -D A=1..2 --seeds 4 --frames 1 --metric x=A*SEED*SEED --summary means.csv -o t.csv
check "--summary writes mean, deviation, interval and quartiles" [ "$(cat means.csv)" = 'A,metric,runs,mean,std,half_width,min,q1,median,q3,max
1,x,4,7.5,6.5574385243,10.4343480019,1,3.25,6.5,10.75,16
2,x,4,15,13.1148770486,20.8686960038,2,6.5,13,21.5,32' ]
# The quantiles of Student's distribution in tables are 12.706, 4.303, 2.262, 2.045 and 1.984.
for row in 2:12.706 3:4.303 10:2.262 30:2.045 100:1.984; do
    sweep sum.fl -D A=1 --seeds "${row%:*}" --frames 1 --metric x=SEED --summary means.csv -o t.csv
    check "the interval of ${row%:*} runs is Student's" \
        [ "$(awk -F, -v n="${row%:*}" 'NR == 2 { printf "%.3f", $6 / $5 * sqrt(n) }' means.csv)" = "${row#*:}" ]
done
sweep sum.fl -D A=1..2 --frames 9 --until 'frame == A' --summary means.csv -o t.csv
check "without metrics, --summary summarises the last frame" has means.csv '2,frame,1,2,,,2,2,2,2,2'
if [ "$2" = draws ]; then
    sweep sum.fl -D A=1..5 -D 'B=1;2' --frames 3 --metric x=A*B --plot plot.png -o t.csv
    check "--plot writes a PNG file" [ "$(head -c 4 plot.png | tail -c 3)" = PNG ]
    check "--plot prints no diagnostics" [ "$(wc -l <err)" -eq 1 ]
    sweep sum.fl -D A=1 --frames 3 --metric x=null --every 1 --plot empty.png -o t.csv
    check "--plot accepts metrics without values" [ -s empty.png ]
    # ticks: prints the distances between the ticks of the first x axis.
    ticks() { sed -n 's/.* d="M \([0-9.]*\) 180 L [0-9.]* 184 .*/\1/p' plot.svg | awk 'NR > 1 { printf "%.0f ", $1 - before } { before = $1 }'; }
    for values in '1;10;100;1000' '1;2;4;8;16;32;64;128' '100;0.1;1'; do
        sweep sum.fl -D "A=$values" --frames 1 --metric x=-A --plot plot.svg -o t.csv
        check "the axis of $values is logarithmic: a tick for each decade, at equal distances" \
            [ "$(ticks)" = "$(case $values in *128) echo '97 97 ' ;; *) echo '68 68 68 ' ;; esac)" ]
    done
    for values in '1..100|9' '0;1;10;100' '-1;10;100;1000' '20;90' '1;5;9'; do
        sweep sum.fl -D "A=$values" -D B=1 --frames 1 --metric x=-B --plot plot.svg -o t.csv
        check "the axis of $values is linear" [ "$(ticks | wc -w)" -ge 3 ]
    done
    # bars: prints the upper and lower ends of the error bars.
    bars() { sed -n 's/.*stroke-width:1.2;.* d="M [0-9.]* \([0-9.]*\) L [0-9.]* [0-9.]* L [0-9.]* [0-9.]* L [0-9.]* \([0-9.]*\) .*/\1 \2/p' plot.svg; }
    sweep sum.fl -D A=1..3 --seeds 2 --frames 1 --metric x=A+SEED --plot plot.svg -o t.csv
    # The values are 2, 3; 3, 4; 4, 5: each bar begins where the one before it ends.
    bars >ends
    check "with two seeds, the standard error reaches both values" \
        eval 'lines_are ends 3 && awk "NR > 1 && (\$2 - top) ^ 2 > 1e-4 { exit 1 } { top = \$1 }" ends'
    sweep sum.fl -D A=1..3 --frames 1 --metric x=A --plot plot.svg -o t.csv
    check "one value has no error bar" [ "$(bars | wc -l)" -eq 0 ]
    # cells: prints the colours of the cells of the heat map.
    cells='s/.*stroke:none.*fill:\(rgb([0-9.%,]*\)).* d="M \(7[0-9]\|8[0-4]\)[0-9.]* [0-9.]* L [0-9.]* [0-9.]* L [0-9.]* [0-9.]* L [0-9.]* [0-9.]* Z M.*/\1/p'
    # bar: prints the number of colours of the bar beside it.
    bar() { sed -n "$(printf '%s\n' "$cells" | sed 's/7\[0-9\]\\|8\[0-4\]/86/')" plot.svg | sort -u | wc -l; }
    sweep sum.fl -D A=1..5 -D 'B=1;3;10;30' --seeds 3 --frames 1 --metric 'x=A*B*SEED if A+B != 5 else null' --plot plot.svg -o t.csv
    check "two parameters have a heat map, without cells that have no value" [ "$(sed -n "$cells" plot.svg | wc -l)" -eq 18 ]
    check "one cell is the largest and one the smallest" \
        [ "$(sed -n "$cells" plot.svg | grep -c 'rgb(94.9\|rgb(95%') $(sed -n "$cells" plot.svg | grep -c 'rgb(20%')" = "1 1" ]
    check "a bar explains the colours" [ "$(bar)" -eq 32 ]
    sweep sum.fl -D 'A=1;10;100' -D 'B=1;10' --frames 1 --metric a_metric_with_a_long_name=A*B --plot plot.svg -o t.csv
    check "colours of numbers that span decades are logarithmic" \
        [ "$(sed -n "$cells" plot.svg | grep -c 'rgb(45') $(sed -n "$cells" plot.svg | grep -c 'rgb(70')" = "2 2" ]
    sweep sum.fl -D A=1..2 -D B=1..2 --frames 1 --metric x=null --plot plot.svg -o t.csv
    check "a map without values has no bar" [ "$(bar)" -eq 0 ]
    check "means over another parameter have no error bars" [ "$(bars | wc -l)" -eq 0 ]
    sweep sum.fl -D A=1..5 -D B=1..3 --sample latin:9 --frames 1 --metric x=A --plot plot.svg -o t.csv
    check "a sample has no heat map" [ "$(sed -n "$cells" plot.svg | wc -l)" -eq 0 ]
fi

# --- tables in HDF5

if [ -x "$(dirname "$petri")/petri-hdf5" ]; then
    for jobs in 1 3; do
        sweep sum.fl -D A=1..3 -D 'V=(3;4);(5;6;7)' --frames 2 --every 1 --metric 'half=A/2' --metric 'text="a,b"' \
            --metric 'part=A/3 if A > 1 else null' --jobs $jobs -o t$jobs.h5
    done
    check "-o FILE.h5 writes a table in HDF5" status_is 0
    check "the HDF5 table does not depend on the number of processes" same t1.h5 t3.h5
    check "no other files remain beside the HDF5 table" [ "$(echo t1.h5*)" = "t1.h5 t1.h5.runs" ]
    sweep sum.fl -D A=1 --frames 1 --metric a=A -o absent/t.h5
    check "an unwritable table is reported before the runs" eval 'status_is 1 && count_is err "cannot write absent/t.h5: No such file" 1'
    if /usr/bin/python3 -I -c 'import h5py' 2>err; then
        sweep sum.fl -D A=1..3 -D 'V=(3;4);(5;6;7)' --frames 2 --every 1 --metric 'half=A/2' --metric 'text="a,b"' \
            --metric 'part=A/3 if A > 1 else null' -o t.csv
        /usr/bin/python3 -I - t1.h5 t.csv >out 2>&1 <<'END'
import csv, math, sys, h5py
table = h5py.File(sys.argv[1])["table"][:]
lines = list(csv.DictReader(open(sys.argv[2], newline="")))
assert list(table.dtype.names) == list(lines[0]) and len(table) == len(lines) == 12
for record, line in zip(table, lines):
    for name, text in line.items():
        value = record[name]
        kind = table.dtype[name].kind
        if kind == "f":
            assert math.isnan(value) if text == "" else value == float(text), (name, text)
        else:
            assert (str(value) if kind == "i" else value.decode()) == text, (name, text)
print("".join(table.dtype[name].kind for name in table.dtype.names))
END
        check "the HDF5 table has the numbers and texts of the CSV table" out_is iiSifSfS
        sweep sum.fl -D A=1..3 -D 'V=(3;4);(5;6;7)' --frames 2 --metric 'half=A/2' --metric 'text="a,b"' -o grid.h5
        sweep sum.fl -D 'A=1;2' -D 'B=1;2' --where 'A<=B' --frames 2 --metric a=A -o part.h5
        sweep sum.fl -D 'A=1;2;1' --frames 2 --metric a=A -o twice.h5
        sweep sum.fl -D 'A=1;2' --frames 2 --metric table=A -o name.h5
        /usr/bin/python3 -I - grid.h5 t1.h5 part.h5 twice.h5 name.h5 >out 2>&1 <<'END'
import sys, h5py
file = h5py.File(sys.argv[1])
assert list(file["A"]) == [1, 2, 3] and list(file["V"].asstr()) == ["3;4", "5;6;7"]
for name in "frame", "half", "text", "error":
    assert [list(scales) for scales in file[name].dims] == [["A"], ["V"]], name
    assert list(file[name][:].ravel()) == list(file["table"][name]), name
assert file["half"].dims[1][0] == file["V"] and h5py.h5ds.is_scale(file["A"].id)
assert [int(dimension) for used, dimension in file["V"].attrs["REFERENCE_LIST"]] == [1] * 4
print([list(h5py.File(name)) for name in sys.argv[2:]])
END
        check "complete HDF5 tables have arrays whose dimensions are the parameters" \
            out_is "[['table'], ['table'], ['table'], ['table']]"
        # kinds ARGS...: prints the kinds of the columns of a table.
        kinds() {
            sweep sum.fl --metric m=A --metric n='null if A > 0 else A' "$@" -o kinds.h5
            /usr/bin/python3 -I -c 'import h5py; table = h5py.File("kinds.h5")["table"].dtype
print("".join(table[name].kind for name in table.names))' 2>&1
        }
        check "metrics are numbers, whole or not" [ "$(kinds -D 'A=1;2' --frames 1) $(kinds -D 'A=0.5;2' --frames 1)" = "iiiffS ififfS" ]
        check "runs that --where excludes do not change kinds" [ "$(kinds -D 'A=0.5;2' --where 'A == 2' --frames 1)" = ififfS ]
        check "a table without rows has the same kinds" [ "$(kinds -D 'A=1;2' --frames 0)" = iiiffS ]
        check "failed runs do not change kinds" [ "$(kinds -D 'A=1;2' --frames 2 --work 1)" = iiiffS ]
        check "a text in one row makes a metric text" [ "$(kinds -D 'A=2;1' --metric t='A/8 if A > 1 else :x' --frames 1)" = iiiffSS ]
        # Every number has the bits that the script computed, also after an interruption and from a cache.
        exact() {
            sweep sum.fl -D 'A=1000000000000000001;2' -D 'B=9223372036854775808;-0.5' --seeds 3 --frames 1 --metric tiny=A*0+5e-324 \
                --metric zero=A*-0.0 --metric part=0.1+0.2*A --metric big=2**63*A --metric t='A/8 if A < 9 else :x' "$@" -o exact.h5
        }
        exact
        mv exact.h5 whole.h5
        /usr/bin/python3 -I - >out 2>&1 <<'END'
import h5py
table = h5py.File("whole.h5")["table"][:]
assert list(table["A"]) == [1000000000000000001] * 6 + [2] * 6, table["A"]
assert list(table["B"][:6]) == [9223372036854775808.0] * 3 + [-0.5] * 3, table["B"]
for row in table:
    a = float(row["A"])
    values = [row[name].item() for name in ("tiny", "zero", "part", "big")]
    assert [value.hex() for value in values] == [x.hex() for x in (5e-324, -0.0, 0.1 + 0.2 * a, 2.0**63 * a)], values
print([text.decode() for text in table["t"][5:7]])
END
        check "numbers in HDF5 have all their bits; a number in a column of texts is written as in CSV" out_is "[':x', '0.25']"
        exact --shard 1/2
        exact --shard 2/2
        check "numbers from a journal have the same kinds and bits" same whole.h5 exact.h5
        rm exact.h5
        exact --cache exactly
        exact --cache exactly
        check "numbers from a cache have the same kinds and bits" eval 'same whole.h5 exact.h5 && has err "12 from the cache"'
    fi
fi

# --- the table after interruptions and crashes

cat >dish.fl <<'END'
let DROPS=DROPS or 20 -- 1..100 how many
    SEED=SEED or 1
!physics state=:drops dimensions=2
    for i in ..DROPS
        !particle id=i position=9*normal(:start;SEED)[2*i;2*i+1]
    !gravity strength=50
    !collision strength=100
END
far='far=sum(hypot($(:drops;i)) for i in ..DROPS)'
# cells ARGS...: runs the sweep that the tests interrupt.
before=
cells() { $before "$petri" sweep dish.fl -D DROPS=10..30\|5 --seeds 12 --frames 500 --every 250 --metric "$far" --quiet "$@"; }
cells --jobs 1 -o whole.csv
check "60 runs have three rows each" lines_are whole.csv 181
check "no journal remains beside the table" [ "$(echo whole.csv*)" = "whole.csv whole.csv.runs" ]
cells --jobs 3 >out
check "rows are in the order of the runs" same whole.csv out
line=$(sed -n 47p whole.csv.runs)
value=$(awk -F, '$1 == 47 && $4 == 499 { print $5 }' whole.csv)
sh -c "$line --print log" >out 2>err
check "a line of FILE.runs is a valid command" status_is 0
sh -c "$line --print state" 2>err | awk '/^@499 /{ on = 1 } on' >state
again=$(awk '/^\$\(:drops;[0-9]+\) = / { split($3, p, ";"); sum += sqrt(p[1]*p[1] + p[2]*p[2]) } END { printf "%.9g", sum }' state)
check "a line of FILE.runs repeats the run: $value" [ "$again" = "$(printf '%.9g' "$value")" ]

# runs_of FILE: prints the number of results in a journal.
runs_of() { cat "$1" 2>/dev/null | grep -ac '^run '; }
# kill_at COUNT [SIGNAL]: kills the sweep after it has completed COUNT runs. If it has already finished, as may happen
# on a busy machine, tries again.
kill_at() {
    for try in 1 2 3 4 5 6 7 8 9; do
        (before=exec && cells --jobs 2 -o killed.csv 2>err) &
        child=$!
        while kill -0 $child 2>/dev/null && [ "$(runs_of killed.csv.part)" -lt "$1" ]; do :; done
        kill "${2:--KILL}" $child 2>/dev/null
        wait $child 2>/dev/null
        status=$?
        [ -e killed.csv ] || break
        rm -f killed.csv*
    done
}
for count in 1 5 6 13 20; do
    kill_at $count
    check "killed after $count runs: the journal has these runs" [ "$(runs_of killed.csv.part)" -ge $count ]
    check "killed after $count runs: no table is written" [ ! -e killed.csv ]
done
printf 'run 59 100 5' >>killed.csv.part # an incomplete result
cells -o killed.csv
check "a resumed sweep writes the same table to the last byte" same whole.csv killed.csv
check "a resumed sweep writes the same commands" same whole.csv.runs killed.csv.runs
check "a finished sweep removes its journal" [ ! -e killed.csv.part ]

kill_at 5
sweep dish.fl -D DROPS=10..30\|5 --seeds 12 --frames 501 --every 250 --metric "$far" -o killed.csv
check "a journal of another sweep is rejected" status_is 2
check "the message about a journal of another sweep says what to do" has err 'to start over, remove that file'
rm killed.csv.part
kill_at 2
sed -i '1s/^petri sweep 2/petri sweep 1/' killed.csv.part
cp killed.csv.part before.part
cells -o killed.csv 2>err
check "a journal of an earlier version is rejected" has err "petri's version have changed; to start over, remove that file"
check "a journal of an earlier version is kept" same killed.csv.part before.part
rm killed.csv.part
kill_at 3 -TERM
check "SIGTERM ends the sweep" status_is 143
check "a stopped sweep prints how to resume" has err 'run the same command to resume'
cat >slow.fl <<'END'
let N=N or 1 BIG=sum(i*i for i in ..100000*N+0*frame)
END
"$petri" sweep slow.fl -D N='1;1;1;1;1;1' --frames 600 --metric x=BIG --jobs 1 -o slow.csv 2>err &
child=$!
while kill -0 $child && [ ! -s slow.csv.part ]; do :; done
kill -STOP $child # the old process still holds the lock
sweep slow.fl -D N='1;1;1;1;1;1' --frames 600 --metric x=BIG --jobs 1 -o slow.csv
check "two processes cannot use one journal" status_is 1
check "a journal in use is reported" has err 'slow.csv.part is in use by another petri process'
kill -9 $child
wait $child 2>/dev/null
ln -s target.csv linked.csv.part
sweep slow.fl -D N=1 --frames 1 --metric x=BIG -o linked.csv
check "a journal is not written through a symbolic link" [ ! -e target.csv ]
check "a symbolic link as journal is reported" has err 'cannot write linked.csv.part: it is a symbolic link'

worker() { pgrep -P "$1" | head -n 1; }
# Kills a worker. SIGKILL is what the kernel sends when memory is short, so the run is executed again. After any other
# signal, the run counts as crashed.
kill_one() {
    for try in 1 2 3 4 5 6 7 8 9; do
        rm -f slow.csv*
        "$petri" sweep slow.fl -D N='1;1;1;1;1;1' --frames 30 --metric x=BIG --jobs 1 --quiet -o slow.csv 2>err &
        child=$!
        while kill -0 $child && [ "$(runs_of slow.csv.part)" -lt 1 ]; do :; done
        kill "$1" "$(worker $child)" 2>/dev/null
        left=$((6 - $(runs_of slow.csv.part)))
        wait $child
        status=$?
        [ $left -lt 2 ] || [ $left -gt 5 ] || break
    done
}
if command -v pgrep >/dev/null; then
    kill_one -KILL
    check "a killed worker is not a failure" status_is 0
    check "the run of a killed worker is executed again" [ "$(grep -c ',29,333328333350000,$' slow.csv)" -eq 6 ]
    kill_one -ABRT
    check "a crashed run is a row of the table" [ "$(grep -c '^[2-6],1,0,,crashed: signal 6' slow.csv)" -eq 1 ]
    check "a crash affects one run only" [ "$(grep -c ',29,333328333350000,$' slow.csv)" -eq 5 ]
fi
sweep slow.fl -D 'N=1;100;2' --frames 2 --metric x=N --work 5M
check "an exceeded limit is a row with its message" [ "$(cut -c 1-62 out | sed -n '3p;4p')" = '2,100,0,,slow.fl:1:22: the frame exceeded its limit of 5242880
3,2,1,2,' ]
check "the number of failed runs is reported" eval 'status_is 1 && has err "1 of 3 runs failed"'

# --- shards

for part in 2 1 3; do
    check "no table is written before shard $part/3 has run" [ ! -e parts.csv ]
    cells --jobs 1 --shard $part/3 -o parts.csv 2>err
done
check "the last shard writes the table" same whole.csv parts.csv
check "no journals remain after all shards" [ "$(echo parts.csv*)" = "parts.csv parts.csv.runs" ]
mkdir bare
cp "$petri" bare
(petri=$work/bare/petri && OMPI_COMM_WORLD_RANK=1 OMPI_COMM_WORLD_SIZE=2 cells -o parts2.csv 2>err)
check "without MPI, each process of mpirun is a shard" exists parts2.csv.part-2-of-2
cells -o parts2.csv
check "a sweep without shards uses the journal of a shard" same whole.csv parts2.csv
check "a finished sweep removes the journal of a shard" [ "$(echo parts2.csv*)" = "parts2.csv parts2.csv.runs" ]

# --- plans

if [ "$3" = yaml ]; then
    mkdir plans
    cp sum.fl plans
    cat >plans/sum.yaml <<'END'
script: sum.fl
define:
  A: 1..3
  V: [(3;4), 5;6]   # two vectors
frames: 2
metric:
  total: >-
    A +
    sum(V)
END
    sweep --plan plans/sum.yaml
    check "--plan reads script and options" out_is 'run,A,V,frame,total,error
1,1,3;4,1,8,
2,1,5;6,1,12,
3,2,3;4,1,9,
4,2,5;6,1,13,
5,3,3;4,1,10,
6,3,5;6,1,14,'
    sweep --plan plans/sum.yaml -D A=7 --frames 5
    check "the command line overrides the plan" [ "$(sed -n 2p out)" = '1,7,3;4,4,14,' ]
    printf 'script: sum.fl\nfrmes: 2\n' >wrong.yaml
    refused "an unknown option in a plan is rejected" "wrong.yaml:2:1: not an option of petri sweep: 'frmes'; did you mean frames" --plan wrong.yaml
    printf 'script: sum.fl\nframes: x\n' >wrong.yaml
    refused "an invalid value in a plan is rejected" "option '--frames' expects an integer" --plan wrong.yaml
    printf 'a: [1\n' >wrong.yaml
    refused "a plan that is not YAML is rejected" 'wrong.yaml:2:1: not valid YAML' --plan wrong.yaml
    head -c 100000 /dev/zero | tr '\0' ' ' >large.yaml
    refused "a plan of more than 64 KiB is rejected" 'cannot read large.yaml: it is too large' --plan large.yaml
    head -c 60000 /dev/zero | tr '\0' '[' >deep.yaml
    refused "deeply nested brackets are rejected" 'deep.yaml: more than 64 nested brackets' --plan deep.yaml
    refused "a missing plan is rejected" 'cannot read nope.yaml: No such file' --plan nope.yaml
    sweep --plan "$root/samples/dish.yaml" --frames 2 -D DROPS=5 --summary means.csv
    check "the sample plan runs" [ "$(cut -d, -f1-4 out | tail -n 1)" = '3,5,0.5,1' ]
else
    refused "plans need libyaml" 'built without libyaml' --plan sum.yaml
fi

# --- the cache

# shellcheck source=tests/sweep/cache.sh
. "$here/cache.sh"

# --- errors

refused "a missing script is rejected" 'no script given'
refused "a sweep without metrics is rejected" 'nothing to measure' sum.fl
refused "an empty range is rejected" 'empty range 3..1' sum.fl -D A=3..1 --metric a=A
printf 'let A=A or 7 -- 1..9\n' >defaults.fl
for values in '2;0' '2;-0' '3;0.0' '2;0;0' '1;(0;0)' '-1..1'; do
    refused "the values $values are rejected, because one has no effect" "write 'let A=A if A != null else 7'" defaults.fl -D "A=$values" --metric a=A
done
cat >late.fl <<'END'
let N=N or 2
    CONSTANT=N*3
func place(i)
    $(:s;i)
func loop(i)
    loop(i-1) if i > 0 else 0
let direct=$(:s;0)
    indirect=place(0)+CONSTANT
    recursive=loop(3)
func _inside()
    place(0)
!physics state=:s dimensions=1
    !particle id=0 position=0 velocity=N
END
for metric in direct indirect ' indirect '; do
    sweep late.fl -D N=1 --frames 3 --metric "m=$metric"
    check "the metric $metric is late" eval 'status_is 0 && has err "reads the state, so it is one frame late"'
done
for metric in N CONSTANT recursive '_inside()' '$(:s;0)' 'indirect+0*N' 'place(0)'; do
    sweep late.fl -D N=1 --frames 3 --metric "m=$metric"
    check "nothing is said about the metric $metric" eval 'status_is 0 && lacks err late'
done
sweep late.fl -D N=1 --frames 3 --metric direct=direct --metric 'now=$(:s;0)' --every 1
check "it has the value after the frame before" [ "$(sed -n 3p out | cut -d, -f4)" = "$(sed -n 2p out | cut -d, -f5)" ]
sweep late.fl -D N=1 --frames 3 --metric m=direct --quiet
check "--quiet hides the hint" empty err
refused "a later value of the wrong type is rejected" "cannot start the sweep: the script does not accept A=x" defaults.fl -D 'A=2;3;x' --metric a=A
printf 'let A=A if A != null else 7\n    B=B or 0\n' >zeros.fl
sweep zeros.fl -D 'A=-1..1' -D 'B=0;2' --frames 1 --metric 's=A+B' --quiet
check "values of 0 are used where the script accepts them" [ "$(cut -d, -f5 out | tail -n 6 | tr '\n' ' ')" = '-1 1 0 2 1 3 ' ]
sweep defaults.fl -D 'A=0..3' --where 'A > 0' --frames 1 --metric a=A
check "values that --where excludes are not rejected" eval 'status_is 0 && lines_are out 4'
refused "a range with step 0 is rejected" "not a range: '1..9|0'" sum.fl -D 'A=1..9|0' --metric a=A
refused "a range is not written with a minus" "write a range as 1..9" sum.fl -D A=1-9 --metric a=A
refused "a value that the script replaces by its default is rejected" "A=0 has no effect" defaults.fl -D A=0..2 --metric a=A
refused "a range without an end is rejected" "not a range: '1..'" sum.fl -D A=1.. --metric a=A
refused "NetCDF is rejected" 'ends in .csv or .h5' sum.fl -D A=1..3 --metric a=A -o table.nc
refused "an empty value is rejected" 'empty value' sum.fl -D 'A=1;;2' --metric a=A
refused "a metric named like a column is rejected" 'already has a column with this name' sum.fl -D A=1 --metric A=1
refused "a metric that is not an expression is rejected" "cannot evaluate the expression of '--metric': '1+'" sum.fl --metric 'a=1+'
refused "a condition with an unbound name is rejected" "cannot evaluate the condition of '--where'" sum.fl -D A=1 --where 'X > 1' --metric a=A
check "the diagnostic shows the condition as written" has err '    X > 1'
refused "a condition that is never true is rejected" "no runs: 'A > 5' is never true" sum.fl -D A=1 --where 'A > 5' --metric a=A
refused "an unknown kind of sample is rejected" 'latin:COUNT' sum.fl -D A=1..2 --sample grid --metric a=A
refused "too many runs are rejected" 'too many runs' sum.fl -D A=1..10000 -D B=1..10000 --metric a=A
refused "an invalid shard is rejected" 'expects I/N' sum.fl --shard 3/2 --metric a=A -o t.csv
refused "a value of the wrong type is rejected" "'x' is not a number" sum.fl -D A=x --metric a=A
sweep gone.fl --metric a=1
check "a missing script file is an error" status_is 1
check "a missing script file is reported" has err "cannot read 'gone.fl'"
refused "a name that the script does not read is rejected" "the script does not read 'C'" sum.fl -D C=1..2 --metric a=A
check "an unused definition is reported once" count_is err "unused definition 'C'" 1
refused "a misspelt parameter is rejected with a hint, also with --quiet" "did you mean 'SEED'" sum.fl -D SEDE=1..2 --metric a=A --quiet
refused "seeds that the script does not read are rejected" "the script does not read 'SEED'" defaults.fl --seeds 3 --metric a=A
refused "names of the engine cannot be varied" "petri sets this name itself" sum.fl -D fps=1..2 --metric a=A
refused "a misspelt metric is rejected with a hint, also with --quiet" "did you mean 'A'" sum.fl -D A=1..2 --metric 'a=AA+B' --quiet -o refused.csv
refused "a misspelt name in --until is rejected" "the expression of '--until': 'frme > 3'" sum.fl -D A=1..2 --metric a=A --until 'frme > 3'
refused "a misspelt metric is rejected although the first run fails" "unbound name 'AA'" slow.fl -D 'N=100;1' --work 5M --metric a=AA+N
check "a rejected sweep leaves no files" [ ! -e refused.csv ]
sweep sum.fl -D 'LIMIT=1..3' --until 'frame == LIMIT' --metric 'a=A if FINE or 1 else 0' --frames 9
check "a name that only --until reads can be varied, without a warning" \
    eval '[ "$(cut -d, -f3 out | tail -n 3 | tr "\n" " ")" = "1 2 3 " ] && [ ! -s err ]'
sweep sum.fl -D LIMIT=1..3 --metric 'a="LIMIT"' --frames 1
check "a name in a string is not read" status_is 2

finish
