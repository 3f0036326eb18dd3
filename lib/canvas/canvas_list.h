// canvas_list.h: the nodes that draw, their attributes, types and defaults: what is read, reported, listed and tested.
//
// NAME(ID, "attribute name"): all names of attributes, each once.
// NODE(ID, "node kind", PLACE, CHILDREN, "help"), and after it, for each of its attributes,
// ATTR(KIND, NAME, TYPE, "default in words", "help"). PLACE tells where a node may stand and CHILDREN which may stand
// in it (PlaceKind of drawing.h), TYPE how the attribute is read (DrawType).
// UNDRAWN("node kind"): what Flitter shows in a window and petri does not (yet).
// clang-format off
#ifndef NAME
#define NAME(id, text)
#endif
#ifndef NODE
#define NODE(id, text, place, children, help)
#endif
#ifndef ATTR
#define ATTR(kind, name, type, fallback, help)
#endif
#ifndef UNDRAWN
#define UNDRAWN(text)
#endif

NAME(TRANSLATE, "translate")
NAME(SCALE, "scale")
NAME(ROTATE, "rotate")
NAME(COLOR, "color")
NAME(STROKE_WIDTH, "stroke_width")
NAME(STROKE_JOIN, "stroke_join")
NAME(STROKE_CAP, "stroke_cap")
NAME(COMPOSITE, "composite")
NAME(ANTIALIAS, "antialias")
NAME(SIZE, "size")
NAME(TITLE, "title")
NAME(FILENAME, "filename")
NAME(STATE, "state")
NAME(NAME, "name")
NAME(FAMILY, "family")
NAME(WEIGHT, "weight")
NAME(SLANT, "slant")
NAME(FILL_TYPE, "fill_type")
NAME(POINT, "point")
NAME(C1, "c1")
NAME(C2, "c2")
NAME(RADIUS, "radius")
NAME(START, "start")
NAME(END, "end")
NAME(SWEEP, "sweep")
NAME(POINTS, "points")
NAME(CURVE, "curve")
NAME(CLOSE, "close")
NAME(FILL, "fill")
NAME(STROKE, "stroke")
NAME(TEXT, "text")
NAME(CENTER, "center")
NAME(FIT, "fit")
NAME(ORIGIN, "origin")
NAME(ALPHA, "alpha")
NAME(OFFSET, "offset")

#define TRANSFORM_ROWS(kind) \
    ATTR(kind, TRANSLATE, POINT, "0;0", "move the origin; of the three, what is written first is applied first") \
    ATTR(kind, SCALE, SCALE, "1;1", "enlarge") \
    ATTR(kind, ROTATE, NUMBER, "0", "turns, clockwise")
#define PAINT_ROWS(kind) \
    ATTR(kind, COLOR, COLOR, "inherited, at first 1", "takes the place of a gradient that would be inherited") \
    ATTR(kind, STROKE_WIDTH, WIDTH, "inherited, at first 1", "0 is the thinnest line that there is") \
    ATTR(kind, STROKE_JOIN, JOIN, "inherited, at first :miter", "corners of lines") \
    ATTR(kind, STROKE_CAP, CAP, "inherited, at first :butt", "ends of lines") \
    ATTR(kind, COMPOSITE, COMPOSITE, "inherited, at first :over", "how colours combine with what is there") \
    ATTR(kind, ANTIALIAS, FLAG, "inherited, at first true", "smooth edges")
#define SHAPE_ROWS(kind) \
    ATTR(kind, FILL, FLAG, "false", "fill the shape by itself; the current path is left alone") \
    ATTR(kind, STROKE, FLAG, "false", "draw its outline by itself; the current path is left alone")

NODE(WINDOW, "window", TOP, WINDOW, "a window on the screen, or the picture that is rendered; black where nothing is drawn")
ATTR(WINDOW, SIZE, SIZE, "1920;1080, or that of its first canvas", "in pixels")
ATTR(WINDOW, TITLE, TEXT, "", "")
ATTR(WINDOW, COMPOSITE, COMPOSITE, ":over", "how each canvas combines with those before it")

NODE(OFFSCREEN, "offscreen", TOP, WINDOW, "a picture that is not shown in a window; transparent where nothing is drawn")
ATTR(OFFSCREEN, SIZE, SIZE, "1920;1080, or that of its first canvas", "in pixels")
ATTR(OFFSCREEN, COMPOSITE, COMPOSITE, ":over", "how each canvas combines with those before it")

