// name_hint_list.h: hints for unbound names that exist in other languages (scope.c).
//
// HINT("NAME NAME", "hint"): the names, separated by spaces, that get the hint.
// clang-format off
#define TYPE "remove the type: let x=5"
#define COLOUR "a colour is r;g;b, each from 0 to 1: "

HINT("range", "write '..10' for the numbers from 0 to 9, '2..10' for those from 2 to 9")
HINT("None nil NULL Null nullptr undefined", "did you mean 'null'?")
HINT("True TRUE", "did you mean 'true'?")
HINT("False FALSE", "did you mean 'false'?")
HINT("print println printf echo puts console", "write 'debug(value)' to print a value")
HINT("return", "remove 'return'; a function returns the values of its lines")
HINT("while", "use 'for i in ..10' to repeat, 'if' to test, or a !counter to count from frame to frame")
HINT("break", "use 'if' to select what a loop creates; there is no 'break'")
HINT("continue", "use 'if' to select what a loop creates; there is no 'continue'")
HINT("pass", "remove the empty block and the line above it")
HINT("end", "remove 'end'; a block ends with its indentation")
HINT("elseif elsif", "write 'elif TEST'")
HINT("const var local", "write 'let x=5' to name a value")
HINT("def function fn", "write 'func f(x)' with its value indented below")
HINT("lambda", "write 'func(x) x*2' for an anonymous function")
HINT("int", TYPE "; to get a whole number, write 'floor(x)'")
HINT("float double bool auto", TYPE)
HINT("str string format", "join strings and values with semicolons: 'x=';x")
HINT("PI Pi M_PI", "did you mean 'pi'? sin, cos and tan take turns, not radians")
HINT("TAU", "did you mean 'tau'? sin, cos and tan take turns, not radians")
HINT("radians degrees", "write angles in turns: 90deg is 0.25")
HINT("random rand randint", "use 'uniform(:name)' for random numbers from 0 to 1; 'uniform(:name)[0]' is the first")
HINT("pow", "write 'x**2' for a power")
HINT("fabs", "did you mean 'abs'?")
HINT("atan atan2", "use 'angle(x;y)' for the angle of a direction, in turns")
HINT("mod fmod", "write 'x % y' for the remainder")
HINT("lerp mix", "use 'map(t, a, b)' to interpolate from a to b")
HINT("append push", "join vectors with semicolons: v;x")
HINT("math Math", "write functions without a prefix: sin(x)")
HINT("rgb rgba", COLOUR "(255;128;0)/255")
// clang-format on

#undef HINT
#undef TYPE
#undef COLOUR
