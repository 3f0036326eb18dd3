// show.glsl: draws a picture on a window: encoded as in files, scaled as in Cairo, with black around it (spec
// pictures.md 4.1).
#include "gl/colour_formulas.h"
uniform sampler2D picture, curve;
uniform vec4 box; // left, bottom, width, height
uniform bool opaque;
out vec4 color;
float limit(int n) { return texelFetch(curve, ivec2(n, 0), 0).r; }
// Returns the byte that encodes c. The byte is computed with `pow`, which is not exact, and then corrected with the
// table.
float byte_of(float c) {
    if (!(c > 0.0))
        return 0.0;
    if (c >= 1.0)
        return 255.0;
    int n = clamp(int(255.0 * SRGB_ENCODE(c, pow) + 0.5), 0, 255);
    if (c >= limit(n))
        n++;
    else if (n > 0 && c < limit(n - 1))
        n--;
    return float(n);
}
vec3 bytes_at(ivec2 p) {
    vec4 t = texelFetch(picture, clamp(p, ivec2(0), textureSize(picture, 0) - 1), 0);
    float a = opaque || !(t.a < 1.0) ? 1.0 : t.a;
    vec3 c = t.rgb / a;
    return a > 0.0 ? roundEven(vec3(byte_of(c.r), byte_of(c.g), byte_of(c.b)) * a) : vec3(0.0);
}
void main() {
    vec2 p = gl_FragCoord.xy - box.xy;
    vec2 cover = clamp(min(p + 0.5, box.zw) - max(p - 0.5, 0.0), 0.0, 1.0);
    vec2 at = p * vec2(textureSize(picture, 0)) / box.zw - 0.5, f = at - floor(at);
    ivec2 i = ivec2(floor(at));
    vec3 low = mix(bytes_at(i), bytes_at(i + ivec2(1, 0)), f.x);
    vec3 high = mix(bytes_at(i + ivec2(0, 1)), bytes_at(i + ivec2(1, 1)), f.x);
    color = vec4(floor(mix(low, high, f.y) * cover.x * cover.y + 0.5) / 255.0, 1.0);
}
