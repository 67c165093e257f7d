#include "parser/data.h"
#include "lib/number.h"
#include "parser/grammar.h"

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* ---- measuring --------------------------------------------------------- */

static const char *skip_digits(const char *c)
{
    while (is_digit(*c))
        c++;
    return c;
}

/* Behind a number with its sign; NULL: there is none. */
static const char *skip_number(const char *c)
{
    c += *c == '-' || *c == '+';
    const char *start = c;
    c = skip_digits(c);
    if (*c == '.')
        c = skip_digits(c + 1);
    if (c == start || (c == start + 1 && *start == '.'))
        return NULL;
    if (*c != 'e' && *c != 'E')
        return c;
    const char *digit = c + 1 + (c[1] == '-' || c[1] == '+');
    return is_digit(*digit) ? skip_digits(digit) : NULL;
}

/* Behind `<a, b, ...>`; `c` is at its first term. */
static const char *skip_vector(const char *c)
{
    for (int terms = 1; terms <= VALUE_TERMS; terms++) {
        c = skip_number(data_skip_blanks(c));
        if (!c)
            return NULL;
        c = data_skip_blanks(c);
        if (*c == '>')
            return terms > 1 ? c + 1 : NULL;
        if (*c++ != ',')
            return NULL;
    }
    return NULL;
}

/* Behind a number or a vector; NULL: neither is there. */
static const char *skip_item(const char *c)
{
    return *c == '<' ? skip_vector(c + 1) : skip_number(c);
}

struct data_span data_measure(const char *text, bool list)
{
    enum { WORTH = 6 }; /* bytes: a short vector                   */
    if (*text != '<' && !list)
        return (struct data_span){0, false};
    const char *first = skip_item(text), *end = text;
    for (const char *item = first; list && item;) {
        const char *c = data_skip_blanks(item);
        if (*c != ',' && *c != '}')
            break;
        end = item;
        item = *c == ',' ? skip_item(data_skip_blanks(c + 1)) : NULL;
    }
    bool vector = *text == '<' && first && (end == text || end == first);
    if (vector)
        end = first;
    return (struct data_span){
        vector || end - text >= WORTH ? (uint32_t)(end - text) : 0, vector};
}

/* ---- reading ----------------------------------------------------------- */

const char *data_token(const char **at, const char *end, struct token *token)
{
    const char *c = data_skip_blanks(*at);
    if (c >= end)
        return NULL;
    if (is_digit(*c) || *c == '.') {
        token->kind = TOK_NUMBER;
        *at = number_read(c, &token->number);
    } else {
        token->kind = (uint16_t)*c;
        *at = c + 1;
    }
    return c;
}

static const char *read_number(const char *c, double *value)
{
    bool negative = *c == '-';
    c = number_read(c + (negative || *c == '+'), value);
    *value = negative ? -*value : *value;
    return c;
}

const char *data_item(struct data_run *run, struct value *value)
{
    const char *c = run->text;
    while (*(c = data_skip_blanks(c)) == ',')
        c++;
    if (c >= run->end)
        return NULL;
    run->text = c;
    *value = (struct value){.kind = VALUE_NUMBER, .terms = 1};
    if (*c != '<')
        return read_number(c, &value->v[0]);
    for (value->terms = 0; *c != '>'; value->terms++)
        c = data_skip_blanks(
            read_number(data_skip_blanks(c + 1), &value->v[value->terms]));
    return c + 1;
}
