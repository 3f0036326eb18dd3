// bloom.glsl (spec pictures.md 7.3)
uniform vec2 radius, sigma;
uniform float exposure, contrast, brightness, shadows, highlights, downsample;

//: reduced
void main() {
    vec4 t = source(coord);
    color = vec4(adjusted(unpremultiplied(t), exposure, contrast, brightness, shadows, highlights) * t.a, t.a);
}
//: reduced
void main() {
    float r = floor(floor(radius.x) / downsample);
    color = blurred(r, r * sigma.x, ivec2(1, 0));
}
//: reduced
void main() {
    float r = floor(floor(radius.y) / downsample);
    color = blurred(r, r * sigma.y, ivec2(0, 1));
}
//: full
void main() { color = max(source_at(ivec2(0)), previous(coord)) * alpha; }
