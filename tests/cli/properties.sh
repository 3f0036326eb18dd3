# properties.sh: tests of NAME.properties, statements about all runs of a script. Part of run.sh.

mkdir -p prop
# tries TEXT...: writes the lines of a file of properties, and tests it.
tries() {
    printf '%s\n' 'seconds 60' 'cases 20' "$@" >prop/fall.properties
    rm -f prop/fall.cases
    petri test prop/fall.properties
}
holds() { status_is 0 && last_line_is out "1 passed, 0 failed"; }
violated() { status_is 1 && has out "prop/fall.properties:" && has out ": violated"; }
cat >prop/fall.fl <<'END'
let N=N or 3        -- 1..9 number of balls
    G=G or 10       -- 5..20.5 acceleration
    SEED=SEED or 0  -- 0..20

!physics state=:fall dimensions=1
    for i in ..N
        !particle id=i position=100+uniform(:h;SEED)[i] radius=1
    !constant acceleration=-G
END

tries 'frames 30' 'always $(:fall;i) <= 101 for i in ..N' 'never $(:fall;0) > 101' 'finally $(:fall;0) < 100.9' finite
check "properties that hold pass" holds
check "a test of properties has the name of its file" has out "ok prop/fall.properties"
tries 'always $(:fall;i) > 99 for i in ..N'
check "always is violated by one element" violated
check "the line of the property is reported" has out "prop/fall.properties:3: error: always"
check "a violation is made as simple as possible" has out "with N=1: i=0: "
check "the values of a comparison are shown" has out "> 99 (particle :fall;0)"
sed -n 's/^ *petri repl \(.*\)/"$petri" repl \1 <\/dev\/null >out 2>err/p' out >command.sh
check "a violation has one command" [ "$(wc -l <command.sh)" -eq 1 ]
frame=$(sed -n 's/^ *violated in frame \([0-9]*\) .*/\1/p' out)
# shellcheck source=/dev/null
. ./command.sh
check "the command stands at the frame" has out "@$frame time="
check "the command explains the particle" has out "constant  -     -10 "
check "a violated case is kept" has prop/fall.cases "N=1 G=10 SEED=0"
petri test prop/fall.properties
check "a kept case is tried first" has out "case 1, simplified by"
check "a kept case is kept once" [ "$(wc -l <prop/fall.cases)" -eq 2 ]
petri test prop/fall.properties
mv out first
petri test prop/fall.properties
check "the same test gives the same report" cmp -s first out
tries 'never $(:fall;i) < 99 for i in ..N'
check "never is violated" violated
tries 'finally $(:fall;0) > 100'
check "finally is violated in the last frame" has out "violated in frame 119 "
tries 'always $(:fall;N-1) > 99 over N in 2..3'
check "a range can follow a property" has out "with N=2: "
tries 'always $(:fall;N-1) > 99 over N in 2..3 over G in 5..6'
check "only one range can follow a property" has out "expected a range such as ..100"
tries 'over N in 4..6' 'always $(:fall;N-1) > 99'
check "over sets the range of a parameter" has out "with N=4: "
tries 'over G in 7.25..7.5' 'over N in 1..2' 'always $(:fall;0) > 99'
check "a range of integers does not contain its end" lacks out "N=2"
check "a range of numbers is not one of integers" has out "with N=1 G=7."

# mistakes
tries 'always $(:fall;0) > NOWHERE'
check "an unbound name in a property fails" has out "prop/fall.properties:3: error: unbound name 'NOWHERE' is null"
tries 'always 1 +'
check "a syntax error in a property fails" has out "prop/fall.properties:3: error: "
tries 'sometimes 1'
check "an unknown property fails" has out "prop/fall.properties:3: error: expected always, never or finally"
tries 'over H in ..3' finite
check "a range of an unknown parameter fails" has out "prop/fall.properties:3: error: the script has no parameter 'H'"
tries 'over N in 5..2' finite
check "an empty range fails" has out "prop/fall.properties:3: error: expected a range"
tries 'frames 0'
check "a setting that is too small fails" has out "prop/fall.properties:3: error: expected a number from 1"
tries
check "a file without properties fails" has out "the file has no property"
tries finite
mv prop/fall.fl prop/gone.fl
petri test prop/fall.properties
check "properties without their script fail" has out "no such script: prop/fall.fl"
mv prop/gone.fl prop/fall.fl
sed -i 's/^!physics/let x=1\/\n&/' prop/fall.fl
petri test prop/fall.properties
check "a script that cannot be loaded fails" status_is 1
sed -i '/^let x/d' prop/fall.fl

# A case that does not end in time proves nothing.
cat >prop/heavy.fl <<'END'
!n a=sum(sin(i) for i in ..20000000)
END
printf 'seconds 0.1\nframes 100000\nfinite\n' >prop/heavy.properties
petri test prop/heavy.properties
check "a search in which no case ends fails" has out "heavy.properties:1: error: no case ended within 0.1 s; add a line such as 'seconds 1'"

# properties with a name: each holds in one script and is violated in another
# named PROPERTY LINE...: tests a system of a particle that moves and these lines.
named() {
    printf 'seconds 60\nframes 60\n%s\n' "$1" >prop/fall.properties
    rm -f prop/fall.cases
    shift
    {
        printf '!physics state=:s dimensions=1 resolution=%s\n' "${resolution:-1/60}"
        printf '    !particle id=:a position=0 velocity=%s radius=1\n' "${velocity:-5}"
        [ $# -eq 0 ] || printf '    %s\n' "$@"
    } >prop/fall.fl
    petri test prop/fall.properties
}
named finite
check "finite holds" holds
named finite '!particle id=:b position=1/0'
check "finite is violated" has out "the position is inf (particle :s;:b)"
named 'inside BARRIERS' '!barrier position=10 normal=-1'
check "inside BARRIERS holds" holds
velocity=1e9 named 'inside BARRIERS' '!barrier position=10 normal=-1' '!barrier position=-10 normal=1'
check "inside BARRIERS is violated, with the line of the wall" has out "behind the !barrier in line "
other='!particle id=:b position=3 velocity=-5 mass=2 radius=1'
named 'conserves momentum' "$other" '!collision strength=20'
check "conserves momentum holds" holds
named 'conserves momentum' "$other" '!constant acceleration=1'
check "conserves momentum is violated" has out "the momentum was -4.95"
resolution=1/2000 named 'conserves energy within 1%' "$other" '!collision strength=20'
check "conserves energy holds" holds
named 'conserves energy within 1%' "$other" '!drag strength=0.1'
check "conserves energy is violated" has out " in frame 1 and is "
named settles '!drag strength=50'
check "settles holds" holds
named settles
check "settles is violated" has out "the kinetic energy is still 12.5, and was at most 12.5"
named 'independent of order' "$other" '!collision strength=20'
check "independent of order holds" holds
named 'independent of order' "$other" '!random strength=5'
check "random numbers depend on the order" has out "the positions differ by "
named 'stable under half steps' "$other" '!collision strength=20'
check "stable under half steps holds" holds
named 'stable under half steps' "$other" '!collision strength=3000'
check "stable under half steps is violated" has out "the positions differ by "
named 'settles within nothing'
check "an amount that is not a number fails" has out "expected 'within NUMBER%'"
