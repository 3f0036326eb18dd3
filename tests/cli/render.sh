# render.sh: tests of `petri render`: images, image sequences and errors. Part of run.sh.

petri help nodes
check "help nodes lists physics nodes" has out "  !particle: "
check "help nodes lists drawing nodes" has out "  !ellipse: "
petri help '!stroke'
check "help on a node lists its attributes" has out "stroke_cap"
check "help on a node shows only that node" [ "$(grep -c '^!' out)" -eq 1 ]

petri render
check "render without a script is a usage error" status_is 2
petri render disc.fl
check "render without an output is a usage error" status_is 2
check "render without an output names the option" has err "option '--output' is missing"
petri render disc.fl -o disc.txt
check "an unknown suffix is a usage error" status_is 2
check "the message lists the known suffixes" has err ".png, .svg, .pdf, .mp4, .m4v, .mov, .mkv, .webm, .ogg or .gif"
for size in 0x10 10 -1x5 10x 1000000000x10; do
    petri render disc.fl -o disc.png --size $size
    check "--size $size is a usage error" status_is 2
    check "--size $size reports the expected format" has err "WIDTHxHEIGHT"
done
petri render disc.fl -o disc.png --scale 0
check "--scale 0 is a usage error" status_is 2
petri render disc.fl -o disc.mp4 --frame 3
check "a video of a single frame is a usage error" status_is 2
petri render disc.fl -o absent/disc.png
check "a missing folder for a picture is an error" status_is 1
check "a missing folder is reported before the script runs" has err "cannot write 'absent/disc.png'"

# Fails if this build has no Cairo.
petri render disc.fl -o disc.png --frames 1
if [ "$status" -ne 0 ]; then
    check "a build without Cairo names the missing library" has err "libcairo2-dev"
    check "a build without Cairo writes no picture" [ ! -e disc.png ]
else
    check "a picture has the size of the window" sized disc.png 40x30
    check "render prints nothing on standard output" empty out
    cp disc.png first.png
    petri render disc.fl -o disc.png --frames 1
    check "equal pictures give equal files" cmp -s disc.png first.png
    petri render disc.fl -o disc.png --frames 9 --frame 8 --size 80x60
    check "--size sets the size" sized disc.png 80x60
    petri render disc.fl -o scaled.png --frames 9 --scale 2
    check "--scale multiplies the size" cmp -s disc.png scaled.png

    # OpenGL is loaded only for effects and 3-D. `petri run` loads no drawing libraries.
    cat >glowing.fl <<'END'
!window size=8;8
    !bloom radius=2
        !canvas3d
            !sphere emissive=1 size=3
