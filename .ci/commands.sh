# commands.sh: the table of the subcommands of dev, with their usage, the check of arguments and completion. Sourced by dev
# after progress.sh.
# shellcheck shell=sh

# Prints the table. A row that is not indented is a subcommand: name, arguments, a colon, and what it does. Indented rows
# describe its options and continue the description. Arguments in brackets may be omitted, "|" separates alternatives, and
# "..." allows repetition. Options must be before or after the operands, as in the row. A word in capitals is a value:
# COUNT, N and PORT are integers. OPTION... means that another program checks all arguments.
commands() {
    cat <<'END'
run FILE [OPTION...]: build, then run a script; on a terminal, show its picture
  OPTION  options of `petri run`; for a list, run: build/petri help run
test [--all | NAME...]: build, then run the tests of the program, or those named
  NAME    a test, a suite of tests/README.md, or a folder of scripts: golden, conformance or samples
  --all   also run slow tests, as CI does: pages, limits, faults, windows, ranks, hashes, packages
build: make a release build with windows and video; the program is build/petri
install [PREFIX]: build, then install petri in PREFIX (default: /usr/local for root, else ~/.local)
uninstall [PREFIX]: remove what `./dev install` installed in PREFIX (default: as for install)
package [--test | --sdist | --wheel | --manylinux | --static | --vscode]: make Debian packages in build/package
  --test       also install and test them on a minimal Debian system
  --sdist      make the source distribution of the Python module there instead
  --wheel      make a Python wheel there instead
  --manylinux  make a Python wheel without pictures there, for other Linux systems
  --static     make a static program without pictures there, with musl
  --vscode     make the extension for VS Code there
dist [--source | --single]: make all files of a release in build/dist, with notes and checksums
  --source  make only the source archive, with bill of materials and checksums
  --single  make only build/dist/single/petri.c and its headers: the engine as one C file
sanitize [--memory | --thread | NAME...]: run most tests with clang's address and undefined-behaviour sanitizers
  NAME      only tests and suites with these names
  --memory  run tests of the libraries with the memory sanitizer instead
  --thread  run tests of the thread pool with the thread sanitizer instead
fuzz [--minutes N | --seconds N] [HARNESS...]: run each fuzzing harness of tests/fuzz, or those named
  --minutes N  for N minutes (default: 10)
  --seconds N  for N seconds
mutate [PATH...] [--count N] [--seed N] [--only NUMBERS]: plant faults in sources and report which the tests catch
  PATH            a folder or file with sources (default: lib grammar)
  --count N       plant N faults (default: 150)
  --seed N        choose other faults (default: 1)
  --only NUMBERS  try these faults again, such as 7,31, also with slow tests
coverage: report which lines of lib/ and src/ the tests run; fail below 95 % or 90 %
format [--check]: format sources and scripts
  --check  only list unformatted files
tidy [--deep]: run clang-tidy
  --deep  run the Clang static analyzer instead, which takes half an hour
bench [--physics | --ranks] [OPTION...]: measure speed
  --physics  measure the particle engine only
  --ranks    measure MPI ranks
  OPTION     options of the benchmark; tests/bench/README.md describes them
maths [COUNT]: compare COUNT results (default: 10^9) of each elementary function with MPFR
crash-test [COUNT]: kill COUNT runs (default: 500) while they write files, then verify the files
hashes [--update]: print result hashes of the conformance scripts
  --update  store them instead
gallery [--update]: draw all pictures of tests/pictures in one image, build/gallery.png
  --update  store new test pictures instead
web [--test | --serve [PORT] | --engine]: build petri for browsers and Node.js in build/web
  --test          also test it
  --serve [PORT]  also serve the page at http://127.0.0.1:PORT (default: 8080)
  --engine        build only the npm package
figures: redraw the figures of the references in tests/docs/figures
clean-install [--as-user] [--terminal] [COMMAND...]: run commands in a checkout on a minimal Debian system
  COMMAND     a shell command (default: `./dev run samples/petri.fl` and `./dev test`)
  --as-user   run as an ordinary user with sudo
  --terminal  simulate a desktop terminal
setup [all]: install the packages for builds
  all  install those for all commands
completion: print a bash function that completes these commands
help [SUBCOMMAND]: print all commands, or the usage of one
END
}

