// schema_list.h: all kinds of nodes that petri interprets, and their attributes. The table drives reading, error
// messages, help and tests; defaults and limits are defined only here.
//
// TYPE(ID, SHAPE, low, high, required, "expected value in words"): how an attribute is read (AttrShape of table.h).
//     In systems, numbers outside the limits are clamped. In drawings they are malformed, and a node is omitted if such
//     a number is in a required attribute.
// NODE(ID, "kind", PLACE, CHILDREN, "help"), followed by its attributes. PLACE is where the node is allowed, CHILDREN
//     which nodes are allowed in it (PlaceKind).
// FORCE(ID, "kind", "help", "formula"): a NODE for the force with the same ID in force_list.h. The formula has the same
//     lines as in lib/physics/README.md; tests/docs/formulas.sh compares them.
// SHAPE(ID, name, "help"): a NODE for a drawing that adds to a path. lib/picture has a function add_NAME.
// COMMAND(ID, name, "help"): a NODE for another drawing without children. lib/picture has a function add_NAME.
// SOURCE(ID, name, CHILDREN, "help"): a NODE for a paint source. lib/picture has a function add_NAME.
// FILTER(ID, name, writer, CHILDREN, inputs, "help"): a NODE FILTER_ID for a filter. Its children are at most 1 filter,
//     or exactly 2. lib/picture has functions apply_NAME and write_WRITER. petri-display-list.inc has a row ID.
// EFFECT(ID, name, "help"): a NODE for a path effect. lib/picture has functions write_NAME and apply_NAME.
//     petri-display-list.inc has a row ID.
// PICTURE_EFFECT(ID, name, scalable, "help"): a NODE for an effect on pictures, with a shader of this name and a row
//     effect_NAME in lib/gl. `scalable` is true if a result of lower resolution looks similar.
// ATTR(KIND, NAME, TYPE, field, default, "unit", "help"). In scripts, NAME is written in lower case: attr_names.awk
//     derives the names from these rows. The value is stored in the field (records.h). If the field is NOWHERE, the
//     value is ignored or, in drawings, looked up by name. The default is IS(x), DESCRIBED(x, "in words"),
//     INHERITED(x, "in words") with the initial value x, or NONE: NaN for a number, else null. For a vector, x is the
//     last element, and the others are 0.
// ALIAS(KIND, NAME, OF, "of", TYPE, field, "unit"): another name for attribute OF of the same kind. If a node has both
//     attributes, OF takes precedence.
// clang-format off
#ifndef TYPE
#define TYPE(id, shape, low, high, required, text)
#endif
#ifndef NODE
#define NODE(id, text, place, children, help)
#endif
#ifndef FORCE
#define FORCE(id, text, help, formula) NODE(id, text, PHYSICS, NOTHING, help)
#endif
#ifndef SHAPE
#define SHAPE(id, name, help) NODE(id, #name, DRAWING, NOTHING, help)
#endif
#ifndef COMMAND
#define COMMAND(id, name, help) NODE(id, #name, DRAWING, NOTHING, help)
#endif
#ifndef SOURCE
#define SOURCE(id, name, children, help) NODE(id, #name, SOURCE, children, help)
#endif
#ifndef FILTER
#define FILTER(id, name, writer, children, inputs, help) NODE(FILTER_##id, #name, FILTER, children, help)
#endif
#ifndef EFFECT
#define EFFECT(id, name, help) NODE(id, #name, EFFECT, EFFECT, help)
#endif
#ifndef PICTURE_EFFECT
#define PICTURE_EFFECT(id, name, scalable, help) NODE(id, #name, PICTURE, PICTURES, help)
#endif
#ifndef ATTR
#define ATTR(kind, name, type, field, default_value, unit, help)
#endif
#ifndef ALIAS
#define ALIAS(kind, name, of, of_text, type, field, unit) ATTR(kind, name, type, field, NONE, unit, "")
#endif

