// habit_list.h: names of other languages that Flitter does not have, and what it has instead (scope.c).
//
// HABIT("name", "hint").
// clang-format off
#define NULL_IS "did you mean 'null'?"
#define TYPE "values have no types: let x=5"
#define COLOUR "a colour is r;g;b, each from 0 to 1: "
#define SEE "to see a value write debug(value)"
#define LET "to name a value write let x=5"
#define FUNCTION "a function is written func f(x), with its value below, indented"
#define RANDOM "random numbers are uniform(:name), from 0 to 1: uniform(:name)[0] is the first"
#define TURNS "angles are in turns: 90deg is 0.25"
#define VECTOR "vectors are joined with semicolons: v;x"

HABIT("range", "the numbers from 0 to 9 are ..10, those from 2 to 9 are 2..10")
HABIT("None", NULL_IS)
HABIT("nil", NULL_IS)
HABIT("NULL", NULL_IS)
HABIT("Null", NULL_IS)
HABIT("nullptr", NULL_IS)
HABIT("undefined", NULL_IS)
HABIT("True", "did you mean 'true'?")
HABIT("TRUE", "did you mean 'true'?")
HABIT("False", "did you mean 'false'?")
HABIT("FALSE", "did you mean 'false'?")
HABIT("print", SEE)
HABIT("println", SEE)
HABIT("printf", SEE)
HABIT("echo", SEE)
HABIT("puts", SEE)
HABIT("console", SEE)
HABIT("return", "the last line of a function is its value: leave return away")
HABIT("while", "there is no while: for i in ..10 repeats, if tests, and a !counter goes on from frame to frame")
HABIT("break", "a loop has no break: choose with if what it makes")
HABIT("continue", "a loop has no continue: choose with if what it makes")
HABIT("pass", "a block that does nothing is left out, with the line above it")
HABIT("end", "a block ends where its indentation does")
HABIT("elseif", "write elif TEST")
HABIT("elsif", "write elif TEST")
HABIT("const", LET)
HABIT("var", LET)
HABIT("local", LET)
HABIT("def", FUNCTION)
HABIT("function", FUNCTION)
HABIT("fn", FUNCTION)
HABIT("lambda", "a function of its own is written func(x) x*2")
HABIT("int", TYPE "; whole numbers are floor(x)")
HABIT("float", TYPE)
HABIT("double", TYPE)
HABIT("bool", TYPE)
HABIT("auto", TYPE)
HABIT("str", "a text of several parts is written with semicolons: 'x=';x")
HABIT("string", "a text of several parts is written with semicolons: 'x=';x")
HABIT("format", "a text of several parts is written with semicolons: 'x=';x")
HABIT("PI", "did you mean 'pi'? sin, cos and tan take turns, not radians")
HABIT("Pi", "did you mean 'pi'? sin, cos and tan take turns, not radians")
HABIT("M_PI", "did you mean 'pi'? sin, cos and tan take turns, not radians")
HABIT("TAU", "did you mean 'tau'? sin, cos and tan take turns, not radians")
HABIT("radians", TURNS)
HABIT("degrees", TURNS)
HABIT("random", RANDOM)
HABIT("rand", RANDOM)
HABIT("randint", RANDOM)
HABIT("pow", "a power is written x**2")
HABIT("fabs", "did you mean 'abs'?")
HABIT("atan", "the angle of a direction, in turns, is angle(x;y)")
HABIT("atan2", "the angle of a direction, in turns, is angle(x;y)")
HABIT("mod", "the remainder is x % y")
HABIT("fmod", "the remainder is x % y")
HABIT("lerp", "from a to b along t is map(t, a, b)")
HABIT("mix", "from a to b along t is map(t, a, b)")
HABIT("append", VECTOR)
HABIT("push", VECTOR)
HABIT("math", "functions stand alone: sin(x)")
HABIT("Math", "functions stand alone: sin(x)")
HABIT("rgb", COLOUR "(255;128;0)/255")
HABIT("rgba", COLOUR "(255;128;0)/255")
HABIT("white", COLOUR "white is 1")
HABIT("black", COLOUR "black is 0")
HABIT("gray", COLOUR "grey is 0.5")
HABIT("grey", COLOUR "grey is 0.5")
HABIT("red", COLOUR "red is 1;0;0")
HABIT("green", COLOUR "green is 0;1;0")
HABIT("blue", COLOUR "blue is 0;0;1")
HABIT("yellow", COLOUR "yellow is 1;1;0")
HABIT("cyan", COLOUR "cyan is 0;1;1")
HABIT("magenta", COLOUR "magenta is 1;0;1")
HABIT("orange", COLOUR "orange is 1;0.5;0")
// clang-format on

#undef HABIT
#undef NULL_IS
#undef TYPE
#undef COLOUR
#undef SEE
#undef LET
#undef FUNCTION
#undef RANDOM
#undef TURNS
#undef VECTOR