# synopsis SUBCOMMAND: prints its name and arguments, or nothing if there is no such subcommand.
synopsis() {
    commands | awk -v name="$1" '/^[^ ]/ && (split($0, word, "[ :]") && word[1] == name) { sub(/: .*/, ""); print }'
}

# Prints all subcommands.
overview() {
    echo "usage: ./dev SUBCOMMAND [ARGUMENTS]; for its options, run: ./dev SUBCOMMAND --help"
    commands | awk '/^[^ ]/ {
        text = $0
        sub(/^[^:]*: /, "", text)
        synopsis = substr($0, 1, length($0) - length(text) - 2)
        if (length(synopsis) > 20)
            printf "  %s\n  %-20s  %s\n", synopsis, "", text
        else
            printf "  %-20s  %s\n", synopsis, text
    }'
}

# usage SUBCOMMAND: prints its usage.
usage() {
    commands | awk -v name="$1" '
        /^[^ ]/ {
            split($0, word, "[ :]")
            found = word[1] == name
            text = $0
            sub(/^[^:]*: /, "", text)
            if (found)
                print "usage: ./dev " substr($0, 1, length($0) - length(text) - 2) "\n" text
            next
        }
        found'
}

# check_arguments SYNOPSIS ARGUMENT...: prints an error if the arguments do not match the synopsis.
check_arguments() {
    row=$1
    shift
    awk -v synopsis="$row" -- '
        # Reads the synopsis. `group` is the number of its brackets, counted from the left.
        # Sets, for an option: group_of, value_of (name of its value) and omissible (its value may be omitted).
        # Sets, for operand i: place[i] (its group), kind[i], repeated[i], required[i].
        function read_synopsis(   i, word, depth, group) {
            count = split(synopsis, words, " ")
            for (i = 2; i <= count; i++) {
                word = words[i]
                if (word == "|")
                    continue
                group += depth == 0
                if (word ~ /^\[/ && word !~ /\]$/ || depth > 0 && word ~ /^\[/)
                    depth++
                if (word ~ /\]$/ && (word !~ /^\[/ || depth > 1))
                    depth -= word ~ /\]\]$/ ? 2 : 1
                required[operands + 1] = word !~ /^\[/ && depth == 0 && words[i] !~ /\]/
                optional_value = words[i] ~ /^\[[A-Z]/
                gsub(/[][]/, "", word)
                if (word ~ /^--/) {
                    group_of[option = word] = group
                    value_of[option] = ""
                    continue
                }
                if (option != "" && group == group_of[option] && words[i - 1] != "|" && word !~ /[.][.][.]$/) {
                    value_of[option] = word
                    omissible[option] = optional_value
                    continue
                }
                operands++
                place[operands] = group
                repeated[operands] = sub(/[.][.][.]$/, "", word)
                kind[operands] = word
            }
        }
        function fail(text) {
            print text
            finished = 1
            exit
        }
        function check_value(what, kind, value) {
            if (kind ~ /^(COUNT|N|PORT)$/ && value !~ /^[0-9]+$/ || kind == "COUNT" && value ~ /^0+$/)
                fail(what " must be " (kind == "COUNT" ? "a positive " : "an ") "integer, not \047" value "\047")
            if (kind ~ /^[a-z]/ && value != kind)
                fail("unknown argument: \047" value "\047")
        }
        function take_option(word) {
            if (!(word in group_of))
                fail("unknown option: \047" word "\047")
            if (group_of[word] in chosen && chosen[group_of[word]] != word)
                fail("cannot combine \047" chosen[group_of[word]] "\047 and \047" word "\047")
            if (group_of[word] < last_place)
                fail("option \047" word "\047 must be before the other arguments")
            chosen[group_of[word]] = word
            if (group_of[word] > last_option)
                last_option = group_of[word]
            if (value_of[word] == "")
                return
            if (at + 1 < ARGC && ARGV[at + 1] !~ /^-/)
                check_value("the value of " word, value_of[word], ARGV[++at])
            else if (!omissible[word])
                fail("option \047" word "\047 needs a value: " value_of[word])
        }
        function take_operand(word) {
            if (next_operand == 0 || !repeated[next_operand])
                next_operand++
            if (next_operand > operands)
                fail(operands > 0 ? "too many arguments: \047" word "\047" : "unknown argument: \047" word "\047")
            if (chosen[place[next_operand]] ~ /^--/)
                fail("cannot combine \047" chosen[place[next_operand]] "\047 and \047" word "\047")
            chosen[place[next_operand]] = word
            if (place[next_operand] < last_option)
                fail("argument \047" word "\047 must be before the options")
            check_value(kind[next_operand], kind[next_operand], word)
            last_place = place[next_operand]
        }
        BEGIN {
            read_synopsis()
            for (at = 1; at < ARGC; at++) {
                for (i = 1; i <= operands; i++)
                    if (kind[i] == "OPTION") {
                        finished = 1 # another program checks them
                        exit
                    }
                if (ARGV[at] ~ /^-/)
                    take_option(ARGV[at])
                else
                    take_operand(ARGV[at])
            }
            exit
        }
        END {
            if (!finished && next_operand < operands && required[next_operand + 1])
                print kind[next_operand + 1] " is missing"
        }' "$@"
}

