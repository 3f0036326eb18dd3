// render_graph_query.c: properties of a render graph that can be determined before rendering; see render_graph.h.
#include "draw/render_graph.h"

#include <math.h>

static bool is_picture(const DrawNode *node) {
    return node->kind != KIND_POINTER && node->kind != KIND_KEY;
}

bool render_graph_is_plain(const DrawNode *node) {
    bool usual = node->kind == KIND_WINDOW || node->kind == KIND_OFFSCREEN || node->kind == KIND_RECORD ||
                 node->kind == KIND_SHADER;
    return usual && !draw_attr(node, ATTR_FRAGMENT) && !draw_attr(node, ATTR_VERTEX) &&
           !draw_attr(node, ATTR_DOWNSAMPLE_PASSES);
}

void render_graph_node_size(const DrawNode *node, int *width, int *height) {
    double size[2];
    if (!draw_pair(node, ATTR_SIZE, size))
        return;
    *width = size[0] <= PETRI_MAX_PICTURE_SIDE ? (int)size[0] : PETRI_MAX_PICTURE_SIDE + 1;
    *height = size[1] <= PETRI_MAX_PICTURE_SIDE ? (int)size[1] : PETRI_MAX_PICTURE_SIDE + 1;
}

const DrawNode *render_graph_direct_canvas(const DrawNode *node, int width, int height) {
    while (node && node->kind != KIND_CANVAS) {
        const DrawNode *only = NULL;
        int wide = width, high = height;
        if (!render_graph_is_plain(node) || draw_number(node, ATTR_ALPHA) != 1)
            return NULL;
        for (uint32_t i = 0; i < node->child_count; i++) {
            const DrawNode *child = node->children[i];
            if (!is_picture(child) || (child->kind != KIND_REFERENCE && draw_flag(child, ATTR_HIDDEN)))
                continue;
            if (only || child->kind == KIND_REFERENCE || child->kind == KIND_PICTURE_IMAGE)
                return NULL;
            only = child;
        }
        if (only)
            render_graph_node_size(only, &wide, &high);
        if (wide != width || high != height)
            return NULL;
        node = only;
    }
    return node && draw_flag(node, ATTR_LINEAR) ? NULL : node;
}

static const bool scalable_kinds[KIND_COUNT] = {
#define PICTURE_EFFECT(id, name, scalable, help) [KIND_##id] = scalable,
#include "schema/schema_list.h"
    [KIND_CANVAS] = true,    [KIND_CANVAS3D] = true,  [KIND_PICTURE_IMAGE] = true,
    [KIND_REFERENCE] = true, [KIND_POINTER] = true,   [KIND_KEY] = true,
    [KIND_WINDOW] = true,    [KIND_OFFSCREEN] = true, [KIND_SHADER] = true,
};

bool render_graph_scalable(const DrawNode *node) {
    PlaceKind children = schema_kinds[node->kind].children;
    if (!scalable_kinds[node->kind] || (children != PLACE_PICTURES && children != PLACE_WINDOW))
        return scalable_kinds[node->kind];
    bool own = draw_attr(node, ATTR_FRAGMENT) || draw_attr(node, ATTR_VERTEX);
    for (uint32_t i = 0; i < node->child_count && !own; i++)
        own = !render_graph_scalable(node->children[i]);
    return !own;
}

int render_graph_pixels(int side, double detail) {
    int pixels = (int)floor(side * detail + 0.5);
    return pixels > 1 ? pixels : 1;
}
