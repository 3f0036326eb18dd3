// plain.glsl (spec pictures.md 3.6)
//: full
void main() { color = merged_here() * alpha; }