// Types of systems. Infinities are valid numbers, NaN is not.
TYPE(ANY, VALUE, 0, 0, false, "any value")
TYPE(ID, VALUE, 0, 0, false, "id of a particle")
TYPE(NUMBERS, NUMBERS, 0, 0, false, "any numbers")
TYPE(NUMBER, NUMBER, -INFINITY, INFINITY, false, "number")
TYPE(ABOVE_ZERO, NUMBER, -INFINITY, INFINITY, false, "number above 0")  // other numbers are allowed and have a special meaning
TYPE(FROM_ZERO, NUMBER, 0, INFINITY, false, "number, 0 or more")
TYPE(PART, NUMBER, 0, 1, false, "number from 0 to 1")
TYPE(OPENING, NUMBER, 0, 1.5, false, "number from 0 to 1.5")
TYPE(INTEGER, INTEGER, -INFINITY, INFINITY, false, "whole number")
TYPE(DIMENSIONS, INTEGER, -INFINITY, INFINITY, false, "whole number, 1 or more")
TYPE(TIME, TIME, -INFINITY, INFINITY, false, "number")
TYPE(VECTOR, VECTOR, 0, 0, false, "vector")
TYPE(NORMAL, NORMAL, 0, 0, false, "vector")
// Types of drawings. Numbers are finite.
TYPE(FINITE, FINITE, -INFINITY, INFINITY, true, "number")
TYPE(WIDTH, FINITE, 0, INFINITY, false, "number, 0 or more")
TYPE(POINT, PAIR, -INFINITY, INFINITY, true, "x;y")
TYPE(SIZE, PAIR, 0, INFINITY, true, "one number or two, each 0 or more")
TYPE(SCALE, PAIR, -INFINITY, INFINITY, true, "one number or two")
TYPE(POINTS, POINTS, 0, 0, true, "x;y;x;y…")
TYPE(COLOR, COLOR, -INFINITY, INFINITY, false, "grey, r;g;b or r;g;b;a, each from 0 to 1")
TYPE(FLAG, FLAG, 0, 0, false, "true or false")
TYPE(TEXT, TEXT, 0, 0, false, "text")
TYPE(WEIGHT, WEIGHT, 0, 1000, false, "0 to 1000, or a word such as :bold")
TYPE(JOIN, WORD, 0, 0, false, ":miter, :round or :bevel")
TYPE(CAP, WORD, 0, 0, false, ":butt, :round or :square")
TYPE(FILL_TYPE, WORD, 0, 0, false, ":winding, :even_odd, :inverse_winding or :inverse_even_odd")
TYPE(SLANT, WORD, 0, 0, false, ":upright, :oblique or :italic")
TYPE(FONT_WIDTH, WORD, 0, 0, false, "a word such as :condensed")
TYPE(COMPOSITE, WORD, 0, 0, false, "a word such as :over, :add, :multiply or :dst_out")
// Types of pictures.
TYPE(AMOUNT, FINITE, -INFINITY, INFINITY, false, "number")
TYPE(FINITE_INTEGER, FINITE, -1e9, 1e9, false, "whole number")
TYPE(AMOUNTS, PAIR, -INFINITY, INFINITY, false, "one number or two")
TYPE(TRIPLE, TRIPLE, -INFINITY, INFINITY, false, "one number or three")
TYPE(QUAD, QUAD, -INFINITY, INFINITY, false, "one number or four")
TYPE(LIST, LIST, -INFINITY, INFINITY, false, "numbers")
// The limits of these lists are the minimum and maximum number of elements.
TYPE(FIVE, LIST, 5, 5, false, "five numbers")
TYPE(NINE, LIST, 9, 9, false, "nine numbers")
TYPE(TWENTY, LIST, 20, 20, false, "twenty numbers")
TYPE(NOISE_TYPE, WORD, 0, 0, false, ":fractal, :turbulence or :improved")
TYPE(SEED, SEED, 0, 0, false, "any value")
TYPE(MIX, WORD, 0, 0, false, ":over, :dest_over, :lighten, :darken, :add, :difference or :multiply")
TYPE(TONEMAP, WORD, 0, 0, false, ":reinhard, :aces, :agx or :agx_punchy")
TYPE(CRF, FINITE, 0, 63, false, "number from 0 to 63")
TYPE(CODEC, WORD, 0, 0, false, ":h264, :hevc, :vp8, :vp9, :av1, :theora, :prores or :gif")
TYPE(PIXFMT, WORD, 0, 0, false, "a word such as :yuv420p, :yuv422p, :yuv444p, :yuv420p10le or :yuv422p10le")
TYPE(PRESET, WORD, 0, 0, false, "a word from :ultrafast to :veryslow, such as :medium")
TYPE(PROFILE, WORD, 0, 0, false, "a word such as :baseline, :main or :high")
TYPE(FADE, WORD, 0, 0, false, ":linear, :quad or :cubic")
TYPE(FLIP, WORD, 0, 0, false, ":horizontal, :vertical or :both")
TYPE(NOISE_SHAPE, WORD, 0, 0, false, ":plane, :cylinder or :sphere")
// Types of 3-D scenes.
TYPE(FACE, WORD, 0, 0, false, ":back or :front")
TYPE(MIX3D, WORD, 0, 0, false, ":over, :source, :dest, :dest_over, :add, :subtract, :lighten or :darken")
TYPE(FOV_REF, WORD, 0, 0, false, ":horizontal, :vertical, :diagonal, :wide or :narrow")
TYPE(UV_MAP, WORD, 0, 0, false, ":standard or :repeat")
TYPE(UV_REMAP, WORD, 0, 0, false, ":sphere, :plane or :book")
TYPE(FUNCTION, FUNCTION, 0, 0, false, "a function")

#define STRENGTH_ROW(kind) \
    ATTR(kind, STRENGTH, NUMBER, TO_FORCE(force.strength), IS(1), "", "factor for the force")
#define EASE_ROW(kind) \
    ATTR(kind, EASE, NUMBER, TO_FORCE(force.ease), IS(0), "", "time that the strength takes to grow from 0 to its full value after the system starts")
#define POWER_ROW(kind) \
    ATTR(kind, POWER, FROM_ZERO, TO_FORCE(force.power), IS(1), "", "exponent in the formula; 1 gives a linear spring")
#define REACH_ROW(kind) \
    ATTR(kind, MAX_DISTANCE, ABOVE_ZERO, TO_FORCE(force.max_distance), DESCRIBED(0, ""), "", "distance beyond which the force is 0")
#define THETA_ROW(kind) \
    ATTR(kind, THETA, OPENING, TO_FORCE(force.theta), DESCRIBED(0, ""), "", "opening angle of the far field, which approximates distant particles; with 0, all pairs are computed")
#define BOUND_ROWS(kind) \
    ATTR(kind, FIXED, NUMBER, TO_FORCE(fixed), NONE, "", "sets both minimum and maximum, and takes precedence over them") \
    ATTR(kind, MINIMUM, NUMBER, TO_FORCE(force.minimum), NONE, "", "distance below which the force pushes") \
    ALIAS(kind, MIN, MINIMUM, "minimum", NUMBER, TO_FORCE(force.minimum), "") \
    ATTR(kind, MAXIMUM, NUMBER, TO_FORCE(force.maximum), NONE, "", "distance above which the force pulls") \
    ALIAS(kind, MAX, MAXIMUM, "maximum", NUMBER, TO_FORCE(force.maximum), "")

