// feedback.glsl (spec pictures.md 7.6)
uniform float timebase, mixer, glow, rotate, beats;
uniform vec2 translate, scale;
uniform bool past; // true if there is a previous frame

//: full
void main() {
    float t = beats / timebase, angle = 6.283185307179586 * rotate * t;
    vec2 q = (coord - 0.5) * size / pow(scale, vec2(t));
    q = vec2(q.x * cos(angle) - q.y * sin(angle), q.x * sin(angle) + q.y * cos(angle)) + vec2(-translate.x, translate.y) * t;
    float k = mixer > 0.0 ? pow(mixer, t) : 0.0;
    vec4 before = past ? previous(q / size + 0.5) : vec4(0.0);
    color = ((1.0 - k) * merged_here() * (1.0 + glow) + k * before) * alpha;
}
