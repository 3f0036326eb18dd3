// scene_through.glsl: light transmitted through translucent bodies (spec canvas3d.md 5.6).
uniform sampler2D backs; // rgb: light that enters through the back face; a: distance of the back face
uniform mat4 view, projection;

// Adds the transmitted light, and returns the remaining opacity. The light is sampled around the point of the back face
// behind this point, along a spiral with Gaussian density. The sampled area grows with the thickness of the body.
float come_through(float translucency, float away) {
    vec4 sum = texelFetch(backs, ivec2(gl_FragCoord.xy), 0);
    if (sum.a <= away)
        return 0.0;
    float thick = sum.a - away, x = clamp(thick / (5.0 * translucency), 0.01, 0.99), number = 1.0;
    float width = thick * thick / (5.0 * translucency);
    vec3 middle = world - thick * V;
    vec3 right = vec3(view[0][0], view[1][0], view[2][0]), up = vec3(view[0][1], view[1][1], view[2][1]);
    int count = int(256.0 * x * (1.0 - x));
    for (int i = 0; i < count; i++) {
        float r = width * sqrt(-2.0 * log(1.0 - (float(i) + 0.5) / float(count))), angle = 2.399963 * float(i);
        vec4 p = projection * (view * vec4(middle + r * (cos(angle) * right + sin(angle) * up), 1.0));
        vec2 at = (0.5 * p.xy / p.w + 0.5) * vec2(textureSize(backs, 0));
        if (p.w > 0.0 && all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(textureSize(backs, 0))))) {
            vec4 back = texelFetch(backs, ivec2(at), 0);
            if (back.a > away) {
                sum += back;
                number += 1.0;
            }
        }
    }
    sum /= number;
    float T = exp2((away - sum.a) / translucency);
    specular += sum.rgb * albedo * (T * (1.0 - T));
    return 1.0 - T * T * T * T * T;
}
