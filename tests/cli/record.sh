# record.sh: tests of `petri run --trajectory` and `--stats`. Part of run.sh.

cat >pair.fl <<'END'
%pragma fps 10
!physics state=:w dimensions=2 time=time resolution=0.1
    !anchor id='a,"b' position=1;2
    !particle id=7 mass=2 radius=0.5 charge=-3 position=3;4 velocity=5;0
    !particle id=8 mass=1 position=0;0 velocity=0;-10
!physics state=:line dimensions=1 time=time
    !particle id=:p position=0.1
END
petri run pair.fl --frames 3 --trajectory run.csv
check "a trajectory is written" status_is 0
check "a CSV trajectory has a row for each particle and frame" lines_are run.csv 13
check "a CSV trajectory has a header" has run.csv "frame,time,system,id,anchor,x1,x2,v1,v2,radius,mass,charge"
check "CSV quotes ids that contain commas or quotes" has run.csv "0,0,:w,\"'a,\"\"b'\",1,1,2,0,0,0,1,0"
check "CSV contains position and velocity" has run.csv "2,0.2,:w,7,0,4,4,5,0,0.5,2,-3"
check "CSV leaves missing components empty" has run.csv "0,0,:line,:p,0,0.1,,0,,0,1,0"
check "a trajectory leaves no temporary files" [ -z "$(find . -name '*.tmp')" ]
petri run pair.fl --frames 5 --every 2 --trajectory run.xyz
check "extended XYZ has a block for every K-th frame" count_is run.xyz "Properties=species:S:1:pos:R:3:velo:R:3:" 3
check "an extended XYZ block contains all systems" lines_are run.xyz 18
check "extended XYZ writes 0 for missing dimensions" has run.xyz "X 5 4 0 5 0 0 0.5 2 -3 7 0 0"
check "extended XYZ lists the ids that are not whole numbers" has run.xyz " id_texts=\"-2='a,%22b' -3=:p\""
check "extended XYZ lists the names of systems" has run.xyz " systems=\"0=:w 1=:line\""
cat >leave.fl <<'END'
if frame < 2
    !physics state=:first dimensions=4
        !particle id=10 position=1;2;3;4 velocity=0;0;0;5
!physics state=:swarm dimensions=3
    for i in 10;'a b';:c;2.5;30
        if i != 10 or frame < 1
            !particle id=i position=frame;0;0
END
petri run leave.fl --frames 3 --trajectory leave.xyz
check "extended XYZ keeps the ids of particles when others leave" \
    [ "$(awk '$1 == "X" && $12 == 1 { printf "%s ", $11 }' leave.xyz)" = "10 -2 -3 -4 30 -2 -3 -4 30 -2 -3 -4 30 " ]
check "extended XYZ keeps the text of ids" count_is leave.xyz " id_texts=\"-2='a%20b' -3=:c -4=2.5\"" 3
check "extended XYZ keeps the number of a system when another ends" count_is leave.xyz " systems=\"1=:swarm\"" 1
check "extended XYZ has columns for further dimensions" has leave.xyz "anchor:I:1:x4:R:1:v4:R:1 "
check "extended XYZ contains the components after the third" has leave.xyz "X 1 2 3 0 0 0 0 1 0 10 0 0 4 5"
petri run pair.fl --trajectory way.txt
check "unknown trajectory formats are rejected" status_is 2
check "the message lists the known trajectory formats" has err "a file name that ends in .xyz, .csv or .h5"
petri run pair.fl --trajectory absent/run.csv
check "a missing folder for a trajectory is an error" status_is 1
check "the message about the missing folder names the file" has err "cannot write absent/run.csv"
cp run.csv before.csv
(
    trap '' XFSZ # the disk is full
    ulimit -f 8
    exec timeout 100 "$petri" run pair.fl --frames 5000 --trajectory run.csv >out 2>err </dev/null
)
status=$?
check "a full disk makes a trajectory fail" status_is 1
check "a full disk is reported once" count_is err "cannot write run.csv: File too large" 1
check "a full disk does not change the old trajectory" cmp -s run.csv before.csv
check "a full disk leaves no partial trajectory" [ -z "$(find . -name '*.tmp')" ]

petri run pair.fl --frames 11 --stats
check "--stats prints a table with the number of frames" has err "  frames            11"
check "--stats prints the number of steps" has err "  simulation steps  20"
check "--stats prints the particles of each system" has err "  system :w, 2-dimensional: 2 particles, 1 anchor"
check "--stats prints the kinetic energy" has err "    kinetic energy    75"
check "--stats prints the momentum" has err "    momentum          10;-10"
check "--stats prints the angular momentum" has err "    angular momentum  "
check "--stats prints no potential energy without forces that have one" [ "$(grep -c potential err)" = 0 ]
check "--stats prints the fastest particle" has err "    fastest particle  8 at 10"
check "--stats prints nothing on standard output" empty out
