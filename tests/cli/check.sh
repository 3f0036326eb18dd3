# check.sh: tests of the warnings of `petri check`. Part of run.sh.

cat >lints.fl <<'END'
%pragma temp 60
let a=1 b=2
let sin=3
func f(x, y, z=1)
    x
!n v=f(1) w=f(1,2,3,4) u=f(1, 2, q=3) t=cos(1,2) s=a;sin
if 1
    !x
else
    !y
!m q=coz(1)
END
petri check lints.fl
check "warnings alone do not fail a check" status_is 0
check "a check writes nothing to stdout" empty out
check "check suggests the nearest name for an unknown pragma" has err "lints.fl:1:1: warning: unknown pragma 'temp'"
check "the nearest name to temp is tempo" has err "did you mean 'tempo'?"
check "check reports an unused let" has err "lints.fl:2:9: warning: unused let 'b'"
check "check does not report a used let" lacks err "unused let 'a'"
check "check reports a name that shadows a built-in" has err "lints.fl:3:5: note: this 'sin' hides the built-in"
check "check reports unused parameters" count_is err "unused parameter" 2
check "check reports a missing argument" has err "lints.fl:6:6: warning: missing argument 'y'"
check "check reports too many arguments" has err "too many arguments: 4; the function takes 3"
check "check reports an unknown named argument" has err "no parameter 'q'"
check "check counts the arguments of built-ins" has err "too many arguments: 2 given to cos(x)"
check "check reports an else that is never reached" has err "lints.fl:7:4: warning: this condition is always true"
check "check suggests the nearest name for an unbound name" has err "did you mean 'cos'?"
check "the summary counts errors and warnings" last_line_is err "petri: 1 file checked: 0 errors, 10 warnings"
petri check --werror lints.fl
check "--werror makes warnings fail" status_is 1
petri run --frames 1 lints.fl
check "a run does not lint" lacks err "unused"

printf '!physics dimensions=2\n    !particle id=0\n!physics state=:s\n    !particle id=0\n' >incomplete.fl
petri check incomplete.fl
check "a system without state or dimensions fails a check" status_is 1
check "check names the missing attributes" has err "incomplete.fl:1:1: error: !physics: attribute 'state' is missing"
check "each missing attribute is one error" last_line_is err "petri: 1 file checked: 2 errors, 0 warnings"
petri run --frames 1 incomplete.fl
check "a run only warns about an incomplete system" status_is 0

cat >clean.fl <<'END'
let a=1
func twice(_unused, x)
    x*2
for i in ..3
    !n v=twice(0, a)
END
petri check --werror clean.fl
check "a clean script passes --werror" status_is 0
check "a clean script gives only the summary" lines_are err 1
cat >library.fl <<'END'
let shared=1
func helper(x)
    x+1
END
petri check --werror library.fl
check "a file that only binds names is a module, whose names count as used" status_is 0

# The triangles of models.
cat >carved.fl <<'END'
!window size=64;64
    !canvas3d
        for x in ..3
            !difference position=x;0;0
                !box
                !box position=0.5
        !sdf resolution=0.5 function=(func (p) hypot(p)-0.8)
        !trim
            !box
        !sphere
END
petri check --stats carved.fl
check "the check of a script with models succeeds" status_is 0
check "--stats counts the triangles of solids" has err "  !difference: 24 triangles, in 3 nodes (carved.fl:4)"
check "--stats counts the triangles of distance fields" grep -q '^  !sdf: [1-9][0-9]* triangles (carved.fl:7)' err
check "--stats reports problems of solids" has err "  !trim: 'normal' is missing; nothing is cut away (carved.fl:8)"
sum=$(awk '/^  !.* triangles/ { sum += $2 * ($4 == "in" ? $5 : 1) } END { print sum }' err)
check "--stats adds up the triangles of all nodes" has err "triangles: $sum in 5 nodes"
petri check carved.fl
check "without --stats, triangles are not counted" lacks err triangles
petri check --stats --work 2k carved.fl
check "--stats keeps to the work limit" has err "counting triangles exceeded its limit of 2048 work units"
petri check --stats clean.fl
check "--stats prints nothing for a script without models" lines_are err 1

