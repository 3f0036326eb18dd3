# diff.sh: tests of `petri diff`. Part of run.sh.

# A script with one force of each kind. Parameters set the strengths.
cat >forces.fl <<'END'
%pragma fps 20
let N=N or 2
let COLLISION=COLLISION or 1.5
let GRAVITY=GRAVITY or 1.5
let ELECTROSTATIC=ELECTROSTATIC or 1.5
let ADHESION=ADHESION or 1.5
let DISTANCE=DISTANCE or 1.5
let CONSTANT=CONSTANT or 1.5
let RANDOM=RANDOM or 1.5
let FIELD=FIELD or 1.5
let DRAG=DRAG or 1.5
let BUOYANCY=BUOYANCY or 1.5
let BARRIER=BARRIER or 1.5
!physics state=:p dimensions=N time=time
    for i in ..12
        !particle id=i position=(i%4*0.8;i//4*0.8;i*0.1)[..N] velocity=(0.1;-0.2;0.3)[..N] radius=0.5 mass=1+i/8 charge=0.5+i/4
    !collision strength=COLLISION
    !gravity strength=GRAVITY
    !electrostatic strength=ELECTROSTATIC
    !adhesion strength=ADHESION
    !distance strength=DISTANCE from=0 to=5 min=9
    !constant strength=CONSTANT force=(0.3;0.7;0.9)[..N]
    !random strength=RANDOM
    !field strength=FIELD direction=(0.3;0.7;0.9)[..N]
    !drag strength=DRAG
    !buoyancy strength=BUOYANCY density=0.3
    !barrier strength=BARRIER normal=(0.6;0.8;0)[..N] max=0.1
END
kinds=$(sed -n 's/^ *AS_[A-Z]*([A-Z]*, \([a-z]*\).*/\1/p' "$here/../../lib/physics/force_list.h")
check "the list of forces is read" [ "$(echo "$kinds" | wc -l)" -ge 11 ]
upper() { echo "$1" | tr '[:lower:]' '[:upper:]'; }
# finds KIND DIMENSIONS: succeeds if a strength that differs by one ulp is found and attributed to the force.
finds() {
    strength=$(upper "$1")
    line=$(grep -n "!$1 " forces.fl | cut -d: -f1)
    petri diff forces.fl -D "N=$2" --threads 2 --against -D "N=$2" -D "$strength=1.5000000000000002"
    status_is 1 && empty err && grep -q "^force on :p;.*: $1\( from .*\)\?$" out && grep -q "^- .*  forces.fl:$line$" out &&
        grep -q "^+ .*  forces.fl:$line$" out && [ "$(grep -c '^  distance in ulps: ' out)" = 2 ]
}
for kind in $kinds; do
    for n in 2 3; do
        check "diff attributes one ulp to !$kind in $n dimensions" finds "$kind" "$n"
    done
done

cat >two.fl <<'END'
%pragma fps 8
let K=K or 2
let STEP=STEP or 0.125
!physics state=:b dimensions=2 time=time resolution=STEP
    for i in 3;1;2
        !particle id=i position=i*1.5;0 radius=0.8 mass=1+i
    !anchor id=:wall position=9;9
    !constant acceleration=0.5;8
    !collision strength=K
!counter state=:turns rate=1
END
same() { status_is 0 && empty out && empty err; }
trouble() { status_is 2 && empty out && lines_are err 1 && has err "$1"; }
petri diff two.fl two.fl --frames 40
check "two equal runs give no output and status 0" same
petri diff two.fl --frames 40 --threads 1 --against --threads 2 --nosimplify --no-batches --neighbours always
check "threads, neighbour lists and optimisations make no difference" same
petri diff two.fl --json --frames 7 --against --threads 2
check "--json reports equal runs" out_is '{"same":true,"frames":7}'

petri diff two.fl --against -D K=3
cat >expected <<'END'
--- two.fl
+++ two.fl -D K=3
frame 1, time 0.125: 4 of 15 entries of the state differ
first: $(:b;3)
- 4.50859375;0.125
+ 4.508984375;0.125
  distance in ulps: 439804651110;0
force on :b;3, step 1 of 1: collision from 2
- 0.20000000000000018;-0  two.fl:9
+ 0.30000000000000027;-0  two.fl:9
  distance in ulps: 2702159776422296;0
END
check "diff shows the first particle in document order, and its first force that differs" cmp -s out expected
check "a difference gives status 1" status_is 1
sed 's/!constant/-- moved\n    !constant/; s/:turns rate=1/:turns rate=1.0000000000000002/' two.fl >moved.fl
petri diff two.fl moved.fl -D K=4
check "two scripts: -D without --against applies to both" lacks out ":b;"
check "entries without particles come first" has out 'first: $:turns'
check "one ulp is a distance of 1" has out "distance in ulps: 1"
petri diff two.fl -D K=3 --against moved.fl -D K=4
check "both scripts have their own parameters and lines" has out "+ 0.40000000000000036;-0  moved.fl:10"
petri diff two.fl --against -D STEP=0.0625
check "steps of different lengths are named" has out \
    "the forces on :b;3 are the same; the runs take different steps: 1 steps, the first of 0.125 and 2 steps, the first of 0.0625"
sed 's/radius=0.8/radius=0.7/' two.fl >small.fl
petri diff small.fl two.fl
check "a force that acts only in one run is shown" has out "- none"
check "attributes of the particle that differ are shown" has out "its attributes differ: radius 0.7 and 0.8"
sed 's/mass=1+i/mass=2+i/; s/acceleration=0.5;8/force=0.5;8/' two.fl >heavy.fl
sed 's/acceleration=0.5;8/force=0.5;8/' two.fl >light.fl
petri diff light.fl heavy.fl
check "a mass that differs is no difference of forces" has out "its motion differs: by its mass, "
petri diff two.fl --json --against -D K=3
check "--json has the values, the force and its positions" has out \
    '"a":{"kind":"collision","from":"2","contribution":"0.20000000000000018;-0","position":"two.fl:9"}'
check "--json is one valid object" python3 -c 'import json; json.load(open("out"))'

# Several steps in a frame: the first step in which a force differs.
petri diff two.fl -D K=3 -D STEP=0.03125 --against -D K=4 -D STEP=0.03125
check "the first step that differs is named" has out "force on :b;3, step 1 of 4: collision from 2"

petri diff two.fl --with "$petri" --frames 30
check "--with: another program that computes the same" same
cat >other <<END
#!/bin/sh
[ "\$1" != run ] && exec "$petri" "\$@" -D K=3
shift
exec "$petri" run -D K=3 "\$@"
END
chmod +x other
petri diff two.fl --with ./other
check "--with: a difference, and the force in the other program" has out "+ 0.30000000000000027;-0  two.fl:9"
check "--with names the program" has out "+++ two.fl with ./other"
petri diff two.fl --with /bin/false
check "--with: a program that fails is an error" trouble "/bin/false failed"
petri diff two.fl --with ./missing
check "--with: a program that cannot be started is an error" trouble "cannot start ./missing: No such file"

echo '# run --frames 21 --print state --every 5' >two.golden
petri test --update two.fl
petri diff two.golden
check "a golden is compared with its script, with the options of the golden" same
petri diff moved.fl two.golden
check "a golden and a script: the first recorded frame that differs" has out "frame 5, time 0.625: 1 of 15 entries of the state differ"
check "a golden and a script: the entry" has out 'first: $:turns'
petri run two.fl --frames 4 --state two.state
petri diff two.state two.fl
check "a state file is compared with the same frame of a script" same
petri diff two.state moved.fl
check "a state file and a script that differ" has out "frame 3, time 0.375: 1 of 15 entries of the state differ"
cp two.state again.state
petri diff two.state again.state
check "two state files" same
petri diff two.fl
check "a single run is an error" trouble "nothing to compare with two.fl: give a second run, --against or --with"
petri diff two.fl moved.fl two.fl
check "three runs are an error" trouble "too many arguments: 'two.fl'; petri diff compares two runs"
petri diff two.fl moved.fl --frames 0
check "no common frame is an error" trouble "nothing to compare: no frame is in both two.fl and moved.fl"
petri diff two.fl missing.fl
check "a script that cannot be read is an error" status_is 2
echo '# run --frames 2 --print hash' >hashes.golden
cp two.fl hashes.fl
petri diff hashes.golden
check "a golden without state is an error" trouble "hashes.golden has no state to compare: its first line needs '--print state'"
petri diff two.golden two.state
check "a golden and a state file without a common frame are an error" trouble "no frame is in both two.golden and two.state"
