// mesh_file.h: model files: their formats, words, lines and numbers.
#pragma once

#include "scene3d/mesh.h"

// Removes the next word from a line and returns it. Returns an empty string at the end of the line.
Str mesh_next_word(Str *line);
// Removes the next line from a text and returns it, without its newline.
Str mesh_next_line(Str *text);
// Reads a decimal number, with optional sign, point and exponent.
bool mesh_read_number(Str word, float *out);

// Read the files of these formats, as mesh_from_file does.
bool mesh_is_stl(Str bytes);
bool mesh_read_stl(Arena *arena, Str bytes, Mesh *mesh, MeshError *error);
bool mesh_read_obj(Arena *arena, Str bytes, Mesh *mesh, MeshError *error);
bool mesh_read_ply(Arena *arena, Str bytes, Mesh *mesh, MeshError *error);
bool mesh_read_off(Arena *arena, Str bytes, Mesh *mesh, MeshError *error);
