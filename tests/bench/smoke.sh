#!/bin/sh
# smoke.sh: checks that the tables of the bench are complete and that CSV and Markdown agree. Does not judge figures.
# usage: smoke.sh PATH-OF-BENCH PATH-OF-PEERS
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
bench=$1
peers=$2
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
refuses() { ! "$@" >"$work/refused" 2>&1; }

# csv_is_complete FILE COLUMNS...: each row has as many fields as the first, the table has these columns and at least one
# row, and each field is a text, empty, or a finite number >= 0.
csv_is_complete() {
    awk -F, -v wanted="$(shift && echo "$*")" '
        NR == 1 {
            fields = NF
            for (i = 1; i <= NF; i++) there[$i] = 1
            n = split(wanted, names, " ")
            for (i = 1; i <= n; i++) if (!(names[i] in there)) { print "no column " names[i]; bad = 1 }
            next
        }
        NF != fields { print "row " NR " has " NF " fields"; bad = 1 }
        { for (i = 1; i <= NF; i++) if ($i ~ /^-|nan|inf/) { print "row " NR ": " $i; bad = 1 } }
        END { exit bad || NR < 2 }' "$1"
}

# positive FILE COLUMNS...: these columns have a positive number in each row.
positive() {
    awk -F, -v wanted="$(shift && echo "$*")" '
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; n = split(wanted, names, " "); next }
        { for (i = 1; i <= n; i++) if (!($at[names[i]] > 0)) { print $1 ": " names[i] " is " $at[names[i]]; bad = 1 } }
        END { exit bad }' "$1"
}

# same_rows CSV TEXT: each name in the first column of the CSV also begins a row of the text.
same_rows() {
    sed -e 1d -e 's/,.*//' "$1" | while read -r name; do
        grep -q "^|* *$name " "$2" || { echo "no row $name"; exit 1; }
    done
}

rows_are() { [ "$(sed 1d "$1" | wc -l)" -eq "$2" ]; }

check "the bench exits with 0" "$bench" --tiny --threads 2 --busy 1 --against "$bench" --csv "$work/t.csv" --markdown "$work/t.md" >"$work/text" \
    2>"$work/err"
check "the table of workloads is complete" csv_is_complete "$work/t.csv" workload limit_ns of_limit_percent speed_up exponent peak_mib allocations \
    bytes_per_particle frame_spread_percent
check "a tiny run has five workloads" rows_are "$work/t.csv" 5
check "figures of workloads are positive" positive "$work/t.csv" evaluation_us physics_us frame_us output_us unit_ns threads_physics_us \
    threads_frame_us start_least_ms start_median_ms load_ms peak_mib bytes_per_particle
check "the table of builds is complete" csv_is_complete "$work/t-builds.csv" workload physics_ratio frame_ratio
check "ratios of builds are positive" positive "$work/t-builds.csv" physics_ratio frame_ratio
check "the table of sweeps is complete" csv_is_complete "$work/t-sweeps.csv" jobs seconds runs_per_s speed_up of_jobs
check "figures of sweeps are positive" positive "$work/t-sweeps.csv" jobs seconds runs_per_s speed_up of_jobs
check "the table of targets is complete" csv_is_complete "$work/t-targets.csv" target petri reference ratio must aim met
for form in text t.md; do
    check "$form has the workloads" same_rows "$work/t.csv" "$work/$form"
    check "$form has the targets" same_rows "$work/t-targets.csv" "$work/$form"
    check "$form describes the machine" grep -q 'processors.* threads; ' "$work/$form"
done
check "an unknown option is rejected" refuses "$bench" --nonsense
check "an option without its value is rejected" refuses "$bench" --csv
check "an unwritable file is an error" refuses "$bench" --tiny --csv "$work/no/such/file.csv"

# LAMMPS is rarely installed: makes a fake one that prints the same lines.
mkdir "$work/bin"
cat >"$work/bin/lmp" <<'END'
#!/bin/sh
case $1 in
-h) printf 'Large-scale Atomic/Molecular Massively Parallel Simulator - 1 Jan 2000\nsoft table harmonic/cut\n' ;;
*)
    echo 'Loop time of 1 on 2 procs for 100 steps with 10000 atoms'
    echo 'Loop time of 0.5 on 2 procs for 400 steps with 10000 atoms'
    echo '99.5% CPU use with 2 MPI tasks x 1 OpenMP threads'
    echo 'Neighbor list builds = 40'
    ;;
esac
END
cat >"$work/bin/mpirun" <<'END'
#!/bin/sh
while [ "$1" != lmp ]; do shift; done
exec "$@"
END
chmod +x "$work/bin/lmp" "$work/bin/mpirun"
says() { [ "$(PATH="$work/bin:$PATH" "$peers/lammps.sh" $1)" = "$2" ]; }
check "lammps.sh prints the version" says version '1 Jan 2000'
check "lammps.sh prints the speed" says '2 100 400 harmonic 2' 'harmonic 8e+06 99.5 10'
for tool in sh cat awk sed tr grep dirname mktemp rm tail; do
    ln -s "$(command -v $tool)" "$work/bin/$tool"
done
rm "$work/bin/lmp"
without_lammps() { PATH="$work/bin" "$bench" --peers >"$work/refused" 2>&1; [ $? -eq 1 ]; }
check "--peers without LAMMPS exits with 1" without_lammps
check "--peers without LAMMPS gives the reason" grep -q 'LAMMPS is not installed' "$work/refused"

finish || { cat "$work/err"; exit 1; }
