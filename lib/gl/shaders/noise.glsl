// noise.glsl (spec pictures.md 7.9)
uniform float seed, components, octaves, roughness, z, multiplier, offset;
uniform vec2 origin;
uniform vec3 scale, tscale;
uniform vec4 other; // the attribute `default`
uniform int shape;  // 0 plane, 1 cylinder, 2 sphere

float perm(float t) {
    t = mod(t, 289.0);
    return t * (34.0 * t + 133.0);
}

vec3 direction(float g) {
    vec3 cube = 2.0 * mod(floor(vec3(g, g / 2.0, g / 4.0)), 2.0) - 1.0, o = cube;
    float axis = floor(g / 16.0), k = 1.0;
    o[int(axis)] = 0.0;
    vec3 r = cube;
    if (mod(floor(g / 8.0), 2.0) == 1.0) {
        r = o + cross(cube, o);
        k = 1.0 - 0.042942436724648037;
    }
    return (1.22474487139 * o + r) * k * 3.5946317686139184;
}

float corner(float h, vec3 q, vec3 v) {
    vec3 d = q - v;
    float near = max(0.0, 0.75 - dot(d, d));
    return near * near * near * near * dot(d, direction(mod(perm(perm(perm(h + v.x) + v.y) + v.z), 48.0)));
}

float lattice(float h, vec3 q) {
    vec3 b = floor(q), f = q - b;
    vec3 s = floor(vec3(-f.x + f.y + f.z, f.x - f.y + f.z, f.x + f.y - f.z) / 4.0 + 0.875);
    return corner(h, q, b + floor((f.x + f.y + f.z) / 4.0 + 0.625))
        + corner(h, q, b + vec3(1.0, 0.0, 0.0) + vec3(-1.0, 1.0, 1.0) * s.x)
        + corner(h, q, b + vec3(0.0, 1.0, 0.0) + vec3(1.0, -1.0, 1.0) * s.y)
        + corner(h, q, b + vec3(0.0, 0.0, 1.0) + vec3(1.0, 1.0, -1.0) * s.z);
}

float noise(float h, vec3 p) {
    const float a = 0.788675134594813, b = -0.211324865405187, c = 0.577350269189626;
    vec3 q = shape == 0 ? mat3(a, b, -c, b, a, -c, c, c, c) * p : (p.x + p.y + p.z) * 2.0 / 3.0 - p;
    return lattice(h, q) + lattice(h, q + 144.5);
}

vec3 point() {
    const float turn = 6.283185307179586;
    float u = coord.x * turn, around = size.x / turn, lat = (coord.y - 0.5) * turn / 2.0;
    if (shape == 1)
        return vec3(around * vec2(cos(u), sin(u)), coord.y * size.y);
    if (shape == 2)
        return around * vec3(cos(lat) * cos(u), cos(lat) * sin(u), sin(lat));
    return vec3(coord * size, 0.0);
}

//: full
void main() {
    vec3 p = (point() + vec3(origin, z) + merged_here().rgb * tscale) * scale;
    float h = seed;
    vec4 made = other; // WebGL does not allow dynamic indexing of an `out` variable
    for (int j = 0; j < 4 && float(j) < components; j++) {
        float sum = 0.0, total = 0.0, k = 1.0;
        for (float i = 0.0; i < octaves; i++) {
            sum += k * noise(h, p / k);
            total += k;
            k *= roughness;
        }
        made[j] = sum / total * multiplier + offset;
        h = perm(h + 1.0);
    }
    color = made * alpha;
}
