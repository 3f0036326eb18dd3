# reach.sh: tests of the restrictions on files that scripts and goldens can access. Part of ../cli/run.sh.

mkdir -p home/sub away elsewhere
work=$(pwd -P)
echo secret >away/secret.txt
echo mine >home/mine.txt
echo below >home/sub/below.txt
echo 'let y=3' >away/module.fl
ln -s ../away/secret.txt home/link.txt
ln -s ../away home/folder
ln -s sub/below.txt home/inside.txt
ln -s "$work" away/back

# reads EXPRESSION WANTED [OPTION...]: succeeds if EXPRESSION evaluates to WANTED in a script in the folder `home`.
reads() {
    printf '!n a=%s\n' "$1" >home/read.fl
    wanted=$2
    shift 2
    petri run home/read.fl --frames 1 --print tree "$@"
    [ "$(sed -n 2p out)" = "!n${wanted:+ a=$wanted}" ]
}
check "a script reads below its folder" reads "read('sub/below.txt')" "'below\\n'"
check "a script reads through a link that stays below its folder" reads "read('inside.txt')" "'below\\n'"
check "a script reads an absolute path below its folder" reads "read('$work/home/mine.txt')" "'mine\\n'"
mkdir cwd
echo here >cwd/here.txt
ln -s ../home cwd/home
cd cwd || exit 1
for file in ../away/secret.txt link.txt folder/secret.txt /etc/passwd sub/../../away/secret.txt "$work/away/secret.txt" \
    /proc/self/environ; do
    printf '!n a=read("%s")\n' "$file" >home/read.fl
    petri run home/read.fl --frames 1 --print tree
    check "a script does not read $file" grep -qx '!n' out
    check "the warning has a position and the reason: $file" grep -q 'read.fl:1:6: warning: .*scripts are not allowed to read there' err
    folder=$(sed -n "s/.*to allow it, use '--allow-read \([^']*\)'.*/\1/p" err | sed 's:/proc/.*:/proc:')
    petri run home/read.fl --frames 1 --print tree --allow-read "$folder"
    check "the folder in the hint allows reading: --allow-read $folder" grep -q '^!n a=' out
    petri run home/read.fl --frames 1 --print tree --allow-read all
    check "--allow-read all allows reading $file" grep -q '^!n a=' out
done
printf '!n a=read("../cwd/here.txt")\n' >home/read.fl
petri run home/read.fl --frames 1 --print tree
check "a script reads below the current folder" grep -q '^!n a=' out
mkdir far
cd far || exit 1
printf '!n a=glob("../*.txt") b=glob("folder/*") c=csv("../cwd/here.txt",0)\n' >../home/glob.fl
petri run ../home/glob.fl --frames 2 --print tree
check "glob and csv are limited to the allowed folders" grep -qx '!n' out
check "each denied read is reported once" [ "$(grep -c 'scripts are not allowed to read there' err)" -eq 3 ]
printf 'import y from "../cwd/here.fl"\n%%include "../cwd/here.fl"\n!n a=y\n' >../home/import.fl
echo 'let y=4' >../here.fl
petri run ../home/import.fl --frames 1 --print tree
check "import and include are limited to the allowed folders" grep -qx '!n' out
check "each denied import is reported" [ "$(grep -c 'scripts are not allowed to read there' err)" -eq 2 ]
petri run ../home/import.fl --frames 1 --print tree --allow-read ..
check "--allow-read allows import and include" grep -qx '!n a=4' out
printf '!n a=read("mine.txt") b=glob("*")\n%%include "glob.fl"\n' >../home/none.fl
petri run ../home/none.fl --frames 1 --print tree --no-files
check "--no-files disables all reading" grep -qx '!n' out
check "--no-files is reported for each read" [ "$(grep -c 'file access is disabled (--no-files)' err)" -eq 3 ]
petri run ../home/none.fl --allow-read /no/such/folder
check "--allow-read rejects a missing folder" status_is 2
petri check ../home/glob.fl
check "check reports denied reads" [ "$(grep -c 'scripts are not allowed to read there' err)" -eq 3 ]
if command -v strace >/dev/null && strace -qq -o trace true 2>/dev/null; then
    # file_without_openat2 FILE: reads FILE as on a system without openat2.
    file_without_openat2() {
        printf '!n a=read("%s")\n' "$1" >../home/old.fl
        strace -f -qq -o trace -e trace=openat2 -e inject=openat2:error=ENOSYS "$petri" run ../home/old.fl --frames 1 \
            --print tree >out 2>err
    }
    # A build with -Dos=posix never calls it.
    file_without_openat2 sub/below.txt
    check "reading works without openat2" eval 'grep -q "a=.below" out && { has trace INJECTED || ! has trace openat2; }'
    file_without_openat2 ../cwd/here.txt
    check "denied reads are denied without openat2" grep -qx '!n' out
