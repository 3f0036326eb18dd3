// plan.c: what can be said of a tree of pictures before it is made; see pictures.h.
#include "draw/pictures.h"

#include <math.h>

static bool is_picture(const DrawNode *node) {
    return node->kind != KIND_POINTER && node->kind != KIND_KEY;
}

bool pictures_plain(const DrawNode *node) {
    bool usual = node->kind == KIND_WINDOW || node->kind == KIND_OFFSCREEN || node->kind == KIND_RECORD ||
                 node->kind == KIND_SHADER;
    return usual && !draw_attr(node, ATTR_FRAGMENT) && !draw_attr(node, ATTR_VERTEX) &&
           !draw_attr(node, ATTR_DOWNSAMPLE_PASSES);
}

void pictures_size(const DrawNode *node, int *width, int *height) {
    double size[2];
    if (!draw_pair(node, ATTR_SIZE, size))
        return;
    *width = size[0] <= PETRI_MOST_PIXELS ? (int)size[0] : PETRI_MOST_PIXELS + 1;
    *height = size[1] <= PETRI_MOST_PIXELS ? (int)size[1] : PETRI_MOST_PIXELS + 1;
}

const DrawNode *pictures_direct(const DrawNode *node, int width, int height) {
    while (node && node->kind != KIND_CANVAS) {
        const DrawNode *only = NULL;
        int wide = width, high = height;
        if (!pictures_plain(node) || draw_number(node, ATTR_ALPHA) != 1)
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
            pictures_size(only, &wide, &high);
        if (wide != width || high != height)
            return NULL;
        node = only;
    }
    return node && draw_flag(node, ATTR_LINEAR) ? NULL : node;
}
