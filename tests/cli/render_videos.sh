# render_videos.sh: tests of `petri render` with videos, and of interrupted videos and series. Part of run.sh.

if ! draws || ! command -v ffmpeg >/dev/null; then
    echo "skipped: videos need Cairo and ffmpeg"
    return
fi
cat >windows.fl <<'END'
!window size=4;4 id="first"
    !canvas
        !rect size=9 fill=true color=1;0;0
!offscreen size=5;4 id=:spare
!window size=6;4 id="second"
    !canvas
        !rect size=9 fill=true color=0;1;0
!window size=8;4 id="../../a%d/b"
    !feedback mixer=0.5
        !canvas
            !rect size=2 point=frame%8;0 fill=true color=0;1;0
!window size=7;4
    !canvas
        !rect size=2 point=frame%8;0 fill=true color=0;1;0
!window size=9;4 id="empty"
END
cat >early.fl <<'END'
!physics state=:w dimensions=2
    !particle id=1 position=20;20 velocity=1;0
!window size=20;20
    !canvas
        !rect size=20 fill=true color=(0;1;0) if $(:w;1) else (1;0;0)
END
mkdir each
petri render windows.fl -o 'each/{window}.gif' --frames 3
check "{window} writes a video of each window" status_is 0
check "each window has a video" [ "$(ls each/*.gif | wc -l)" -eq 4 ]
petri render windows.fl -o windows.gif --frames 3 --window 3
check "the video of a window equals that of --window" cmp -s windows.gif each/_._.._a_d_b.gif
printf '!window size=2;2 id=frame\n    !canvas\n' >many.fl
petri render many.fl -o 'many-{window}.gif' --frames 70
check "more than 64 videos are an error" has err "a run can write at most 64 videos"
check "none of too many videos is written" [ ! -e many-0.gif ]
for suffix in mp4 m4v mov mkv webm ogg gif; do
    petri render disc.fl -o film.$suffix --frames 10 --fps 50
    check "render writes a video: $suffix" [ -s film.$suffix ]
    frames=$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 film.$suffix)
    check "a video has all frames: $suffix" [ "${frames%%,*}" = 10 ]
done
check "videos leave no temporary files" nothing_beside
petri render disc.fl -o fast.gif --frames 60
ffprobe -v error -show_entries packet=duration_time -of csv=p=0 fast.gif | sort | uniq -c >delays
check "a GIF of 60 frames per second has 50" [ "$(tr -d ' ,' <delays)" = 500.020000 ]
petri render early.fl -o early.mp4 --frames 10
frames=$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 early.mp4)
check "a video has the requested number of frames" [ "${frames%%,*}" = 10 ]
ffmpeg -v error -i early.mp4 -frames:v 1 -pix_fmt rgb24 -f rawvideo - </dev/null | od -An -N3 -tu1 >colour
check "a video starts with the first frame that shows its particles" awk '{ exit !($1 < 50 && $2 > 200) }' colour
frame_count() { ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 "$1" | tr -d ,; }
cat >record.fl <<'END'
!window size=40;40
    !record filename="films/whole.mp4"
        !canvas
            !rect size=40;40 fill=true
    !record filename="part.gif" limit=0.1
        !canvas
            !rect size=40;40 fill=true
    !record filename="growing.mp4" size=((40;40) if frame < 3 else (20;20))
        !canvas
            !rect size=40;40 fill=true
END
petri render record.fl -o last.png --frames 12
check "!record writes videos" status_is 0
check "a video of !record has a frame for each frame of the script" [ "$(frame_count films/whole.mp4)" = 12 ]
check "a video of !record ends at its limit" [ "$(frame_count part.gif)" = 5 ] # 0.1 s
check "a video of !record leaves out frames of another size" [ "$(frame_count growing.mp4)" = 3 ]
rm -rf films part.gif growing.mp4
# Options of the encoder: those of the list arrive, others are refused.
# encode FILE ATTRIBUTES: records three frames.
encode() {
    printf '!window size=33;31\n    !record filename="%s" %s\n        !canvas color=frame\n' "$1" "$2" >record.fl
    petri render record.fl -o last.png --frames 3
}
# stream ENTRY FILE: prints a property of a video.
stream() { ffprobe -v error -show_entries "stream=$1" -of csv=p=0 "$2"; }
encode options.mp4 'crf=40 preset=:slow profile=:high422 pixfmt=:yuv422p'
check "!record passes options to the encoder" status_is 0
check "a video has the profile and pixel format of !record" \
    [ "$(stream profile,pix_fmt options.mp4)" = "High 4:2:2,yuv422p" ]
encode options.mkv "codec='libvpx-vp9'"
check "a video has the codec of !record" [ "$(stream codec_name options.mkv)" = vp9 ]
encode none.webm codec=:h264
check "a codec that the container cannot contain is an error" \
    has err "cannot write 'none.webm': .webm files cannot contain the codec 'h264', only vp9 vp8 av1"
