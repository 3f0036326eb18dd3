// flare.glsl (spec pictures.md 7.10)
uniform float threshold, attenuation, upright_length, diagonal_length, halo_radius, halo_attenuation, ghosts;
uniform float aberration;

vec3 bright(vec3 c) { return c * smoothstep(0.0, 1.0, lum(c) - threshold); }

vec3 ghost(float distort, float scale, float att, float ab) {
    const vec3 spectrum[6] = vec3[6](vec3(0.1, 0.0, 0.3), vec3(0.0, 0.0, 0.5), vec3(0.0, 0.25, 0.2),
        vec3(0.0, 0.5, 0.0), vec3(0.4, 0.25, 0.0), vec3(0.5, 0.0, 0.0));
    vec2 p = (coord - 0.5) * size;
    float r = length(p), edge = length(size) / 2.0, moved = (1.0 - pow(1.0 - r / edge, distort)) * edge / scale;
    vec2 q = r > 0.0 ? moved * p / r : vec2(0.0);
    float inside = clamp(moved / edge, 0.0, 1.0), w = 1.0 - inside * inside;
    vec3 sum = vec3(0.0);
    if (ab > 0.0)
        for (int j = 0; j < 6; j++)
            sum += bright(source(0.5 + q * (1.0 + (float(j) / 5.0 - 0.5) * ab / 4.0) / size).rgb) * spectrum[j];
    else
        sum = bright(source(0.5 + q / size).rgb);
    return sum * exp2(-att) * w;
}

vec3 halo() {
    float rho = halo_radius * min(size.x, size.y) / 2.0, n = 6.283185307179586 * rho;
    vec3 sum = vec3(0.0);
    if (n <= 0.0)
        return sum;
    for (float i = 0.0; i < n; i++) {
        float angle = 6.283185307179586 * i / n;
        sum += bright(source(coord + rho * vec2(cos(angle), sin(angle)) / size).rgb);
    }
    return sum / n * exp2(-(attenuation - 0.5 + halo_attenuation));
}

vec3 streak(float n, vec2 one, vec2 other) {
    vec3 sum = vec3(0.0);
    for (float i = 0.0; i < n; i++) {
        vec2 a = i * one / size, b = i * other / size;
        vec3 most = max(max(source(coord + a).rgb, source(coord - a).rgb), max(source(coord + b).rgb, source(coord - b).rgb));
        sum += bright(most) * (1.0 - i / n) * (1.0 - i / n);
    }
    return n > 0.0 ? sum / n : sum;
}

vec3 streaks() {
    float side = min(size.x, size.y) / 2.0;
    vec3 upright = streak(upright_length * side, vec2(1.0, 0.0), vec2(0.0, 1.0));
    vec3 diagonal = streak(diagonal_length * side * sqrt(0.5), vec2(1.0, 1.0), vec2(1.0, -1.0));
    return max(upright, diagonal) * exp2(-attenuation);
}

//: reduced
void main() {
    const vec4 rows[6] = vec4[6](vec4(1.0, -1.25, 0.0, 1.0), vec4(1.5, -0.25, 0.0, 1.0), vec4(0.5, 0.25, 1.0, 1.0),
        vec4(0.75, -3.0, 2.0, 0.5), vec4(0.25, 2.0, 3.0, 0.5), vec4(1.0, -0.75, 1.0, 1.0));
    vec3 sum = halo();
    for (int i = 0; i < 6 && float(i) < ghosts; i++)
        sum += ghost(rows[i].x, rows[i].y, attenuation + rows[i].z, aberration * rows[i].w);
    color = vec4(sum, 1.0);
}
//: reduced
void main() {
    float r = floor(0.05 * min(size.x, size.y));
    color = blurred(r, 0.3 * r, ivec2(1, 0));
}
//: reduced
void main() {
    float r = floor(0.05 * min(size.x, size.y));
    color = blurred(r, 0.3 * r, ivec2(0, 1));
    color.rgb += streaks();
}
//: full
void main() {
    vec4 t = source_at(ivec2(0)), f = previous(coord);
    color = vec4(t.rgb + f.rgb, min(t.a + f.a, 1.0)) * alpha;
}