# Far fields of few particles.
cat >far.fl <<'END'
let N=N or 100
!physics state=:s dimensions=2
    for i in ..N
        !particle id=i position=i;0
    !gravity theta=0.5
END
petri check far.fl
check "check reports a theta that cannot save time" has err "attribute 'theta' saves time only for more than about 1800 particles"
petri check -D N=2000 far.fl
check "check accepts a theta that saves time" last_line_is err "petri: 1 file checked: 0 errors, 0 warnings"
petri run --frames 1 far.fl
check "a run does not report a theta that cannot save time" lacks err "theta"

# Nodes: `petri check` evaluates the first frame, but prints and stores nothing.
cat >nodes.fl <<'END'
!window size=200;200
    !canvas
        !path
            !elipse point=50;50 radius=20
            !ellipse point=50;50 radus=20
        !fil color=1;0;0
    !record filename="out.png"
!pysics state=:a dimensions=1
!physics dimensions=2
    !particle id=1
!physics state=:b dimensions=2
    !particle position=1;2
    !partcle id=1
    for i in ..20
        !particle id=i poistion=i;0
    !particle id=:far positoin=1;2
    !collision strength="much"
!offscreen
    !canvas
        !rect piont=1;1
import a from "nowhere.fl"
if time > 100
    import b from "neither.fl"
    !b a=b(a)
%include "gone.fl"
!shown a=debug("seen")
END
petri check nodes.fl
check "a system without state fails a check that finds other mistakes too" status_is 1
check "a check prints nothing of the frame" empty out
check "a check does not print what the first frame logs" lacks err "> seen"
check "a check does not draw !record" [ ! -e out.png ]
for diagnostic in "4:13: warning: !path: '!elipse' is not supported; ignored; did you mean '!ellipse'?" \
    "5:34: warning: !ellipse: unknown attribute 'radus'; did you mean 'radius'?" \
    "6:9: warning: !canvas: '!fil' is not supported; ignored; did you mean '!fill'?" \
    "8:1: warning: '!pysics' does nothing" \
    "9:1: error: !physics: attribute 'state' is missing or null" \
    "12:5: warning: !particle: attribute 'id' is missing or null; the node is ignored" \
    "13:5: warning: !partcle id=1: unknown inside !physics; the node is ignored; did you mean !particle?" \
    "15:24: warning: !particle id=0: unknown attribute 'poistion'; did you mean 'position'?" \
    "16:23: warning: !particle id=:far: unknown attribute 'positoin'; did you mean 'position'?" \
    "17:16: warning: !collision: strength should be one number, not 'much'" \
    "20:15: warning: !rect: unknown attribute 'piont'; did you mean 'point'?" \
    "21:1: warning: cannot import 'nowhere.fl': no such file" \
    "23:5: warning: cannot import 'neither.fl': no such file" \
    "25:10: warning: cannot include 'gone.fl'"; do
    check "check finds $diagnostic" count_is err "nodes.fl:$diagnostic" 1
done
check "check gives no other diagnostics" last_line_is err "petri: 1 file checked: 1 error, 14 warnings"
petri run --frames 2 nodes.fl
check "a run also reports a misspelled node at the top" count_is err "did you mean '!physics'?" 1

# Every node or attribute that is ignored is reported once, with place and reason, by all commands alike.
cat >ignored.fl <<'END'
!osc
!foo
!pointer state=:p
!rect size=frame
!window size=8;8 vsync=true fullscreen=false
    !video filename="sea.mp4"
    !physics state=:x dimensions=1
    !canvas dither=true
        !rect size=3 foo=3
            !bar
    !shader fragment="% if x" vertex="""
  <%include file='a.glsl'/>"""
    !shader fragment="""${HEADER}
        out vec4 color;
        void main() { color = vec4(float(7 % 3)); }"""