check "an impossible codec exits with 1 and writes nothing" eval 'status_is 1 && [ ! -e none.webm ]'
encode none.ogg crf=3
check "an option that the codec lacks is an error" has err "the codec 'theora' has no option 'crf'"
encode none.mp4 crf=60
check "a crf that the codec lacks is an error" has err "for the codec 'h264', crf must be at most 51"
encode none.mp4 profile=:hq
check "a profile that the codec lacks is an error" has err "the codec 'h264' has no profile 'hq'"
encode none.webm 'codec=:vp8 pixfmt=:yuv444p'
check "a pixel format that the codec lacks is an error" has err "the codec 'vp8' has no pixel format 'yuv444p'"
encode none.webm preset=:slow
check "a preset that the codec lacks is an error" has err "the codec 'vp9' has no option 'preset'"
encode listed.mp4 "codec='-y' preset='x -f null' crf=64"
check "options outside the list are reported" count_is err "[bad-attribute]" 3
check "options outside the list do not reach the encoder" [ "$(stream codec_name listed.mp4)" = h264 ]
printf '!window size=40;40\n    !record filename="absent.mp4/x.mp4"\n        !canvas\n' >record.fl
: >absent.mp4
petri render record.fl -o last.png --frames 2
check "a video of !record that cannot be written is an error" status_is 1
check "the message names the video of !record" has err "absent.mp4"
rm absent.mp4 last.png
petri render disc.fl -o odd.mp4 --frames 2 --size 41x31
check "a video can have an odd size" status_is 0
for name in file:film.mp4 at:12.gif; do
    petri render disc.fl -o "$name" --frames 2
    check "a colon is part of a video's name: $name" [ -s "$name" ]
done
check "a colon in a video's name creates no other file" nothing_beside
mkdir films
: >films/last.mp4
ln -s films/last.mp4 link.mp4
petri render disc.fl -o link.mp4 --frames 2
check "a video's name can be a symbolic link, which is kept" [ -L link.mp4 ]
check "a video is written through a symbolic link" [ -s films/last.mp4 ]

# render_small ARGUMENT...: renders with less memory than a frame of 16000x16000 needs. ulimit counts in
# kilobytes.
render_small() (
    ulimit -v 900000
    exec timeout 100 "$petri" render disc.fl "$@" >out 2>err </dev/null
)
if render_small -o small.mp4 --frames 2; then # fails with sanitizers, which reserve much memory
    render_small -o large.mp4 --frames 2 --size 16000x16000
    status=$?
    check "a frame that exceeds memory is an error" status_is 1
    check "a frame that exceeds memory is reported" has err "out of memory"
    check "a frame that exceeds memory leaves no video" [ "$(echo large.mp4*)" = "large.mp4*" ]
fi

mkdir tools
# A mock of ffmpeg that is killed while it reads.
cat >tools/ffmpeg <<'END'
#!/bin/sh
for last; do :; done
head -c 30000 >"${last#file:}"
kill -9 $$
END
chmod +x tools/ffmpeg
cp film.mp4 before.mp4
PATH=$PWD/tools:$PATH petri render disc.fl -o film.mp4 --frames 50
check "a killed ffmpeg is an error" status_is 1
check "a killed ffmpeg is reported once" count_is err "ffmpeg was killed by signal 9" 1
check "a killed ffmpeg does not change the old video" cmp -s film.mp4 before.mp4
check "a killed ffmpeg leaves no partial video" nothing_beside
printf '#!/bin/sh\nhead -c 9000 >/dev/null\nexit 0\n' >tools/ffmpeg
PATH=$PWD/tools:$PATH petri render disc.fl -o film.mp4 --frames 50
check "an ffmpeg that ends early is an error" status_is 1
check "an ffmpeg that ends early is reported" has err "ffmpeg ended early"
printf '#!/bin/sh\necho one >&2\necho two >&2\nexit 3\n' >tools/ffmpeg
PATH=$PWD/tools:$PATH petri render disc.fl -o film.mp4 --frames 50
check "the last message of ffmpeg is shown" has err "ffmpeg failed with status 3: two"
rm -r tools
(
    ulimit -f 16 # in blocks of 512 bytes; writing a larger file fails as on a full disk
    exec timeout 100 "$petri" render disc.fl -o film.mp4 --frames 600 --size 600x600 >out 2>err </dev/null
)
status=$?
check "a full disk makes a video fail" status_is 1
check "a full disk is reported once for a video" count_is err "cannot write 'film.mp4'" 1
check "a full disk does not change the old video" cmp -s film.mp4 before.mp4
check "a full disk leaves no partial video" nothing_beside
printf '!window size=200;200\n    !canvas\n        !ellipse point=frame%%200 radius=9 fill=true\n' >long.fl
# start_long ARGUMENT...: starts rendering many frames and waits until some exist.
# stop_long: waits until the process ends.
start_long() {
    "$petri" render long.fl --frames 1000000 "$@" >out 2>err </dev/null &
    job=$!
    tries=0
    while ! frames_there && [ $tries -lt 300 ]; do
        sleep 0.1
        tries=$((tries + 1))
    done
}
stop_long() {
    wait "$job"
    status=$?
}
# Prints the process id of ffmpeg in this folder, because others may be running on this machine.
encoder() {
    for id in $(pgrep -x ffmpeg); do
        [ "$(readlink "/proc/$id/cwd")" != "$work" ] || echo "$id"
    done
}
no_ffmpeg() { [ -z "$(encoder)" ]; }
# A video has no name before it is complete, so progress is measured by the bytes that ffmpeg has read: 160 kB
# per frame.
frames_there() {
    [ -z "$(find . -name 'long*.png' -size +0c)" ] || return 0
    awk '$1 == "rchar:" { read = $2 } END { exit read < 3e6 }' "/proc/$(encoder)/io" 2>/dev/null
}
for suffix in mp4 webm gif; do
    start_long -o long.$suffix --fps 50
    kill -INT "$job"
    stop_long
    check "Ctrl-C during a video exits with the signal's status: $suffix" status_is 130
    kept=$(sed -n "s/.*stopped; 'long.$suffix' is complete, with the \([0-9]*\) frames* drawn so far.*/\1/p" err)
    frames=$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 long.$suffix 2>&1)
    check "Ctrl-C during a video reports the number of kept frames" [ "${kept:-0}" -gt 0 ]
    check "an interrupted video can be played: ${frames%%,*}" [ "${frames%%,*}" = "$kept" ]
    check "an interrupted video leaves no temporary files" nothing_beside
    rm -f long.$suffix
