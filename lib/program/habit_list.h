// habit_list.h: names of other languages that Flitter does not have, and what it has instead (scope.c).
//
// HABIT("NAME NAME", "hint"): spaces part the names.
// clang-format off
#define TYPE "values have no types: let x=5"
#define COLOUR "a colour is r;g;b, each from 0 to 1: "

HABIT("range", "the numbers from 0 to 9 are ..10, those from 2 to 9 are 2..10")
HABIT("None nil NULL Null nullptr undefined", "did you mean 'null'?")
HABIT("True TRUE", "did you mean 'true'?")
HABIT("False FALSE", "did you mean 'false'?")
HABIT("print println printf echo puts console", "to see a value write debug(value)")
HABIT("return", "the last line of a function is its value: leave return away")
HABIT("while", "there is no while: for i in ..10 repeats, if tests, and a !counter goes on from frame to frame")
HABIT("break", "a loop has no break: choose with if what it makes")
HABIT("continue", "a loop has no continue: choose with if what it makes")
HABIT("pass", "a block that does nothing is left out, with the line above it")
HABIT("end", "a block ends where its indentation does")
HABIT("elseif elsif", "write elif TEST")
HABIT("const var local", "to name a value write let x=5")
HABIT("def function fn", "a function is written func f(x), with its value below, indented")
HABIT("lambda", "a function of its own is written func(x) x*2")
HABIT("int", TYPE "; whole numbers are floor(x)")
HABIT("float double bool auto", TYPE)
HABIT("str string format", "a text of several parts is written with semicolons: 'x=';x")
HABIT("PI Pi M_PI", "did you mean 'pi'? sin, cos and tan take turns, not radians")
HABIT("TAU", "did you mean 'tau'? sin, cos and tan take turns, not radians")
HABIT("radians degrees", "angles are in turns: 90deg is 0.25")
HABIT("random rand randint", "random numbers are uniform(:name), from 0 to 1: uniform(:name)[0] is the first")
HABIT("pow", "a power is written x**2")
HABIT("fabs", "did you mean 'abs'?")
HABIT("atan atan2", "the angle of a direction, in turns, is angle(x;y)")
HABIT("mod fmod", "the remainder is x % y")
HABIT("lerp mix", "from a to b along t is map(t, a, b)")
HABIT("append push", "vectors are joined with semicolons: v;x")
HABIT("math Math", "functions stand alone: sin(x)")
HABIT("rgb rgba", COLOUR "(255;128;0)/255")
HABIT("white", COLOUR "white is 1")
HABIT("black", COLOUR "black is 0")
HABIT("gray grey", COLOUR "grey is 0.5")
HABIT("red", COLOUR "red is 1;0;0")
HABIT("green", COLOUR "green is 0;1;0")
HABIT("blue", COLOUR "blue is 0;0;1")
HABIT("yellow", COLOUR "yellow is 1;1;0")
HABIT("cyan", COLOUR "cyan is 0;1;1")
HABIT("magenta", COLOUR "magenta is 1;0;1")
HABIT("orange", COLOUR "orange is 1;0.5;0")
// clang-format on

#undef HABIT
#undef TYPE
#undef COLOUR
