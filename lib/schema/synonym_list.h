// synonym_list.h: names that other programs have for kinds of nodes, for suggestions (reports.c).
//
// SYNONYM("NAME NAME", "kind")
// clang-format off
SYNONYM("ball body disc_body point_mass", "particle")
SYNONYM("pin fixed_point", "anchor")
SYNONYM("spring rod joint link", "distance")
SYNONYM("wall floor ground plane", "barrier")
SYNONYM("friction damping", "drag")
SYNONYM("acceleration wind", "constant")
SYNONYM("circle disc disk oval", "ellipse")
SYNONYM("rectangle square background", "rect")
SYNONYM("polyline segment", "line")
SYNONYM("polygon", "path")
SYNONYM("label string", "text")
SYNONYM("picture img", "image")
SYNONYM("bezier", "curve_to")
// clang-format on
#undef SYNONYM
