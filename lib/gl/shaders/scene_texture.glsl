// scene_texture.glsl: texture maps of surfaces (spec canvas3d.md 5.2).
uniform sampler2D color_texture, metal_texture, roughness_texture, ao_texture, emissive_texture, transparency_texture;
uniform int textured; // one bit for each texture map that is set
uniform bool bordered;
uniform bvec2 repeated;
uniform vec4 border;

vec4 texel(sampler2D t, ivec2 p) {
    ivec2 s = textureSize(t, 0);
    if (bordered)
        return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, s)) ? texelFetch(t, p, 0) : border;
    ivec2 r = (p % s + s) % s, c = clamp(p, ivec2(0), s - 1);
    return texelFetch(t, ivec2(repeated.x ? r.x : c.x, repeated.y ? r.y : c.y), 0);
}
vec4 take(sampler2D t) {
    if (!bordered && !any(repeated))
        return texture(t, coord);
    vec2 p = coord * vec2(textureSize(t, 0)) - 0.5, f = fract(p);
    ivec2 i = ivec2(floor(p));
    vec4 low = mix(texel(t, i), texel(t, i + ivec2(1, 0)), f.x);
    vec4 high = mix(texel(t, i + ivec2(0, 1)), texel(t, i + ivec2(1, 1)), f.x);
    return mix(low, high, f.y);
}
vec3 covered(vec3 value, vec4 t) { return value * (1.0 - clamp(t.a, 0.0, 1.0)) + t.rgb; }
float covered(float value, vec4 t) {
    return value * (1.0 - clamp(t.a, 0.0, 1.0)) + clamp(lum(t.rgb), 0.0, 1.0);
}
