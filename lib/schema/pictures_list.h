// pictures_list.h: the rows of schema_list.h for the tree of pictures (spec pictures.md): windows, what stands in them,
// effects. Included by schema_list.h and nothing else.
// clang-format off

// What makes a picture.
#define SOURCE_ROWS(kind) \
    ATTR(kind, SIZE, SIZE, NOWHERE, DESCRIBED(0, "that of the node around it"), "pixels", "") \
    ATTR(kind, ID, TEXT, NOWHERE, NONE, "", "the name by which !reference and images find this picture") \
    ATTR(kind, HIDDEN, FLAG, NOWHERE, IS(false), "", "make the picture, but do not show it to the node around it")
// What makes one of the pictures inside.
#define PROGRAM_ROWS(kind) \
    SOURCE_ROWS(kind) \
    ATTR(kind, COMPOSITE, MIX, NOWHERE, DESCRIBED(MIX_OVER, ":over"), "", "how each picture inside combines with those before it") \
    ALIAS(kind, BLEND, COMPOSITE, "composite", MIX, NOWHERE, "") \
    ATTR(kind, ALPHA, AMOUNT, NOWHERE, IS(1), "", "multiplies the result, all four channels") \
    ATTR(kind, COLORBITS, FINITE_INTEGER, NOWHERE, DESCRIBED(0, "the window's"), "", "8, 16 or 32 for each channel") \
    ATTR(kind, PASSES, FINITE_INTEGER, NOWHERE, DESCRIBED(0, ""), "", "how often the program is run, each time on its last result") \
    ATTR(kind, DOWNSAMPLE, FINITE_INTEGER, NOWHERE, IS(2), "", "how much smaller the passes of downsample_passes are") \
    ATTR(kind, DOWNSAMPLE_PASSES, LIST, NOWHERE, NONE, "", "") \
    ATTR(kind, BORDER, QUAD, NOWHERE, DESCRIBED(0, "0;0;0;0"), "", "colour beyond the edges of the pictures inside") \
    ATTR(kind, REPEAT, AMOUNTS, NOWHERE, NONE, "", "the pictures inside repeat beyond their edges, along x and y") \
    ATTR(kind, NEAREST, FLAG, NOWHERE, IS(false), "", "take the nearest pixel of pictures of another size") \
    ATTR(kind, VERTEX, TEXT, NOWHERE, NONE, "", "a program of GLSL in place of the usual one") \
    ATTR(kind, FRAGMENT, TEXT, NOWHERE, NONE, "", "a program of GLSL in place of the usual one")
#define BLUR_ROWS(kind) \
    ATTR(kind, RADIUS, AMOUNTS, NOWHERE, IS(0), "pixels", "how far it reaches along x and y, whole pixels") \
    ATTR(kind, SIGMA, AMOUNTS, NOWHERE, IS(0.3), "radii", "standard deviation")
#define ADJUST_ROWS(kind, usual) \
    ATTR(kind, EXPOSURE, AMOUNT, NOWHERE, IS(usual), "stops", "1 is twice as bright") \
    ATTR(kind, CONTRAST, AMOUNT, NOWHERE, IS(1), "", "") \
    ATTR(kind, BRIGHTNESS, AMOUNT, NOWHERE, IS(0), "", "is added") \
    ATTR(kind, SHADOWS, AMOUNT, NOWHERE, IS(0), "stops", "exposure of what is dark") \
    ATTR(kind, HIGHLIGHTS, AMOUNT, NOWHERE, IS(0), "stops", "exposure of what is bright")

NODE(WINDOW, "window", TOP, WINDOW, "a window on the screen, or the picture that is rendered; black where nothing is drawn")
PROGRAM_ROWS(WINDOW)
ATTR(WINDOW, TITLE, TEXT, NOWHERE, DESCRIBED(0, "Flitter"), "", "")
ATTR(WINDOW, SCREEN, AMOUNT, NOWHERE, NONE, "", "ignored")
ATTR(WINDOW, FULLSCREEN, FLAG, NOWHERE, IS(false), "", "ignored: `petri view --fullscreen`")
ATTR(WINDOW, VSYNC, FLAG, NOWHERE, IS(false), "", "ignored")
ATTR(WINDOW, CURSOR, FLAG, NOWHERE, IS(true), "", "ignored")
ATTR(WINDOW, RESIZABLE, FLAG, NOWHERE, IS(true), "", "ignored")

NODE(OFFSCREEN, "offscreen", TOP, PICTURES, "a picture that is not shown in a window; transparent where nothing is drawn")
PROGRAM_ROWS(OFFSCREEN)

NODE(RECORD, "record", PICTURE, PICTURES, "write what is inside to a file, when rendering or viewing")
PROGRAM_ROWS(RECORD)
ATTR(RECORD, FILENAME, TEXT, NOWHERE, NONE, "", "a picture, written once for each name, or a film; null: nothing is written")
ATTR(RECORD, QUALITY, FINITE_INTEGER, NOWHERE, IS(75), "", "of JPEG, up to 100")
ATTR(RECORD, KEEP_ALPHA, FLAG, NOWHERE, IS(false), "", "write alpha, too; colours stay multiplied by it")
ATTR(RECORD, CODEC, TEXT, NOWHERE, DESCRIBED(0, "h264"), "", "of films")
ATTR(RECORD, PIXFMT, TEXT, NOWHERE, DESCRIBED(0, "yuv420p"), "", "of films")
ATTR(RECORD, LIMIT, AMOUNT, NOWHERE, NONE, "seconds", "after which a film ends")

