// looks.c: the graphics state: transforms, and how a node's attributes change what is inherited.
#include "draw/draw.h"

#include <math.h>

static const double TURN = 6.283185307179586;

void draw_take_look(Look *look, const DrawNode *node) {
    for (uint32_t i = 0; i < node->attr_count; i++) {
        schema_store(&node->attrs[i], look);
        if (node->attrs[i].name == ATTR_COLOR)
            look->source = NULL;
    }
    if (node->kind == KIND_FONT) // it does not paint
        return;
    for (uint32_t i = 0; i < node->child_count; i++)
        if (node->children[i]->kind == KIND_GRADIENT)
            look->source = node->children[i];
        else if (node->children[i]->kind == KIND_COLOR)
            draw_take_look(look, node->children[i]);
}

bool draw_is_invertible(const cairo_matrix_t *m) {
    double determinant = m->xx * m->yy - m->xy * m->yx;
    return isfinite(determinant) && determinant != 0 && isfinite(m->x0) && isfinite(m->y0);
}

static void apply(cairo_matrix_t *m, const AttrValue *attr) {
    const double *n = attr->as.numbers;
    if (attr->name == ATTR_TRANSLATE)
        cairo_matrix_translate(m, n[0], n[1]);
    else if (attr->name == ATTR_SCALE)
        cairo_matrix_scale(m, n[0], n[1]);
    else if (attr->name == ATTR_ROTATE)
        cairo_matrix_rotate(m, (n[0] - floor(n[0])) * TURN);
}

bool draw_transform(cairo_t *cr, const DrawNode *node) {
    cairo_matrix_t matrix;
    cairo_get_matrix(cr, &matrix);
    for (uint32_t i = 0; i < node->attr_count; i++)
        apply(&matrix, &node->attrs[i]);
    if (!draw_is_invertible(&matrix)) // Cairo would fail for good
        return false;
    cairo_set_matrix(cr, &matrix);
    return true;
}

double draw_scale_of(cairo_t *cr) {
    cairo_matrix_t m;
    cairo_get_matrix(cr, &m);
    return sqrt(fabs(m.xx * m.yy - m.xy * m.yx));
}
