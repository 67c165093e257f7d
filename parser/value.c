#include "parser/value.h"
#include "parser/utf8.h"
#include <math.h>
#include <string.h>

/* POV-Ray 3.7 reference, 3.3.1.5: what is closer than this is equal. */
static const double EPSILON = 1e-10;

static const char *const kind_name[VALUE_KINDS] = {
    [VALUE_NONE] = "nothing",
    [VALUE_NUMBER] = "number",
    [VALUE_STRING] = "string",
    [VALUE_ARRAY] = "array",
    [VALUE_MACRO] = "macro",
    [VALUE_OBJECT] = "object",
    [VALUE_TEXTURE] = "texture",
    [VALUE_PIGMENT] = "pigment",
    [VALUE_NORMAL] = "normal",
    [VALUE_FINISH] = "finish",
    [VALUE_COLOR_MAP] = "color_map",
    [VALUE_MATERIAL] = "material",
    [VALUE_INTERIOR] = "interior",
    [VALUE_MEDIA] = "media",
    [VALUE_DENSITY] = "density",
    [VALUE_TRANSFORM] = "transform",
    [VALUE_CAMERA] = "camera",
    [VALUE_LIGHT] = "light_source",
    [VALUE_LIST] = "long vector",
    [VALUE_FORMULA] = "formula",
    [VALUE_FUNCTION] = "function",
    [VALUE_FILE] = "file",
    [VALUE_SPLINE] = "spline",
    [VALUE_NORMAL_MAP] = "normal_map",
    [VALUE_SLOPE_MAP] = "slope_map",
    [VALUE_PIGMENT_MAP] = "pigment_map",
    [VALUE_TEXTURE_MAP] = "texture_map",
    [VALUE_DENSITY_MAP] = "density_map",
    [VALUE_FOG] = "fog",
    [VALUE_RAINBOW] = "rainbow",
    [VALUE_SKY_SPHERE] = "sky_sphere",
    [VALUE_PATTERN] = "pattern",
    [VALUE_INTERIOR_TEXTURE] = "interior_texture"};

const char *value_name(const struct value *value)
{
    if (value->kind == VALUE_NUMBER) {
        return value->terms == 1             ? "float"
               : value->terms == VALUE_TERMS ? "color"
                                             : "vector";
    }
    return kind_name[value->kind];
}

struct value value_vector(int terms, const double *v)
{
    struct value value = {.kind = VALUE_NUMBER, .terms = terms};
    memcpy(value.v, v, (size_t)terms * sizeof *v);
    return value;
}

struct value value_color(double red, double green, double blue, double filter,
                         double transmit)
{
    double v[VALUE_TERMS] = {red, green, blue, filter, transmit};
    return value_vector(VALUE_TERMS, v);
}

struct value value_string(const char *text, size_t length)
{
    struct value value = {.kind = VALUE_STRING};
    value.string = (struct string){text, length};
    return value;
}

struct value value_node(enum value_kind kind, void *node)
{
    struct value value = {.kind = kind};
    value.node = node;
    return value;
}

struct value value_promote(struct value value, int terms)
{
    for (int i = 1; i < VALUE_TERMS; i++) {
        if (i >= terms) {
            value.v[i] = 0;
        } else if (value.terms == 1) {
            value.v[i] = value.v[0];
        }
    }
    value.terms = terms;
    return value;
}

bool value_is_true(double x)
{
    return fabs(x) > EPSILON;
}

static bool equal(double a, double b)
{
    return a == b || fabs(a - b) <= EPSILON;
}

double value_operate(enum value_operator op, double a, double b)
{
    switch (op) {
    /* clang-format off */
    case VALUE_ADD: return a + b;
    case VALUE_SUBTRACT: return a - b;
    case VALUE_MULTIPLY: return a * b;
    case VALUE_DIVIDE: return b == 0 ? HUGE_VAL : a / b;
    case VALUE_LESS: return a < b;
    case VALUE_LESS_EQUAL: return a < b || equal(a, b);
    case VALUE_EQUAL: return equal(a, b);
    case VALUE_NOT_EQUAL: return !equal(a, b);
    case VALUE_GREATER_EQUAL: return a > b || equal(a, b);
    case VALUE_GREATER: return a > b;
    case VALUE_AND: return value_is_true(a) && value_is_true(b);
    case VALUE_OR: return value_is_true(a) || value_is_true(b);
        /* clang-format on */
    }
    return 0;
}

bool value_combine(enum value_operator op, const struct value *a,
                   const struct value *b, struct value *out)
{
    int terms = a->terms > b->terms ? a->terms : b->terms;
    if (terms == 1) {
        *out = value_float(value_operate(op, a->v[0], b->v[0]));
        return op != VALUE_DIVIDE || b->v[0] != 0;
    }
    struct value left = value_promote(*a, terms);
    struct value right = value_promote(*b, terms);
    bool sound = true;
    for (int i = 0; i < terms; i++) {
        sound = sound && (op != VALUE_DIVIDE || right.v[i] != 0);
        left.v[i] = value_operate(op, left.v[i], right.v[i]);
    }
    *out = left;
    return sound;
}

struct value value_negate(struct value a)
{
    for (int i = 0; i < a.terms; i++) {
        a.v[i] = -a.v[i];
    }
    return a;
}

struct value value_not(struct value a)
{
    for (int i = 0; i < a.terms; i++) {
        a.v[i] = !value_is_true(a.v[i]);
    }
    return a;
}

int value_compare_strings(struct string a, struct string b)
{
    size_t i = 0, j = 0, step;
    while (i < a.length && j < b.length) {
        int left = (int)utf8_decode(a.text + i, a.length - i, &step);
        i += step;
        int right = (int)utf8_decode(b.text + j, b.length - j, &step);
        j += step;
        if (left != right) {
            return left - right;
        }
    }
    if (i < a.length) {
        return (int)utf8_decode(a.text + i, a.length - i, &step);
    }
    return j < b.length ? -(int)utf8_decode(b.text + j, b.length - j, &step)
                        : 0;
}
