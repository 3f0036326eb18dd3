// blur.glsl (spec pictures.md 7.2)
uniform vec2 radius, sigma;

//: full
void main() {
    float r = floor(radius.x);
    color = blurred_source(r, r * sigma.x, ivec2(1, 0));
}
//: full
void main() {
    float r = floor(radius.y);
    color = blurred(r, r * sigma.y, ivec2(0, 1)) * alpha;
}