NODE(POINTER, "pointer", INPUT, NOTHING, "write where the pointer is, when viewing")
ATTR(POINTER, STATE, ANY, TO_INPUT(state), NONE, "", "key of the state that is written")

NODE(KEY, "key", INPUT, NOTHING, "write whether a key is down, when viewing")
ATTR(KEY, NAME, ANY, TO_INPUT(name), NONE, "", "which key")
ATTR(KEY, STATE, ANY, TO_INPUT(state), NONE, "", "key of the state that is written")

NODE(PICTURE_IMAGE, "image", PICTURE, NOTHING, "a picture from a PNG or JPEG file")
ATTR(PICTURE_IMAGE, FILENAME, TEXT, NOWHERE, NONE, "", "")
ATTR(PICTURE_IMAGE, SIZE, SIZE, NOWHERE, DESCRIBED(0, "that of the file"), "pixels", "")
ATTR(PICTURE_IMAGE, FLIP, FLIP, NOWHERE, DESCRIBED(0, "not at all"), "", "")
ATTR(PICTURE_IMAGE, ID, TEXT, NOWHERE, NONE, "", "the name by which !reference and images find this picture")
ATTR(PICTURE_IMAGE, HIDDEN, FLAG, NOWHERE, IS(false), "", "make the picture, but do not show it to the node around it")

NODE(REFERENCE, "reference", PICTURE, NOTHING, "the picture of another node")
ATTR(REFERENCE, ID, TEXT, NOWHERE, NONE, "", "of that node")

NODE(SHADER, "shader", PICTURE, PICTURES, "a program of GLSL run for each pixel")
PROGRAM_ROWS(SHADER)

NODE(ADJUST, "adjust", PICTURE, PICTURES, "change colours")
PROGRAM_ROWS(ADJUST)
ATTR(ADJUST, COLOR_MATRIX, LIST, NOWHERE, DESCRIBED(1, "1;0;0;0;1;0;0;0;1"), "", "nine numbers by columns: what red, green and blue become")
ATTR(ADJUST, HUE, AMOUNT, NOWHERE, IS(0), "turns", "")
ATTR(ADJUST, SATURATION, AMOUNT, NOWHERE, IS(1), "", "0 is grey")
ADJUST_ROWS(ADJUST, 0)
ATTR(ADJUST, GAMMA, AMOUNT, NOWHERE, IS(1), "", "")
ATTR(ADJUST, TONEMAP, TONEMAP, NOWHERE, DESCRIBED(0, "none"), "", "bring colours beyond white into what can be shown")
ATTR(ADJUST, WHITEPOINT, AMOUNT, NOWHERE, IS(0), "", "what :reinhard makes white, if above 1")

NODE(BLUR, "blur", PICTURE, PICTURES, "blur")
PROGRAM_ROWS(BLUR)
BLUR_ROWS(BLUR)

NODE(BLOOM, "bloom", PICTURE, PICTURES, "let bright places shine beyond their edges")
PROGRAM_ROWS(BLOOM)
BLUR_ROWS(BLOOM)
ADJUST_ROWS(BLOOM, -1)

NODE(EDGES, "edges", PICTURE, PICTURES, "what a blur changes: edges")
PROGRAM_ROWS(EDGES)
BLUR_ROWS(EDGES)
ATTR(EDGES, MIXER, AMOUNT, NOWHERE, IS(0), "", "how much of the picture itself is seen")

NODE(CHROMAKEY, "chromakey", PICTURE, PICTURES, "make what has one hue transparent")
PROGRAM_ROWS(CHROMAKEY)
ATTR(CHROMAKEY, HUE, AMOUNT, NOWHERE, DESCRIBED(1.0 / 3, "1/3"), "turns", "")
ATTR(CHROMAKEY, RANGE, AMOUNT, NOWHERE, IS(0.1), "turns", "of the hue")
ATTR(CHROMAKEY, SATURATION, AMOUNT, NOWHERE, IS(0.75), "", "least")
ATTR(CHROMAKEY, BRIGHTNESS, AMOUNT, NOWHERE, IS(0.1), "", "least")
ATTR(CHROMAKEY, RADIUS, AMOUNTS, NOWHERE, IS(10), "pixels", "of the mask's blur")
ATTR(CHROMAKEY, SIGMA, AMOUNTS, NOWHERE, IS(0.3), "radii", "standard deviation")
ATTR(CHROMAKEY, HARD, AMOUNT, NOWHERE, IS(4), "", "how sharp the mask is after it")

