// scene_vertex.glsl: transforms a vertex of a model by the matrix of an instance (spec canvas3d.md 1.4).
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in mat4 model;
layout(location = 7) in mat3 cofactors;
layout(location = 10) in vec4 albedo_given;
layout(location = 11) in vec4 emissive_given;
layout(location = 12) in vec4 surface_given;
uniform mat4 view, projection;
#ifdef DISC
out vec3 across;
flat out vec4 ball, towards;
#else
out vec3 world, outwards;
#endif
out vec2 coord;
flat out vec4 albedo_transparency, emissive_translucency, surface;

void main() {
    vec4 p = model * vec4(position, 1.0);
#ifdef DISC
    ball = vec4(cofactors[0], cofactors[1].x);
    towards = vec4(model[2].xyz, cofactors[1].y);
    across = (p.xyz - model[3].xyz) / ball.w;
#else
    world = p.xyz;
    outwards = cofactors * normal;
    float size = max(max(abs(outwards.x), abs(outwards.y)), abs(outwards.z));
    outwards = size > 0.0 ? normalize(outwards / size) : vec3(0.0);
#endif
    coord = uv;
    albedo_transparency = albedo_given;
    emissive_translucency = emissive_given;
    surface = surface_given;
    gl_Position = projection * (view * p);
}