NODE(PHYSICS, "physics", SCENE, PHYSICS, "a particle system")
ATTR(PHYSICS, STATE, ANY, TO_SYSTEM(state), NONE, "", "state key of the particles: $(key;id) is a position, $(key;id;:velocity) a velocity")
ATTR(PHYSICS, DIMENSIONS, DIMENSIONS, TO_SYSTEM(dimensions), DESCRIBED(0, ""), "", "number of components of each vector")
ATTR(PHYSICS, TIME, TIME, TO_SYSTEM(time), DESCRIBED(0, "the frame's time in seconds"), "", "the clock to follow, such as beat")
ATTR(PHYSICS, RESOLUTION, ABOVE_ZERO, TO_SYSTEM(resolution), DESCRIBED(0, "1/fps"), "units of time", "longest simulation step")
ATTR(PHYSICS, RUN, INTEGER, TO_SYSTEM(run), IS(0), "", "the system restarts when this number changes")
ATTR(PHYSICS, SPEED_OF_LIGHT, NUMBER, TO_SYSTEM(speed_of_light), DESCRIBED(0, ""), "", "maximum speed; with 0 or less, there is no limit")

NODE(PARTICLE, "particle", PHYSICS, NOTHING, "a particle; its position and velocity attributes are only initial values")
ATTR(PARTICLE, ID, ANY, TO_BODY(id), NONE, "", "unique in its system; a particle without an id is ignored")
ATTR(PARTICLE, POSITION, VECTOR, TO_BODY(numbers.position), IS(0), "", "initial position")
ATTR(PARTICLE, VELOCITY, VECTOR, TO_BODY(numbers.velocity), IS(0), "length per unit of time", "initial velocity")
ATTR(PARTICLE, FORCE, VECTOR, TO_BODY(numbers.force), IS(0), "", "a force on this particle alone")
ATTR(PARTICLE, EASE, NUMBER, TO_BODY(numbers.ease), IS(0), "", "time that the force takes to grow from 0 to its full value after the system starts")
ATTR(PARTICLE, RADIUS, FROM_ZERO, TO_BODY(numbers.radius), IS(0), "", "if 0, there are no collisions, adhesion, drag or buoyancy")
ATTR(PARTICLE, MASS, FROM_ZERO, TO_BODY(numbers.mass), IS(1), "", "if 0, the particle is never accelerated")
ATTR(PARTICLE, CHARGE, NUMBER, TO_BODY(numbers.charge), IS(0), "", "electric charge, which !electrostatic and !field use")

NODE(ANCHOR, "anchor", PHYSICS, NOTHING, "a particle that no force moves; it stays at its position attribute")
ATTR(ANCHOR, ID, ANY, TO_BODY(id), NONE, "", "unique in its system; an anchor without an id is ignored")
ATTR(ANCHOR, POSITION, VECTOR, TO_BODY(numbers.position), IS(0), "", "its position in every frame")
ATTR(ANCHOR, VELOCITY, VECTOR, NOWHERE, IS(0), "", "ignored, because anchors are at rest")
ATTR(ANCHOR, FORCE, VECTOR, NOWHERE, IS(0), "", "ignored, because no force moves an anchor")
ATTR(ANCHOR, EASE, NUMBER, NOWHERE, IS(0), "", "ignored, because no force moves an anchor")
ATTR(ANCHOR, RADIUS, FROM_ZERO, TO_BODY(numbers.radius), IS(0), "", "if 0, there are no collisions, adhesion, drag or buoyancy")
ATTR(ANCHOR, MASS, FROM_ZERO, TO_BODY(numbers.mass), IS(1), "", "if 0, !gravity ignores the anchor")
ATTR(ANCHOR, CHARGE, NUMBER, TO_BODY(numbers.charge), IS(0), "", "electric charge, which !electrostatic and !field use")

NODE(GROUP, "group", PHYSICS, PHYSICS, "a group; except for !distance, its forces act only inside it, and none act between sibling groups")

FORCE(CONSTANT, "constant", "the same force or acceleration for all particles",
    "F = (force + acceleration · m) · strength")
ATTR(CONSTANT, FORCE, VECTOR, TO_FORCE(force.vector), IS(0), "", "force on each particle")
ATTR(CONSTANT, ACCELERATION, VECTOR, TO_FORCE(force.vector2), IS(0), "", "acceleration of each particle, added to the force")
STRENGTH_ROW(CONSTANT)
EASE_ROW(CONSTANT)

FORCE(RANDOM, "random", "a random force on each particle",
    "F = strength · normal(state;run;iteration)[i]")
ATTR(RANDOM, STRENGTH, NUMBER, TO_FORCE(force.strength), IS(1), "", "standard deviation of each component of the force")
EASE_ROW(RANDOM)

FORCE(FIELD, "field", "a force on each particle, proportional to its charge",
    "F = strength · direction · q")
ATTR(FIELD, DIRECTION, VECTOR, TO_FORCE(force.vector), IS(0), "", "force on a charge of 1")
STRENGTH_ROW(FIELD)
EASE_ROW(FIELD)

FORCE(DISTANCE, "distance", "a spring between two particles",
    "F = strength · (min − l)^power if l < min\nF = −strength · (l − max)^power if l > max\nF = 0")