NODE(RECORD, "record", WINDOW, NOTHING, "write this frame's picture, when rendering or viewing")
ATTR(RECORD, FILENAME, TEXT, "", ".png, .svg or .pdf; null: nothing is written")

NODE(POINTER, "pointer", WINDOW, NOTHING, "write where the pointer is, when viewing")
ATTR(POINTER, STATE, ANY, "", "key of the state that is written")

NODE(KEY, "key", WINDOW, NOTHING, "write whether a key is down, when viewing")
ATTR(KEY, NAME, ANY, "", "which key")
ATTR(KEY, STATE, ANY, "", "key of the state that is written")

NODE(CANVAS, "canvas", WINDOW, DRAWING, "a sheet to draw on: origin at the top left, y down, angles in turns")
ATTR(CANVAS, SIZE, SIZE, "that of the window", "if different, the sheet is scaled to fit")
TRANSFORM_ROWS(CANVAS)
PAINT_ROWS(CANVAS)

NODE(GROUP, "group", DRAWING, DRAWING, "what is set here, or clipped inside, holds for what is inside")
TRANSFORM_ROWS(GROUP)
PAINT_ROWS(GROUP)

NODE(TRANSFORM, "transform", DRAWING, DRAWING, "move, enlarge and turn what is inside")
TRANSFORM_ROWS(TRANSFORM)

NODE(PAINT, "paint", DRAWING, DRAWING, "colour and manner of drawing for what is inside")
PAINT_ROWS(PAINT)

NODE(FONT, "font", DRAWING, DRAWING, "font for what is inside")
ATTR(FONT, FAMILY, TEXT, "inherited, at first \"sans\"", "one or more names, with commas; the first that there is")
ATTR(FONT, SIZE, WIDTH, "inherited, at first 14", "")
ATTR(FONT, WEIGHT, WEIGHT, "inherited, at first :normal", "")
ATTR(FONT, SLANT, SLANT, "inherited, at first :upright", "")

NODE(LAYER, "layer", DRAWING, DRAWING, "draw what is inside by itself, then all of it at once")
ATTR(LAYER, SIZE, SIZE, "no limit", "what lies outside of it is cut off")
ATTR(LAYER, ORIGIN, POINT, "0;0", "top left corner of the size")
ATTR(LAYER, ALPHA, NUMBER, "1", "0 is invisible")
TRANSFORM_ROWS(LAYER)
PAINT_ROWS(LAYER)

NODE(PATH, "path", DRAWING, DRAWING, "begin a new path; what is inside adds to it, then fills or strokes it")
ATTR(PATH, FILL_TYPE, FILL_TYPE, ":winding", "what is inside where the path crosses itself")
PAINT_ROWS(PATH)

NODE(MOVE_TO, "move_to", DRAWING, NOTHING, "begin another piece of the path")
ATTR(MOVE_TO, POINT, POINT, "", "")

NODE(LINE_TO, "line_to", DRAWING, NOTHING, "a straight line from where the path ends")
ATTR(LINE_TO, POINT, POINT, "", "")

NODE(CURVE_TO, "curve_to", DRAWING, NOTHING, "a Bézier curve from where the path ends")
ATTR(CURVE_TO, POINT, POINT, "", "")
ATTR(CURVE_TO, C1, POINT, "", "the control point; with c2, that of the beginning; without both, a straight line")
ATTR(CURVE_TO, C2, POINT, "", "control point of the end")

NODE(ARC, "arc", DRAWING, NOTHING, "part of an ellipse, joined to the path by a line")
ATTR(ARC, POINT, POINT, "0;0", "centre")
ATTR(ARC, RADIUS, SIZE, "", "one, or that along x and that along y")
ATTR(ARC, START, NUMBER, "0", "turns, clockwise from the x axis")
ATTR(ARC, END, NUMBER, "start + sweep", "turns")
ATTR(ARC, SWEEP, NUMBER, "1", "turns; end goes before it")

NODE(RECT, "rect", DRAWING, SOURCE, "a rectangle")
ATTR(RECT, POINT, POINT, "0;0", "top left corner")
ATTR(RECT, SIZE, SIZE, "", "")
ATTR(RECT, RADIUS, SIZE, "0", "of its corners, shrunk to what fits")
SHAPE_ROWS(RECT)
PAINT_ROWS(RECT)

