// pictures_list.h: the rows of schema_list.h for the tree of pictures (spec pictures.md): windows, their children and
// effects. Included only by schema_list.h.
// clang-format off

// Attributes of nodes that create a picture.
#define SOURCE_ROWS(kind) \
    ATTR(kind, SIZE, SIZE, NOWHERE, DESCRIBED(0, "the size of the enclosing node"), "pixels", "") \
    ATTR(kind, ID, TEXT, NOWHERE, NONE, "", "name by which !reference and images refer to this picture") \
    ATTR(kind, HIDDEN, FLAG, NOWHERE, IS(false), "", "create the picture, but do not pass it to the enclosing node")
// Attributes of effect nodes, which create a picture from the pictures of the nodes inside them.
#define PROGRAM_ROWS(kind) \
    SOURCE_ROWS(kind) \
    ATTR(kind, COMPOSITE, MIX, NOWHERE, DESCRIBED(MIX_OVER, ":over"), "", "how each picture inside is combined with the previous ones") \
    ALIAS(kind, BLEND, COMPOSITE, "composite", MIX, NOWHERE, "") \
    ATTR(kind, ALPHA, AMOUNT, NOWHERE, IS(1), "", "factor for all four channels of the result") \
    ATTR(kind, COLORBITS, FINITE_INTEGER, NOWHERE, DESCRIBED(0, "the colorbits of the window"), "", "bits per channel: 8, 16 or 32") \
    ATTR(kind, PASSES, FINITE_INTEGER, NOWHERE, DESCRIBED(0, ""), "", "number of times that the shader runs, each time on its previous result") \
    ATTR(kind, DOWNSAMPLE, FINITE_INTEGER, NOWHERE, IS(2), "", "divisor for the width and height of the passes in downsample_passes") \
    ATTR(kind, DOWNSAMPLE_PASSES, LIST, NOWHERE, NONE, "", "numbers of the passes that are rendered at a smaller size; the first pass has number 0") \
    ATTR(kind, BORDER, QUAD, NOWHERE, DESCRIBED(0, "0;0;0;0"), "", "colour beyond the edges of the pictures inside") \
    ATTR(kind, REPEAT, AMOUNTS, NOWHERE, NONE, "", "whether the pictures inside repeat beyond their edges, along x and y") \
    ATTR(kind, NEAREST, FLAG, NOWHERE, IS(false), "", "do not interpolate between pixels where a picture of a different size is scaled") \
    ATTR(kind, VERTEX, TEXT, NOWHERE, NONE, "", "GLSL source that replaces the default vertex shader") \
    ATTR(kind, FRAGMENT, TEXT, NOWHERE, NONE, "", "GLSL source that replaces the default fragment shader")
#define BLUR_ROWS(kind) \
    ATTR(kind, RADIUS, AMOUNTS, NOWHERE, IS(0), "pixels", "radius of the blur along x and y, in whole pixels") \
    ATTR(kind, SIGMA, AMOUNTS, NOWHERE, IS(0.3), "radii", "standard deviation of the blur")
#define ADJUST_ROWS(kind, usual) \
    ATTR(kind, EXPOSURE, AMOUNT, NOWHERE, IS(usual), "stops", "1 doubles the brightness") \
    ATTR(kind, CONTRAST, AMOUNT, NOWHERE, IS(1), "", "factor for the difference of each channel from 0.5") \
    ATTR(kind, BRIGHTNESS, AMOUNT, NOWHERE, IS(0), "", "added to each channel") \
    ATTR(kind, SHADOWS, AMOUNT, NOWHERE, IS(0), "stops", "exposure of dark areas") \
    ATTR(kind, HIGHLIGHTS, AMOUNT, NOWHERE, IS(0), "stops", "exposure of bright areas")

NODE(WINDOW, "window", TOP, WINDOW, "a window on the screen, or the rendered picture; black where nothing is drawn")
PROGRAM_ROWS(WINDOW)
ATTR(WINDOW, TITLE, TEXT, NOWHERE, DESCRIBED(0, "Flitter"), "", "")
ATTR(WINDOW, SCREEN, AMOUNT, NOWHERE, NONE, "", "ignored; use 'petri view --screen'")
ATTR(WINDOW, FULLSCREEN, FLAG, NOWHERE, IS(false), "", "ignored; use 'petri view --fullscreen'")
ATTR(WINDOW, VSYNC, FLAG, NOWHERE, IS(false), "", "ignored")
ATTR(WINDOW, CURSOR, FLAG, NOWHERE, IS(true), "", "ignored")
ATTR(WINDOW, RESIZABLE, FLAG, NOWHERE, IS(true), "", "ignored")

