// angle_list.h: the built-in functions that take angles (lint_angles.c).
//
// ANGLE(function, argument, first): the argument of this number, from 0, consists of angles in turns. If `first` is
// true, only its first element is an angle.
// clang-format off
ANGLE(cos, 0, false)
ANGLE(hsl, 0, true)
ANGLE(hsv, 0, true)
ANGLE(polar, 0, false)
ANGLE(quaternion, 1, false)
ANGLE(sin, 0, false)
ANGLE(tan, 0, false)
// clang-format on
#undef ANGLE
