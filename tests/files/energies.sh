# energies.sh: tests of `petri run --energies`. Part of ../cli/run.sh.

cat >orbit.fl <<'END'
!physics state=:orbit dimensions=2 time=time resolution=0.001
    !particle id=1 position=0;0 velocity=0;0 mass=100
    !particle id=2 position=10;0 velocity=0;3
    !anchor id=3 position=500;0
    !gravity strength=1 max_distance=50
    !drag strength=0
!physics state=:free dimensions=1
    !particle id=1 position=0 velocity=2
END
petri run orbit.fl --frames 61 --trajectory orbit.csv --energies --stats
# The last row of a system has the numbers of --stats.
kinetic=$(sed -n '/:orbit/,$ s/ *kinetic energy *//p' err | head -n 1)
potential=$(sed -n '/:orbit/,$ s/ *potential energy *//p' err | head -n 1)
awk -F, '$1 == 60 && $3 == ":orbit" && $4 == 2 { printf "%.9g %.9g\n", $13, $14 }' orbit.csv >last
check "the last row of a table has the energies of --stats" \
    awk -v k="$kinetic" -v p="$potential" '{ exit k == "" || ($1 / k - 1)^2 > 1e-16 || ($2 / p - 1)^2 > 1e-16 }' last
check "the header names the energies" [ "$(sed -n '1s/.*charge//p' orbit.csv)" = ,kinetic_energy,potential_energy ]
awk -F, '$3 == ":orbit" { e = $13 + $14; if (!n++) first = e; if ((e / first - 1)^2 > 1e-6) bad = 1 } END { exit bad || n < 100 }' orbit.csv
check "the total energy of an orbit is conserved" [ $? -eq 0 ]
check "a system without forces has no potential energy" [ "$(awk -F, '$3 == ":free" { print $NF }' orbit.csv | sort -u)" = 0 ]
petri run orbit.fl --frames 61 --trajectory orbit.xyz --energies
# The line has the sums over all systems.
awk '/kinetic_energy/ { sub(/.*kinetic_energy=/, ""); sub("potential_energy=", ""); k = $1; p = $2 } END { printf "%.9g %.9g\n", k - 2, p }' orbit.xyz >last
check "the line of a frame has the energies of all systems" \
    awk -v k="$kinetic" -v p="$potential" '{ exit ($1 / k - 1)^2 > 1e-16 || ($2 / p - 1)^2 > 1e-16 }' last
petri run orbit.fl --frames 3 --trajectory plain.csv
check "without the option a table has no energies" lacks plain.csv energy

# A resumed table keeps its columns.
petri run orbit.fl --frames 10 --state s --trajectory resumed.csv --energies
petri run orbit.fl --frames 51 --state s --trajectory resumed.csv
check "a resumed table keeps its columns" cmp resumed.csv orbit.csv

if [ -x "$(dirname "$petri")/petri-hdf5" ] && /usr/bin/python3 -I -c 'import h5py' 2>err; then
    petri run orbit.fl --frames 61 --trajectory orbit.h5 --energies
    /usr/bin/python3 -I -c '
import csv, h5py
with h5py.File("orbit.h5") as file:
    for name, wanted in [("orbit", ":orbit"), ("free", ":free")]:
        rows = {int(row["frame"]): row for row in csv.DictReader(open("orbit.csv")) if row["system"] == wanted}
        group = file["observables"][name]
        for quantity in "kinetic_energy", "potential_energy":
            element = group[quantity]
            assert element["step"] == file["particles"][name]["position/step"]
            assert list(element["value"]) == [float(rows[int(step)][quantity]) for step in element["step"]], quantity
    assert len(element["value"]) == 61' 2>err
    check "H5MD observables have the energies of the table" [ $? -eq 0 ]
fi
