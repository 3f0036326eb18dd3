// uniforms.c: see uniforms.h.
//
// A name is searched among the values that petri computes, then among the node's attributes, then among the names of
// the frame. A uniform that is found nowhere is 0.
#include "gl/uniforms.h"

#include "gl/context.h"
#include "maths/maths.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The value of a uniform. `list` points to the numbers, which can be stored elsewhere or in `own`.
typedef struct Numbers {
    const double *list;
    uint32_t count;
    double own[9];
} Numbers;

static void set_list(Numbers *out, const double *list, uint32_t count) {
    out->list = list;
    out->count = count;
}

static void set_scalar(Numbers *out, double x) {
    out->own[0] = x;
    set_list(out, out->own, 1);
}

// Computes a = a · b for column-major 3 x 3 matrices.
static void multiply_3x3(double a[9], const double b[9]) {
    double out[9] = {0};
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            for (int k = 0; k < 3; k++)
                out[3 * column + row] += a[3 * k + row] * b[3 * column + k];
    memcpy(a, out, sizeof out);
}

static bool invert_3x3(double m[9]) {
    double out[9], determinant;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++) {
            int a = (row + 1) % 3, b = (row + 2) % 3, c = (column + 1) % 3, d = (column + 2) % 3;
            out[3 * column + row] = m[3 * a + c] * m[3 * b + d] - m[3 * b + c] * m[3 * a + d];
        }
    determinant = m[0] * out[0] + m[3] * out[1] + m[6] * out[2];
    for (int i = 0; i < 9; i++)
        m[i] = out[i] / determinant;
    return determinant != 0 && isfinite(determinant);
}

