// chromakey.glsl (spec pictures.md 7.5)
uniform float hue, range, saturation, brightness, hard, downsample;
uniform vec2 radius, sigma;

//: reduced
void main() {
    vec3 c = hsv_of(source(coord).rgb);
    bool key = hue - range / 2.0 < c.x && c.x < hue + range / 2.0 && c.y > saturation && c.z > brightness;
    color = vec4(key ? 0.0 : 1.0);
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
void main() { color = source_at(ivec2(0)) * pow(previous(coord), vec4(hard)) * alpha; }
