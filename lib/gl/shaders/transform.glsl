// transform.glsl (spec pictures.md 7.7)
uniform mat3 inverse_matrix; // all elements are 0 if the matrix is not invertible

//: full
void main() {
    vec3 p = inverse_matrix * vec3((coord - 0.5) * size, 1.0);
    color = p.z == 0.0 ? vec4(0.0) : merged(p.xy / p.z / size + 0.5) * alpha;
}
