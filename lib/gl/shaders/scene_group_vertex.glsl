// scene_group_vertex.glsl: the vertex shader of a group that has only a fragment shader. The names of inputs and outputs
// are those of Flitter.
in vec3 model_position, model_normal;
in vec2 model_uv;
in mat4 model_matrix;
in mat3 model_normal_matrix;
in vec4 material_albedo, material_emissive, material_properties;
uniform mat4 pv_matrix;
out vec3 world_position, world_normal;
out vec2 texture_uv;
flat out vec4 fragment_albedo, fragment_emissive, fragment_properties;

void main() {
    vec4 place = model_matrix * vec4(model_position, 1.0);
    world_position = place.xyz;
    world_normal = model_normal_matrix * model_normal;
    texture_uv = model_uv;
    fragment_albedo = material_albedo;
    fragment_emissive = material_emissive;
    fragment_properties = material_properties;
    gl_Position = pv_matrix * place;
}
