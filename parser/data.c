#include "parser/data.h"
#include "lib/number.h"
#include "parser/grammar.h"

static bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static const char *skip_blanks(const char *c)
{
    while (is_blank(*c))
        c++;
    return c;
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
        c = skip_number(skip_blanks(c));
        if (!c)
            return NULL;
        c = skip_blanks(c);
        if (*c == '>')
            return terms > 1 ? c + 1 : NULL;
        if (*c++ != ',')
            return NULL;
    }
    return NULL;
}

size_t data_measure(const char *text)
{
    enum { WORTH = 6 }; /* bytes: a short vector                   */
    const char *end = text;
    for (const char *c = text;; c = skip_blanks(c + 1)) {
        const char *item = *c == '<' ? skip_vector(c + 1) : skip_number(c);
        if (!item)
            break;
        c = skip_blanks(item);
        if (*c != ',' && *c != '}')
            break;
        end = item;
        if (*c == '}')
            break;
    }
    return end - text >= WORTH ? (size_t)(end - text) : 0;
}

size_t data_measure_vector(const char *text)
{
    const char *end = *text == '<' ? skip_vector(text + 1) : NULL;
    return end ? (size_t)(end - text) : 0;
}

/* ---- reading ----------------------------------------------------------- */

const char *data_token(const char **at, const char *end, struct token *token)
{
    const char *c = skip_blanks(*at);
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
    while (is_blank(*c) || *c == ',')
        c++;
    if (c >= run->end)
        return NULL;
    run->text = c;
    *value = (struct value){.kind = VALUE_NUMBER, .terms = 1};
    if (*c != '<')
        return read_number(c, &value->v[0]);
    for (value->terms = 0; *c != '>'; value->terms++)
        c = skip_blanks(
            read_number(skip_blanks(c + 1), &value->v[value->terms]));
    return c + 1;
}