ATTR(DISTANCE, FROM, ID, TO_FORCE(from), NONE, "", "one end of the spring")
ATTR(DISTANCE, TO, ID, TO_FORCE(to), NONE, "", "the other end of the spring")
BOUND_ROWS(DISTANCE)
POWER_ROW(DISTANCE)
STRENGTH_ROW(DISTANCE)
EASE_ROW(DISTANCE)

FORCE(COLLISION, "collision", "particles that overlap push each other away",
    "F = strength · (r₁ + r₂ − l)^power if l < r₁ + r₂\nF = 0")
POWER_ROW(COLLISION)
STRENGTH_ROW(COLLISION)
EASE_ROW(COLLISION)
REACH_ROW(COLLISION)

FORCE(GRAVITY, "gravity", "masses attract each other",
    "D = max(l, r₁ + r₂)\nF = −strength · m₁ · m₂ / D² if max_distance ≤ 0 or l < max_distance\nF = 0")
STRENGTH_ROW(GRAVITY)
EASE_ROW(GRAVITY)
REACH_ROW(GRAVITY)
THETA_ROW(GRAVITY)

FORCE(ELECTROSTATIC, "electrostatic", "like charges repel each other, opposite charges attract each other",
    "D = max(l, r₁ + r₂)\nF = strength · q₁ · q₂ / D² if max_distance ≤ 0 or l < max_distance\nF = 0")
STRENGTH_ROW(ELECTROSTATIC)
EASE_ROW(ELECTROSTATIC)
REACH_ROW(ELECTROSTATIC)
THETA_ROW(ELECTROSTATIC)

FORCE(ADHESION, "adhesion", "particles that touch stick together",
    "o = r₁ + r₂ − l\na = |r₁ − r₂|·overlap + (r₁ + r₂)·(1 − overlap)\nF = −strength · o · (l − a) if l < r₁ + r₂\nF = 0")
ATTR(ADHESION, OVERLAP, PART, TO_FORCE(force.overlap), IS(0.25), "", "overlap below which particles attract and above which they repel: 0 if they just touch, 1 if one is inside the other")
STRENGTH_ROW(ADHESION)
EASE_ROW(ADHESION)
REACH_ROW(ADHESION)

FORCE(DRAG, "drag", "friction in a medium that can flow",
    "c = min(strength · |v − flow| · r^(n − 1), m/δ)\nF = −(v − flow) · c")
ATTR(DRAG, FLOW, VECTOR, TO_FORCE(force.vector), IS(0), "", "velocity of the medium")
STRENGTH_ROW(DRAG)
EASE_ROW(DRAG)

FORCE(BUOYANCY, "buoyancy", "weight and buoyancy in a medium",
    "F = strength · gravity · (m − density·r^n)")
ATTR(BUOYANCY, GRAVITY, VECTOR, TO_FORCE(force.vector), DESCRIBED(-1, "0;...;0;-1"), "", "acceleration of free fall in a vacuum")
ATTR(BUOYANCY, DENSITY, NUMBER, TO_FORCE(force.density), IS(1), "", "mass of the medium that a particle of radius 1 displaces")
STRENGTH_ROW(BUOYANCY)
EASE_ROW(BUOYANCY)

FORCE(BARRIER, "barrier", "a wall that reflects particles",
    "F = strength · (min − s)^power if 0 ≤ s and s < min\nF = −strength · (s − max)^power if s > max\nF = 0")
ATTR(BARRIER, POSITION, VECTOR, TO_FORCE(force.vector), IS(0), "", "a point on the wall")
ATTR(BARRIER, NORMAL, NORMAL, TO_FORCE(force.vector2), IS(0), "", "vector that points away from the wall, of any length except 0; required")
ATTR(BARRIER, RESTITUTION, PART, TO_FORCE(force.restitution), IS(1), "", "fraction of the speed that remains after a bounce")
BOUND_ROWS(BARRIER)
POWER_ROW(BARRIER)
STRENGTH_ROW(BARRIER)
EASE_ROW(BARRIER)

NODE(COUNTER, "counter", SCENE, NOTHING, "a clock with its own rate, whose value is written to the state")
ATTR(COUNTER, STATE, ANY, TO_COUNTER(state), NONE, "", "state key to which the value is written")
ATTR(COUNTER, INITIAL, NUMBERS, TO_COUNTER(initial), IS(0), "", "value at the start, and while reset is true")
ATTR(COUNTER, RATE, NUMBERS, TO_COUNTER(rate), IS(0), "", "growth per unit of time")
ATTR(COUNTER, TIME, NUMBERS, TO_COUNTER(time), DESCRIBED(0, "the frame's time in seconds"), "", "the clock to follow, such as beat")
ATTR(COUNTER, MINIMUM, NUMBERS, TO_COUNTER(minimum), NONE, "", "smallest value")
ALIAS(COUNTER, MIN, MINIMUM, "minimum", NUMBERS, TO_COUNTER(minimum), "")
ATTR(COUNTER, MAXIMUM, NUMBERS, TO_COUNTER(maximum), NONE, "", "largest value")
ALIAS(COUNTER, MAX, MAXIMUM, "maximum", NUMBERS, TO_COUNTER(maximum), "")
ATTR(COUNTER, RESET, NUMBERS, TO_COUNTER(reset), NONE, "", "if true, the value is reset to the initial value")

