// edges.glsl (spec pictures.md 7.4)
uniform vec2 radius, sigma;
uniform float mixer, downsample;

//: reduced
void main() {
    float r = floor(floor(radius.x) / downsample);
    color = blurred_source(coord, r, r * sigma.x, vec2(1.0, 0.0));
}
//: reduced
void main() {
    float r = floor(floor(radius.y) / downsample);
    color = blurred(coord, r, r * sigma.y, vec2(0.0, 1.0));
}
//: full
void main() {
    vec4 t = source(coord), b = previous(coord);
    vec4 e = vec4(abs(t.rgb - b.rgb), max(t.a, b.a));
    color = (t * mixer + e * (1.0 - t.a * mixer)) * alpha;
}