NODE(OFFSCREEN, "offscreen", TOP, PICTURES, "a picture without a window; transparent where nothing is drawn")
PROGRAM_ROWS(OFFSCREEN)

NODE(RECORD, "record", PICTURE, PICTURES, "write the pictures inside to a file when rendering or viewing")
PROGRAM_ROWS(RECORD)
ATTR(RECORD, FILENAME, TEXT, NOWHERE, NONE, "", "an image file, which is written only once for each name, or a video file; with null, nothing is written")
ATTR(RECORD, QUALITY, FINITE_INTEGER, NOWHERE, IS(75), "", "JPEG quality, at most 100")
ATTR(RECORD, KEEP_ALPHA, FLAG, NOWHERE, IS(false), "", "also write alpha; colours stay premultiplied")
ATTR(RECORD, CODEC, CODEC, NOWHERE, DESCRIBED(0, "the container's, usually :h264"), "", "codec of videos")
ATTR(RECORD, PIXFMT, PIXFMT, NOWHERE, DESCRIBED(0, "the codec's, usually :yuv420p"), "", "pixel format of videos")
ATTR(RECORD, CRF, CRF, NOWHERE, DESCRIBED(NAN, "17 for :h264"), "", "constant rate factor of videos: less is better and larger")
ATTR(RECORD, PRESET, PRESET, NOWHERE, DESCRIBED(3, ":veryfast"), "", "speed of the encoder; slower presets give smaller videos; only for :h264 and :hevc")
ATTR(RECORD, PROFILE, PROFILE, NOWHERE, DESCRIBED(0, "the encoder's"), "", "profile of the encoder; only for :h264, :hevc and :prores")
ATTR(RECORD, LIMIT, AMOUNT, NOWHERE, NONE, "seconds", "maximum length of a video")

NODE(POINTER, "pointer", INPUT, NOTHING, "when viewing, write the position of the pointer to the state")
ATTR(POINTER, STATE, ANY, TO_INPUT(state), NONE, "", "state key to which the position is written")

NODE(KEY, "key", INPUT, NOTHING, "when viewing, write to the state whether a key is pressed")
ATTR(KEY, NAME, ANY, TO_INPUT(name), NONE, "", "name of the key")
ATTR(KEY, STATE, ANY, TO_INPUT(state), NONE, "", "state key to which the result is written")

NODE(PICTURE_IMAGE, "image", PICTURE, NOTHING, "an image from a PNG or JPEG file")
ATTR(PICTURE_IMAGE, FILENAME, TEXT, NOWHERE, NONE, "", "")
ATTR(PICTURE_IMAGE, SIZE, SIZE, NOWHERE, DESCRIBED(0, "the size of the image file"), "pixels", "")
ATTR(PICTURE_IMAGE, FLIP, FLIP, NOWHERE, DESCRIBED(0, "not flipped"), "", "")
ATTR(PICTURE_IMAGE, ID, TEXT, NOWHERE, NONE, "", "name by which !reference and images refer to this picture")
ATTR(PICTURE_IMAGE, HIDDEN, FLAG, NOWHERE, IS(false), "", "create the picture, but do not pass it to the enclosing node")

NODE(REFERENCE, "reference", PICTURE, NOTHING, "show the picture of another node")
ATTR(REFERENCE, ID, TEXT, NOWHERE, NONE, "", "id of the node whose picture is shown")

NODE(SHADER, "shader", PICTURE, PICTURES, "run a GLSL shader for each pixel")
PROGRAM_ROWS(SHADER)