# reject SUBCOMMAND MESSAGE: prints the message and the usage, and exits.
reject() {
    say "$2"
    usage "$1" >&2
    exit 2
}

# read_arguments SUBCOMMAND ARGUMENT...: prints help, or checks the arguments. Exits unless the subcommand must run.
read_arguments() {
    [ $# -gt 0 ] || {
        overview >&2
        exit 2
    }
    name=$1
    shift
    case $name in
    help | -h | --help)
        [ $# -le 1 ] || reject help "too many arguments: '$2'"
        [ $# -eq 1 ] || {
            overview
            exit
        }
        case $1 in
        -*) name=help ;;
        *) name=$1 ;;
        esac
        set -- --help
        ;;
    esac
    row=$(synopsis "$name")
    [ -n "$row" ] || {
        say "no such command: '$name'"
        overview >&2
        exit 2
    }
    for word; do
        case $word in
        -h | --help)
            usage "$name"
            exit
            ;;
        esac
    done
    error=$(check_arguments "$row" "$@")
    [ -z "$error" ] || reject "$name" "$error"
}

# Prints a bash function that completes subcommands and options, and file names otherwise. It also works in zsh.
completion() {
    echo "# For bash: eval \"\$(./dev completion)\". For zsh, first: autoload -Uz bashcompinit && bashcompinit"
    commands | awk '
        /^[^ ]/ {
            split($0, word, "[ :]")
            sub(/: .*/, "")
            options = "--help"
            count = split($0, words, "[][ |]+")
            for (i = 2; i <= count; i++)
                if (words[i] ~ /^(--|[a-z])/)
                    options = options " " words[i]
            names = names " " word[1]
            cases = cases "    " word[1] ") words=\"" options "\" ;;\n"
        }
        END {
            print "_petri_dev() {"
            print "    local words= word=${COMP_WORDS[COMP_CWORD]}"
            print "    case $COMP_CWORD:${COMP_WORDS[1]} in"
            print "    1:*) words=\"" substr(names, 2) "\" ;;"
            gsub(/\n    /, "\n    *:", cases)
            printf "    *:%s", substr(cases, 5)
            print "    esac"
            print "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))"
            print "}"
            print "complete -o default -F _petri_dev dev"
        }'
}
