// mesh_polygons.c: reads PLY and OFF files, which consist of vertices and polygons; see mesh_file.h.
//
// Counts that are stored in a file only end loops that read the file, so a wrong count cannot allocate memory.
#include "scene3d/mesh_file.h"

#include <math.h>
#include <string.h>

typedef struct Polygons {
    Arena *arena;
    MeshVertex *vertices;
    uint32_t vertex_count;
    uint32_t vertex_capacity;
    uint32_t *indices;
    uint32_t index_count;
    uint32_t index_capacity;
    bool normals;      // true if the vertices have normals
    uint32_t first;    // corners of the current polygon
    uint32_t previous; // the last corner read
    uint32_t corners;  // number of corners read
    const char *problem;
} Polygons;

static bool fail(Polygons *polygons, const char *problem) {
    polygons->problem = problem;
    return false;
}

static MeshVertex *add_vertex(Polygons *polygons) {
    if (polygons->vertex_count >= MESH_MAX_CORNERS) {
        fail(polygons, "there are more than 12 million vertices");
        return NULL;
    }
    polygons->vertices = arena_grow_array(polygons->arena, polygons->vertices, polygons->vertex_count,
                                          &polygons->vertex_capacity, sizeof *polygons->vertices);
    MeshVertex *vertex = &polygons->vertices[polygons->vertex_count++];
    *vertex = (MeshVertex){.uv = {0}};
    return vertex;
}

// Adds a corner to the current polygon, and a triangle if it is at least the third one.
static bool add_corner(Polygons *polygons, double number) {
    if (!(number >= 0 && number < polygons->vertex_count))
        return fail(polygons, "a face refers to a vertex that does not exist");
    if (polygons->index_count > MESH_MAX_CORNERS - 3)
        return fail(polygons, "there are more than 4 million triangles");
    uint32_t corner = (uint32_t)number, triangle[3] = {polygons->first, polygons->previous, corner};
    polygons->previous = corner;
    if (polygons->corners++ == 0)
        polygons->first = corner;
    for (int k = 0; k < 3 && polygons->corners > 2; k++) {
        polygons->indices = arena_grow_array(polygons->arena, polygons->indices, polygons->index_count,
                                             &polygons->index_capacity, sizeof *polygons->indices);
        polygons->indices[polygons->index_count++] = triangle[k];
    }
    return true;
}

static bool finish(Polygons *polygons, Mesh *mesh, MeshError *error) {
    *error = (MeshError){"it contains no triangles", 0};
    *mesh = (Mesh){.vertices = polygons->vertices,
                   .indices = polygons->indices,
                   .vertex_count = polygons->vertex_count,
                   .index_count = polygons->index_count};
    if (mesh->index_count == 0)
        return false;
    if (!polygons->normals)
        mesh_snap(polygons->arena, mesh, 0.5);
    return true;
}

// --- OFF

// Returns the next line that is neither empty nor a comment.
static Str next_off_line(Str *bytes, uint32_t *number) {
    while (bytes->len > 0) {
        Str line = mesh_next_line(bytes), rest = line, word = mesh_next_word(&rest);
        ++*number;
        if (word.len > 0 && word.bytes[0] != '#')
            return line;
    }
    return STR("");
}

static bool read_counts(Str line, float counts[2]) {
    return mesh_read_number(mesh_next_word(&line), &counts[0]) && mesh_read_number(mesh_next_word(&line), &counts[1]);
}

static bool read_off_vertex(Polygons *polygons, Str line) {
    MeshVertex *vertex = add_vertex(polygons);
    for (int k = 0; vertex && k < 3; k++)
        if (!mesh_read_number(mesh_next_word(&line), &vertex->position[k]))
            return fail(polygons, "a vertex needs three numbers");
    return vertex;
}

static bool read_off_face(Polygons *polygons, Str line) {
    float count, corner;
    if (!mesh_read_number(mesh_next_word(&line), &count))
        return fail(polygons, "a face needs the number of its corners, and their vertices");
    polygons->corners = 0;
    for (double i = 0; i < count; i++) { // every iteration reads a word
        if (!mesh_read_number(mesh_next_word(&line), &corner))
            return fail(polygons, "a face needs the number of its corners, and their vertices");
        if (!add_corner(polygons, corner))
            return false;
    }
    return true;
}