#define TRANSFORM_ROWS(kind) \
    ATTR(kind, TRANSLATE, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "move the origin; translate, scale and rotate apply in the order in which they are written") \
    ATTR(kind, SCALE, SCALE, NOWHERE, DESCRIBED(1, "1;1"), "", "scale factors along x and y") \
    ATTR(kind, ROTATE, FINITE, NOWHERE, IS(0), "turns", "rotation, clockwise")
#define PAINT_ROWS(kind) \
    ATTR(kind, COLOR, COLOR, TO_GRAPHICS(color), INHERITED(0, "0"), "", "colour; it replaces an inherited source, such as a gradient") \
    ATTR(kind, STROKE_WIDTH, WIDTH, TO_GRAPHICS(stroke_width), INHERITED(0, "0"), "", "width of lines; 0 means one pixel at any scale") \
    ATTR(kind, STROKE_JOIN, JOIN, TO_GRAPHICS(join), INHERITED(JOIN_MITER, ":miter"), "", "shape of line corners") \
    ATTR(kind, STROKE_CAP, CAP, TO_GRAPHICS(cap), INHERITED(CAP_BUTT, ":butt"), "", "shape of line ends") \
    ATTR(kind, COMPOSITE, COMPOSITE, TO_GRAPHICS(composite), INHERITED(COMPOSITE_OVER, ":over"), "", "how colours are combined with those already drawn") \
    ATTR(kind, ANTIALIAS, FLAG, TO_GRAPHICS(antialias), INHERITED(true, "true"), "", "smooth the edges of shapes; text is always smooth") \
    ATTR(kind, DITHER, FLAG, NOWHERE, IS(false), "", "ignored")
#define FONT_ROWS(kind) \
    ATTR(kind, FONT_FAMILY, TEXT, TO_GRAPHICS(family), INHERITED_TEXT("Helvetica"), "", "one or more font names, separated by commas; the first available font is used") \
    ATTR(kind, FONT_SIZE, WIDTH, TO_GRAPHICS(font_size), INHERITED(20, "20"), "", "") \
    ATTR(kind, FONT_WEIGHT, WEIGHT, TO_GRAPHICS(weight), INHERITED(400, ":normal"), "", "") \
    ATTR(kind, FONT_WIDTH, FONT_WIDTH, TO_GRAPHICS(width), INHERITED(4, ":normal"), "", "") \
    ATTR(kind, FONT_SLANT, SLANT, TO_GRAPHICS(slant), INHERITED(SLANT_UPRIGHT, ":upright"), "", "")
#define SHAPE_ROWS(kind) \
    ATTR(kind, FILL, FLAG, NOWHERE, IS(false), "", "fill the shape, without changing the current path") \
    ATTR(kind, STROKE, FLAG, NOWHERE, IS(false), "", "draw the outline, without changing the current path")

#include "schema/pictures_list.h"

NODE(CANVAS, "canvas", PICTURE, DRAWING, "a drawing surface: origin at the top left, y down, angles in turns")
SOURCE_ROWS(CANVAS)
ATTR(CANVAS, LINEAR, FLAG, NOWHERE, IS(false), "", "colours are given and combined in linear light")
ATTR(CANVAS, COLORBITS, FINITE_INTEGER, NOWHERE, IS(8), "", "bits per channel if linear=true: 8, 16 or 32; values above 1 (HDR) need 16 or 32")
TRANSFORM_ROWS(CANVAS)
PAINT_ROWS(CANVAS)
FONT_ROWS(CANVAS)

NODE(CANVAS_GROUP, "group", DRAWING, DRAWING, "a group; its attributes and clips apply only to the nodes inside")
ATTR(CANVAS_GROUP, FILL_TYPE, FILL_TYPE, NOWHERE, DESCRIBED(FILL_WINDING, ":winding"), "", "fill rule of the path that begins with this group")
TRANSFORM_ROWS(CANVAS_GROUP)
PAINT_ROWS(CANVAS_GROUP)
FONT_ROWS(CANVAS_GROUP)

NODE(TRANSFORM, "transform", DRAWING, DRAWING, "move, scale and rotate the nodes inside")
TRANSFORM_ROWS(TRANSFORM)

NODE(PAINT, "paint", DRAWING, DRAWING, "colour and line style for the nodes inside")
PAINT_ROWS(PAINT)

NODE(FONT, "font", DRAWING, DRAWING, "font for the nodes inside")
FONT_ROWS(FONT)
ALIAS(FONT, FAMILY, FONT_FAMILY, "font_family", TEXT, TO_GRAPHICS(family), "")
ALIAS(FONT, SIZE, FONT_SIZE, "font_size", WIDTH, TO_GRAPHICS(font_size), "")
ALIAS(FONT, WEIGHT, FONT_WEIGHT, "font_weight", WEIGHT, TO_GRAPHICS(weight), "")
ALIAS(FONT, SLANT, FONT_SLANT, "font_slant", SLANT, TO_GRAPHICS(slant), "")

NODE(LAYER, "layer", DRAWING, DRAWING, "draw the nodes inside separately, then the result as one image")
ATTR(LAYER, SIZE, SIZE, NOWHERE, NONE, "", "size of the layer, to which the rest of the enclosing group is also clipped; required")
ATTR(LAYER, ORIGIN, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "top left corner of the layer, before its own translate, scale and rotate")
ATTR(LAYER, ALPHA, FINITE, NOWHERE, IS(1), "", "opacity; 0 is invisible")
TRANSFORM_ROWS(LAYER)
PAINT_ROWS(LAYER)
FONT_ROWS(LAYER)

