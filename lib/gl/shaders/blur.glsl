// blur.glsl (spec pictures.md 7.2)
uniform vec2 radius, sigma;

//: full
void main() {
    float r = floor(radius.x);
    color = blurred_source(coord, r, r * sigma.x, vec2(1.0, 0.0));
}
//: full
void main() {
    float r = floor(radius.y);
    color = blurred(coord, r, r * sigma.y, vec2(0.0, 1.0)) * alpha;
}