static const double unit_matrix[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
static const double TURN = 6.283185307179586;

// Computes the inverse of the matrix of `!transform` (spec pictures.md 7.7). If the matrix is not invertible, sets all
// elements to 0.
static void find_matrix(const GlEffect *effect, double m[9]) {
    memcpy(m, unit_matrix, sizeof unit_matrix);
    for (uint32_t i = 0; i < effect->node->attr_count; i++) {
        const AttrValue *attr = &effect->node->attrs[i];
        const double *x = attr->as.numbers;
        double a[9];
        memcpy(a, unit_matrix, sizeof unit_matrix);
        if (attr->name == ATTR_SCALE) {
            a[0] = x[0], a[4] = x[1];
        } else if (attr->name == ATTR_ROTATE) {
            double cosine = maths_cos(TURN * x[0]), sine = maths_sin(TURN * x[0]);
            a[0] = cosine, a[1] = sine, a[3] = -sine, a[4] = cosine;
        } else if (attr->name == ATTR_TRANSLATE) {
            a[6] = x[0] * effect->detail, a[7] = x[1] * effect->detail;
        } else if (attr->name == ATTR_KEYSTONE) {
            a[2] = x[0] / effect->width, a[5] = x[1] / effect->height;
        } else {
            continue;
        }
        multiply_3x3(m, a);
    }
    if (!invert_3x3(m))
        memset(m, 0, 9 * sizeof *m);
}

const AttrValue *gl_custom_attr(const DrawNode *node, const char *name) {
    for (uint32_t i = 0; i < node->attr_count; i++)
        if (node->attrs[i].name == ATTR_NONE && strcmp(node->attrs[i].custom_name, name) == 0)
            return &node->attrs[i];
    return NULL;
}

// Sets *out to the value of a node's attribute, or to the default if the attribute is not set. Returns false if the
// node has no such attribute.
static bool find_attribute(const DrawNode *node, const char *name, Numbers *out) {
    if (strcmp(name, "other") == 0)
        name = "default"; // `default` is a keyword of GLSL
    const AttrValue *custom = gl_custom_attr(node, name);
    if (custom) {
        set_list(out, custom->as.list, custom->count);
        return true;
    }
    for (int i = 1; i < ATTR_COUNT; i++) {
        const SchemaRow *row =
            strcmp(schema_names[i], name) == 0 ? schema_row((NodeKind)node->kind, (AttrName)i) : NULL;
        const AttrValue *attr = row ? draw_attr(node, (AttrName)i) : NULL;
        AttrShape shape = row ? schema_types[row->type].shape : SHAPE_OTHER;
        if (!row)
            continue;
        if (!attr && shape == SHAPE_LIST) // color_matrix, whose default is the unit matrix
            set_list(out, unit_matrix, 9);
        else if (shape == SHAPE_WORD || shape == SHAPE_FLAG)
            set_scalar(out, !attr ? row->default_value.value : shape == SHAPE_WORD ? attr->as.word : attr->as.flag);
        else if (!attr)
            set_scalar(out, row->default_value.value);
        else if (shape == SHAPE_LIST)
            set_list(out, attr->as.list, attr->count);
        else
            set_list(out, attr->as.numbers,
                     shape == SHAPE_QUAD     ? 4
                     : shape == SHAPE_TRIPLE ? 3
                     : shape == SHAPE_PAIR   ? 2
                                             : 1);
        return true;
    }
    return false;
}

static bool find_builtin(const GlState *state, const char *name, Numbers *out) {
    const GlEffect *effect = state->effect;
    out->own[0] = state->target.width;
    out->own[1] = state->target.height;
    if (strcmp(name, "size") == 0)
        set_list(out, out->own, 2);
    else if (strcmp(name, "pass") == 0)
        set_scalar(out, state->pass);
    else if (strcmp(name, "passes") == 0)
        set_scalar(out, state->passes);
    else if (strcmp(name, "downsample") == 0)
        set_scalar(out, state->downsample);
    else if (strcmp(name, "beats") == 0)
        set_scalar(out, effect->frame->beats);
    else if (strcmp(name, "past") == 0)
        set_scalar(out, state->last.texture != 0);
    else if (strcmp(name, "inverse_matrix") == 0)
        find_matrix(effect, out->own), set_list(out, out->own, 9);
    else if (strcmp(name, "repeated") == 0)
        return find_attribute(effect->node, "repeat", out);
    else
        return false;
    return true;
}

// Converts blur radii from units to pixels, which the shaders need.
static void scale_lengths(const GlEffect *effect, const char *name, Numbers *out) {
    NodeKind kind = (NodeKind)effect->node->kind;
    bool blurs = kind == KIND_BLUR || kind == KIND_BLOOM || kind == KIND_EDGES || kind == KIND_CHROMAKEY;
    if (effect->detail == 1 || !blurs || strcmp(name, "radius") != 0 || out->count > 2)
        return;
    for (uint32_t i = 0; i < out->count; i++)
        out->own[i] = out->list[i] * effect->detail;
    out->list = out->own;
}

static void find_numbers(const GlState *state, const char *name, Numbers *out) {
    const GlEffect *effect = state->effect;
    if (find_builtin(state, name, out))
        return;
    if (find_attribute(effect->node, name, out)) {
        scale_lengths(effect, name, out);
    } else {
        set_scalar(out, 0);
        // Runs backwards, so that the first of equal names takes precedence.
        for (uint32_t i = effect->frame->name_count; i-- > 0;)
            if (strcmp(effect->frame->names[i], name) == 0)
                set_scalar(out, effect->frame->numbers[i]);
    }
}

// Returns the number of components of a type, or 0 if the type is not supported. Sets *is_integer to true if values
// must be rounded down to integers.
static uint32_t size_of(GLenum type, bool *is_integer) {
    static const struct {
        GLenum type;
        uint8_t size;
        bool whole;
    } types[] = {
        {GL_FLOAT, 1, false},      {GL_FLOAT_VEC2, 2, false}, {GL_FLOAT_VEC3, 3, false},  {GL_FLOAT_VEC4, 4, false},
        {GL_INT, 1, true},         {GL_INT_VEC2, 2, true},    {GL_INT_VEC3, 3, true},     {GL_INT_VEC4, 4, true},
        {GL_BOOL, 1, true},        {GL_BOOL_VEC2, 2, true},   {GL_BOOL_VEC3, 3, true},    {GL_BOOL_VEC4, 4, true},
        {GL_FLOAT_MAT2, 4, false}, {GL_FLOAT_MAT3, 9, false}, {GL_FLOAT_MAT4, 16, false},
    };
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (types[i].type == type) {
            *is_integer = types[i].whole;
            return types[i].size;
        }
    return 0;
}

static void send_uniform(GLint at, GLenum type, uint32_t size, GLsizei count, bool is_integer, const float *x,
                         const GLint *n) {
    if (type == GL_FLOAT_MAT2)
        glUniformMatrix2fv(at, count, GL_FALSE, x);
    else if (type == GL_FLOAT_MAT3)
        glUniformMatrix3fv(at, count, GL_FALSE, x);
    else if (type == GL_FLOAT_MAT4)
        glUniformMatrix4fv(at, count, GL_FALSE, x);
    else if (size == 1)
        is_integer ? glUniform1iv(at, count, n) : glUniform1fv(at, count, x);
    else if (size == 2)
        is_integer ? glUniform2iv(at, count, n) : glUniform2fv(at, count, x);
    else if (size == 3)
        is_integer ? glUniform3iv(at, count, n) : glUniform3fv(at, count, x);
    else
        is_integer ? glUniform4iv(at, count, n) : glUniform4fv(at, count, x);
}

GlUniform gl_uniform(unsigned program, unsigned index) {
    GlUniform uniform = {.name = ""}; // in a browser, the name is not written if the context was lost
    GLint size = 0;
    GLenum type = 0;
    glGetActiveUniform(program, index, sizeof uniform.name, NULL, &size, &type, uniform.name);
    uniform.at = glGetUniformLocation(program, uniform.name);
    uniform.name[strcspn(uniform.name, "[")] = 0;
    uniform.count = size;
    uniform.type = type;
    return uniform;
}

void gl_set_uniform(Arena *arena, const GlUniform *uniform, const double *numbers, uint32_t length) {
    enum { FEW = 64 };
    bool is_integer;
    uint32_t size = size_of(uniform->type, &is_integer);
    if (size == 0)
        return;
    uint32_t all = size * (uint32_t)uniform->count; // limited by the driver, which has linked the program
    float few[FEW], *x = all <= FEW ? few : arena_alloc_array(arena, all, sizeof *x);
    GLint few_integers[FEW], *n = all <= FEW ? few_integers : arena_alloc_array(arena, all, sizeof *n);
    bool fits = length == all || length == 1 || length == size;
    for (uint32_t i = 0; i < all; i++) {
        double number = fits ? numbers[i % length] : 0;
        x[i] = (float)number;
        n[i] = fabs(number) < 1e9 ? (GLint)floor(number) : 0;
    }
    send_uniform(uniform->at, uniform->type, size, uniform->count, is_integer, x, n);
}

static void set_picture(const Gl *gl, GLint at, const GlState *state, const char *name, GLint unit) {
    const GlEffect *effect = state->effect;
    GlImage image = {0};
    char *end;
    unsigned long input = strncmp(name, "texture", 7) == 0 ? strtoul(name + 7, &end, 10) : effect->count;
    if (strcmp(name, "first") == 0)
        image = state->first;
    else if (strcmp(name, "last") == 0)
        image = state->last;
    else if (input < effect->count)
        image = effect->inputs[input];
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, image.texture ? image.texture : gl->nothing);
    glUniform1i(at, unit);
}

void gl_set_uniforms(const Gl *gl, Arena *arena, unsigned program, const GlState *state) {
    GLint count = 0, unit = 0;
    glUseProgram(program);
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; i++) {
        GlUniform uniform = gl_uniform(program, (unsigned)i);
        Numbers numbers = {.list = NULL};
        if (uniform.type == GL_SAMPLER_2D) {
            set_picture(gl, uniform.at, state, uniform.name, unit++);
        } else {
            find_numbers(state, uniform.name, &numbers);
            gl_set_uniform(arena, &uniform, numbers.list, numbers.count);
        }
    }
    glActiveTexture(GL_TEXTURE0);
}