bool mesh_read_off(Arena *arena, Str bytes, Mesh *mesh, MeshError *error) {
    Polygons polygons = {.arena = arena};
    float counts[2] = {0};
    error->line = 0;
    Str line = next_off_line(&bytes, &error->line);
    mesh_next_word(&line); // "OFF" or "COFF"; colours, which follow the coordinates, are ignored
    if (!read_counts(line, counts) && !read_counts(next_off_line(&bytes, &error->line), counts)) {
        error->text = "the numbers of vertices and faces are missing";
        return false;
    }
    for (double i = 0; i < (double)counts[0] + counts[1]; i++) { // every iteration reads a line
        bool is_vertex = i < counts[0];
        line = next_off_line(&bytes, &error->line);
        if (line.len == 0)
            fail(&polygons, "the file ends before the last face");
        if (line.len == 0 || !(is_vertex ? read_off_vertex(&polygons, line) : read_off_face(&polygons, line))) {
            error->text = polygons.problem;
            return false;
        }
    }
    return finish(&polygons, mesh, error);
}

// --- PLY

typedef enum NumberType { TYPE_I8, TYPE_U8, TYPE_I16, TYPE_U16, TYPE_I32, TYPE_U32, TYPE_F32, TYPE_F64 } NumberType;

static const struct {
    const char *name;
    NumberType type;
} types[] = {{"char", TYPE_I8},   {"int8", TYPE_I8},     {"uchar", TYPE_U8},   {"uint8", TYPE_U8},
             {"short", TYPE_I16}, {"int16", TYPE_I16},   {"ushort", TYPE_U16}, {"uint16", TYPE_U16},
             {"int", TYPE_I32},   {"int32", TYPE_I32},   {"uint", TYPE_U32},   {"uint32", TYPE_U32},
             {"float", TYPE_F32}, {"float32", TYPE_F32}, {"double", TYPE_F64}, {"float64", TYPE_F64}};

// What a property of a vertex or a face is: a number of MeshVertex, the list of corners, or nothing that is used.
enum { USE_NOTHING = 8, USE_CORNERS = 9 };
static const struct {
    const char *name;
    uint8_t use;
} uses[] = {{"x", 0}, {"y", 1}, {"z", 2}, {"nx", 3}, {"ny", 4},        {"nz", 5},
            {"u", 6}, {"v", 7}, {"s", 6}, {"t", 7},  {"texture_u", 6}, {"texture_v", 7}};

enum { MAX_PROPERTIES = 100, MAX_ELEMENTS = 20 };

typedef struct Property {
    NumberType type;
    NumberType count_type; // of a list
    bool list;
    uint8_t use;
} Property;

typedef struct Element {
    Property properties[MAX_PROPERTIES];
    uint32_t property_count;
    double count; // number of rows
    bool vertices;
    bool faces;
} Element;

typedef struct Ply {
    Polygons polygons;
    Str bytes; // what is left of the file
    Str row;   // what is left of the current line of a text file
    bool text;
    bool big_endian;
    uint32_t line; // number of the current line
    Element elements[MAX_ELEMENTS];
    uint32_t element_count;
} Ply;

static bool find_type(Str name, NumberType *type) {
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (str_equal(name, str_from(types[i].name))) {
            *type = types[i].type;
            return true;
        }
    return false;
}

static bool read_property(Element *element, Str line) {
    Property *property = &element->properties[element->property_count++];
    *property = (Property){.use = USE_NOTHING};
    Str word = mesh_next_word(&line);
    property->list = str_equal(word, STR("list"));
    if (property->list && !find_type(mesh_next_word(&line), &property->count_type))
        return false;
    if (!find_type(property->list ? mesh_next_word(&line) : word, &property->type))
        return false;
    word = mesh_next_word(&line);
    if (property->list && element->faces &&
        (str_equal(word, STR("vertex_indices")) || str_equal(word, STR("vertex_index"))))
        property->use = USE_CORNERS;
    for (size_t i = 0; i < sizeof uses / sizeof *uses && element->vertices && !property->list; i++)
        if (str_equal(word, str_from(uses[i].name)))
            property->use = uses[i].use;
    return true;
}

static bool read_element(Ply *ply, Str line) {
    Element *element = &ply->elements[ply->element_count++];
    Str name = mesh_next_word(&line);
    float count;
    *element = (Element){.vertices = str_equal(name, STR("vertex")), .faces = str_equal(name, STR("face"))};
    if (!mesh_read_number(mesh_next_word(&line), &count))
        return false;
    element->count = count;
    return true;
}

static bool read_format(Ply *ply, Str line) {
    Str word = mesh_next_word(&line);
    ply->text = str_equal(word, STR("ascii"));
    ply->big_endian = str_equal(word, STR("binary_big_endian"));
    return ply->text || ply->big_endian || str_equal(word, STR("binary_little_endian"));
}