NODE(PATH, "path", DRAWING, DRAWING, "begin a new path; the nodes inside add to it and fill or stroke it")
ATTR(PATH, FILL_TYPE, FILL_TYPE, NOWHERE, DESCRIBED(FILL_WINDING, ":winding"), "", "fill rule where the path crosses itself; inverse rules swap inside and outside")

SHAPE(MOVE_TO, move_to, "begin another subpath")
ATTR(MOVE_TO, POINT, POINT, NOWHERE, NONE, "", "start of the subpath")

SHAPE(LINE_TO, line_to, "a straight line from the end of the path, or from 0;0 if the path is empty")
ATTR(LINE_TO, POINT, POINT, NOWHERE, NONE, "", "end of the line")

SHAPE(CURVE_TO, curve_to, "a Bézier curve from the end of the path, or from 0;0 if the path is empty")
ATTR(CURVE_TO, POINT, POINT, NOWHERE, NONE, "", "end of the curve")
ATTR(CURVE_TO, C1, POINT, NOWHERE, NONE, "", "control point, or the first of two if c2 is set; required")
ATTR(CURVE_TO, C2, POINT, NOWHERE, NONE, "", "second control point, for a cubic curve")

SHAPE(ARC, arc, "an arc of an ellipse, joined to the path by a line")
ATTR(ARC, POINT, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "centre")
ATTR(ARC, RADIUS, SIZE, NOWHERE, NONE, "", "one radius, or the radii along x and y")
ATTR(ARC, START, FINITE, NOWHERE, IS(0), "turns", "start angle, clockwise from the x axis")
ATTR(ARC, SWEEP, FINITE, NOWHERE, DESCRIBED(NAN, "end - start"), "turns", "angle of the arc, modulo 1; sweep or end is required")
ATTR(ARC, END, FINITE, NOWHERE, NONE, "turns", "end angle; ignored if sweep is set")
ATTR(ARC, MOVE_TO, FLAG, NOWHERE, IS(false), "", "begin another subpath instead of drawing a line to the arc")

SHAPE(ARC_TO, arc_to, "an arc of an ellipse from the end of the path, or from 0;0 if the path is empty")
ATTR(ARC_TO, POINT, POINT, NOWHERE, NONE, "", "end of the arc")
ATTR(ARC_TO, RADIUS, SIZE, NOWHERE, NONE, "", "one radius, or the radii along x and y; enlarged if the arc cannot reach the point")
ATTR(ARC_TO, ROTATION, FINITE, NOWHERE, IS(0), "degrees", "rotation of the ellipse, clockwise")
ATTR(ARC_TO, LARGE, FLAG, NOWHERE, IS(false), "", "take the longer arc")
ATTR(ARC_TO, CCW, FLAG, NOWHERE, IS(false), "", "draw the arc counter-clockwise")

SHAPE(RECT, rect, "a rectangle")
ATTR(RECT, POINT, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "a corner: the top left one unless the size is negative")
ATTR(RECT, SIZE, SCALE, NOWHERE, NONE, "", "width;height; both can be negative")
ATTR(RECT, RADIUS, SIZE, NOWHERE, IS(0), "", "radius of the corners; reduced if it does not fit")
SHAPE_ROWS(RECT)
PAINT_ROWS(RECT)

SHAPE(ELLIPSE, ellipse, "an ellipse or a circle")
ATTR(ELLIPSE, POINT, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "centre")
ATTR(ELLIPSE, RADIUS, SIZE, NOWHERE, NONE, "", "one radius, or the radii along x and y")
SHAPE_ROWS(ELLIPSE)
PAINT_ROWS(ELLIPSE)

SHAPE(LINE, line, "a line through points")
ATTR(LINE, POINTS, POINTS, NOWHERE, NONE, "", "")
ATTR(LINE, CURVE, FINITE, NOWHERE, IS(0), "turns", "corners that turn by at most this angle become curves: with 0 none, with 0.25 or more all")
ATTR(LINE, CLOSE, FLAG, NOWHERE, IS(false), "", "join the last point to the first")
SHAPE_ROWS(LINE)
PAINT_ROWS(LINE)

SHAPE(CLOSE, close, "a straight line to the start of the subpath")

COMMAND(CLIP, clip, "draw only inside the path until the group, transform or layer ends")

COMMAND(MASK, mask, "draw only outside the path until the group, transform or layer ends")

COMMAND(FILL, fill, "fill the path")
PAINT_ROWS(FILL)

COMMAND(STROKE, stroke, "draw a line along the path")
PAINT_ROWS(STROKE)

COMMAND(TEXT, text, "one line of text")
ATTR(TEXT, TEXT, TEXT, NOWHERE, NONE, "", "")
ATTR(TEXT, POINT, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "centre of the text; if center=false, start of the baseline")
ATTR(TEXT, CENTER, FLAG, NOWHERE, IS(true), "", "")
ATTR(TEXT, FILL, FLAG, NOWHERE, DESCRIBED(true, "true, unless stroke is true"), "", "fill the letters")
ATTR(TEXT, STROKE, FLAG, NOWHERE, IS(false), "", "draw the outlines of the letters")
PAINT_ROWS(TEXT)
FONT_ROWS(TEXT)

COMMAND(IMAGE, image, "an image from a PNG or JPEG file or from another node")
ATTR(IMAGE, FILENAME, TEXT, NOWHERE, NONE, "", "")
ATTR(IMAGE, IMAGE_ID, TEXT, NOWHERE, NONE, "", "id of another node, whose picture is used")
ALIAS(IMAGE, TEXTURE_ID, IMAGE_ID, "image_id", TEXT, NOWHERE, "")
ATTR(IMAGE, POINT, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "top left corner")
ATTR(IMAGE, SIZE, SCALE, NOWHERE, DESCRIBED(0, "the size of the picture"), "", "size to which the image is stretched")
ATTR(IMAGE, FIT, SIZE, NOWHERE, NONE, "", "size of a box into which the image is fitted")
ATTR(IMAGE, FILL, SIZE, NOWHERE, NONE, "", "size of a box that the image fills; the rest of the image is cut off")

