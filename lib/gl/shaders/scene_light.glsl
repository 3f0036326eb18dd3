// scene_light.glsl: lighting of a surface point (spec canvas3d.md 5.3, 5.4).
#ifdef DISC
in vec3 across;                // vector from the centre of the disc to this point, in radii of the sphere
flat in vec4 ball, towards;    // ball: centre and radius; towards: direction to the camera, and radius / distance
vec3 world;
#ifdef DEEP
uniform mat4 view, projection;
#endif
#else
in vec3 world, outwards;
#endif
in vec2 coord;
flat in vec4 albedo_transparency, emissive_translucency, surface;
out vec4 color;

uniform vec3 eye, ahead; // eye: position of the camera; ahead: direction from the focus to the camera
uniform bool orthographic, monochrome;
uniform float fog_min, fog_max, fog_curve;
uniform vec3 fog_color, tint;
uniform vec3 ambient;
uniform int ends[5]; // for directional, spot, point, ball and line lights: index after the last light of the kind

#ifdef MANY_LIGHTS
uniform highp sampler2D lights;
#define LIGHT(i, k) texelFetch(lights, ivec2(4 * ((i) & 255) + (k), (i) >> 8), 0)
#else
layout(std140) uniform Lights { vec4 lights[LIGHTS_MAX * 4]; };
#define LIGHT(i, k) lights[4 * (i) + (k)]
#endif

#include "gl/colour_formulas.h"
float lum(vec3 c) { return dot(c, vec3(LUMINANCE_WEIGHTS)); }

vec3 N, V, albedo, F0, diffuse_share, diffuse, specular;
#ifdef BACK
vec3 entering, entering_share;
#endif
float alpha2, k, NV, GV;

// Adds light of colour c from direction L and distance d, scaled by b. Adds the diffuse part if `first`, and the
// specular part if `last`.
void shine(vec3 c, vec4 falloff, vec3 L, float d, float b, bool first, bool last) {
    float NL = clamp(dot(N, L), 0.0, 1.0);
    vec3 I = c * (b * NL / (falloff.x + d * (falloff.y + d * (falloff.z + d * falloff.w))));
    float most = max(max(abs(I.r), abs(I.g)), abs(I.b));
    if (NL == 0.0 || most < (last ? 1e-3 * alpha2 : 1e-3))
        return;
    if (first)
        diffuse += I * diffuse_share;
#ifdef BACK
    if (first)
        entering += I * entering_share;
#endif
    if (last) {
        vec3 H = normalize(V + L);
        float HV = clamp(dot(H, V), 0.0, 1.0), NH = clamp(dot(N, H), 0.0, 1.0), rest = 1.0 - HV;
        float rest2 = rest * rest;
        vec3 F = F0 + (1.0 - F0) * (rest2 * rest2 * rest);
        float denominator = NH * NH * (alpha2 - 1.0) + 1.0;
        float D = alpha2 / (denominator * denominator);
        float G = GV * NL / (NL * (1.0 - k) + k);
        specular += I * F * (D * G / (4.0 * NV * NL + 1e-6));
    }
}

void shine_ball(vec3 c, vec4 falloff, vec3 Q, float r) {
    float away = length(Q);
    float b = clamp(1.0 - r / away, 0.005, 1.0);
    shine(c, falloff, Q / away, away - min(r, 0.99 * away), b, true, false);
    vec3 R = V - 2.0 * dot(V, N) * N;
    vec3 l = dot(Q, R) * R - Q;
    vec3 near = Q + l * min(0.99, r / length(l));
    away = length(near);
    shine(c, falloff, near / away, away, b, false, true);
}

void shine_line(vec3 c, vec4 falloff, vec3 Q, vec3 a, float len, float r) {
    float qn = dot(Q, N), an = dot(a, N);
    float cp = clamp(-dot(Q, a), 0.0, len), ip = clamp(-qn / an, 0.0, len), middle = len / 2.0;
    if (qn < 0.0) {
        middle = (ip + len) / 2.0;
        cp = max(cp, ip);
    } else if (qn + len * an < 0.0) {
        middle = ip / 2.0;
        cp = min(cp, ip);
    }
    vec3 near = Q + a * ((3.0 * cp + middle) / 4.0);
    float away = length(near);
    shine(c, falloff, near / away, away - min(r, 0.99 * away), clamp(1.0 - r / away, 0.0, 1.0), true, false);
    vec3 R = V - 2.0 * dot(V, N) * N;
    float s = dot(R, a), beta = (dot(Q, a) - s * dot(Q, R)) / (1.0 - s * s);
    near = Q + clamp(-beta, 0.0, len) * a;
    vec3 l = dot(near, R) * R - near;
    away = length(near);
    float b = clamp(1.0 - r / away, 0.0, 1.0);
    near += l * min(0.99, r / away);
    away = length(near);
    shine(c, falloff, near / away, away, b, false, true);
}
