// builtin_list.h: one row per built-in, ascending by name (spec builtins.md B0.6).
//
// BUILTIN(name, parameters, required, fixed, variadic, named, pure, each, help); see struct Builtin. The function is
// called builtin_NAME. Included several times, so it has no guard.

BUILTIN(abs, "x", 1, 1, false, false, true, 1, "Absolute value of each number.")
BUILTIN(accumulate, "xs, zs=1", 1, 2, false, true, true, 0,
        "Running sums of xs, or of each of zs series that are interleaved in xs.")
BUILTIN(acos, "x", 1, 1, false, false, true, 1, "Arc cosine of each number, in turns.")
BUILTIN(angle, "xy, ys", 1, 2, false, true, true, 2,
        "Angle, in turns, of each pair x;y in xy; with ys, of each x in xy with its y in ys.")
BUILTIN(asin, "x", 1, 1, false, false, true, 1, "Arc sine of each number, in turns.")
BUILTIN(beta, "value=null", 0, 1, false, true, true, 0,
        "Stream of random numbers from 0 to 1 for a seed, most often near 0.5 (beta distribution).")
BUILTIN(bounce, "x", 1, 1, false, false, true, 1,
        "Wave that rises from 0 to 1 and falls back along half a sine in each cycle.")
BUILTIN(ceil, "x", 1, 1, false, false, true, 1, "Each number rounded up.")
BUILTIN(chr, "x", 1, 1, false, false, true, 0, "String of the given Unicode code points.")
BUILTIN(clamp, "xs, ys, zs", 3, 3, false, true, true, 1, "Each x limited to the range from y to z.")
BUILTIN(colortemp, "t, normalize=0", 1, 2, false, true, true, 0, "Colour red;green;blue of a black body at t kelvin.")
BUILTIN(concat, "x", 1, 1, false, false, true, 0, "Elements converted to text and joined into one string.")
BUILTIN(cos, "x", 1, 1, false, false, true, 1, "Cosine of each angle in turns.")
BUILTIN(count, "xs, ys", 2, 2, false, true, true, 0, "Number of times that each x occurs in ys.")
BUILTIN(cross, "xs, ys", 2, 2, false, true, true, 0, "Cross product of two 3-vectors.")
BUILTIN(csv, "filename, row_number", 2, 2, false, true, false, 0, "One row of a CSV file; the first row has number 0.")
BUILTIN(cubic, "x", 1, 1, false, false, true, 1, "Easing from 0 to 1 along a cubic curve.")
BUILTIN(debug, "value", 1, 1, false, true, false, 0, "Logs a value and returns it.")
BUILTIN(dot, "xs, ys", 2, 2, false, true, true, 0, "Dot product of two vectors.")
BUILTIN(exp, "x", 1, 1, false, false, true, 1, "e to the power of each number.")
BUILTIN(floor, "x", 1, 1, false, false, true, 1, "Each number rounded down.")
BUILTIN(fract, "x", 1, 1, false, false, true, 1, "Fractional part of each number: x minus its floor.")
BUILTIN(glob, "pattern", 1, 1, false, true, false, 0, "Absolute paths of the files that match a pattern.")
BUILTIN(hsl, "x", 1, 1, false, false, true, 0, "Colour red;green;blue of a hue;saturation;lightness.")
BUILTIN(hsv, "x", 1, 1, false, false, true, 0, "Colour red;green;blue of a hue;saturation;value.")
BUILTIN(hypot, "...", 0, 0, true, false, true, 2,
        "Square root of the sum of the squares of a vector's elements; for several vectors, element by element.")
BUILTIN(impulse, "xs, cs=0.25", 1, 2, false, true, true, 1,
        "Wave that rises until the fraction cs of each cycle, then falls.")
BUILTIN(inverse, "x", 1, 1, false, false, true, 0, "Inverse of a 3x3 or 4x4 matrix.")
BUILTIN(len, "x", 1, 1, false, false, true, 0, "Number of elements.")
BUILTIN(length, "xy, ys", 1, 2, false, true, true, 2,
        "Length of each pair x;y in xy; with ys, of each x in xy with its y in ys.")
BUILTIN(linear, "x", 1, 1, false, false, true, 1, "Each number limited to the range from 0 to 1.")
BUILTIN(log, "x", 1, 1, false, false, true, 1, "Natural logarithm of each number.")
BUILTIN(log10, "x", 1, 1, false, false, true, 1, "Logarithm to base 10 of each number.")
BUILTIN(log2, "x", 1, 1, false, false, true, 1, "Logarithm to base 2 of each number.")
BUILTIN(map, "xs, ys, zs", 3, 3, false, true, true, 1, "Each x, from 0 to 1, mapped to the range from y to z.")
BUILTIN(max, "xs, ...", 1, 1, true, true, true, 0, "Greatest element, or greatest of several vectors.")
BUILTIN(maxindex, "xs, ...", 1, 1, true, true, true, 0, "Index of the greatest element, or of the greatest argument.")
BUILTIN(mean, "xs, zs=1", 1, 2, false, true, true, 0, "Mean of xs, or of each of zs series that are interleaved in xs.")
BUILTIN(measure_text, "text, family, size, weight, width, slant", 1, 6, false, true, false, 0,
        "Width of a text that !text draws with these attributes of !font; null in commands that do not draw.")
