#!/bin/sh
# smoke.sh: the bench prints whole tables, and CSV and Markdown agree with them. No figure is judged.
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

# csv_is_whole FILE COLUMNS...: as many fields in each row as in the first, these columns among them, at least one row,
# and each field a text, nothing, or a finite number that is not negative.
csv_is_whole() {
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

# positive FILE COLUMNS...: these hold a number above 0 in each row.
positive() {
    awk -F, -v wanted="$(shift && echo "$*")" '
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; n = split(wanted, names, " "); next }
        { for (i = 1; i <= n; i++) if (!($at[names[i]] > 0)) { print $1 ": " names[i] " is " $at[names[i]]; bad = 1 } }
        END { exit bad }' "$1"
}

# same_rows CSV TEXT: each name in the first column of the CSV begins a row of the text.
same_rows() {
    sed -e 1d -e 's/,.*//' "$1" | while read -r name; do
        grep -q "^|* *$name " "$2" || { echo "no row $name"; exit 1; }
    done
}

rows_are() { [ "$(sed 1d "$1" | wc -l)" -eq "$2" ]; }

check "runs" "$bench" --tiny --threads 2 --busy 1 --against "$bench" --csv "$work/t.csv" --markdown "$work/t.md" >"$work/text" \
    2>"$work/err"
check "workloads" csv_is_whole "$work/t.csv" workload limit_ns of_limit_percent speed_up exponent peak_mib allocations \
    bytes_per_particle frame_spread_percent
check "five workloads" rows_are "$work/t.csv" 5
check "figures" positive "$work/t.csv" evaluation_us physics_us frame_us output_us unit_ns threads_physics_us \
    threads_frame_us start_least_ms start_median_ms load_ms peak_mib bytes_per_particle
check "builds" csv_is_whole "$work/t-builds.csv" workload physics_ratio frame_ratio
check "ratios of builds" positive "$work/t-builds.csv" physics_ratio frame_ratio
check "sweeps" csv_is_whole "$work/t-sweeps.csv" jobs seconds runs_per_s speed_up of_jobs
check "their figures" positive "$work/t-sweeps.csv" jobs seconds runs_per_s speed_up of_jobs
check "targets" csv_is_whole "$work/t-targets.csv" target petri reference ratio must aim met
for form in text t.md; do
    check "workloads in $form" same_rows "$work/t.csv" "$work/$form"
    check "targets in $form" same_rows "$work/t-targets.csv" "$work/$form"
    check "machine in $form" grep -q 'processors.* threads; ' "$work/$form"
done
check "unknown option" refuses "$bench" --nonsense
check "option without its value" refuses "$bench" --csv
check "file that cannot be written" refuses "$bench" --tiny --csv "$work/no/such/file.csv"

# LAMMPS is hardly ever there: a stand-in that says what LAMMPS says.
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
check "version of LAMMPS" says version '1 Jan 2000'
check "speed of LAMMPS" says '2 100 400 harmonic 2' 'harmonic 8e+06 99.5 10'
for tool in sh cat awk sed tr grep dirname mktemp rm tail; do
    ln -s "$(command -v $tool)" "$work/bin/$tool"
done
rm "$work/bin/lmp"
without_lammps() { PATH="$work/bin" "$bench" --peers >"$work/refused" 2>&1; [ $? -eq 1 ]; }
check "no LAMMPS" without_lammps
check "no LAMMPS, said so" grep -q 'there is no LAMMPS here' "$work/refused"

finish || { cat "$work/err"; exit 1; }
