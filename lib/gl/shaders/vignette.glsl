// vignette.glsl (spec pictures.md 7.8)
uniform float inset;
uniform int fade; // 0 linear, 1 quad, 2 cubic

float eased(float x) {
    x = clamp(x, 0.0, 1.0);
    float y = 1.0 - x;
    return fade == 1 ? (x < 0.5 ? 2.0 * x * x : 1.0 - 2.0 * y * y)
         : fade == 2 ? (x < 0.5 ? 4.0 * x * x * x : 1.0 - 4.0 * y * y * y) : x;
}

float share(float x) { return inset <= 0.0 ? 1.0 : x < inset ? x / inset : x > 1.0 - inset ? (1.0 - x) / inset : 1.0; }

//: full
void main() { color = merged_here() * eased(share(coord.x)) * eased(share(coord.y)) * alpha; }
