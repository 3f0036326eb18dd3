// scene.glsl: the colour of a point of a surface as the camera sees it (spec canvas3d.md 5.3, 5.5).
void main() {
#ifdef DISC
    // Computes where the ray through this point of the disc meets the sphere. The radius of the disc is sqrt(1 - near²)
    // times the radius of the sphere.
    float near = towards.w, depth = sqrt(max(1.0 - dot(across, across) / (1.0 - near * near), 0.0));
    N = (across + towards.xyz * (depth + near)) / (1.0 + near * depth);
    world = ball.xyz + ball.w * N;
#ifdef DEEP
    vec4 place = projection * (view * vec4(world, 1.0));
    gl_FragDepth = 0.5 * place.z / place.w + 0.5;
#endif
#else
    N = normalize(outwards);
#endif
    V = eye - world;
    float away = length(V), metal = surface.y, roughness = surface.z, ao = surface.w;
    float transparency = albedo_transparency.a;
    if (orthographic) {
        away = dot(V, ahead);
        V = ahead;
    } else {
        V /= away;
    }
#ifdef BACK
    V = N;
#endif
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
#ifdef BACK
    entering = vec3(0.0);
    entering_share = (1.0 - F0) * (1.0 - metal) * (1.0 + albedo) / 2.0;
#endif
    float brightness = lum(emissive);
    specular = brightness <= 1.0 ? emissive
                                 : emissive / brightness + (emissive - emissive / brightness) * nv;
    // One loop for each kind of light, because each kind needs only some of the computations.
    diffuse += diffuse_share * ambient * ao;
    for (int i = 0; i < ends[0]; i++)
        shine(LIGHT(i, 0).rgb, LIGHT(i, 3), -LIGHT(i, 2).xyz, 1.0, 1.0, true, true);
    for (int i = ends[0]; i < ends[1]; i++) {
        vec4 at = LIGHT(i, 1), towards = LIGHT(i, 2);
        vec3 Q = at.xyz - world;
        float d = length(Q), x = -dot(Q / d, towards.xyz);
        float b = 1.0 - clamp((towards.w - x) / max(towards.w - at.w, 1e-9), 0.0, 1.0);
        shine(LIGHT(i, 0).rgb, LIGHT(i, 3), Q / d, d, b, true, true);
    }
    for (int i = ends[1]; i < ends[2]; i++) {
        vec3 Q = LIGHT(i, 1).xyz - world;
        float d = length(Q);
        shine(LIGHT(i, 0).rgb, LIGHT(i, 3), Q / d, d, 1.0, true, true);
    }
    for (int i = ends[2]; i < ends[3]; i++)
        shine_ball(LIGHT(i, 0).rgb, LIGHT(i, 3), LIGHT(i, 1).xyz - world, LIGHT(i, 1).w);
    for (int i = ends[3]; i < ends[4]; i++)
        shine_line(LIGHT(i, 0).rgb, LIGHT(i, 3), LIGHT(i, 1).xyz - world, LIGHT(i, 2).xyz, LIGHT(i, 2).w,
                   LIGHT(i, 1).w);
    float fog = fog_max > fog_min && fog_curve > 0.0
                    ? pow(clamp((away - fog_min) / (fog_max - fog_min), 0.0, 1.0), 1.0 / fog_curve)
                    : 0.0;
    float opacity = 1.0 - transparency;
#ifdef TRANSLUCENT
    opacity *= come_through(emissive_translucency.a, away);
#endif
    vec3 sum = mix(diffuse, fog_color, fog) * opacity + specular * (1.0 - fog);
    if (monochrome)
        sum = vec3(lum(sum));
    color = vec4(sum * tint, opacity);
#ifdef BACK
    color = vec4(entering, away);
#endif
    if (any(isnan(color)) || any(isinf(color)))
        color = vec4(0.0);
}