static bool read_header(Ply *ply) {
    for (bool has_format = false; ply->bytes.len > 0;) {
        Str line = mesh_next_line(&ply->bytes), word = mesh_next_word(&line);
        bool good = true;
        ply->line++;
        if (str_equal(word, STR("end_header")))
            return has_format || fail(&ply->polygons, "the line 'format' is missing");
        if (str_equal(word, STR("format")))
            good = has_format = read_format(ply, line);
        else if (str_equal(word, STR("element")))
            good = ply->element_count < MAX_ELEMENTS && read_element(ply, line);
        else if (str_equal(word, STR("property"))) {
            Element *element = ply->element_count ? &ply->elements[ply->element_count - 1] : NULL;
            good = element && element->property_count < MAX_PROPERTIES && read_property(element, line);
        }
        if (!good)
            return fail(&ply->polygons, "this line of the header is not valid");
    }
    return fail(&ply->polygons, "the line 'end_header' is missing");
}

// Reads the next number of the current line, or of the next line that has one.
static bool read_text_number(Ply *ply, double *out) {
    float number;
    Str word = mesh_next_word(&ply->row);
    for (; word.len == 0 && ply->bytes.len > 0; ply->line++) {
        ply->row = mesh_next_line(&ply->bytes);
        word = mesh_next_word(&ply->row);
    }
    if (!mesh_read_number(word, &number))
        return fail(&ply->polygons, word.len ? "a number is not valid" : "the file ends before the last face");
    *out = number;
    return true;
}

static bool read_binary_number(Ply *ply, NumberType type, double *out) {
    static const uint8_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    uint64_t bits = 0;
    size_t size = sizes[type];
    if (ply->bytes.len < size)
        return fail(&ply->polygons, "the file ends before the last face");
    for (size_t i = 0; i < size; i++)
        bits |= (uint64_t)(unsigned char)ply->bytes.bytes[i] << 8 * (ply->big_endian ? size - 1 - i : i);
    ply->bytes = (Str){ply->bytes.bytes + size, ply->bytes.len - size};
    float narrow;
    uint32_t half = (uint32_t)bits;
    memcpy(&narrow, &half, sizeof narrow);
    switch (type) {
    case TYPE_I8:
        *out = (int8_t)bits;
        break;
    case TYPE_I16:
        *out = (int16_t)bits;
        break;
    case TYPE_I32:
        *out = (int32_t)bits;
        break;
    case TYPE_F32:
        *out = narrow;
        break;
    case TYPE_F64:
        memcpy(out, &bits, sizeof *out);
        break;
    default:
        *out = (double)bits;
    }
    return true;
}

static bool read_number(Ply *ply, NumberType type, double *out) {
    return ply->text ? read_text_number(ply, out) : read_binary_number(ply, type, out);
}

static bool read_list(Ply *ply, const Property *property) {
    double count, number;
    if (!read_number(ply, property->count_type, &count))
        return false;
    ply->polygons.corners = 0;
    for (double i = 0; i < count; i++) // every iteration reads a part of the file
        if (!read_number(ply, property->type, &number) ||
            (property->use == USE_CORNERS && !add_corner(&ply->polygons, number)))
            return false;
    return true;
}

static bool read_row(Ply *ply, const Element *element) {
    MeshVertex *vertex = element->vertices ? add_vertex(&ply->polygons) : NULL;
    if (element->vertices && !vertex)
        return false;
    for (uint32_t i = 0; i < element->property_count; i++) {
        const Property *property = &element->properties[i];
        double number;
        if (property->list ? !read_list(ply, property) : !read_number(ply, property->type, &number))
            return false;
        if (property->use >= USE_NOTHING)
            continue;
        if (!(fabs(number) < 1e30))
            return fail(&ply->polygons, "a coordinate is out of range");
        float *field = property->use < 3   ? &vertex->position[property->use]
                       : property->use < 6 ? &vertex->normal[property->use - 3]
                                           : &vertex->uv[property->use - 6];
        *field = (float)number;
        ply->polygons.normals |= property->use == 5;
    }
    return true;
}

bool mesh_read_ply(Arena *arena, Str bytes, Mesh *mesh, MeshError *error) {
    Ply *ply = arena_alloc(arena, sizeof *ply);
    *ply = (Ply){.polygons = {.arena = arena}, .bytes = bytes, .row = STR("")};
    if (!read_header(ply)) {
        *error = (MeshError){ply->polygons.problem, ply->line};
        return false;
    }
    for (uint32_t i = 0; i < ply->element_count; i++)
        for (double k = 0; k < ply->elements[i].count && ply->elements[i].property_count > 0; k++)
            if (!read_row(ply, &ply->elements[i])) {
                *error = (MeshError){ply->polygons.problem, ply->text ? ply->line : 0};
                return false;
            }
    return finish(&ply->polygons, mesh, error);
}
