// mesh_report.c: counts the triangles of solids, distance fields and models in the last frame (petri_print_meshes).
#include "petri-draw.h"
#include "scene3d/mesh.h"
#include "scene3d/scene.h"
#include "scene3d/scene_solid.h"
#include "session/draw_access.h"

enum { MAX_DEPTH = 100, MAX_REPORTS = 100 };

// The state of a call of petri_print_meshes.
typedef struct Request {
    PetriSession *session;
    Arena arena;
    DiagSink diags;   // problems of the models
    uint32_t printed; // number of diags that are in the text
    const FileAccess *reach;
    Text lines;
    double triangles;
    uint32_t nodes;
    PetriWriteCallback *write;
    void *user_data;
} Request;

static bool sample_function(void *user_data, void *function, const double (*points)[3], uint32_t count,
                            double *distances) {
    Request *request = user_data;
    return session_sample_function(request->session, &request->arena, function, points, count, distances);
}

static void add_line(Request *request, const Diag *diag) {
    Str line = diag_one_line(&request->arena, diag);
    text_add_format(&request->lines, "  %.*s\n", STR_ARGS(line));
}

static bool is_counted(NodeKind kind) {
    return kind == KIND_MODEL || scene_is_solid(kind);
}

// Builds the mesh of a model and adds its line, and then those of its problems.
static void add_model(Request *request, const Scene *scene, uint32_t index) {
    const SceneModel *model = &scene->models[index];
    Mesh mesh = {.index_count = 0};
    uint32_t count = 0;
    for (uint32_t g = 0; g < scene->group_count; g++)
        for (uint32_t i = 0; i < scene->groups[g]->instance_count; i++)
            count += scene->groups[g]->instances[i].model == index;
    if (count == 0 || !is_counted((NodeKind)model->kind))
        return;
    uint32_t triangles = scene_mesh(scene, model, &request->arena, &mesh) ? mesh.index_count / 3 : 0;
    Str each = count == 1 ? (Str){0} : str_format(&request->arena, ", in %u nodes", count);
    Str text =
        str_format(&request->arena, "!%s: %u triangles%.*s", schema_kinds[model->kind].name, triangles, STR_ARGS(each));
    add_line(request, &(Diag){.at = model->node->origin, .text = text});
    for (; request->printed < request->diags.count; request->printed++)
        add_line(request, &request->diags.items[request->printed]);
    request->triangles += (double)triangles * count;
    request->nodes += count;
}

static void add_scenes(Request *request, const DrawNode *node, int depth) {
    enum { ANY_SIZE = 512, ANY_BITS = 16 }; // the meshes do not depend on the size of the picture
    if (node->kind != KIND_CANVAS3D) {
        for (uint32_t i = 0; i < node->child_count && depth < MAX_DEPTH; i++)
            add_scenes(request, node->children[i], depth + 1);
        return;
    }
    Scene *scene = scene_read(&request->arena, node, ANY_SIZE, ANY_SIZE, ANY_BITS, request->reach, &request->diags);
    for (uint32_t i = 0; i < scene->model_count; i++)
        add_model(request, scene, i);
}

static PetriStatus print_meshes(PetriSession *session, void *context) {
    Request *request = context;
    DrawAccess access = session_draw_access(session);
    const Node *window;
    request->reach = access.reach;
    request->diags = diag_sink_new(&request->arena, MAX_REPORTS);
    request->lines = text_new(&request->arena);
    for (uint32_t at = 0; (window = canvas_next_window(access.schema, access.tree, &at));) {
        const DrawNode *top = canvas_read(access.schema, &request->arena, window);
        scene_sample_functions(&request->arena, top, sample_function, request);
        add_scenes(request, top, 0);
    }
    if (request->nodes == 0)
        return PETRI_OK;
    Str text = str_format(&request->arena, "triangles: %.0f in %u node%s\n%.*s", request->triangles, request->nodes,
                          request->nodes == 1 ? "" : "s", STR_ARGS(text_str(&request->lines)));
    return request->write(request->user_data, text.bytes, text.len) ? PETRI_OK : PETRI_INVALID;
}

PetriStatus petri_print_meshes(PetriSession *session, PetriWriteCallback *write, void *user_data) {
    if (!session || !write || petri_frame_number(session) < 0)
        return PETRI_INVALID;
    DrawAccess access = session_draw_access(session);
    Request request = {.session = session, .write = write, .user_data = user_data};
    arena_init(&request.arena, "meshes", access.memory_limit);
    request.arena.budget = access.budget;
    PetriStatus status = session_protect(session, &request.arena, print_meshes, &request);
    diag_sink_free(&request.diags);
    arena_free(&request.arena);
    return session_report_abort(session, status, "counting triangles");
}
