// builtin_list.h: one row per built-in, ascending by name (spec builtins.md B0.6).
//
// BUILTIN(name, function, parameters, required, fixed, variadic, named, pure, help); see struct Builtin. Included
// several times, so it has no guard.

BUILTIN("abs", builtin_abs, "x", 1, 1, false, false, true, "Magnitude of each number.")
BUILTIN("accumulate", builtin_accumulate, "xs, zs=1", 1, 2, false, true, true, "Running sums of zs interleaved series.")
BUILTIN("acos", builtin_acos, "x", 1, 1, false, false, true, "Arc cosine of each number, in turns.")
BUILTIN("angle", builtin_angle, "xy, ys", 1, 2, false, true, true,
        "Angle in turns of each pair x;y, or of each x with its y from ys.")
BUILTIN("asin", builtin_asin, "x", 1, 1, false, false, true, "Arc sine of each number, in turns.")
BUILTIN("beta", builtin_beta, "value=null", 0, 1, false, true, true,
        "Stream of random numbers from 0 to 1, denser in the middle, for a seed.")
BUILTIN("bounce", builtin_bounce, "x", 1, 1, false, false, true, "Half sine wave that touches 0 once a cycle.")
BUILTIN("ceil", builtin_ceil, "x", 1, 1, false, false, true, "Each number rounded up.")
BUILTIN("chr", builtin_chr, "x", 1, 1, false, false, true, "String of the given code points.")
BUILTIN("clamp", builtin_clamp, "xs, ys, zs", 3, 3, false, true, true, "Each x limited to the range from y to z.")
BUILTIN("colortemp", builtin_colortemp, "t, normalize=0", 1, 2, false, true, true,
        "Red, green and blue of a black body of t kelvin.")
BUILTIN("concat", builtin_concat, "x", 1, 1, false, false, true, "Texts of all elements as one string.")
BUILTIN("cos", builtin_cos, "x", 1, 1, false, false, true, "Cosine of each number of turns.")
BUILTIN("count", builtin_count_equal, "xs, ys", 2, 2, false, true, true, "For each x how often it occurs in ys.")
BUILTIN("cross", builtin_cross, "xs, ys", 2, 2, false, true, true, "Cross product of two 3-vectors.")
BUILTIN("csv", builtin_csv, "filename, row_number", 2, 2, false, true, false, "One row of a CSV file, counted from 0.")
BUILTIN("cubic", builtin_cubic, "x", 1, 1, false, false, true, "Easing from 0 to 1 along a cubic curve.")
BUILTIN("debug", builtin_debug, "value", 1, 1, false, true, false, "Logs a value and returns it.")
BUILTIN("dot", builtin_dot, "xs, ys", 2, 2, false, true, true, "Dot product of two vectors.")
BUILTIN("exp", builtin_exp, "x", 1, 1, false, false, true, "e to the power of each number.")
BUILTIN("floor", builtin_floor, "x", 1, 1, false, false, true, "Each number rounded down.")
BUILTIN("fract", builtin_fract, "x", 1, 1, false, false, true, "Each number less its floor.")
BUILTIN("glob", builtin_glob, "pattern", 1, 1, false, true, false, "Absolute paths of the files that match a pattern.")
BUILTIN("hsl", builtin_hsl, "x", 1, 1, false, false, true, "Colour of hue;saturation;lightness.")
BUILTIN("hsv", builtin_hsv, "x", 1, 1, false, false, true, "Colour of hue;saturation;value.")
BUILTIN("hypot", builtin_hypot, "...", 0, 0, true, false, true,
        "Root of the sum of squares of a vector, or element by element of several.")
BUILTIN("impulse", builtin_impulse, "xs, cs=0.25", 1, 2, false, true, true, "Wave that rises until cs and then falls.")
BUILTIN("inverse", builtin_inverse, "x", 1, 1, false, false, true, "Inverse of a 3x3 or 4x4 matrix.")
BUILTIN("len", builtin_len, "x", 1, 1, false, false, true, "Number of elements.")
BUILTIN("length", builtin_length, "xy, ys", 1, 2, false, true, true,
        "Length of each pair x;y, or of each x with its y from ys.")
BUILTIN("linear", builtin_linear, "x", 1, 1, false, false, true, "Each number limited to the range from 0 to 1.")
BUILTIN("log", builtin_log, "x", 1, 1, false, false, true, "Natural logarithm of each number.")
BUILTIN("log10", builtin_log10, "x", 1, 1, false, false, true, "Logarithm to base 10 of each number.")
BUILTIN("log2", builtin_log2, "x", 1, 1, false, false, true, "Logarithm to base 2 of each number.")
BUILTIN("map", builtin_map, "xs, ys, zs", 3, 3, false, true, true, "Each x mapped from the range 0 to 1 to y to z.")
BUILTIN("max", builtin_max, "xs, ...", 1, 1, true, true, true, "Greatest element, or greatest of several vectors.")
BUILTIN("maxindex", builtin_maxindex, "xs, ...", 1, 1, true, true, true,
        "Position of the greatest element, or of the greatest argument.")
