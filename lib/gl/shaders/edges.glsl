// edges.glsl (spec pictures.md 7.4)
uniform vec2 radius, sigma;
uniform float mixer, downsample;

//: reduced
void main() {
    float r = floor(floor(radius.x) / downsample);
    color = blurred_source(r, r * sigma.x, ivec2(1, 0));
}
//: reduced
void main() {
    float r = floor(floor(radius.y) / downsample);
    color = blurred(r, r * sigma.y, ivec2(0, 1));
}
//: full
void main() {
    vec4 t = source_at(ivec2(0)), b = previous(coord);
    vec4 e = vec4(abs(t.rgb - b.rgb), max(t.a, b.a));
    color = (t * mixer + e * (1.0 - t.a * mixer)) * alpha;
}
