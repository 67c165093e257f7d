#include "parser/scalar.h"
#include "parser/grammar.h"
#include "parser/symbol.h"
#include "parser/value.h"
#include <math.h>

/* Operators, the binary ones by enum value_operator, and open brackets. */
enum { NEGATE = VALUE_OR + 1, NOT, PARENTHESIS, BRACKET };

/* More than this is left to the grammar. */
enum { DEEPEST = 32 };

struct operation {
    int what;
    int rank;                  /* the higher, the closer it binds         */
    const struct array *array; /* of a BRACKET                            */
};

struct scalar {
    const struct token *token; /* the next one                            */
    bool full;
    bool failed; /* left to the grammar                     */
    double value[DEEPEST];
    struct operation operation[DEEPEST];
    int values, operations;
    int open; /* brackets among the operations           */
};

/* The ranks of the grammar's operators; a bracket's is below all. */
enum { OPEN, LOGIC, RELATION, SUM, PRODUCT, SIGN };

static void push_value(struct scalar *s, double value)
{
    s->failed = s->failed || s->values == DEEPEST;
    if (!s->failed) {
        s->value[s->values++] = value;
    }
}

static void push_operation(struct scalar *s, int what, int rank,
                           const struct array *array)
{
    s->failed = s->failed || s->operations == DEEPEST;
    if (!s->failed) {
        s->operation[s->operations++] = (struct operation){what, rank, array};
        s->open += rank == OPEN;
    }
}

/* ---- operators --------------------------------------------------------- */

static void apply(struct scalar *s, int what)
{
    double *last = &s->value[s->values - 1];
    if (what == NEGATE) {
        *last = -*last;
    } else if (what == NOT) {
        *last = !value_is_true(*last);
    } else {
        s->failed = s->failed || (what == VALUE_DIVIDE && *last == 0);
        last[-1] = value_operate((enum value_operator)what, last[-1], *last);
        s->values--;
    }
}

/* Applies what binds as close as `rank` or closer. */
static void reduce(struct scalar *s, int rank)
{
    while (s->operations > 0 && s->operation[s->operations - 1].rank >= rank) {
        apply(s, s->operation[--s->operations].what);
    }
}

/* The binary operator of a token; false: it is none. */
static bool binary(int kind, struct operation *operation)
{
    static const struct {
        int kind, what, rank;
    } table[] = {{'+', VALUE_ADD, SUM},
                 {'-', VALUE_SUBTRACT, SUM},
                 {'*', VALUE_MULTIPLY, PRODUCT},
                 {'/', VALUE_DIVIDE, PRODUCT},
                 {'<', VALUE_LESS, RELATION},
                 {'>', VALUE_GREATER, RELATION},
                 {'=', VALUE_EQUAL, RELATION},
                 {TOK_LESS_EQUAL, VALUE_LESS_EQUAL, RELATION},
                 {TOK_GREATER_EQUAL, VALUE_GREATER_EQUAL, RELATION},
                 {TOK_NOT_EQUAL, VALUE_NOT_EQUAL, RELATION},
                 {'&', VALUE_AND, LOGIC},
                 {'|', VALUE_OR, LOGIC}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        if (table[i].kind == kind) {
            *operation = (struct operation){table[i].what, table[i].rank, NULL};
            return true;
        }
    }
    return false;
}

/* ---- operands ---------------------------------------------------------- */

static bool is_float(const struct value *value)
{
    return value->kind == VALUE_NUMBER && value->terms == 1;
}

static void take_name(struct scalar *s, const struct name *name)
{
    const struct value *value = symbols_find(name);
    if (!value || name->symbol->deprecated) {
        s->failed = true;
    } else if (is_float(value)) {
        push_value(s, value->v[0]);
    } else if (value->kind == VALUE_ARRAY && value->array->rank == 1 &&
               s->token->kind == '[') {
        push_operation(s, BRACKET, OPEN, value->array);
        s->token++;
    } else {
        s->failed = true;
    }
}

/* Takes a token where an operand must stand; true: it is one. */
static bool take_operand(struct scalar *s)
{
    const struct token *token = s->token++;
    int operations = s->operations;
    switch (token->kind) {
    case TOK_NUMBER:
        push_value(s, token->number);
        return true;
    case TOK_IDENTIFIER:
        take_name(s, token->name);
        return s->operations == operations;
    case '(':
        push_operation(s, PARENTHESIS, OPEN, NULL);
        return false;
    case '-':
        push_operation(s, NEGATE, SIGN, NULL);
        return false;
    case '!':
        push_operation(s, NOT, SIGN, NULL);
        return false;
    default:
        s->failed = s->failed || token->kind != '+';
        return false;
    }
}

/* ---- behind operands --------------------------------------------------- */

/* The last value is an index: the item takes its place. */
static void take_item(struct scalar *s, const struct array *array)
{
    double index = trunc(s->value[s->values - 1]);
    if (!(index >= 0 && index < array->count)) {
        s->failed = true;
        return;
    }
    const struct value *item = &array->item[(size_t)index];
    s->failed = !is_float(item);
    s->value[s->values - 1] = item->v[0];
}

static void close_bracket(struct scalar *s, int what)
{
    reduce(s, OPEN + 1);
    struct operation open = s->operation[--s->operations];
    s->open--;
    s->token++;
    if (open.what != what) {
        s->failed = true;
    } else if (what == BRACKET) {
        take_item(s, open.array);
    }
}

/* Whether relations may stand here: in parentheses. */
static bool is_full(const struct scalar *s)
{
    for (int i = s->operations; s->open > 0 && i > 0; i--) {
        if (s->operation[i - 1].rank == OPEN) {
            return s->operation[i - 1].what == PARENTHESIS;
        }
    }
    return s->full;
}

/* Takes a token behind an operand; true: an operator, behind which another
 * operand must stand. *ends: no part of the expression. */
static bool take_operator(struct scalar *s, bool *ends)
{
    int kind = s->token->kind;
    struct operation operation;
    if ((kind == ')' || kind == ']') && s->open > 0) {
        close_bracket(s, kind == ')' ? PARENTHESIS : BRACKET);
        return false;
    }
    if (binary(kind, &operation) && (operation.rank >= SUM || is_full(s))) {
        reduce(s, operation.rank);
        push_operation(s, operation.what, operation.rank, NULL);
        s->token++;
        return true;
    }
    *ends = true;
    s->failed = s->failed || s->open > 0 || kind == TOK_DOT || kind == '?';
    return false;
}

const struct token *scalar_read(const struct token *token, bool full,
                                double *value)
{
    struct scalar s;
    s.token = token;
    s.full = full;
    s.failed = false;
    s.values = s.operations = s.open = 0;
    bool operand = true, ends = false;
    while (!s.failed && !ends) {
        operand = operand ? !take_operand(&s) : take_operator(&s, &ends);
    }
    if (s.failed) {
        return NULL;
    }
    reduce(&s, OPEN + 1);
    *value = s.value[0];
    return s.failed ? NULL : s.token;
}