!physics state=:y
!physics state=:z dimensions=2
    !particle id=1 radius=1
        !foo
    !drag
        !particle
    !rect
!counter state=:c
    !drag
END
cat >expected <<'END'
1:1: warning: '!osc' is not supported; ignored [unsupported-node]
2:1: warning: '!foo' does nothing [unknown-node]
3:1: warning: '!pointer' does nothing at the top level; it belongs in '!window' [misplaced-node]
4:1: warning: '!rect' does nothing at the top level; it belongs in '!canvas' [misplaced-node]
5:18: warning: !window: attribute 'vsync' is ignored [ignored-attribute]
6:5: warning: !window: '!video' is not supported; ignored [unsupported-node]
7:5: warning: !window: '!physics' has no effect here; ignored; it belongs at the top level [misplaced-node]
8:13: warning: !canvas: attribute 'dither' is ignored [ignored-attribute]
9:22: warning: !rect: unknown attribute 'foo' [unknown-attribute]
10:13: warning: !rect: '!bar' is not supported; ignored [unknown-node]
11:13: warning: !shader: template '% if x' is not supported, only '${HEADER}'; the default shader is used [bad-shader]
11:31: warning: !shader: template '<%include file='a.glsl'/>' is not supported, only '${HEADER}'; the default shader is used [bad-shader]
16:1: warning: !physics state=:y: attribute 'dimensions' is missing or null; the system is skipped [invalid-system]
19:9: warning: !particle id=1: '!foo' is not supported; ignored [unknown-node]
21:9: warning: !drag: '!particle' has no effect here; ignored; it belongs in '!physics' [misplaced-node]
22:5: warning: !rect: unknown inside !physics; the node is ignored; it belongs in '!canvas' [unknown-node]
24:5: warning: !counter state=:c: '!drag' has no effect here; ignored; it belongs in '!physics' [misplaced-node]
END
for command in check "run --frames 3" "render -o out.png --frames 3"; do
    petri $command ignored.fl
    # An incomplete system is an error only in a check.
    grep '^ignored' err | sort -t: -k2n -k3n | sed 's/^ignored.fl://; s/error: !physics/warning: !physics/' >reported
    check "$command reports everything that is ignored, once" cmp expected reported
done
cat >later.fl <<'END'
!window size=8;8
    !canvas
        for i in ..frame*20
            !rect size=i
        if frame > 2
            !video
            !rect size=3
                !bar
    if frame > 3
        !video
        !shade
if frame == 5
    !window
        !vidoe
END
petri run later.fl --frames 8
grep -o '^later.fl:[0-9:]*: warning' err >reported
printf 'later.fl:%s: warning\n' 6:13 8:17 10:9 11:9 14:9 >expected
check "a run reports ignored nodes that first appear in later frames, once" cmp expected reported
printf '!outer a=1\n!windows3d\n' >output.fl
petri check --werror output.fl
check "without a window, unknown nodes are output" status_is 0

# Systems are read but not simulated. Ten million steps would take minutes.
cat >slow.fl <<'END'
!physics state=:s dimensions=2 resolution=1n time=time+10
    for i in ..1000
        !particle id=i position=i;i radius=1
    !gravity
END
petri check --werror slow.fl
check "a check simulates nothing" status_is 0
printf 'func f(x)\n    f(x+1) + f(x+1)\n!n a=f(frame)\n' >limit.fl
petri check --work 1M limit.fl
check "check reports a first frame that exceeds the work limit" has err "limit.fl:2:"

printf 'let n=SIZE\n!n a=n\n' >define.fl
petri check --werror define.fl
check "check reports a name without a definition" status_is 1
petri check --werror -D SIZE=3 define.fl clean.fl
check "-D defines the name for all scripts" status_is 0
petri check -D SIZE define.fl
check "-D without a value is a wrong command line" status_is 2

cat >order.fl <<'END'
!window
    !canvas
        !elipse