BUILTIN(min, "xs, ...", 1, 1, true, true, true, 0, "Least element, or least of several vectors.")
BUILTIN(minindex, "xs, ...", 1, 1, true, true, true, 0, "Index of the least element, or of the least argument.")
BUILTIN(noise, "seed, ...", 1, 1, true, true, true, BUILTIN_EACH_POINT,
        "OpenSimplex noise at a point of one to four coordinates; for vectors, at all combinations of their elements.")
BUILTIN(normal, "value=null", 0, 1, false, true, true, 0, "Stream of normally distributed random numbers for a seed.")
BUILTIN(normalize, "x", 1, 1, false, false, true, 0, "Vector scaled to length 1.")
BUILTIN(octnoise, "seed, octaves, roughness, ...", 3, 3, true, true, true, 0,
        "Sum of octaves of noise; roughness is the ratio of the amplitudes of successive octaves.")
BUILTIN(oklab, "x", 1, 1, false, false, true, 0, "Colour red;green;blue of an OKLab lightness;a;b.")
BUILTIN(oklch, "x", 1, 1, false, false, true, 0, "Colour red;green;blue of an OKLCh lightness;chroma;hue.")
BUILTIN(ord, "x", 1, 1, false, false, true, 0, "Unicode code points of a string.")
BUILTIN(point_towards, "direction, up", 2, 2, false, true, true, 0, "Matrix that rotates the -z axis to a direction.")
BUILTIN(polar, "x", 1, 1, false, false, true, 0, "Cosine and sine of each angle in turns.")
BUILTIN(product, "xs, w=1", 1, 2, false, true, true, 0,
        "Product of xs, or of each of w series that are interleaved in xs.")
BUILTIN(qbetween, "a, b", 2, 2, false, true, true, 0, "Quaternion that rotates direction a to direction b.")
BUILTIN(qmul, "a, b", 2, 2, false, true, true, 0, "Product of two quaternions, or a 3-vector rotated by a quaternion.")
BUILTIN(quad, "x", 1, 1, false, false, true, 1, "Easing from 0 to 1 along a parabola.")
BUILTIN(quaternion, "axis, angle", 2, 2, false, true, true, 0,
        "Quaternion that rotates by an angle, in turns, about an axis.")
BUILTIN(read, "filename", 1, 1, false, true, false, 0, "Text of a file as one string.")
BUILTIN(read_bytes, "filename", 1, 1, false, true, false, 0, "Bytes of a file as numbers.")
BUILTIN(round, "xs, ys=0", 1, 2, false, true, true, 1, "Each x rounded to ys decimals; halves are rounded away from 0.")
BUILTIN(sample, "texture_id, coord, default=null", 2, 3, false, true, false, 0,
        "Colour r;g;b;a of each point x;y, from 0;0 (bottom left) to 1;1, of the previous picture of the node with "
        "this id.")
BUILTIN(sawtooth, "x", 1, 1, false, false, true, 1, "Wave that rises from 0 to 1 in each cycle.")
BUILTIN(sharkfin, "x", 1, 1, false, false, true, 1, "Wave that rises and falls along quarter sines.")
BUILTIN(shuffle, "source, xs", 2, 2, false, true, true, 0,
        "Elements of xs in a random order that the stream source determines.")
BUILTIN(sin, "x", 1, 1, false, false, true, 1, "Sine of each angle in turns.")
BUILTIN(sine, "x", 1, 1, false, false, true, 1, "Sine wave from 0 to 1 and back in each cycle.")
BUILTIN(slerp, "t, a, b", 3, 3, false, true, true, 0,
        "Quaternion interpolated spherically from a to b, at t from 0 to 1.")
BUILTIN(snap, "x", 1, 1, false, false, true, 1, "Easing from 0 to 1 along square-root curves.")
BUILTIN(sort, "x", 1, 1, false, false, true, 0, "Numbers or strings in ascending order.")
BUILTIN(split, "text, separator=\"\\n\"", 1, 2, false, true, true, 0, "Pieces of a string between separators.")
BUILTIN(sqrt, "x", 1, 1, false, false, true, 1, "Square root of each number.")
BUILTIN(square, "x", 1, 1, false, false, true, 1,
        "Wave that is 0 in the first half of each cycle and 1 in the second half.")
BUILTIN(srt, "filename, time", 2, 2, false, true, false, 0, "Lines that a subtitle file shows at a given time.")
BUILTIN(sum, "xs, w=1", 1, 2, false, true, true, 0, "Sum of xs, or of each of w series that are interleaved in xs.")
BUILTIN(tan, "x", 1, 1, false, false, true, 1, "Tangent of each angle in turns.")
BUILTIN(triangle, "x", 1, 1, false, false, true, 1, "Wave that rises linearly to 1 and falls back in each cycle.")
BUILTIN(uniform, "value=null", 0, 1, false, true, true, 0, "Stream of random numbers from 0 to 1 for a seed.")
BUILTIN(zip, "...", 0, 0, true, false, true, 0, "Interleaved elements of several vectors.")