PICTURE_EFFECT(ADJUST, adjust, true, "change colours")
PROGRAM_ROWS(ADJUST)
ATTR(ADJUST, COLOR_MATRIX, LIST, NOWHERE, DESCRIBED(1, "1;0;0;0;1;0;0;0;1"), "", "nine numbers in column-major order: a 3 by 3 matrix for red, green and blue")
ATTR(ADJUST, HUE, AMOUNT, NOWHERE, IS(0), "turns", "added to the hue")
ATTR(ADJUST, SATURATION, AMOUNT, NOWHERE, IS(1), "", "factor for the saturation; 0 is grey")
ADJUST_ROWS(ADJUST, 0)
ATTR(ADJUST, GAMMA, AMOUNT, NOWHERE, IS(1), "", "exponent applied to each channel")
ATTR(ADJUST, TONEMAP, TONEMAP, NOWHERE, DESCRIBED(0, "none"), "", "map colours brighter than white into the displayable range")
ATTR(ADJUST, WHITEPOINT, AMOUNT, NOWHERE, IS(0), "", "brightness that :reinhard maps to white; ignored unless above 1")

PICTURE_EFFECT(BLUR, blur, true, "blur the pictures inside")
PROGRAM_ROWS(BLUR)
BLUR_ROWS(BLUR)

PICTURE_EFFECT(BLOOM, bloom, true, "let bright areas glow beyond their edges")
PROGRAM_ROWS(BLOOM)
BLUR_ROWS(BLOOM)
ADJUST_ROWS(BLOOM, -1)

PICTURE_EFFECT(EDGES, edges, true, "show edges: the difference from a blurred copy")
PROGRAM_ROWS(EDGES)
BLUR_ROWS(EDGES)
ATTR(EDGES, MIXER, AMOUNT, NOWHERE, IS(0), "", "fraction of the original picture that is mixed in")

PICTURE_EFFECT(CHROMAKEY, chromakey, true, "make one hue transparent")
PROGRAM_ROWS(CHROMAKEY)
ATTR(CHROMAKEY, HUE, AMOUNT, NOWHERE, DESCRIBED(1.0 / 3, "1/3"), "turns", "centre of the range of hues that become transparent")
ATTR(CHROMAKEY, RANGE, AMOUNT, NOWHERE, IS(0.1), "turns", "width of the range of hues that become transparent")
ATTR(CHROMAKEY, SATURATION, AMOUNT, NOWHERE, IS(0.75), "", "minimum saturation of pixels that become transparent")
ATTR(CHROMAKEY, BRIGHTNESS, AMOUNT, NOWHERE, IS(0.1), "", "minimum brightness of pixels that become transparent")
ATTR(CHROMAKEY, RADIUS, AMOUNTS, NOWHERE, IS(10), "pixels", "blur radius of the mask")
ATTR(CHROMAKEY, SIGMA, AMOUNTS, NOWHERE, IS(0.3), "radii", "standard deviation of the blur")
ATTR(CHROMAKEY, HARD, AMOUNT, NOWHERE, IS(4), "", "sharpness of the mask after the blur")

PICTURE_EFFECT(FEEDBACK, feedback, false, "mix with the picture of the previous frame, to draw trails")
PROGRAM_ROWS(FEEDBACK)
ATTR(FEEDBACK, TIMEBASE, AMOUNT, NOWHERE, IS(1), "beats", "time in which the other attributes take full effect")
ATTR(FEEDBACK, MIXER, AMOUNT, NOWHERE, IS(0), "", "fraction of the previous picture that is kept")
ATTR(FEEDBACK, GLOW, AMOUNT, NOWHERE, IS(0), "", "the pictures inside are multiplied by 1 + glow")
ATTR(FEEDBACK, TRANSLATE, AMOUNTS, NOWHERE, IS(0), "pixels", "movement of the previous picture, y down")
ATTR(FEEDBACK, SCALE, AMOUNTS, NOWHERE, IS(1), "", "scale of the previous picture")
ATTR(FEEDBACK, ROTATE, AMOUNT, NOWHERE, IS(0), "turns", "rotation of the previous picture, clockwise")

PICTURE_EFFECT(PICTURE_TRANSFORM, transform, true, "move, scale and rotate pictures about their centre, in the order in which the attributes are written")
PROGRAM_ROWS(PICTURE_TRANSFORM)
ATTR(PICTURE_TRANSFORM, SCALE, AMOUNTS, NOWHERE, IS(1), "", "scale factors along x and y")
ATTR(PICTURE_TRANSFORM, ROTATE, AMOUNT, NOWHERE, IS(0), "turns", "rotation, counter-clockwise")
ATTR(PICTURE_TRANSFORM, TRANSLATE, AMOUNTS, NOWHERE, IS(0), "pixels", "displacement, y up")
ATTR(PICTURE_TRANSFORM, KEYSTONE, AMOUNTS, NOWHERE, IS(0), "", "perspective distortion along x and y")

