/* value.h - values of the scene language, and arithmetic on numbers.
 *
 * Numbers are vectors of 1 to 5 terms: one term is a float, five a colour
 * (red, green, blue, filter, transmit), as in POV-Ray. Values are copied
 * freely; what they point at lies in the parse arena and does not change,
 * save an array's items through #declare. */
#ifndef PARSER_VALUE_H
#define PARSER_VALUE_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum value_kind {
    VALUE_NONE,             /* not set: an array's item before its first use */
    VALUE_NUMBER,           /* float, vector or colour: see `terms`        */
    VALUE_STRING,
    VALUE_ARRAY,
    VALUE_MACRO,
    VALUE_LIST,             /* `<...>` of more terms than a number has     */
    VALUE_FORMULA,          /* of a function's parameters, not known yet   */
    VALUE_FUNCTION,
    VALUE_FILE,             /* opened by #fopen                            */
    /* Made by the builder, which alone looks into `node`. */
    VALUE_OBJECT,
    VALUE_TEXTURE, VALUE_PIGMENT, VALUE_NORMAL, VALUE_FINISH,
    VALUE_COLOR_MAP,
    VALUE_MATERIAL, VALUE_INTERIOR, VALUE_MEDIA, VALUE_DENSITY,
    VALUE_TRANSFORM,
    VALUE_CAMERA, VALUE_LIGHT, VALUE_SPLINE,
    VALUE_NORMAL_MAP, VALUE_SLOPE_MAP, VALUE_PIGMENT_MAP, VALUE_TEXTURE_MAP,
    VALUE_DENSITY_MAP,
    VALUE_FOG, VALUE_RAINBOW, VALUE_SKY_SPHERE,
    VALUE_PATTERN, VALUE_INTERIOR_TEXTURE,
    VALUE_KINDS
};

enum { VALUE_TERMS = 5, VALUE_RANK = 5 };

struct list;
struct formula;
struct stream;

struct string {
    const char *text;       /* UTF-8, NUL behind it; may hold NULs         */
    size_t length;          /* bytes                                       */
};

struct value {
    enum value_kind kind;
    int terms;              /* of a number: 1 to 5                         */
    union {
        double v[VALUE_TERMS];      /* v[terms..] are 0                    */
        struct string string;
        struct array *array;
        struct macro *macro;
        const struct list *list;
        const struct formula *formula;
        struct stream *stream;
        void *node;
    };
};

struct list {
    int count;
    double term[];
};

struct array {
    int rank;                       /* 1 to VALUE_RANK                     */
    uint32_t size[VALUE_RANK];
    uint32_t count;                 /* product of the sizes                */
    struct value *item;             /* last index fastest                  */
    bool list;                      /* a `{ ... }` that an array is made from */
};

/* What a number of so many terms, or another kind, is called in messages:
 * "float", "vector", "color", "pigment identifier" without "identifier". */
const char *value_name(const struct value *value);

static inline struct value value_float(double x)
{
    struct value value = {.kind = VALUE_NUMBER, .terms = 1};
    value.v[0] = x;
    return value;
}

struct value value_vector(int terms, const double *v);
struct value value_color(double red, double green, double blue,
                         double filter, double transmit);
struct value value_string(const char *text, size_t length);
struct value value_node(enum value_kind kind, void *node);

/* The number with another count of terms: a float fills all of them; a vector
 * is cut, or filled up with zeros. */
struct value value_promote(struct value value, int terms);
/* True for a float that is not (nearly) 0; POV-Ray's 1e-10. */
bool value_is_true(double x);

/* Operators work term by term on both operands promoted to the longer one;
 * comparisons and logic give 1 or 0 for each term. */
enum value_operator {
    VALUE_ADD, VALUE_SUBTRACT, VALUE_MULTIPLY, VALUE_DIVIDE,
    VALUE_LESS, VALUE_LESS_EQUAL, VALUE_EQUAL, VALUE_NOT_EQUAL,
    VALUE_GREATER_EQUAL, VALUE_GREATER, VALUE_AND, VALUE_OR
};
double value_operate(enum value_operator op, double a, double b);
/* False when a term was divided by zero: that term is then infinite, as in
 * POV-Ray, and the rest is computed. */
bool value_combine(enum value_operator op, const struct value *a,
                   const struct value *b, struct value *out);
struct value value_negate(struct value a);
struct value value_not(struct value a);
/* Orders strings by characters: <0, 0, >0, the difference of the first two
 * that differ. */
int value_compare_strings(struct string a, struct string b);

#endif