END
    loads() { grep -qE "file=lib($1)" err; }
    loads_no() { ! loads "$1"; }
    LD_DEBUG=files petri run glowing.fl --frames 3 --print tree
    check "run loads the C library" loads 'c\.so'
    check "run loads no drawing libraries" loads_no 'EGL|GL|epoxy|cairo|pango'
    LD_DEBUG=files petri render disc.fl -o loaded.png --frames 1
    check "render loads Cairo" loads cairo
    check "render loads no OpenGL without effects" loads_no 'EGL|GLES'
    LD_DEBUG=files petri render glowing.fl -o loaded.png --frames 1
    check "render loads OpenGL for effects, if it was built with it" eval 'loads EGL || has err libepoxy-dev'

    petri render disc.fl -o disc%03d.png --frames 7 --every 3
    check "a series has a picture for every K-th frame" [ "$(echo disc0*.png)" = "disc000.png disc003.png disc006.png" ]
    check "the first picture of a series is that of the first frame" cmp -s disc000.png first.png
    check "pictures of a series differ" eval '! cmp -s disc003.png first.png'
    petri render disc.fl -o disc.svg --frames 1
    check "SVG is written" has disc.svg "<svg"
    petri render disc.fl -o disc.pdf --frames 1
    check "PDF is written" has disc.pdf "%PDF-"
    cp disc.pdf first.pdf
    petri render disc.fl -o disc.pdf --frames 1
    check "equal PDFs give equal files" cmp -s disc.pdf first.pdf
    petri render disc.fl -o none.png --frames 0
    check "rendering zero frames is an error" status_is 1
    petri render disc.fl -o none.png --frame 5 --runtime 0.01
    check "a frame that is not reached is an error" status_is 1
    check "a frame that is not reached is named" has err "before frame 5"

    printf '!x\n' >nothing.fl
    petri render nothing.fl -o none.png --frames 1
    check "a script without a picture is an error" one_error
    check "a script without a picture writes no file" [ ! -e none.png ]
    printf '!window size=60;40\n    !video\n!physics state=:w dimensions=3\n    !particle id=1\n' >solid.fl
    petri render solid.fl -o solid.png --frames 2
    check "a window with only unsupported nodes shows the particles" status_is 0
    check "the picture of particles has the size of the window" sized solid.png 60x40
    check "an unsupported node is reported once" count_is err "'!video' is not supported" 1
    printf '!physics state=:w dimensions=2\n    !particle id=1 radius=1\n' >bare.fl
    petri render bare.fl -o bare.png --frames 2
    check "physics without a window has a picture" sized bare.png 1080x1080
    printf '!physics state=:w dimensions=2\n    !particle id=0 velocity=60;30\n' >lone.fl
    petri render lone.fl -o lone%03d.png --frames 201 --every 40 --size 60x60
    check "a lone particle is not followed" eval '! cmp -s lone040.png lone080.png && ! cmp -s lone080.png lone120.png'
    petri render lone.fl -o lone.png --frame 200 --size 60x60
    check "a picture does not depend on previously drawn frames" cmp -s lone.png lone200.png
    petri render disc.fl -o none.png --frames 1 --auto
    check "--auto without physics is an error" one_error

    # several windows
    cat >windows.fl <<'END'
!window size=4;4 id="first"
    !canvas
        !rect size=9 fill=true color=1;0;0
!offscreen size=5;4 id=:spare
    !canvas
        !rect size=9 fill=true color=0;0;1
!window size=6;4 id="second"
    !canvas
        !rect size=9 fill=true color=0;1;0
END
    petri render windows.fl -o windows.png --frames 2
    check "render draws the first window" [ "$(width windows.png)" = 4 ]
    check "render reports once that another window is not drawn" \
        count_is err "windows.fl:7:1: warning: !window: only one window is drawn; to draw this one, use --window 2" 1
    for window in second:6 2:6 spare:5 first:4; do
        petri render windows.fl -o windows.png --frames 2 --window "${window%:*}"
        check "--window ${window%:*} draws this window" [ "$(width windows.png)" = "${window#*:}" ]
        check "--window ${window%:*} reports nothing" empty err
    done
    petri render windows.fl -o windows.png --window third
    check "a window that does not exist is an error" has err "the frame has no window with this number or id"
    check "a window that does not exist exits with 1" status_is 1

    # a file for each window
    mkdir each
    cat >>windows.fl <<'END'
!window size=8;4 id="../../a%d/b"
    !feedback mixer=0.5
        !canvas
            !rect size=2 point=frame%8;0 fill=true color=0;1;0
!window size=7;4
    !canvas
        !rect size=2 point=frame%8;0 fill=true color=0;1;0