NODE(ELLIPSE, "ellipse", DRAWING, SOURCE, "an ellipse or a circle")
ATTR(ELLIPSE, POINT, POINT, "0;0", "centre")
ATTR(ELLIPSE, RADIUS, SIZE, "", "one, or that along x and that along y")
SHAPE_ROWS(ELLIPSE)
PAINT_ROWS(ELLIPSE)

NODE(LINE, "line", DRAWING, SOURCE, "a line through points")
ATTR(LINE, POINTS, POINTS, "", "")
ATTR(LINE, CURVE, NUMBER, "0", "how round its corners are: 0 not at all, 1 as far as the middles of its pieces")
ATTR(LINE, CLOSE, FLAG, "false", "join the last point to the first")
SHAPE_ROWS(LINE)
PAINT_ROWS(LINE)

NODE(CLOSE, "close", DRAWING, NOTHING, "a straight line to where this piece of the path began")

NODE(CLIP, "clip", DRAWING, NOTHING, "draw only inside the path, until the group, transform, paint, font or layer ends")
ATTR(CLIP, ANTIALIAS, FLAG, "inherited, at first true", "smooth edges")

NODE(FILL, "fill", DRAWING, SOURCE, "fill the path")
PAINT_ROWS(FILL)

NODE(STROKE, "stroke", DRAWING, SOURCE, "draw along the path")
PAINT_ROWS(STROKE)

NODE(TEXT, "text", DRAWING, SOURCE, "one line of text")
ATTR(TEXT, TEXT, TEXT, "", "")
ATTR(TEXT, POINT, POINT, "0;0", "its middle; with center=false where its base line begins")
ATTR(TEXT, CENTER, FLAG, "true", "")
ATTR(TEXT, FILL, FLAG, "true", "draw the letters")
ATTR(TEXT, STROKE, FLAG, "false", "draw their outlines; if both are false, they are added to the path")
PAINT_ROWS(TEXT)

NODE(IMAGE, "image", DRAWING, NOTHING, "a picture from a PNG or JPEG file")
ATTR(IMAGE, FILENAME, TEXT, "", "")
ATTR(IMAGE, POINT, POINT, "0;0", "top left corner")
ATTR(IMAGE, SIZE, SIZE, "that of the file", "of a box that it is stretched to")
ATTR(IMAGE, FIT, SIZE, "", "of a box that it is put into, as large as it goes")
ATTR(IMAGE, FILL, SIZE, "", "of a box that it fills; what does not fit is cut off")
ATTR(IMAGE, COMPOSITE, COMPOSITE, "inherited, at first :over", "how colours combine with what is there")

NODE(GRADIENT, "gradient", SOURCE, STOP, "colours that flow into each other, for the node that it stands in and what is inside")
ATTR(GRADIENT, START, POINT, "0;0", "of a linear one")
ATTR(GRADIENT, END, POINT, "", "of a linear one")
ATTR(GRADIENT, RADIUS, NUMBER, "", "of a radial one")
ATTR(GRADIENT, POINT, POINT, "0;0", "centre of a radial one")

NODE(STOP, "stop", STOP, NOTHING, "a colour of a gradient")
ATTR(STOP, OFFSET, NUMBER, "evenly spread", "from 0 to 1")
ATTR(STOP, COLOR, COLOR, "1", "")

NODE(COLOR, "color", SOURCE, NOTHING, "one colour, for the node that it stands in and what is inside")
ATTR(COLOR, COLOR, COLOR, "1", "")

UNDRAWN("canvas3d")
UNDRAWN("reference")
UNDRAWN("video")
UNDRAWN("shader")
UNDRAWN("adjust")
UNDRAWN("blur")
UNDRAWN("bloom")
UNDRAWN("edges")
UNDRAWN("chromakey")
UNDRAWN("feedback")
UNDRAWN("vignette")
UNDRAWN("noise")
UNDRAWN("flare")
UNDRAWN("kaleid")
// clang-format on

#undef NAME
#undef NODE
#undef ATTR
#undef UNDRAWN
#undef TRANSFORM_ROWS
#undef PAINT_ROWS
#undef SHAPE_ROWS
