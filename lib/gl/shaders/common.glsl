// common.glsl: functions of all effects (spec pictures.md 6). It follows the text of input_composite.c and effect.c,
// which defines take, merged, source and previous.
float lum(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

vec3 unpremultiplied(vec4 c) { return c.a > 0.0 ? c.rgb / c.a : vec3(0.0); }

vec3 adjusted(vec3 c, float exposure, float contrast, float brightness, float shadows, float highlights) {
    c = c * exp2(exposure) * contrast + brightness + (1.0 - contrast) / 2.0;
    float l = lum(c);
    return c * exp2(shadows * clamp(4.0 * (0.25 - l), 0.0, 1.0)) * exp2(highlights * clamp(2.0 * (l - 0.5), 0.0, 1.0));
}

vec3 hsv_of(vec3 c) {
    float v = max(c.r, max(c.g, c.b)), x = v - min(c.r, min(c.g, c.b)), h = 0.0;
    if (x > 0.0)
        h = v == c.r ? (c.g - c.b) / x : v == c.g ? 2.0 + (c.b - c.r) / x : 4.0 + (c.r - c.g) / x;
    return vec3(fract(h / 6.0 + 1.0), x / (v + 1e-10), v);
}

vec3 rgb_of(vec3 hsv) {
    vec3 k = clamp(abs(6.0 * fract(hsv.x + vec3(1.0, 2.0 / 3.0, 1.0 / 3.0)) - 3.0) - 1.0, 0.0, 1.0);
    return hsv.z * (1.0 - hsv.y + hsv.y * k);
}

// A Gaussian blur over 2r+1 pixels of this pass's target along an axis. Weights exp(-i^2/2sigma^2) are computed
// incrementally.
// previous_at needs a previous pass of the same size.
#define BLUR(NAME, AT) \
vec4 NAME(float r, float sigma, ivec2 axis) { \
    vec4 sum = AT(ivec2(0)); \
    if (r < 1.0 || sigma <= 0.0) \
        return sum; \
    float w = 1.0, total = 1.0, ratio = exp(-0.5 / (sigma * sigma)), change = ratio * ratio; \
    for (int i = 1; i <= int(r); i++) { \
        w *= ratio; \
        ratio *= change; \
        sum += w * (AT(i * axis) + AT(-i * axis)); \
        total += 2.0 * w; \
    } \
    return sum / total; \
}
BLUR(blurred_source, source_at)
BLUR(blurred, previous_at)