SOURCE(GRADIENT, gradient, STOP, "a colour gradient for nodes drawn after it")
ATTR(GRADIENT, START, POINT, NOWHERE, NONE, "", "start of a linear gradient")
ATTR(GRADIENT, END, POINT, NOWHERE, NONE, "", "end of a linear gradient")
ATTR(GRADIENT, RADIUS, SIZE, NOWHERE, NONE, "", "radius of a radial gradient: one number, or the radii along x and y")
ATTR(GRADIENT, POINT, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "centre of a radial gradient")
ATTR(GRADIENT, ROTATE, FINITE, NOWHERE, IS(0), "turns", "rotation of a radial gradient")

NODE(STOP, "stop", STOP, NOTHING, "a colour of a gradient")
ATTR(STOP, OFFSET, FINITE, NOWHERE, DESCRIBED(NAN, "stops are spread evenly"), "", "position in the gradient, from 0 to 1")
ATTR(STOP, COLOR, COLOR, NOWHERE, DESCRIBED(0, "the current colour"), "", "")

SOURCE(COLOR, color, NOTHING, "one colour for nodes drawn after it")
ATTR(COLOR, COLOR, COLOR, NOWHERE, DESCRIBED(0, "the current colour"), "", "")

SOURCE(PATTERN, pattern, NOTHING, "an image repeated in both directions, for nodes drawn after it")
ATTR(PATTERN, FILENAME, TEXT, NOWHERE, NONE, "", "")
ATTR(PATTERN, IMAGE_ID, TEXT, NOWHERE, NONE, "", "id of another node, whose picture is used")
ALIAS(PATTERN, TEXTURE_ID, IMAGE_ID, "image_id", TEXT, NOWHERE, "")
ATTR(PATTERN, TRANSLATE, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "displacement; translate, scale and rotate apply in the order in which they are written")
ATTR(PATTERN, SCALE, SCALE, NOWHERE, DESCRIBED(1, "1;1"), "", "scale factors along x and y")
ATTR(PATTERN, ROTATE, FINITE, NOWHERE, IS(0), "turns", "rotation, clockwise")

SOURCE(BLEND, blend, SOURCE, "a mix of the two sources inside it, for nodes drawn after it")
ATTR(BLEND, RATIO, FINITE, NOWHERE, NONE, "", "fraction of the second source")
ATTR(BLEND, MODE, COMPOSITE, NOWHERE, DESCRIBED(COMPOSITE_OVER, ":over"), "", "how the second source is combined with the first; ignored if ratio is set")

SOURCE(CANVAS_NOISE, noise, NOTHING, "noise in all four channels, for nodes drawn after it")
ATTR(CANVAS_NOISE, FREQUENCY, SCALE, NOWHERE, NONE, "", "number of waves per unit of length, along x and y; required")
ATTR(CANVAS_NOISE, OCTAVES, FINITE_INTEGER, NOWHERE, IS(8), "", "number of layers of noise, each twice as fine as the one before")
ATTR(CANVAS_NOISE, SEED, FINITE, NOWHERE, IS(0), "", "any number; each seed gives different noise")
ATTR(CANVAS_NOISE, SIZE, SIZE, NOWHERE, DESCRIBED(0, "no repetition"), "", "size of a tile that repeats without seams, in whole units")
ATTR(CANVAS_NOISE, TYPE, NOISE_TYPE, NOWHERE, DESCRIBED(TURBULENCE_FRACTAL, ":fractal"), "", ":turbulence takes the absolute value of each wave")

FILTER(BLUR, blur, radius, FILTER, 1, "blur nodes drawn after it")
ATTR(FILTER_BLUR, RADIUS, SIZE, NOWHERE, NONE, "", "standard deviation of the blur, along x and y")

FILTER(SHADOW, shadow, shadow, FILTER, 1, "a shadow behind nodes drawn after it")
ATTR(FILTER_SHADOW, RADIUS, SIZE, NOWHERE, NONE, "", "standard deviation of the blur, along x and y")
ATTR(FILTER_SHADOW, OFFSET, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "displacement of the shadow from the object")
ATTR(FILTER_SHADOW, COLOR, COLOR, NOWHERE, IS(0), "", "")
ATTR(FILTER_SHADOW, SHADOW_ONLY, FLAG, NOWHERE, IS(false), "", "draw the shadow without the object")

FILTER(OFFSET, offset, offset, FILTER, 1, "move nodes drawn after it")
ATTR(FILTER_OFFSET, OFFSET, POINT, NOWHERE, NONE, "", "displacement along x and y")

FILTER(DILATE, dilate, radius, FILTER, 1, "thicken the shapes drawn after it (dilation)")
ATTR(FILTER_DILATE, RADIUS, SIZE, NOWHERE, NONE, "", "each channel becomes the largest value within this distance along x and y")

FILTER(ERODE, erode, radius, FILTER, 1, "thin the shapes drawn after it (erosion)")
ATTR(FILTER_ERODE, RADIUS, SIZE, NOWHERE, NONE, "", "each channel becomes the smallest value within this distance along x and y")

