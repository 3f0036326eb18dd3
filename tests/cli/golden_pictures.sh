# golden_pictures.sh: tests of goldens that contain pictures. Part of run.sh.

draws || { echo "skipped: no Cairo"; return 0; }
mkdir -p pics
cp disc.fl pics/disc.fl
petri test --new pics/disc.fl --render --frames 2 --size 80x60
check "--new --render creates a golden of pictures" out_is "created pics/disc.golden"
check "a golden of pictures lists them" [ "$(cat pics/disc.golden)" = "# render --frames 2 --size 80x60
disc.0000.png
disc.0001.png" ]
check "pictures have the size of the options" sized pics/disc.0001.png 80x60
petri test pics
check "the same pictures pass" last_line_is out "1 passed, 0 failed"
check "drawing leaves no files in the folder of temporary files" [ -z "$(find . -name 'petri-*')" ]

# Equal pixels in another file do not fail, and --update does not write the file again.
render_again() { petri render pics/disc.fl -o pics/all-%04d.png --frames 2 --size 80x60; }
render_again
if command -v python3 >/dev/null; then
    cat >recompress.py <<'END'
import struct, sys, zlib
data = open(sys.argv[1], 'rb').read()
at, chunks, pixels = 8, [], b''
while at < len(data):
    length = struct.unpack('>I', data[at:at + 4])[0]
    kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + length]
    pixels += body if kind == b'IDAT' else b''
    chunks += [] if kind == b'IDAT' else [(kind, body)]
    at += 12 + length
chunks.insert(-1, (b'IDAT', zlib.compress(zlib.decompress(pixels), 1)))
out = b'\x89PNG\r\n\x1a\n'
for kind, body in chunks:
    out += struct.pack('>I', len(body)) + kind + body + struct.pack('>I', zlib.crc32(kind + body))
open(sys.argv[1], 'wb').write(out)
END
    python3 recompress.py pics/disc.0000.png
    check "the file has other bytes" eval '! cmp -s pics/disc.0000.png pics/all-0000.png'
    cp pics/disc.0000.png other.png
    petri test pics/disc.fl
    check "pixels are compared, not bytes" last_line_is out "1 passed, 0 failed"
    petri test --update pics/disc.fl
    check "--update keeps a file with the same pixels" eval 'cmp -s pics/disc.0000.png other.png && lacks out updated'
fi
rm -f pics/all-*

# another colour
sed -i 's/color=1;0;0/color=1;0.01;0/' pics/disc.fl
petri test pics/disc.fl
check "a picture that differs fails" status_is 1
check "the number of pixels and their distance are reported" has out " of 4800 pixels differ, by at most 3 of 255"
check "old, new and difference are written side by side" sized pics/disc.0001.failed.png 256x60
sed -i '1s/$/\n# tolerance 3/' pics/disc.golden
petri test pics/disc.fl
check "a tolerance of the largest distance passes" last_line_is out "1 passed, 0 failed"
check "a test that passes deletes the comparisons" [ ! -e pics/disc.0001.failed.png ]
sed -i '2s/3/2/' pics/disc.golden
petri test pics/disc.fl
check "a tolerance below the distance fails" status_is 1
printf 'p\nr\n' >answers
timeout 100 "$petri" test --review pics/disc.fl <answers >out 2>err
check "a review names the comparisons" has out "old, new and difference: pics/disc.0000.failed.png"
check "a rejected picture leaves no comparison" [ ! -e pics/disc.0000.failed.png ]

# other numbers of pictures, and another size
sed -i '1s/--frames 2/--frames 3/' pics/disc.golden
petri test pics/disc.fl
check "a picture that is not recorded fails" has out "    +disc.0002.png"
petri test --update pics/disc.fl
check "--update records it" [ -e pics/disc.0002.png ]
sed -i '1s/--frames 3/--frames 1/' pics/disc.golden
echo x >pics/disc.0009.png
echo ../outside.png >>pics/disc.golden
echo x >outside.png
petri test --update pics/disc.fl
check "--update deletes pictures that are no longer drawn" [ ! -e pics/disc.0002.png ]
check "--update deletes no pictures that the golden does not list" [ -e pics/disc.0009.png ]
check "--update deletes no other files" [ -e outside.png ]
sed -i '1s/80x60/60x60/' pics/disc.golden
petri test pics/disc.fl
check "another size is reported" has out "expected 80x60 pixels, got 60x60"
rm pics/disc.0000.png
petri test pics/disc.fl
check "a picture that is missing fails" has out "cannot read "
sed -i '1s/$/ -o x.png/' pics/disc.golden
petri test pics/disc.fl
check "a golden of pictures cannot write other files" has out "line 1: option '--output' is not allowed in goldens"
cp disc.fl "pics/it's %d.fl"
petri test --new "pics/it's %d.fl" --render --frame 3
check "names with signs of patterns are plain names" [ -e "pics/it's %d.0003.png" ]
sed -i 's/color=1;0;0/color=0;1;0/' "pics/it's %d.fl"
petri test "pics/it's %d.fl"
check "a comparison of strange names is written" [ -e "pics/it's %d.0003.failed.png" ]
printf '!n\n' >pics/nothing.fl
petri test --new pics/nothing.fl --render
check "a script that draws nothing gets no golden" eval 'status_is 1 && [ ! -e pics/nothing.golden ]'
# A comparison shows the old disc, the new one, and a disc in the difference of their colours.
cp disc.fl pics/three.fl
petri test --new pics/three.fl --render --frame 0
sed -i 's/color=1;0;0/color=0;0.5;1/' pics/three.fl
petri test pics/three.fl
cat >three.fl <<'END'
!window size=136;30
    !canvas
        !rect size=136;30 fill=true color=0.5
        for i in ..3
            !group translate=48*i;0
                !rect size=40;30 fill=true color=0
                !ellipse point=5;15 radius=4 fill=true color=((1;0;0), (0;0.5;1), (1;0.5;1))[i]
END
sed -i 's/((1;0;0), (0;0.5;1), (1;0.5;1))\[i\]/(1;0;0;0;0.5;1;1;0.5;1)[3*i..3*i+3]/' three.fl
petri render three.fl -o three.png --frame 0
petri --compare-pictures three.png pics/three.0000.failed.png 2
check "a comparison has the difference as its third picture" status_is 0
