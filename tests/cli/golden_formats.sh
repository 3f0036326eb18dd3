# golden_formats.sh: tests of `petri test --format`, whose output other programs read. Part of run.sh.

mkdir -p ci/below
printf '!n a=frame\n' >ci/good.fl
petri test --new ci/good.fl --frames 2
# A name and an output with all that the formats must escape.
odd="ci/below/a'b,c:d#e%f\\g&<h>.fl"
printf 'debug("]]> <a&b> 100%% it'"'"'s \\"q\\"")\n' >"$odd"
petri test --new "$odd" --frames 1 --print log
sed -i 's/100/101/' "$odd"
cp "$odd" ci/below/lost.golden

petri test --format tap ci
check "--format tap fails like text" status_is 1
check "TAP begins with version and plan" [ "$(head -n 2 out)" = "TAP version 14
1..3" ]
check "TAP escapes names" has out "not ok 1 - ci/below/a'b,c:d\\#e%f\\\\g&<h>.fl"
check "TAP numbers tests that pass" has out "ok 3 - ci/good.fl"
check "TAP has nothing but tests and their data" [ "$(grep -c -v -e '^ok ' -e '^not ok ' -e '^  ' out)" -eq 2 ]
check "TAP has the position" has out "  at: 'ci/below/a''b,c:d#e%f\\g&<h>.golden:3'"
check "TAP has the difference" has out "    -> ']]> <a&b> 100% it"

petri test --format github ci
check "--format github also has the text" last_line_is out "1 passed, 2 failed"
check "an annotation has the escaped file, the line and the name" has out \
    "::error file=ci/below/a'b%2Cc%3Ad#e%25f\\g&<h>.golden,line=3,title=ci/below/a'b%2Cc%3Ad#e%25f\\g&<h>.fl::frame 0: expected"
check "an annotation is one line" [ "$(grep -c '^::error ' out)" -eq 2 ]
check "an annotation has the difference" has out "%0A--- recorded%0A+++ now%0A@@ -"
petri test --format github ./ci/below
check "paths of annotations do not begin with ./" has out "::error file=ci/below/lost.golden,line=1,"

petri test --format junit ci
check "--format junit writes only XML" [ "$(head -n 1 out) $(tail -n 1 out)" = '<?xml version="1.0" encoding="UTF-8"?> </testsuite>' ]
mv out report.xml
petri test --junit same.xml ci
strip() { sed 's/time="[0-9.]*"/time=""/g' "$1"; }
check "--junit FILE writes the same report" [ "$(strip report.xml)" = "$(strip same.xml)" ]
check "JUnit has the folder as class" has report.xml 'classname="ci.below" name="lost.golden"'
check "JUnit has the output" has report.xml "    <system-out>--- recorded"
if command -v python3 >/dev/null; then
    cat >read.py <<'END'
import sys, xml.etree.ElementTree
suite = xml.etree.ElementTree.parse(sys.argv[1]).getroot()
cases = list(suite)
assert suite.tag == 'testsuite' and suite.get('tests') == '3' and suite.get('failures') == '2'
assert all(case.tag == 'testcase' and case.get('classname') and case.get('name') for case in cases)
assert len({(case.get('classname'), case.get('name')) for case in cases}) == 3
odd = next(case for case in cases if case.get('name').startswith("a'b"))
assert odd.get('name') == "a'b,c:d#e%f\\g&<h>.fl"
assert ']]> <a&b> 100% it' in odd.find('failure').get('message')
assert '\n-> ' in odd.find('system-out').text and '\n+> ' in odd.find('system-out').text
END
    check "JUnit is XML that gives back each character" python3 read.py report.xml
fi
# A message with control characters and with ill-formed UTF-8: the name of a script in it.
bad=$(printf 'ci/x\033\377.fl')
if printf '!n (\n' >"$bad" 2>/dev/null; then
    printf 'line 7\n' >"$(printf 'ci/x\033\377.err')"
    petri test --format junit ci
    mv out bad.xml
    check "JUnit replaces what XML cannot contain" has bad.xml 'name="x??.fl"'
    ! command -v python3 >/dev/null || check "JUnit with a strange name is XML" python3 -c \
        'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' bad.xml
fi
petri test --format yaml ci
check "an unknown format is a wrong command line" status_is 2