FILTER(COLOUR_MATRIX, color_matrix, matrix, FILTER, 1, "change the colours of nodes drawn after it")
ATTR(FILTER_COLOUR_MATRIX, MATRIX, TWENTY, NOWHERE, NONE, "", "four rows, for red, green, blue and alpha; each has five factors, for r;g;b;a;1; if set, all other attributes are ignored")
ATTR(FILTER_COLOUR_MATRIX, RED, FIVE, NOWHERE, DESCRIBED(0, "1;0;0;0;0"), "", "row of the matrix for red; if a row is set, scale, offset, brightness, contrast and saturation are ignored")
ATTR(FILTER_COLOUR_MATRIX, GREEN, FIVE, NOWHERE, DESCRIBED(0, "0;1;0;0;0"), "", "row of the matrix for green")
ATTR(FILTER_COLOUR_MATRIX, BLUE, FIVE, NOWHERE, DESCRIBED(0, "0;0;1;0;0"), "", "row of the matrix for blue")
ATTR(FILTER_COLOUR_MATRIX, ALPHA, FIVE, NOWHERE, DESCRIBED(0, "0;0;0;1;0"), "", "row of the matrix for alpha")
ATTR(FILTER_COLOUR_MATRIX, SCALE, TRIPLE, NOWHERE, IS(1), "", "factors for red, green and blue; if scale or offset is set, brightness, contrast and saturation are ignored")
ATTR(FILTER_COLOUR_MATRIX, OFFSET, TRIPLE, NOWHERE, IS(0), "", "added to red, green and blue after scale")
ATTR(FILTER_COLOUR_MATRIX, BRIGHTNESS, FINITE, NOWHERE, IS(0), "", "added to red, green and blue")
ATTR(FILTER_COLOUR_MATRIX, CONTRAST, FINITE, NOWHERE, IS(1), "", "factor for the difference of red, green and blue from 0.5")
ATTR(FILTER_COLOUR_MATRIX, SATURATION, FINITE, NOWHERE, IS(1), "", "factor for the saturation; 0 is grey")

FILTER(SOURCE, source, nothing, NOTHING, 0, "the unfiltered drawing, as input to another filter")

FILTER(PAINT, paint, paint, NOTHING, 0, "an area filled with a colour or the current source, as input to another filter")
PAINT_ROWS(FILTER_PAINT)

FILTER(BLEND, blend, blend, FILTER, 2, "blend the results of the two filters inside it; applied to nodes drawn after it")
ATTR(FILTER_BLEND, COEFFICIENTS, QUAD, NOWHERE, NONE, "", "k1;k2;k3;k4: the result is k1*first*second + k2*second + k3*first + k4")
ATTR(FILTER_BLEND, RATIO, FINITE, NOWHERE, NONE, "", "fraction of the first filter; ignored if coefficients is set")
ATTR(FILTER_BLEND, MODE, COMPOSITE, NOWHERE, DESCRIBED(COMPOSITE_OVER, ":over"), "", "how the second filter is combined with the first; ignored if coefficients or ratio is set")

EFFECT(DASH, dash, "lines of nodes drawn after it become dashed")
ATTR(DASH, INTERVALS, LIST, NOWHERE, NONE, "", "lengths dash;gap;dash;gap…; there must be as many gaps as dashes")
ATTR(DASH, OFFSET, FINITE, NOWHERE, IS(0), "", "position in the intervals at which each line begins")

EFFECT(ROUND_CORNERS, round_corners, "round the corners of nodes drawn after it")
ATTR(ROUND_CORNERS, RADIUS, WIDTH, NOWHERE, NONE, "", "distance from a corner at which its curve begins")

EFFECT(JITTER, jitter, "roughen nodes drawn after it")
ATTR(JITTER, LENGTH, WIDTH, NOWHERE, NONE, "", "length of the segments into which lines are cut")
ATTR(JITTER, DEVIATION, FINITE, NOWHERE, NONE, "", "maximum sideways displacement of the ends of segments")
ATTR(JITTER, SEED, FINITE, NOWHERE, IS(0), "", "any number; each seed gives different displacements")

EFFECT(PATH_MATRIX, path_matrix, "transform paths drawn after it, but not their line width")
ATTR(PATH_MATRIX, MATRIX, NINE, NOWHERE, NONE, "", "three rows of three numbers; if set, all other attributes are ignored")
ATTR(PATH_MATRIX, SCALE, SCALE, NOWHERE, DESCRIBED(1, "1;1"), "", "applied first")
ATTR(PATH_MATRIX, ROTATE, FINITE, NOWHERE, IS(0), "turns", "applied second, clockwise")
ATTR(PATH_MATRIX, TRANSLATE, POINT, NOWHERE, DESCRIBED(0, "0;0"), "", "applied last")

EFFECT(SUM, sum, "apply each effect inside to the paths drawn after it, and draw all results")
#include "schema/canvas3d_list.h"
// clang-format on

#undef TYPE
#undef NODE
#undef FORCE
#undef SHAPE
#undef COMMAND
#undef SOURCE
#undef FILTER
#undef EFFECT
#undef PICTURE_EFFECT
#undef ATTR
#undef ALIAS
#undef STRENGTH_ROW
#undef EASE_ROW
#undef POWER_ROW
#undef REACH_ROW
#undef BOUND_ROWS
#undef TRANSFORM_ROWS
#undef PAINT_ROWS
#undef SHAPE_ROWS
#undef FONT_ROWS
#undef SOURCE_ROWS
#undef PROGRAM_ROWS
#undef BLUR_ROWS
#undef ADJUST_ROWS