!n a=1 b=unknown
!physics state=:s dimensions=1
    !particle
END
petri check order.fl
check "diagnostics come in the order of the text" [ "$(grep -o '^order.fl:[0-9]*' err | tr '\n' ' ')" = \
    "order.fl:3 order.fl:4 order.fl:4 order.fl:6 " ]

# A system that is skipped.
printf '!physics dimensions=2\n    !partikel id=0\n    !group\n        !particle id=1 positon=2;3\n' >skipped.fl
petri check skipped.fl
check "check looks into a system that is skipped" has err "'!partikel' is not supported; ignored; did you mean '!particle'?"
check "check looks into its groups, too" has err "skipped.fl:4:24: warning: !particle id=1: unknown attribute 'positon'; did you mean 'position'?"

# Optional definitions.
printf '!window size=RECORD or 5\n' >optional.fl
petri check optional.fl
check "check lists optional definitions" has err "optional.fl:1:14: note: 'RECORD' is optional; to set it, use -D RECORD=VALUE"
petri check --quiet optional.fl
check "check --quiet lists no optional definitions" eval '! grep -q RECORD err'
petri run optional.fl --frames 1
check "run does not report optional definitions" empty err

# Output formats for other programs.
printf 'let \303\251=coz(1)\n!n a=\303\251 b="\\q"+1\n!pysics\n!p\n    let u=2\n    !o a=1\n' >codes.fl
petri check --format gcc codes.fl
check "--format gcc prints one line per diagnostic on standard output" lines_are out 4
check "gcc output has position, text, hint and code" \
    has out "codes.fl:1:7: warning: unbound name 'coz' is null; did you mean 'cos'? [unbound-name]"
check "gcc output leaves the summary on standard error" last_line_is err "petri: 1 file checked: 0 errors, 4 warnings"
petri check --format=json codes.fl
check "--format json prints an array" [ "$(sed -n '1p;$p' out | tr -d '\n')" = "[]" ]
check "JSON output gives start and end in characters" has out '{"file": "codes.fl", "level": "warning", "code": "unbound-name", "text": "unbound name '"'coz'"' is null", "hint": "did you mean '"'cos'"'?", "line": 1, "column": 7, "endLine": 1, "endColumn": 10}'
check "JSON output has a null hint if there is no hint" has out '"hint": null'
petri check --format=json clean.fl
check "JSON output is an empty array for a clean script" [ "$(cat out)" = "[]" ]
petri check --format=json none.fl
check "JSON output reports a file that cannot be read" has out '{"file": "none.fl", "level": "error", "code": "cannot-read"'
check "a file that cannot be read fails with --format as well" status_is 1
petri check --format=sarif none.fl clean.fl
check "SARIF output reports a file that cannot be read" has out '"ruleId": "cannot-read"'
check "SARIF output says that not all files were checked" has out '"executionSuccessful": false'
cp codes.fl "co\"d es.fl"
petri check --format=sarif "co\"d es.fl" clean.fl
check "--format sarif prints a log of version 2.1.0" has out '"version": "2.1.0"'
check "SARIF output lists the rules" has out '"rules": [{"id": "unbound-name", "shortDescription": {"text": "The name is not bound; its value is null."}, "helpUri": "https://'
check "SARIF output gives positions by URI" has out '{"artifactLocation": {"uri": "co%22d%20es.fl"}, "region": {"startLine": 1, "startColumn": 7, "endLine": 1, "endColumn": 10}}'
check "SARIF output says that all files were checked" has out '"executionSuccessful": true'
check "SARIF output with warnings exits with 0" status_is 0
printf '!a\n\377\n' >latin.fl
petri check --format=sarif latin.fl
check "SARIF output gives a location for a file that is not text" has out '"locations": [{"physicalLocation": {"artifactLocation": {"uri": "latin.fl"}, "region": {"startLine": '
petri check --format=json --werror codes.fl
check "--werror makes warnings fail with --format as well" status_is 1
