# shaders.sh: tests that a script's shaders cannot crash petri or exceed its limits.

# shader NAME [LINE...]: writes NAME.fl, which draws with a shader. The lines are its declarations.
shader() {
    {
        printf '!window size=100;80\n    !shader fragment="""${HEADER}\nin vec2 coord; out vec4 color; uniform float time;\n'
        printf '%s\n' "$2" "void main() { float x = coord.x; $3; color = vec4(x, 0, 0, 1); }" '"""'
    } >"$1.fl"
}
# draw NAME [OPTION...]: renders a frame, within memory that suffices if shaders are limited.
draw() {
    shader_name=$1
    shift
    petri render "$shader_name.fl" -o "$shader_name.png" --frames 1 "$@"
}

shader good 'float twice(float x) { return 2.0 * x; }' 'x = twice(x)'
draw good
if [ -s good.png ] && ! has err "effects and 3-D scenes are left out"; then
    check "a shader draws" status_is 0
    check "a shader draws without a message" empty err
    shader bad '' 'x = y'
    draw bad
    check "a rejected shader is a warning" status_is 0
    check "the warning has the position in the shader" has err "bad.fl:5:38: warning: !shader: \`y' undeclared"

    # the text of an empty attribute has no bytes
    for texts in 'vertex="" fragment=""' 'fragment=""' 'vertex=""'; do
        for node in shader canvas3d; do
            printf '!window size=20\n    !%s %s\n        !sphere\n' $node "$texts" >hollow.fl
            draw hollow
            check "$node $texts is reported" eval 'status_is 0 && has err "hollow.fl:2:"'
        done
    done

    shader large 'float a[2000000000];' 'a[int(x)] = x; x = a[int(x * time)]'
    draw large
    check "a shader that crashes the driver is an error" status_is 1
    check "the error has a position" has err "large.fl:2:13: error: !shader: "
    check "the picture is drawn without the shader" [ -s large.png ]

    cat >group.fl <<'END'
!window size=100;80
    !canvas3d viewpoint=0;0;3 near=0.1
        !group count=COUNT fragment="""${HEADER}
in vec3 world_position; out vec4 color; uniform float count;
void main() { float x = 0.0; for (float i = 0.0; i < count; i++) x = sin(x + i); color = vec4(x, SECOND, 0, 1); }
"""
            !sphere
END
    sed 's/COUNT/9/; s/SECOND/1/' group.fl >group_good.fl
    draw group_good
    check "a group draws with a shader" eval 'status_is 0 && empty err'
    sed 's/COUNT/9/; s/SECOND/y/' group.fl >group_bad.fl
    draw group_bad
    check "a rejected shader of a group is a warning" status_is 0
    check "the warning of a group has the position in the shader" has err "group_bad.fl:5:98: warning: !group: \`y' undeclared"
    sed 's/COUNT/60000/; s/SECOND/1/' group.fl >group_slow.fl
    draw group_slow --work 5000000
    check "a shader of a group that draws too long is an error" status_is 1
    check "the error of a group names the work limit" has err \
        "error: !group: the shader took longer to draw than the work limit allows (--work); the scene is left out"
    sed 's/COUNT/0/; s/SECOND/1/; s/float x = 0.0/float a[2000000000]; a[int(count)] = count; float x = a[int(world_position)]/' \
        group.fl >group_large.fl
    draw group_large
    check "a shader of a group that crashes the driver is an error" status_is 1
    check "the error of a group has a position" has err "group_large.fl:3:24: error: !group: "

    macros='#define A0(x) sin(x)'
    for i in $(seq 30); do
        macros="$macros
#define A$i(x) A$((i - 1))(A$((i - 1))(x))"
    done
    shader macros "$macros" 'x = A30(x)'
    draw macros
    check "a shader that compiles too long is an error" status_is 1
    check "the error names the limit" grep -Eq "error: !shader: (the shader takes more than 4 s to compile and to draw 256 pixels|OpenGL crashed)" err
    rm -f macros.png
    "$petri" render macros.fl -o macros.png --frames 1 >out 2>err </dev/null &
    process=$!
    for _ in $(seq 100); do
        ! pgrep -P $process >/dev/null || break # the process that tests the shader has started
        sleep 0.05
    done
    kill -TERM $process
    status=0
    wait $process || status=$?
    check "a signal ends petri while a shader is tested" status_is 143
    check "a signal leaves no picture" [ ! -e macros.png ]

    shader loops '' 'for (int i = 0; i < 300; i++) for (int j = 0; j < 300; j++) x = sin(x + float(i * j) + time)'
    draw loops --work 2000000
    check "a shader that draws too long is an error" status_is 1
    check "the error names the work limit" has err "error: !shader: the shader took longer to draw than the work limit allows (--work)"
    draw loops --work "$(sed -n 's/.*note: --work \([0-9]*M\) suffices.*/\1/p' err | tail -n 1)"
    check "the note names a limit that suffices for the shader" eval 'status_is 0 && empty err'

    {
        cat good.fl
        printf 'if frame == 1\n    !window size=100;80\n'
        sed -n '2,$s/^/    /p' large.fl
    } | sed '1,/^"""$/{ s/^/    /; 1i if frame < 1
}' >series.fl
    petri render series.fl -o series%d.png --frames 2
    check "a series with a shader that crashes fails" status_is 1
    check "the frames before it are complete" cmp -s series0.png good.png
fi
