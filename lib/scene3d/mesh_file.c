// mesh_file.c: reads triangles from files and lists (spec canvas3d.md 8); see mesh.h.
//
// Sizes that are stored in a file are never trusted, but checked against the length of the file.
#include "scene3d/mesh_file.h"

#include "base/hash_index.h"
#include "base/number.h"
#include "scene3d/matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool mesh_from_lists(Arena *arena, const double *vertices, uint32_t vertex_numbers, const double *faces,
                     uint32_t face_numbers, const double *uv, uint32_t uv_numbers, Mesh *mesh, const char **problem) {
    uint32_t count = vertex_numbers / 3;
    *problem = "'vertices' needs three numbers per vertex, 'faces' three per face and 'uv' two per vertex";
    if (vertex_numbers % 3 || face_numbers % 3 || count == 0 || face_numbers == 0 ||
        (uv_numbers && uv_numbers != 2 * count))
        return false;
    *mesh = (Mesh){arena_alloc_array(arena, count, sizeof(MeshVertex)),
                   arena_alloc_array(arena, face_numbers, sizeof(uint32_t)), count, face_numbers};
    double(*normals)[3] = arena_alloc_array(arena, count, sizeof *normals);
    memset(normals, 0, count * sizeof *normals);
    *problem = "'faces' refers to a vertex that does not exist";
    for (uint32_t i = 0; i < face_numbers; i++) {
        double number = floor(faces[i]);
        if (!(number >= 0 && number < count))
            return false;
        mesh->indices[i] = (uint32_t)number;
    }
    for (uint32_t i = 0; i < face_numbers; i += 3) {
        const double *a = vertices + 3 * (size_t)mesh->indices[i], *b = vertices + 3 * (size_t)mesh->indices[i + 1],
                     *c = vertices + 3 * (size_t)mesh->indices[i + 2];
        double one[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, two[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        vector_cross(one, two, one); // the length of the product is twice the area, so large triangles weigh more
        for (uint32_t k = 0; k < 9; k++)
            normals[mesh->indices[i + k / 3]][k % 3] += one[k % 3];
    }
    for (uint32_t i = 0; i < count; i++) {
        MeshVertex *vertex = &mesh->vertices[i];
        *vertex = (MeshVertex){.uv = {0}};
        vector_normalise(normals[i]);
        for (int k = 0; k < 3; k++) {
            vertex->position[k] = (float)vertices[3 * (size_t)i + (size_t)k];
            vertex->normal[k] = (float)normals[i][k];
        }
        for (int k = 0; uv_numbers && k < 2; k++)
            vertex->uv[k] = (float)uv[2 * (size_t)i + (size_t)k];
    }
    return true;
}

static bool read_floats(Str line, int min, int max, float *out) {
    for (int k = 0; k < max; k++) {
        Str word = mesh_next_word(&line);
        if (word.len == 0)
            return k >= min;
        if (!mesh_read_number(word, &out[k]))
            return false;
    }
    return true;
}

// A list of vectors with a fixed number of floats.
typedef struct Floats {
    float *items;
    uint32_t count;
    uint32_t capacity;
} Floats;

static float *add_floats(Arena *arena, Floats *list, uint32_t size) {
    list->items = arena_grow_array(arena, list->items, list->count, &list->capacity, size * sizeof(float));
    float *out = list->items + (size_t)size * list->count++;
    memset(out, 0, size * sizeof *out);
    return out;
}

typedef struct Corner {
    uint32_t parts[3]; // position, texture coordinates and normal, each numbered from 1 in its list; 0: none
} Corner;

typedef struct Obj {
    Arena *arena;
    Floats lists[3]; // vectors of v, vt and vn lines
    Corner *corners; // three per triangle
    uint32_t count;
    uint32_t capacity;
    bool normals; // true if all corners have normals
    const char *problem;
} Obj;

static bool fail_parse(Obj *obj, const char *problem) {
    obj->problem = problem;
    return false;
}

static const char corner_form[] = "a corner of a face is written 1, 1/2, 1//3 or 1/2/3";
static const char too_large[] = "there are more than 12 million corners";

// Reads "a", "a/b", "a//c" or "a/b/c". Negative numbers count from the end of the list so far.
static bool read_corner(Obj *obj, Str word, Corner *out) {
    size_t at = 0;
    *out = (Corner){{0}};
    for (int part = 0; part < 3 && at <= word.len; part++) {
        bool minus = at < word.len && word.bytes[at] == '-';
        size_t start = at += minus;
        int64_t number = 0;
        for (; at < word.len && word.bytes[at] >= '0' && word.bytes[at] <= '9' && number < UINT32_MAX; at++)
            number = 10 * number + (word.bytes[at] - '0');
        int64_t count = obj->lists[part].count;
        number = minus ? count + 1 - number : number;
        if (at > start && (number < 1 || number > count))
            return fail_parse(obj, part == 0   ? "a face refers to a vertex that does not exist"
                                   : part == 1 ? "a face refers to texture coordinates (vt) that do not exist"
                                               : "a face refers to a normal (vn) that does not exist");
        if (at == start && (minus || part == 0))
            return fail_parse(obj, corner_form);
        out->parts[part] = at > start ? (uint32_t)number : 0;
        if (at < word.len && word.bytes[at] != '/')
            return fail_parse(obj, corner_form);
        at++;
    }
    return at >= word.len || fail_parse(obj, corner_form);
}

static void add_corner(Obj *obj, Corner corner) {
    obj->corners = arena_grow_array(obj->arena, obj->corners, obj->count, &obj->capacity, sizeof corner);
    obj->corners[obj->count++] = corner;
    obj->normals &= corner.parts[2] != 0;
}

static bool read_face(Obj *obj, Str line) {
    Corner first = {{0}}, before = {{0}}, corner;
    int count = 0;
    for (Str word; (word = mesh_next_word(&line)).len > 0; count++) {
        if (!read_corner(obj, word, &corner))
            return false;
        if (obj->count > MESH_MAX_CORNERS)
            return fail_parse(obj, too_large);
        if (count == 0)
            first = corner;
        if (count >= 2) {
            add_corner(obj, first);
            add_corner(obj, before);
            add_corner(obj, corner);
        }
        before = corner;
    }
    return count >= 3 || fail_parse(obj, "a face needs at least three corners");
}

static bool read_obj_line(Obj *obj, Str line) {
    static const struct {
        const char *name;
        int min;
        int size;
        const char *form;
    } lists[] = {{"v", 3, 3, "'v' needs three numbers"},
                 {"vt", 1, 2, "'vt' needs one or two numbers"},
                 {"vn", 3, 3, "'vn' needs three numbers"}};
    Str word = mesh_next_word(&line);
    for (int i = 0; i < 3; i++) {
        if (!str_equal(word, str_from(lists[i].name)))
            continue;
        if (obj->lists[i].count >= MESH_MAX_CORNERS)
            return fail_parse(obj, too_large);
        float *out = add_floats(obj->arena, &obj->lists[i], (uint32_t)lists[i].size);
        return read_floats(line, lists[i].min, lists[i].size, out) || fail_parse(obj, lists[i].form);
    }
    return !str_equal(word, STR("f")) || read_face(obj, line);
}

static bool is_corner(const void *owner, uint32_t entry, const void *key) {
    return memcmp(&((const Corner *)owner)[entry], key, sizeof(Corner)) == 0;
}

static void set_vertex(const Obj *obj, const Corner *corner, MeshVertex *vertex) {
    *vertex = (MeshVertex){.uv = {0}};
    memcpy(vertex->position, obj->lists[0].items + 3 * (size_t)(corner->parts[0] - 1), sizeof vertex->position);
    if (corner->parts[1])
        memcpy(vertex->uv, obj->lists[1].items + 2 * (size_t)(corner->parts[1] - 1), sizeof vertex->uv);
    if (corner->parts[2])
        memcpy(vertex->normal, obj->lists[2].items + 3 * (size_t)(corner->parts[2] - 1), sizeof vertex->normal);
}

// Returns the next line of an OBJ file, with all lines that continue it after a `\` at the end of a line. Comments are
// not continued, because they can end with the name of a folder. Adds the number of lines to *number.
static Str next_obj_line(Arena *arena, Str *bytes, uint32_t *number) {
    Str line = mesh_next_line(bytes);
    ++*number;
    Text joined = text_new(arena);
    for (Str part = line; part.len > 0 && *line.bytes != '#'; part = mesh_next_line(bytes), ++*number) {
        size_t len = part.len - (part.bytes[part.len - 1] == '\r');
        bool continues = len > 0 && part.bytes[len - 1] == '\\';
        if (!continues && joined.len == 0)
            return line;
        text_add(&joined, (Str){part.bytes, continues ? len - 1 : len});
        if (!continues || bytes->len == 0)
            break;
        text_add_c(&joined, " ");
    }
    return joined.len ? text_str(&joined) : line;
}

bool mesh_read_obj(Arena *arena, Str bytes, Mesh *mesh, MeshError *error) {
    Obj obj = {.arena = arena, .normals = true};
    for (uint32_t line = 0; bytes.len > 0;) {
        uint32_t first = line + 1;
        if (!read_obj_line(&obj, next_obj_line(arena, &bytes, &line))) {
            *error = (MeshError){obj.problem, first};
            return false;
        }
    }
    *error = (MeshError){"it contains no triangles", 0};
    if (obj.count == 0)
        return false;
    // Creates a vertex for each distinct corner.
    Corner *different = arena_alloc_array(arena, obj.count, sizeof *different);
    *mesh = (Mesh){.vertices = arena_alloc_array(arena, obj.count, sizeof(MeshVertex)),
                   .indices = arena_alloc_array(arena, obj.count, sizeof(uint32_t)),
                   .index_count = obj.count};
    HashIndex index = {0};
    for (uint32_t i = 0; i < obj.count; i++) {
        uint64_t hash = hash_bytes(0, &obj.corners[i], sizeof(Corner));
        uint32_t found = hash_index_find(&index, hash, is_corner, different, &obj.corners[i]);
        if (found == HASH_INDEX_NONE) {
            found = mesh->vertex_count++;
            different[found] = obj.corners[i];
            set_vertex(&obj, &obj.corners[i], &mesh->vertices[found]);
            if (!hash_index_add(&index, hash, found)) {
                hash_index_free(&index);
                arena_exhausted(arena);
            }
        }
        mesh->indices[i] = found;
    }
    hash_index_free(&index);
    if (!obj.normals)
        mesh_snap(arena, mesh, 0.5);
    return true;
}

// Adds the three corners of a triangle. The normals in the file are not used.
static bool add_stl_triangle(Arena *arena, Floats *list, const float corners[9]) {
    for (int k = 0; k < 9; k++)
        if (!(fabsf(corners[k]) < 1e30f))
            return false;
    if (list->count >= MESH_MAX_CORNERS)
        return false;
    for (int i = 0; i < 3; i++)
        memcpy(add_floats(arena, list, 3), corners + 3 * i, 3 * sizeof *corners);
    return true;
}

static bool read_stl_text(Arena *arena, Str bytes, Floats *list, MeshError *error) {
    float corners[9];
    int count = 0;
    for (error->line = 1; bytes.len > 0; error->line++) {
        Str line = mesh_next_line(&bytes), word = mesh_next_word(&line);
        if (str_equal(word, STR("vertex"))) {
            error->text = "'vertex' needs three numbers, and a loop needs three vertices";
            if (count == 3 || !read_floats(line, 3, 3, corners + 3 * count))
                return false;
            count++;
        } else if (str_equal(word, STR("endloop"))) {
            error->text = count == 3 ? too_large : "a loop needs three vertices";
            if (count != 3 || !add_stl_triangle(arena, list, corners))
                return false;
            count = 0;
        }
    }
    error->text = "the file ends within a loop, before 'endloop'";
    error->line--;
    return count == 0;
}

static uint32_t little_endian(const char *bytes) {
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
}

enum { STL_HEAD = 84, STL_TRIANGLE = 50 };

static bool is_binary_stl(Str bytes) {
    return bytes.len >= STL_HEAD &&
           (bytes.len - STL_HEAD) / STL_TRIANGLE == little_endian(bytes.bytes + STL_HEAD - 4) &&
           (bytes.len - STL_HEAD) % STL_TRIANGLE == 0;
}

static bool read_stl_binary(Arena *arena, Str bytes, Floats *list) {
    for (size_t at = STL_HEAD; at < bytes.len; at += STL_TRIANGLE) {
        float corners[9];
        for (size_t k = 0; k < 9; k++) {
            uint32_t bits = little_endian(bytes.bytes + at + 12 + 4 * k);
            memcpy(&corners[k], &bits, sizeof bits);
        }
        if (!add_stl_triangle(arena, list, corners))
            return false;
    }
    return true;
}

bool mesh_is_stl(Str bytes) {
    return is_binary_stl(bytes) || str_starts_with(bytes, STR("solid"));
}

bool mesh_read_stl(Arena *arena, Str bytes, Mesh *mesh, MeshError *error) {
    Floats list = {0};
    *error = (MeshError){"a coordinate is out of range, or there are more than 4 million triangles", 0};
    if (is_binary_stl(bytes) ? !read_stl_binary(arena, bytes, &list) : !read_stl_text(arena, bytes, &list, error))
        return false;
    *error = (MeshError){"it contains no triangles", 0};
    if (list.count == 0)
        return false;
    *mesh = (Mesh){.vertices = arena_alloc_array(arena, list.count, sizeof(MeshVertex)),
                   .indices = arena_alloc_array(arena, list.count, sizeof(uint32_t)),
                   .vertex_count = list.count,
                   .index_count = list.count};
    for (uint32_t i = 0; i < list.count; i++) {
        mesh->vertices[i] = (MeshVertex){.uv = {0}};
        memcpy(mesh->vertices[i].position, list.items + 3 * (size_t)i, sizeof mesh->vertices[i].position);
        mesh->indices[i] = i;
    }
    mesh_snap(arena, mesh, 0.5);
    return true;
}
