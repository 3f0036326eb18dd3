// synonym_list.h: names that other programs have for kinds of nodes, for suggestions, help and the manual's search. A
// kind has at most one row.
//
// SYNONYM("NAME NAME", "kind")
// clang-format off
SYNONYM("ball body disc_body point_mass", "particle")
SYNONYM("pin fixed_point", "anchor")
SYNONYM("spring rod joint link rope", "distance")
SYNONYM("wall floor ground plane border boundary", "barrier")
SYNONYM("friction damping viscosity", "drag")
SYNONYM("acceleration wind", "constant")
SYNONYM("attraction", "gravity")
SYNONYM("coulomb magnet repulsion", "electrostatic")
SYNONYM("brownian thermostat", "random")
SYNONYM("circle disc disk dot oval", "ellipse")
SYNONYM("rectangle square background backdrop", "rect")
SYNONYM("polyline segment", "line")
SYNONYM("polygon", "path")
SYNONYM("label string", "text")
SYNONYM("picture img", "image")
SYNONYM("bezier", "curve_to")
SYNONYM("mouse cursor touch click", "pointer")
SYNONYM("keyboard keypress", "key")
SYNONYM("glow", "bloom")
SYNONYM("mesh", "model")
// clang-format on
#undef SYNONYM
