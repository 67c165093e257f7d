#include "parser/param.h"

#include <stdio.h>
#include <string.h>

const struct param *param_find(const struct param *table, const char *word)
{
    for (; table && table->word; table++)
        if (*table->word == *word && !strcmp(table->word, word))
            return table;
    return NULL;
}

int param_least(const struct param *row)
{
    switch (row->kind) {
    case PARAM_FLOAT:
    case PARAM_INTEGER:
    case PARAM_VECTOR:
    case PARAM_RGB:
    case PARAM_COLOR:
    case PARAM_PAIR:
        return isnan(row->alone) ? 1 : 0;
    case PARAM_VALUES:
        return row->least;
    default:
        return 0;
    }
}

int param_most(const struct param *row)
{
    switch (row->kind) {
    case PARAM_MARK:
    case PARAM_CLEAR:
    case PARAM_CHOICE:
        return 0;
    case PARAM_PAIR:
        return 2;
    case PARAM_VALUES:
    case PARAM_IGNORED:
        return row->most;
    default:
        return 1;
    }
}

void param_defaults(const struct param *table, void *node)
{
    for (; table->word; table++) {
        char *to = (char *)node + table->offset;
        switch (table->kind) {
        case PARAM_FLOAT:
            memcpy(to, table->start, sizeof(double));
            break;
        case PARAM_PAIR:
            memcpy(to, table->start, 2 * sizeof(double));
            break;
        case PARAM_VECTOR:
        case PARAM_RGB:
            memcpy(to, table->start, 3 * sizeof(double));
            break;
        case PARAM_INTEGER:
        case PARAM_CHOICE:
            *(int *)to = (int)table->start[0];
            break;
        case PARAM_SWITCH:
            *(bool *)to = table->start[0] != 0;
            break;
        case PARAM_COLOR:
        case PARAM_MARK:
        case PARAM_CLEAR:
        case PARAM_VALUES:
        case PARAM_IGNORED:
            break;
        }
    }
}

static int terms_of(enum param_kind kind)
{
    switch (kind) {
    case PARAM_VECTOR:
    case PARAM_RGB:
        return 3;
    case PARAM_COLOR:
        return 5;
    default:
        return 1;
    }
}

/* "must be greater than 0", "must be from 0 to 90", ... */
static bool out_of_range(struct parser *parser, const struct param *row,
                         double x, struct location at)
{
    const char *from = row->open & PARAM_ABOVE ? "greater than" : "at least";
    const char *to = row->open & PARAM_BELOW ? "less than" : "at most";

    if (!isfinite(x))
        return parser_mistake(parser, at, "'%s' is %g, must be finite",
                              row->word, x);
    if (isinf(row->high))
        return parser_mistake(parser, at, "'%s' is %g, must be %s %g",
                              row->word, x, from, row->low);
    if (isinf(row->low))
        return parser_mistake(parser, at, "'%s' is %g, must be %s %g",
                              row->word, x, to, row->high);
    return parser_mistake(parser, at, "'%s' is %g, must be %s %g and %s %g",
                          row->word, x, from, row->low, to, row->high);
}

static bool in_range(const struct param *row, double x)
{
    return isfinite(x) && x >= row->low && x <= row->high &&
           !(row->open & PARAM_ABOVE && x == row->low) &&
           !(row->open & PARAM_BELOW && x == row->high);
}

static bool check_terms(struct parser *parser, const struct param *row,
                        const double *x, int terms, struct location at)
{
    if (row->kind == PARAM_SWITCH)
        return true;
    /* Filter and transmit of a colour are not bound by its range. */
    for (int i = 0; i < (terms < 3 ? terms : 3); i++)
        if (!in_range(row, x[i]))
            return out_of_range(parser, row, x[i], at);
    return true;
}