!window size=9;4 id="empty"
END
    petri render windows.fl -o 'each/{window}-x.png' --frames 3
    check "{window} writes a file for each window with content" status_is 0
    check "{window} reports no windows that are not drawn" empty err
    check "{window} is the id or the number, without characters that lead to other folders" \
        [ "$(ls each)" = "$(printf '%s\n' _._.._a_d_b-x.png 4-x.png first-x.png second-x.png | LC_ALL=C sort)" ]
    check "each file has the size of its window" eval 'sized each/first-x.png 4x4 && sized each/second-x.png 6x4 &&
        sized each/_._.._a_d_b-x.png 8x4 && sized each/4-x.png 7x4'
    petri render windows.fl -o windows.png --frames 3 --window 3
    check "{window} continues the history of frames only once per frame" cmp -s windows.png each/_._.._a_d_b-x.png
    petri render windows.fl -o 'each/%02d-{window}.png' --frames 3
    check "{window} can be combined with frame numbers" [ "$(ls each/0?-*.png | wc -l)" -eq 12 ]
    petri render windows.fl -o windows.png --frame 1 --window 4
    check "a file of a series has the picture of its window and frame" cmp -s windows.png each/01-4.png
    petri render windows.fl -o 'one-{window}.png' --frames 1 --window second
    check "--window selects the only file of {window}" [ "$(echo one-*)" = one-second.png ]
    petri render disc.fl -o 'one-{window}.png' --frames 1
    check "a window without an id has a number" cmp -s one-0.png first.png
    petri render windows.fl -o '{window}/x.png' --frames 1
    check "a folder cannot depend on the window" has err "cannot write '{window}/x.png'"
    sed 's/second/first/' windows.fl >double.fl
    petri render double.fl -o 'double-{window}.png' --frames 1
    check "windows with the same id are an error" has err "windows 0 and 2 have the same file, 'double-first.png'"
    check "windows with the same id exit with 1" status_is 1
    printf 'for i in ..65\n    !window size=1;1\n        !canvas\n' >many.fl
    petri render many.fl -o 'many-{window}.png' --frames 1
    check "more than 64 windows are an error" has err "a frame has more than 64 windows"
    check "a frame with too many windows writes no file" [ ! -e many-0.png ]

    # built-ins that depend on the picture
    cat >samples.fl <<'END'
!window size=60;20
    !canvas id=:pic
        !rect size=60;20 color=0.2;0.4;0.6 fill=true antialias=false
        !rect size=6;2 color=1;0;0 fill=true antialias=false
    !canvas id=:odd size=1;1
let far=sample(:pic, 2;2, 7)
let points=sample(:pic, 0.05;0.95;0.5;0.5;3;3) few=sample(:pic, 3;3;0.5;0.5, 1;2;3;4)
!counter state=(:far;frame) rate=0 initial=far
!counter state=(:points;frame) rate=0 initial=points
!counter state=(:few;frame) rate=0 initial=few
!counter state=(:edge;frame) rate=0 initial=sample(:pic, -0.01;0, 7)
!counter state=(:over;frame) rate=0 initial=sample(:pic, 1;0, 7)
!counter state=(:none;frame) rate=0 initial=sample(:foo, 0;0, 7)
!counter state=(:text;frame) rate=0 initial=sample(:pic, "a", 7)
!counter state=:wide rate=0 initial=measure_text('iiii', 'DejaVu Sans Mono', 40)
!counter state=:part rate=0 initial=2*measure_text('ii', 'DejaVu Sans Mono', 40)
!counter state=:half rate=0 initial=2*measure_text('iiii', 'DejaVu Sans Mono')
!counter state=:nothing rate=0 initial=measure_text('', size=10)
END
    value() { sed -n "s/^\$($1) = //p" samples.state; }
    petri render samples.fl -o 'samples%d.png' --frames 3 --state samples.state
    check "render of sampled pictures succeeds" status_is 0
    check "in the first frame, sample() has no picture" [ "$(value ':far;0'),$(value ':edge;0')" = "7,7" ]
    check "sample() reads colours of the previous frame, with y from the bottom" [ "$(value ':points;1')" = \
        "1;0;0;1;0.20000000298023224;0.4000000059604645;0.6000000238418579;1;0;0;0;0" ]
    check "sample() of several points uses a default of four numbers" [ "$(value ':few;2')" = \
        "1;2;3;4;0.20000000298023224;0.4000000059604645;0.6000000238418579;1" ]
    check "sample() rounds coordinates toward 0" [ "$(value ':edge;1')" = \
        "0.20000000298023224;0.4000000059604645;0.6000000238418579;1" ]
    check "sample() outside the picture returns the default" [ "$(value ':far;1'),$(value ':over;1')" = "7,7" ]
    check "sample() of an unknown id returns the default" [ "$(value ':none;2')" = 7 ]
    check "sample() of coordinates that are no numbers returns the default" [ "$(value ':text;2')" = 7 ]
    check "measure_text() adds the widths of characters" [ "$(value :wide)" = "$(value :part)" ]
    check "measure_text() is proportional to the size, 20 by default" [ "$(value :wide)" = "$(value :half)" ]
    check "measure_text() of no text is 0" [ "$(value :nothing)" = 0 ]
    check "measure_text() is positive" [ "$(value :wide | cut -d. -f1)" -gt 20 ]
    cp samples.state first.state
    rm samples.state
    petri render samples.fl -o samples.mp4 --frames 3 --state samples.state
    [ "$status" -eq 1 ] || check "sampled values do not depend on the output" cmp -s samples.state first.state
    cat >later.fl <<'END'