fi
cd "$work" || exit 1

printf '!window size=40\n    !canvas\n        !rect size=10 fill=true color=1\n' >disc.fl
petri render disc.fl --frames 1 -o disc.png
if [ "$status" -eq 0 ]; then # this build has Cairo
    # record NAME [OPTION...]: runs a script in the folder `home` that records to NAME.
    record() {
        printf '!window size=40\n    !record filename="%s"\n    !canvas\n        !rect size=10\n' "$1" >home/record.fl
        shift
        petri render home/record.fl --frames 1 -o shown.png "$@"
    }
    echo keep >away/keep.png
    ln -s ../away/keep.png home/link.png
    ln -s ../away/new.png home/dangling.png
    ln -s sub/there.png home/stays.png
    mkfifo home/pipe.png
    ls -l away >before
    for file in ../away/keep.png ../away/new.png link.png dangling.png folder/keep.png "$work/away/new.png" ../new.png \
        sub/../../away/new.png folder/back/new.png; do
        record "$file"
        check "a script does not write $file" status_is 1
        check "the error has a position and the option that allows it: $file" \
            [ "$(grep -c "record.fl:2:1[0-9]: error: !record: cannot write .*to allow it, use '--allow-write $work[/a-z]*'" err)" -eq 1 ]
        ls -l away >after
        check "nothing is written outside the folder: $file" eval 'cmp -s before after && [ ! -e new.png ]'
    done
    record pipe.png
    check "a script does not write to a pipe" eval 'status_is 1 && [ -p home/pipe.png ]'
    record ../away/new.png --allow-read "$work/away"
    check "--allow-read does not allow writing" status_is 1
    for file in own.png sub/own.png stays.png; do
        record "$file"
        check "a script writes below its folder: $file" eval 'status_is 0 && [ -s "home/$file" ]'
    done
    check "a script writes through a link that stays below its folder" eval '[ -L home/stays.png ] && [ -s home/sub/there.png ]'
    record ../away/new.png --allow-write away
    check "--allow-write allows writing" eval 'status_is 0 && [ -s away/new.png ]'
    record link.png --allow-write away
    check "--allow-write allows writing through a link, which is kept" eval 'status_is 0 && [ -L home/link.png ] && grep -q PNG away/keep.png'
    record own.png --no-files
    check "--no-files disables writing" status_is 1
    petri render home/record.fl --frames 1 -o away/named.png --no-files
    check "--no-files makes the run fail if the script writes" status_is 1
    petri render disc.fl --frames 1 -o away/named.png --no-files
    check "--no-files does not limit the output of the command line" eval 'status_is 0 && [ -s away/named.png ]'
    printf '!window size=40\n    !canvas\n        !image filename="../disc.png"\n        !rect size=5 fill=true\n' >home/image.fl
    cd cwd || exit 1
    petri render ../home/image.fl --frames 1 -o image.png
    check "an image outside the allowed folders is not drawn" eval 'status_is 0 && grep -q "image.fl:3:16: warning: !image: cannot read" err'
    petri render ../home/image.fl --frames 1 -o allowed.png --allow-read ..
    check "--allow-read allows an image" eval 'status_is 0 && empty err && ! cmp -s image.png allowed.png'
    cd "$work" || exit 1
fi

# The options in a golden may come from another author, like the script.
mkdir -p golden
echo '!n' >golden/t.fl
echo keep >elsewhere/victim.csv
for options in '--trajectory ../elsewhere/victim.csv' '--state ../elsewhere/new.state' '--state=../elsewhere/new.state' \
    '--allow-write ..' '--every 1 --frames=1 --state x' '-D a=1 --show'; do
    printf '# run --frames 2 %s\n' "$options" >golden/t.golden
    petri test golden/t.fl
    check "a golden with $options fails" status_is 1
    check "a rejected golden gives the reason: $options" has out "is not allowed in goldens: tests write no files"
    petri test --update golden/t.fl
    check "--update rejects a golden with $options" status_is 1
    check "a rejected golden writes no files: $options" eval '[ "$(cat elsewhere/*)" = keep ]'
done
printf '# run --frames 1 -D a=--state --allow-read .. --print tree\n@0 time=0 beat=0\n!n\n' >golden/t.golden
petri test golden/t.fl
check "a golden can have options that read, and values that look like other options" status_is 0
