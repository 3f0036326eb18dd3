// adjust.glsl (spec pictures.md 7.1)
uniform float hue, saturation, exposure, contrast, brightness, shadows, highlights, gamma, whitepoint;
uniform mat3 color_matrix;
uniform int tonemap; // 1 reinhard, 2 aces, 3 agx, 4 agx_punchy

vec3 aces(vec3 c) {
    vec3 x = c * mat3(0.59719, 0.35458, 0.04823, 0.07600, 0.90834, 0.01566, 0.02840, 0.13383, 0.83777);
    vec3 y = (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081);
    return y * mat3(1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605, -0.00327, -0.07276, 1.07602);
}

vec3 agx(vec3 c) {
    const mat3 inset = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992,
        0.878468636469772, 0.0784336, 0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 outset = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368,
        1.15190312990417, -0.0980434501171241, -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    vec3 x = (clamp(log2(inset * c), -12.47393, 4.026069) + 12.47393) / 16.499999;
    vec3 y = ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
    if (tonemap == 4) {
        float l = lum(y);
        y = l + 1.4 * (pow(max(y, 0.0), vec3(1.35)) - l);
    }
    return outset * y;
}

vec3 toned(vec3 c) {
    if (tonemap == 1)
        return c / (1.0 + c) * (whitepoint > 1.0 ? 1.0 + c / (whitepoint * whitepoint) : vec3(1.0));
    return tonemap == 2 ? aces(c) : tonemap >= 3 ? agx(c) : c;
}

//: full
void main() {
    vec4 m = merged_here();
    vec3 hsv = hsv_of(color_matrix * unpremultiplied(m));
    vec3 c = rgb_of(vec3(hsv.x + hue, hsv.y * saturation, hsv.z));
    c = max(adjusted(c, exposure, contrast, brightness, shadows, highlights), 0.0);
    color = vec4(toned(pow(c, vec3(gamma))) * m.a, m.a) * alpha;
}