done
# Building the display list takes longer than drawing, so the signal arrives while the list is being built.
cp long.fl even.fl
printf '        for i in ..200000\n            !transform scale=1+i\n' >>long.fl
start_long -o long.mp4
kill -INT "$job"
stop_long
check "Ctrl-C while a display list is built keeps the video: $(cat err)" ffprobe -v error long.mp4
mv even.fl long.fl
rm -f long.mp4
start_long -o long%06d.png
kill -TERM "$job"
stop_long
check "SIGTERM during a series exits with the signal's status" status_is 143
kept=$(sed -n "s/.*stopped; 'long%06d.png' has the \([0-9]*\) frames* drawn so far.*/\1/p" err)
check "an interrupted series reports its number of pictures" [ "$(find . -name 'long*.png' | wc -l)" -eq "${kept:-0}" ]
check "an interrupted series has consecutive pictures" [ -e "$(printf long%06d.png $((${kept:-0} - 1)))" ]
check "an interrupted series has no partial pictures" nothing_beside
rm -f long0*.png
# The first image takes long; the others are rendered in the meantime.
cp long.fl even.fl
printf '!window size=200;200\n    !canvas\n        for i in ..(30000 if frame==0 else 1)\n            !ellipse point=200*uniform(:p;i)[..2] radius=20 stroke=true\n' >long.fl
start_long -o long%06d.png
kill -INT "$job"
stop_long
kept=$(sed -n "s/.*stopped; 'long%06d.png' has the \([0-9]*\) frames* drawn so far.*/\1/p" err)
check "an interrupted series with slow pictures reports its number of pictures" [ "$(find . -name 'long*.png' | wc -l)" -eq "${kept:-0}" ]
check "an interrupted series with slow pictures has no gaps" [ "$(find . -name 'long*.png' | sort | tail -n 1)" = "$(printf ./long%06d.png $((${kept:-0} - 1)))" ]
check "an interrupted series with slow pictures has no partial pictures" nothing_beside
rm -f long0*.png
mv even.fl long.fl
cp film.mp4 long.mp4
for output in long.mp4 long%06d.png; do
    printf '!window size=1500;1500\n    !canvas\n        for i in ..20000\n            !ellipse point=1500*uniform(:p;i)[..2] radius=40 stroke=true\n' >slow.fl
    "$petri" render slow.fl --frames 1000000 -o "$output" >out 2>err </dev/null &
    job=$!
    sleep 1
    kill -INT "$job"
    sleep 0.5
    kill -INT "$job" 2>/dev/null
    stop_long
    check "a second Ctrl-C ends rendering at once: $output" status_is 130
    check "a second Ctrl-C leaves no partial files: $output" nothing_beside
    check "a second Ctrl-C ends ffmpeg" no_ffmpeg
done
check "a second Ctrl-C does not change the old video" cmp -s long.mp4 film.mp4
rm -f long.mp4
timeout 1 "$petri" render long.fl --frames 1000000 -o long.mp4 >out 2>err </dev/null
check "a signal from timeout that arrives twice keeps the video" ffprobe -v error long.mp4