BUILTIN("mean", builtin_mean, "xs, zs=1", 1, 2, false, true, true, "Means of zs interleaved series.")
BUILTIN("measure_text", builtin_measure_text, "text, family, size, weight, width, slant", 1, 6, false, true, true,
        "Null: text is measured only where it is drawn, by !text.")
BUILTIN("min", builtin_min, "xs, ...", 1, 1, true, true, true, "Least element, or least of several vectors.")
BUILTIN("minindex", builtin_minindex, "xs, ...", 1, 1, true, true, true,
        "Position of the least element, or of the least argument.")
BUILTIN("noise", builtin_noise, "seed, ...", 1, 1, true, true, true,
        "OpenSimplex noise at one to four coordinates, for all combinations of their elements.")
BUILTIN("normal", builtin_normal, "value=null", 0, 1, false, true, true,
        "Stream of normally distributed random numbers for a seed.")
BUILTIN("normalize", builtin_normalize, "x", 1, 1, false, false, true, "Vector scaled to length 1.")
BUILTIN("octnoise", builtin_octnoise, "seed, octaves, roughness, ...", 3, 3, true, true, true,
        "Sum of octaves of noise, each of the weight of the one before times roughness.")
BUILTIN("oklab", builtin_oklab, "x", 1, 1, false, false, true, "Colour of OKLab lightness;a;b.")
BUILTIN("oklch", builtin_oklch, "x", 1, 1, false, false, true, "Colour of OKLCh lightness;chroma;hue.")
BUILTIN("ord", builtin_ord, "x", 1, 1, false, false, true, "Code points of a text.")
BUILTIN("point_towards", builtin_point_towards, "direction, up", 2, 2, false, true, true,
        "Matrix that turns the -z axis to a direction.")
BUILTIN("polar", builtin_polar, "x", 1, 1, false, false, true, "Cosine and sine of each number of turns.")
BUILTIN("product", builtin_product, "xs, w=1", 1, 2, false, true, true, "Products of w interleaved series.")
BUILTIN("qbetween", builtin_qbetween, "a, b", 2, 2, false, true, true, "Quaternion that turns direction a to b.")
BUILTIN("qmul", builtin_qmul, "a, b", 2, 2, false, true, true,
        "Product of two quaternions, or a 3-vector turned by one.")
BUILTIN("quad", builtin_quad, "x", 1, 1, false, false, true, "Easing from 0 to 1 along a parabola.")
BUILTIN("quaternion", builtin_quaternion, "axis, angle", 2, 2, false, true, true,
        "Quaternion that turns by an angle, in turns, about an axis.")
BUILTIN("read", builtin_read, "filename", 1, 1, false, true, false, "Text of a file as one string.")
BUILTIN("read_bytes", builtin_read_bytes, "filename", 1, 1, false, true, false, "Bytes of a file as numbers.")
BUILTIN("round", builtin_round, "xs, ys=0", 1, 2, false, true, true,
        "Each x rounded to ys decimals, halves away from 0.")
BUILTIN("sample", builtin_sample, "texture_id, coord, default=null", 2, 3, false, true, false,
        "The default: petri has no rendered images.")
BUILTIN("sawtooth", builtin_sawtooth, "x", 1, 1, false, false, true, "Wave that rises from 0 to 1 in each cycle.")
BUILTIN("sharkfin", builtin_sharkfin, "x", 1, 1, false, false, true, "Wave that rises and falls along quarter sines.")
BUILTIN("shuffle", builtin_shuffle, "source, xs", 2, 2, false, true, true, "Elements in the random order of a stream.")
BUILTIN("sin", builtin_sin, "x", 1, 1, false, false, true, "Sine of each number of turns.")
BUILTIN("sine", builtin_sine, "x", 1, 1, false, false, true, "Sine wave from 0 to 1 and back in each cycle.")
BUILTIN("slerp", builtin_slerp, "t, a, b", 3, 3, false, true, true, "Quaternion at part t of the way from a to b.")
BUILTIN("snap", builtin_snap, "x", 1, 1, false, false, true, "Easing from 0 to 1 along square roots.")
BUILTIN("sort", builtin_sort, "x", 1, 1, false, false, true, "Numbers or strings in ascending order.")
BUILTIN("split", builtin_split, "text, separator=\"\\n\"", 1, 2, false, true, true,
        "Pieces of a text between separators.")
BUILTIN("sqrt", builtin_sqrt, "x", 1, 1, false, false, true, "Square root of each number.")
BUILTIN("square", builtin_square, "x", 1, 1, false, false, true, "Wave that is 0 and then 1 in each cycle.")
BUILTIN("srt", builtin_srt, "filename, time", 2, 2, false, true, false, "Lines of a subtitle file shown at a time.")
BUILTIN("sum", builtin_sum, "xs, w=1", 1, 2, false, true, true, "Sums of w interleaved series.")
BUILTIN("tan", builtin_tan, "x", 1, 1, false, false, true, "Tangent of each number of turns.")
BUILTIN("triangle", builtin_triangle, "x", 1, 1, false, false, true, "Wave that rises to 1 and falls evenly.")
BUILTIN("uniform", builtin_uniform, "value=null", 0, 1, false, true, true,
        "Stream of random numbers from 0 to 1 for a seed.")
BUILTIN("zip", builtin_zip, "...", 0, 0, true, false, true, "Elements of several vectors in turn.")