!window size=20;20
    !canvas id=:pic
        !rect size=20;20 color=1;1;1 fill=true
if frame > 2
    !counter state=(:seen;frame) rate=0 initial=sample(:pic, 0.5;0.5, 7)
END
    rm -f samples.state
    petri render later.fl -o later.png --frames 6 --state samples.state
    check "sample() in a later frame has values from the next frame on" \
        [ "$(value ':seen;3') $(value ':seen;4') $(value ':seen;5')" = "7 1;1;1;1 1;1;1;1" ]
    for call in "'a', weight=:fat" "'a', width=:wide" "'a', slant=:left" "'a', size=-1" "'a', size=1e9" "..20000"; do
        printf '!window size=2;2\n    !canvas\n        !text text=measure_text(%s)\n' "$call" >bad.fl
        petri render bad.fl -o bad.png --frames 1
        check "measure_text($call) is reported with its position" has err "bad.fl:3:20: warning: measure_text: "
        check "measure_text($call) does not end the run" status_is 0
    done
    printf '!window\n    !canvas\n        !text text=sum(measure_text("abc", ("f";i), weight=i%%1000) for i in ..100000)\n' >bad.fl
    petri render bad.fl -o bad.png --frames 1 --work 200M
    check "measuring texts is charged to the work limit" has err "work-limit"
    petri run samples.fl --frames 2 --print state
    check "run has no pictures to sample" has out '$(:far;1) = 7'
    check "run reports once that it cannot measure texts" count_is err "measure_text: not supported: only render and view have fonts" 4

    # record
    cat >record.fl <<'END'
!window size=20;20
    !record filename=("frame";frame;".png") if frame%2 else null
        !canvas
            !rect size=10 fill=true
END
    petri render record.fl -o last.png --frames 4
    check "!record writes pictures of the frames that contain it" [ "$(echo frame*.png)" = "frame1.png frame3.png" ]
    check "!record writes the same picture as -o" cmp -s frame3.png last.png
    printf '!window size=300;300\n    !record filename="deep/er/same.png"\n        !canvas\n            !ellipse point=10+frame;50 radius=40 fill=true\n' >record.fl
    petri render record.fl -o first.png --frames 1
    rm -r deep
    petri render record.fl -o last.png --frames 60
    check "!record can use the same file name in every frame" status_is 0
    check "!record creates folders and replaces no file that it has written" cmp -s deep/er/same.png first.png
    petri run record.fl --frames 4
    check "run ignores !record" status_is 0
    printf '!window size=20;20\n    !record filename="x.txt"\n        !canvas\n' >record.fl
    petri render record.fl -o last.png --frames 4
    check "!record to an unknown kind of file is an error" one_error

    # Earlier frames are drawn only if the picture depends on them. Drawing frame 1 gives a warning.
    cat >own.fl <<'END'
!window size=20;4
    !canvas id=:top
        !rect size=(2+frame;4) fill=true color=0;1;0
    !canvas size=((20000;4) if frame == 1 else (20;4))
        !image image_id=:top point=8;0
    !record filename=null
        !reference id=:top