PICTURE_EFFECT(VIGNETTE, vignette, true, "fade towards the edges")
PROGRAM_ROWS(VIGNETTE)
ATTR(VIGNETTE, INSET, AMOUNT, NOWHERE, IS(0.25), "widths", "distance from the edge over which the picture fades")
ATTR(VIGNETTE, FADE, FADE, NOWHERE, DESCRIBED(FADE_LINEAR, ":linear"), "", "shape of the fade")

PICTURE_EFFECT(NOISE, noise, false, "noise; to animate it, make z depend on beat")
PROGRAM_ROWS(NOISE)
ATTR(NOISE, SEED, SEED, NOWHERE, DESCRIBED((double)(int64_t)RANDOM_HASH_START / 281474976710656.0, "null"), "", "each seed gives different noise")
ATTR(NOISE, COMPONENTS, FINITE_INTEGER, NOWHERE, IS(1), "", "number of channels filled with noise")
ATTR(NOISE, OCTAVES, FINITE_INTEGER, NOWHERE, IS(1), "", "number of octaves")
ATTR(NOISE, ROUGHNESS, AMOUNT, NOWHERE, IS(0.5), "", "amplitude of each octave relative to the previous one")
ATTR(NOISE, ORIGIN, AMOUNTS, NOWHERE, IS(0), "", "x;y, added to the point at which the noise is evaluated")
ATTR(NOISE, Z, AMOUNT, NOWHERE, IS(0), "", "third coordinate of the point at which the noise is evaluated")
ATTR(NOISE, SCALE, TRIPLE, NOWHERE, IS(1), "", "factors for the coordinates of the point")
ATTR(NOISE, TSCALE, TRIPLE, NOWHERE, IS(1), "", "factors for the colours of the pictures inside, which are added to the point")
ATTR(NOISE, MULTIPLIER, AMOUNT, NOWHERE, IS(0.5), "", "factor for the noise")
ATTR(NOISE, OFFSET, AMOUNT, NOWHERE, IS(0.5), "", "added to the noise")
ATTR(NOISE, DEFAULT, QUAD, NOWHERE, IS(1), "", "value of the channels without noise")
ATTR(NOISE, SHAPE, NOISE_SHAPE, NOWHERE, DESCRIBED(NOISE_PLANE, ":plane"), "", "surface on which the noise is evaluated")

PICTURE_EFFECT(FLARE, flare, true, "lens flare of bright areas")
PROGRAM_ROWS(FLARE)
ATTR(FLARE, THRESHOLD, AMOUNT, NOWHERE, IS(1), "", "luminance above which areas flare")
ATTR(FLARE, ATTENUATION, AMOUNT, NOWHERE, IS(2), "stops", "attenuation of the flares")
ATTR(FLARE, UPRIGHT_LENGTH, AMOUNT, NOWHERE, IS(0.25), "", "length of horizontal and vertical streaks")
ATTR(FLARE, DIAGONAL_LENGTH, AMOUNT, NOWHERE, IS(0.125), "", "length of diagonal streaks")
ATTR(FLARE, HALO_RADIUS, AMOUNT, NOWHERE, IS(0.0625), "", "radius of the halo, as a fraction of half the width or height, whichever is smaller")
ATTR(FLARE, HALO_ATTENUATION, AMOUNT, NOWHERE, IS(0), "stops", "additional attenuation of the halo")
ATTR(FLARE, GHOSTS, FINITE_INTEGER, NOWHERE, IS(6), "", "number of ghosts, at most 6")
ATTR(FLARE, ABERRATION, AMOUNT, NOWHERE, IS(1), "", "separation of colours")

PICTURE_EFFECT(KALEID, kaleid, true, "a kaleidoscope")
PROGRAM_ROWS(KALEID)
ATTR(KALEID, SEGMENTS, AMOUNT, NOWHERE, IS(6), "", "number of segments")
ATTR(KALEID, ROTATION, AMOUNT, NOWHERE, IS(0), "turns", "rotation of the segments")
ATTR(KALEID, RADIUS, AMOUNT, NOWHERE, IS(1), "", "distance between mirrors, as a fraction of half the width or height, whichever is smaller")
