// scene.glsl: the colour of a point of a surface as the camera sees it (spec canvas3d.md 5.3, 5.5).
void main() {
    N = normalize(outwards);
    V = eye - world;
    float away = length(V), metal = surface.y, roughness = surface.z, ao = surface.w;
    float transparency = albedo_transparency.a;
    if (orthographic) {
        away = dot(V, ahead);
        V = ahead;
    } else {
        V /= away;
    }
    albedo = albedo_transparency.rgb;
    vec3 emissive = emissive_translucency.rgb;
#ifdef TEXTURED
    if ((textured & 1) != 0)
        albedo = covered(albedo, take(color_texture));
    if ((textured & 2) != 0)
        metal = covered(metal, take(metal_texture));
    if ((textured & 4) != 0)
        roughness = covered(roughness, take(roughness_texture));
    if ((textured & 8) != 0)
        ao = covered(ao, take(ao_texture));
    if ((textured & 16) != 0)
        emissive = covered(emissive, take(emissive_texture));
    if ((textured & 32) != 0)
        transparency = covered(transparency, take(transparency_texture));
#endif
    float f0 = (surface.x - 1.0) / (surface.x + 1.0);
    F0 = mix(vec3(f0 * f0), albedo, metal);
    alpha2 = roughness * roughness;
    alpha2 *= alpha2;
    k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    float nv = dot(N, V);
    NV = clamp(nv, 0.0, 1.0);
    GV = NV / (NV * (1.0 - k) + k);
    diffuse_share = (1.0 - F0) * (1.0 - metal) * albedo;
    diffuse = vec3(0.0);
    float brightness = lum(emissive);
    specular = brightness <= 1.0 ? emissive
                                 : emissive / brightness + (emissive - emissive / brightness) * nv;
    for (int i = 0; i < light_count; i++) {
        vec4 c = LIGHT(i, 0), at = LIGHT(i, 1), towards = LIGHT(i, 2), falloff = LIGHT(i, 3);
        if (c.a == 0.0) {
            diffuse += diffuse_share * c.rgb * ao;
        } else if (c.a == 1.0) {
            shine(c.rgb, falloff, -towards.xyz, 1.0, 1.0, true, true);
        } else if (c.a == 2.0) {
            vec3 Q = at.xyz - world;
            float d = length(Q);
            float x = -dot(Q / d, towards.xyz);
            float b = 1.0 - clamp((towards.w - x) / max(towards.w - at.w, 1e-9), 0.0, 1.0);
            shine(c.rgb, falloff, Q / d, d, b, true, true);
        } else if (c.a == 3.0) {
            shine_point(c.rgb, falloff, at.xyz - world, at.w);
        } else {
            shine_line(c.rgb, falloff, at.xyz - world, towards.xyz, towards.w, at.w);
        }
    }
    float fog = fog_max > fog_min && fog_curve > 0.0
                    ? pow(clamp((away - fog_min) / (fog_max - fog_min), 0.0, 1.0), 1.0 / fog_curve)
                    : 0.0;
    float opacity = 1.0 - transparency;
    vec3 sum = mix(diffuse, fog_color, fog) * opacity + specular * (1.0 - fog);
    if (monochrome)
        sum = vec3(lum(sum));
    color = vec4(sum * tint, opacity);
    if (any(isnan(color)) || any(isinf(color)))
        color = vec4(0.0);
}