END
    petri render own.fl -o own.png --frame 3
    check "a picture of one frame is drawn alone if it refers only to this frame" eval 'status_is 0 && empty err'
    petri render own.fl -o own%d.png --frames 4
    check "the picture of one frame is that of a series" cmp -s own.png own3.png
    petri render own.fl -o other.png --frames 4
    check "the last picture is drawn alone if it refers only to its frame" eval 'lacks err bad-size && cmp -s own.png other.png'
    sed '2s/id=:top/id=(:top if frame%3 else :other)/' own.fl >past.fl
    petri render past.fl -o past%d.png --frames 8
    check "references show the previous frame if the picture is missing" eval '! cmp -s own3.png past3.png'
    for frame in 3 4 6; do
        petri render past.fl -o past.png --frame $frame
        check "frame $frame is drawn after the frames that it refers to" cmp -s past.png past$frame.png
    done
    printf '!window size=20;4\n    !feedback mixer=0.5\n        !canvas\n            !rect size=1+frame;4 fill=true\n' >past.fl
    petri render past.fl -o past%d.png --frames 4
    petri render past.fl -o past.png --frame 3
    check "the picture of one frame contains the feedback of a series" cmp -s past.png past3.png

    # Frames are not saved before the systems have stored positions. Such a frame would be red, because its script finds no
    # position in the state.
    cat >early.fl <<'END'
!physics state=:w dimensions=2
    !particle id=1 position=20;20 velocity=1;0
!window size=20;20
    !record filename=concat("early-";frame;".png")
        !canvas
            !rect size=20 fill=true color=(0;1;0) if $(:w;1) else (1;0;0)
END
    printf '!window size=20;20\n    !canvas\n        !rect size=20 fill=true color=0;1;0\n' >green.fl
    petri render green.fl -o green.png --frames 1
    petri render early.fl -o early%02d.png --frames 3
    check "a series starts with the first frame that shows its particles" [ "$(echo early0*.png)" = "early02.png early03.png early04.png" ]
    check "the first picture of a series shows particles" cmp -s early02.png green.png
    check "!record skips frames without particles" [ "$(echo early-*.png)" = "early-2.png early-3.png early-4.png" ]
    rm -f early*.png
    petri render early.fl -o early%02d.png --frames 7 --every 3
    check "--every counts from the first frame with particles" [ "$(echo early0*.png)" = "early02.png early05.png early08.png" ]
    petri render early.fl -o early.png --frames 1
    check "--frames 1 draws a frame with particles" cmp -s early.png green.png
    petri render early.fl -o early.png --runtime 0.01
    check "--runtime draws a frame with particles" cmp -s early.png green.png
    petri render early.fl -o early.png --frame 0
    check "--frame 0 draws frame 0" eval '[ "$status" -eq 0 ] && ! cmp -s early.png green.png'
    petri run early.fl --frames 100 --state early.state
    rm -f early*.png
    petri render early.fl -o early%02d.png --frames 1 --state early.state
    check "a restored state has particles in its first frame" cmp -s early100.png green.png
    sed 's/dimensions=2/dimensions=2 time=0/' early.fl >stands.fl
    petri render stands.fl -o stands%d.png --frames 1
    check "a system with constant time is not waited for" [ -e stands2.png ]
    petri render early.fl --auto -o auto%d.png --frames 1 --size 20x20
    check "the automatic picture shows particles in frame 0" [ -e auto0.png ]

    # bad sizes
    for size in 0 -1 1e9 '0/0' '100;0' '1;2;3' ':big'; do
        printf '!window size=%s\n    !canvas\n        !rect size=5 fill=true\n' "$size" >size.fl
        rm -f size.png
        petri render size.fl -o size.png --frames 3
        check "a window of size=$size is an error" one_error
        check "a window of size=$size writes no file" [ ! -e size.png ]
    done
    head -c 700 "$here/../pictures/images/small.jpg" >half.jpg
    printf '!window size=40;40\n    !canvas\n        !image filename="half.jpg" size=40\n' >half.fl
    petri render half.fl -o half.png --frames 3
    check "a damaged JPEG file is reported once" count_is err "cannot read 'half.jpg': the JPEG file is damaged" 1
    # A grey progressive JPEG of WIDTH x HEIGHT whose AC coefficients, all 0, are coded COUNT times.
    scans() {
        /usr/bin/python3 -I - "$@" <<'END'
import struct
import sys

width, height, count = map(int, sys.argv[1:4])


def segment(marker, data):
    return bytes([0xff, marker]) + struct.pack(">H", len(data) + 2) + data


def huffman(table, symbol):
    return segment(0xc4, bytes([table, 1] + [0] * 15 + [symbol]))


def scan(first, last, bits):
    bits += "1" * (-len(bits) % 8)
    data = bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8)).replace(b"\xff", b"\xff\0")
    return segment(0xda, bytes([1, 1, 0, first, last, 0])) + data


