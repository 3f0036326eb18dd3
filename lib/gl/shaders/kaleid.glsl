// kaleid.glsl (spec pictures.md 7.11)
uniform float segments, rotation, radius;

//: full
void main() {
    const float turn = 6.283185307179586;
    vec2 p = (coord - 0.5) * size;
    float t = (atan(p.y, p.x) / turn + 0.5 - rotation) * segments, i = floor(t);
    t = mod(i, 2.0) == 0.0 ? t - i : i + 1.0 - t;
    float angle = turn * (t / segments + rotation - 0.5);
    float s = radius * min(size.x, size.y) / 2.0, r = length(p) / s, j = floor(r);
    r = (mod(j, 2.0) == 0.0 ? r - j : j + 1.0 - r) * s;
    color = merged(r * vec2(cos(angle), sin(angle)) / size + 0.5) * alpha;
}