static void store(const struct param *row, void *node, const double *x)
{
    char *to = (char *)node + row->offset;

    switch (row->kind) {
    case PARAM_INTEGER:
        *(int *)to = (int)x[0];
        break;
    case PARAM_SWITCH:
        *(bool *)to = value_is_true(x[0]);
        break;
    case PARAM_PAIR:
        memcpy(to, x, 2 * sizeof *x);
        break;
    default:
        memcpy(to, x, (size_t)terms_of(row->kind) * sizeof *x);
        break;
    }
}

/* A word without a number: stores what that means. */
static bool set_alone(struct parser *parser, const struct param *row,
                      void *node, struct location at)
{
    char *to = (char *)node + row->offset;
    double x[3] = {row->alone, row->alone, row->alone};

    switch (row->kind) {
    case PARAM_MARK:
        *(int *)to = (int)row->alone;
        return true;
    case PARAM_CLEAR:
        *(bool *)to = false;
        return true;
    case PARAM_IGNORED:
        return true;
    case PARAM_SWITCH:
        *(bool *)to = true;
        return true;
    default:
        if (isnan(row->alone))
            return parser_error(parser, at, "'%s' needs a number", row->word);
        store(row, node, x);
        return true;
    }
}

static bool takes_numbers(struct parser *parser, const struct param *row,
                          struct location at, const struct value *number,
                          int count)
{
    int most = row->kind == PARAM_PAIR ? 2 : 1;

    if (row->kind == PARAM_MARK || row->kind == PARAM_CLEAR ||
        row->kind == PARAM_CHOICE)
        return parser_error(parser, at, "'%s' takes no number", row->word);
    if (row->kind == PARAM_IGNORED)
        return true;
    if (count > most)
        return parser_error(parser, at, "'%s' takes %d number%s, not %d",
                            row->word, most, most == 1 ? "" : "s", count);
    for (int i = 0; i < count; i++)
        if (number[i].kind != VALUE_NUMBER)
            return parser_error(parser, at, "'%s' needs a number, not a %s",
                                row->word, value_name(&number[i]));
    if (terms_of(row->kind) == 1 && number->terms != 1)
        return parser_error(parser, at, "'%s' needs a float, not a %s",
                            row->word, value_name(number));
    return true;
}

bool param_set(struct parser *parser, const struct param *row, void *node,
               struct location at, const struct value *number, int count,
               struct location number_at)
{
    if (count == 0)
        return set_alone(parser, row, node, at);
    if (!takes_numbers(parser, row, number_at, number, count))
        return false;
    if (row->kind == PARAM_IGNORED)
        return true;

    int terms = terms_of(row->kind);
    struct value x = value_promote(*number, terms);
    if (row->kind == PARAM_PAIR) {
        terms = 2;
        x.v[1] = count == 2 ? number[1].v[0] : row->start[1];
    }
    if (!check_terms(parser, row, x.v, terms, number_at))
        return false;
    store(row, node, x.v);
    return true;
}

/* Names the words that could have been chosen; a NULL choice: no word is. */
static bool wrong_choice(struct parser *parser, const struct param *row,
                         const char *choice, struct location at)
{
    char words[200];
    size_t used = 0;

    if (row->kind != PARAM_CHOICE)
        return parser_error(parser, at, "'%s' takes a number, not '%s'",
                            row->word, choice);
    for (int i = 0; row->choice[i] && used < sizeof words; i++)
        used += (size_t)snprintf(words + used, sizeof words - used, "%s%s",
                                 i == 0               ? ""
                                 : row->choice[i + 1] ? ", "
                                                      : " or ",
                                 row->choice[i]);
    if (!choice)
        return parser_error(parser, at, "'%s' must be %s", row->word, words);
    return parser_error(parser, at, "'%s' must be %s, not '%s'", row->word,
                        words, choice);
}

bool param_choose(struct parser *parser, const struct param *row, void *node,
                  const char *choice, struct location at)
{
    if (choice && row->kind == PARAM_CHOICE)
        for (int i = 0; row->choice[i]; i++)
            if (!strcmp(row->choice[i], choice)) {
                *(int *)((char *)node + row->offset) = i;
                return true;
            }
    return wrong_choice(parser, row, choice, at);
}