blocks = (width + 7) // 8 * ((height + 7) // 8)
end_of_blocks = "0" + "1" * 14  # the one code of table 0x10: an end-of-band run of 2^15 - 1 blocks
open(sys.argv[4], "wb").write(
    b"\xff\xd8" + segment(0xdb, b"\0" + b"\1" * 64) + segment(0xc2, struct.pack(">BHHBBBB", 8, height, width, 1, 1, 0x11, 0))
    + huffman(0x00, 0) + huffman(0x10, 0xe0) + scan(0, 0, "0" * blocks) + scan(1, 63, end_of_blocks * -(-blocks // 32767)) * count
    + b"\xff\xd9")
END
    }
    # Images on the GPU are reused. Pixels that a script's own shader does not write must be transparent, and must not show
    # what the image contained before.
    cat >discard.fl <<'END'
!window size=100;80
    if frame < 2
        !adjust
            !canvas
                !rect size=100;80 color=1;0;0 fill=true
    else
        !shader fragment="""${HEADER}
in vec2 coord; out vec4 color;
void main() { if (coord.x < 2.0) discard; color = vec4(1.0); }
"""
END
    printf '!window size=4000\n    !blur radius=1000\n        !adjust\n' >heavy.fl
    petri render discard.fl -o discard%d.png --frames 4
    if [ -s discard3.png ] && ! grep -Eq "OpenGL|without" err; then
        printf '!window size=100;80\n    !canvas\n' >empty.fl
        petri render empty.fl -o empty.png --frames 1
        for frame in 2 3; do
            check "a shader that discards shows transparency in frame $frame" cmp -s discard$frame.png empty.png
        done
        petri render heavy.fl -o heavy.png --frames 1
        check "an effect above the work limit is left out" has err "!blur: drawing exceeded the work limit (--work): the effect is left out"
        printf '!window size=400\n    !blur radius=100\n        !adjust\n' >heavy.fl
        petri render heavy.fl -o heavy.png --frames 1 --work 1000000
        petri render heavy.fl -o heavy.png --frames 1 --work "$(sufficient work)"
        check "the message names a sufficient limit" empty err
        # Each apex is farther out than the previous one, so it sees all side faces of the hull that was built so far. The
        # time for this was once quadratic.
        cat >hull.fl <<'END'
let n=650
let base=(cos(i/n);sin(i/n);0.001*cos(2*i/n)) for i in ..n
let apex=(0.0001*cos(i/7);0.0001*sin(i/7);1+i*i/100) for i in ..1349
!window size=60;40
    !canvas3d
        !light color=1 direction=0;0;-1
        for k in ..40
            !model vertices=base;apex;(0;0;-1-k) size=10
END
        petri render hull.fl -o hull.png --frames 1
        check "hulls of 2000 points do not exceed the default limits" empty err
        petri render hull.fl -o hull.png --frames 1 --work 10M
        check "hulls above the work limit are left out" count_is err "!model: drawing exceeded the work limit (--work): the model is left out" 1
        printf '!window size=30\n    !canvas3d\n        !light color=1\n        for i in ..20\n            !sphere segments=256 snap_edges=0.1+i/2000\n' >meshes.fl
        petri render meshes.fl -o meshes.png --frames 1 --memory 60M
        check "meshes are charged to the memory limit" has err "exceeds the memory limit (--memory)"
        left_out="!canvas3d: drawing exceeded the work limit (--work): the scene is left out"
        # many large instances; many lights; many groups with many lights
        for scene in 'for i in ..20000\n            !cylinder segments=1024 position=i/2000 size=50\n' \
            'for i in ..4000\n            !light color=1 start=i;0;0 end=0;i;10 radius=3\n        !box size=2000 transparency=0.5\n' \
            'for i in ..900\n            !light color=1 start=i;0;0 end=0;i;10\n        for i in ..20000\n            !group\n                !box size=20 translucency=0.5\n'; do
            printf "!window size=600;400\n    !canvas3d max_lights=4000 viewpoint=0;0;100\n        !light color=1\n        $scene" >scene.fl
            petri render scene.fl -o scene.png --frames 1
            check "a scene above the work limit is left out" has err "error: $left_out"
            check "a picture without its scene ends with status 1" status_is 1
        done
        # balls that hide each other, which take about a second
        printf '!window size=540\n    !canvas3d\n        !light color=1 direction=0;0;-1\n        for i in ..2000\n            !transform rotate_z=i/100 scale=2 translate=0;0;i/20-50\n                !sphere position=0;50;0 size=25\n' >balls.fl
        petri render balls.fl -o scene.png --frames 1 --work 200M
        check "2000 balls do not exceed a limit of 2 s" empty err
        printf '!window size=600;400\n    !canvas3d viewpoint=0;0;100 samples=SAMPLES\n        !light color=1\n        for i in ..600\n            !cylinder segments=512 position=i/2000 size=1\n' >scene.fl
        sed 's/SAMPLES/0/' scene.fl >plain.fl
        sed -i 's/SAMPLES/4/' scene.fl
        petri render plain.fl -o scene.png --frames 1 --work 40M
        check "triangles with one sample per pixel are below the limit" empty err
        petri render scene.fl -o scene.png --frames 1 --work 40M
        check "multisampled triangles cost more" has err "$left_out"
        printf '!window size=60\n    !canvas3d viewpoint=0;0;50\n        !light color=1\n        for i in ..999\n            !box size=40 position=0;0;-i/100 transparency=0.5\n' >scene.fl
        petri render scene.fl -o scene.png --frames 1 --work 1000000
        petri render scene.fl -o scene.png --frames 1 --work "$(sufficient work)"
        check "the message names a limit that suffices for the scene" empty err
    fi
    printf '!window size=20\n    !canvas\n        !image filename="scans.jpg" size=20\n' >scans.fl
    if scans 64 64 99 scans.jpg 2>/dev/null; then
        petri render scans.fl -o scans.png --frames 1
        check "a JPEG file with 100 scans is read" empty err
        scans 64 64 100 scans.jpg
        petri render scans.fl -o scans.png --frames 1
        check "a JPEG file with too many scans is reported" has err "cannot read 'scans.jpg': the JPEG file has more than 100 scans"
        scans 8192 8192 2 scans.jpg # 256 MiB of pixels and 128 MiB of coefficients
        petri render scans.fl -o scans.png --frames 1 --memory 300M
        check "the decoder's memory is limited" has err "cannot read 'scans.jpg': it exceeds the memory limit (--memory)"
    fi
    # invalid and non-finite attributes are reported once and their elements are omitted
    cat >wrong.fl <<'END'
let nan=0/0
    big=1e308*10
!window size=40;40
    !canvas
        !rect size=40 fill=true color=0;0;1
        !group translate=nan;0
            !rect size=40 fill=true
        !ellipse point=big;0 radius=50 fill=true
        !ellipse point=20 radius=nan fill=true
        !line points=0;0;nan;5;70;70 stroke=true
        !rect size=nan fill=true
        !transform scale=0
            !rect size=40 fill=true
        !font size=nan
        !text text="x" point=nan
        !paint color=1;2 stroke_width=-1 stroke_join=:rond composite=:modulat colour=3
        !elipse radius=5
        !stop color=1
        !image filename="absent.png"
        !image filename="disc.fl"
        !font family="No Such Font"
            !text text="x" point=-50;-50
END
    petri render wrong.fl -o wrong.png --frames 5
    check "invalid attributes do not stop rendering" status_is 0
    for text in "!group: translate should be x;y, not nan;0" "!ellipse: point should be x;y, not inf;0" \
        "!ellipse: radius should be" "!line: points should be" "!rect: size should be" "!font: size should be" \
        "!text: point should be" "!paint: color should be grey" "!paint: stroke_width should be number, 0 or more" \
        "!paint: stroke_join should be :miter, :round or :bevel, not :rond" "!paint: composite should be a word such as :over" \
        "unknown attribute 'colour'; did you mean 'color'?" "'!elipse' is not supported; ignored; did you mean '!ellipse'?" \
        "'!stop' has no effect here" "cannot read 'absent.png': No such file" "cannot read 'disc.fl': it is neither PNG nor JPEG" \
        "font 'No Such Font' is not installed"; do
        check "reported once: $text" count_is err "$text" 1
    done
    printf '!window size=40;40\n    !canvas\n        !rect size=40 fill=true color=0;0;1\n' >blue.fl
    petri render blue.fl -o blue.png --frames 1
    check "elements with invalid attributes are not drawn" cmp -s wrong.png blue.png
    printf '!window size=40;40\n    !canvas\n        !rect size=1e300 point=-1e299 fill=true color=0;0;1\n        !line points=1e9;5;1e9;7 stroke=true stroke_width=1e6\n' >far.fl
    petri render far.fl -o far.png --frames 1
    check "distant elements are drawn correctly" cmp -s far.png blue.png

    # limits
    printf '!window size=1000;1000\n    !canvas\n        !line points=1000*uniform(:p)[..2000000] stroke=true\n' >points.fl
    rm -f points.png
    petri render points.fl -o points.png --frames 1
    check "a million points all over the picture are rejected" one_error
    check "the message gives the reason" has err "a path has too many points"
    check "a rejected picture writes no file" [ ! -e points.png ]
    printf '!window size=1000;1000\n    !canvas\n        !line points=(..2000000)/2000 stroke=true color=0;1;0\n' >points.fl
    petri render points.fl -o points.png --frames 1
    check "a million points on a line are drawn" status_is 0
    printf '!window size=1000;1000\n    !canvas\n        for i in ..12000\n            !text text="." point=500;(i%%2)*990\n        !rect size=40\n        !fill\n' >texts.fl
    petri render texts.fl -o texts.png --frames 1
    check "thousands of texts are not part of the path around them" status_is 0
    nest='wrap(wrap(wrap(wrap(wrap(wrap(wrap(wrap(wrap(wrap(x))))))))))'
    cat >nest.fl <<END
func wrap(x)
    !group
        !path
            !ellipse point=20;20 radius=50
            !clip
        x
func ten(x)
    $nest
func hundred(x)
    $(echo "$nest" | sed 's/wrap/ten/g')
func thousand(x)
    $(echo "$nest" | sed 's/wrap/hundred/g')
let x=(!rect size=40 fill=true color=0;0;1)
!window size=40;40
    !canvas
        $(echo "$nest" | sed 's/wrap/thousand/g')
END
    petri render nest.fl -o nest.png --frames 1
    check "10,000 nested clips are drawn" status_is 0
    check "10,000 nested clips do not change the picture" cmp -s nest.png blue.png
    sed 's/!group/!layer size=1000/; /!path/d; /!ellipse/d; /!clip/d' nest.fl >layers.fl
    petri render layers.fl -o layers.png --frames 1
    check "the innermost of 10,000 nested layers are drawn without layers" count_is err "layers are nested too deeply or too large" 1
    check "10,000 nested layers do not change the picture" cmp -s layers.png blue.png
fi