NODE(FEEDBACK, "feedback", PICTURE, PICTURES, "mix with the picture of the frame before: trails")
PROGRAM_ROWS(FEEDBACK)
ATTR(FEEDBACK, TIMEBASE, AMOUNT, NOWHERE, IS(1), "beats", "the time for which the others are told")
ATTR(FEEDBACK, MIXER, AMOUNT, NOWHERE, IS(0), "", "how much of the past stays")
ATTR(FEEDBACK, GLOW, AMOUNT, NOWHERE, IS(0), "", "how much brighter the new is")
ATTR(FEEDBACK, TRANSLATE, AMOUNTS, NOWHERE, IS(0), "pixels", "the past moves, y down")
ATTR(FEEDBACK, SCALE, AMOUNTS, NOWHERE, IS(1), "", "the past grows")
ATTR(FEEDBACK, ROTATE, AMOUNT, NOWHERE, IS(0), "turns", "the past turns, clockwise")

NODE(PICTURE_TRANSFORM, "transform", PICTURE, PICTURES, "move, enlarge and turn pictures about the middle, in the order written")
PROGRAM_ROWS(PICTURE_TRANSFORM)
ATTR(PICTURE_TRANSFORM, SCALE, AMOUNTS, NOWHERE, IS(1), "", "")
ATTR(PICTURE_TRANSFORM, ROTATE, AMOUNT, NOWHERE, IS(0), "turns", "counter-clockwise")
ATTR(PICTURE_TRANSFORM, TRANSLATE, AMOUNTS, NOWHERE, IS(0), "pixels", "y up")
ATTR(PICTURE_TRANSFORM, KEYSTONE, AMOUNTS, NOWHERE, IS(0), "", "perspective")

NODE(VIGNETTE, "vignette", PICTURE, PICTURES, "fade towards the edges")
PROGRAM_ROWS(VIGNETTE)
ATTR(VIGNETTE, INSET, AMOUNT, NOWHERE, IS(0.25), "widths", "how far from the edges")
ATTR(VIGNETTE, FADE, FADE, NOWHERE, DESCRIBED(FADE_LINEAR, ":linear"), "", "")

NODE(NOISE, "noise", PICTURE, PICTURES, "noise that flows in space")
PROGRAM_ROWS(NOISE)
ATTR(NOISE, SEED, SEED, NOWHERE, DESCRIBED((double)(int64_t)RANDOM_HASH_START / 281474976710656.0, "null"), "", "")
ATTR(NOISE, COMPONENTS, FINITE_INTEGER, NOWHERE, IS(1), "", "how many channels are noise")
ATTR(NOISE, OCTAVES, FINITE_INTEGER, NOWHERE, IS(1), "", "")
ATTR(NOISE, ROUGHNESS, AMOUNT, NOWHERE, IS(0.5), "", "of each octave against the one before")
ATTR(NOISE, ORIGIN, AMOUNTS, NOWHERE, IS(0), "", "")
ATTR(NOISE, Z, AMOUNT, NOWHERE, IS(0), "", "")
ATTR(NOISE, SCALE, TRIPLE, NOWHERE, IS(1), "", "")
ATTR(NOISE, TSCALE, TRIPLE, NOWHERE, IS(1), "", "how far colours inside move the point")
ATTR(NOISE, MULTIPLIER, AMOUNT, NOWHERE, IS(0.5), "", "")
ATTR(NOISE, OFFSET, AMOUNT, NOWHERE, IS(0.5), "", "is added")
ATTR(NOISE, DEFAULT, QUAD, NOWHERE, IS(1), "", "of the channels that are no noise")
ATTR(NOISE, SHAPE, NOISE_SHAPE, NOWHERE, DESCRIBED(NOISE_PLANE, ":plane"), "", "what the picture is wound around")

NODE(FLARE, "flare", PICTURE, PICTURES, "what a lens makes of bright places")
PROGRAM_ROWS(FLARE)
ATTR(FLARE, THRESHOLD, AMOUNT, NOWHERE, IS(1), "", "luminance from which places flare")
ATTR(FLARE, ATTENUATION, AMOUNT, NOWHERE, IS(2), "stops", "")
ATTR(FLARE, UPRIGHT_LENGTH, AMOUNT, NOWHERE, IS(0.25), "", "of streaks along x and y")
ATTR(FLARE, DIAGONAL_LENGTH, AMOUNT, NOWHERE, IS(0.125), "", "of streaks between them")
ATTR(FLARE, HALO_RADIUS, AMOUNT, NOWHERE, IS(0.0625), "", "")
ATTR(FLARE, HALO_ATTENUATION, AMOUNT, NOWHERE, IS(0), "stops", "")
ATTR(FLARE, GHOSTS, FINITE_INTEGER, NOWHERE, IS(6), "", "how many, up to 6")
ATTR(FLARE, ABERRATION, AMOUNT, NOWHERE, IS(1), "", "how far colours fall apart")

NODE(KALEID, "kaleid", PICTURE, PICTURES, "a kaleidoscope")
PROGRAM_ROWS(KALEID)
ATTR(KALEID, SEGMENTS, AMOUNT, NOWHERE, IS(6), "", "")
ATTR(KALEID, ROTATION, AMOUNT, NOWHERE, IS(0), "turns", "")
ATTR(KALEID, RADIUS, AMOUNT, NOWHERE, IS(1), "", "")
