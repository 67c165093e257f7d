#include "lib/number.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/* What the digits say: mantissa 10^exponent. */
struct decimal {
    uint64_t mantissa;
    int exponent;
    int digits; /* of the mantissa, without leading zeros          */
};

/* A mantissa of so many digits cannot overflow. */
enum { DIGITS = 19, EXPONENT_MAX = 100000 };

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static const char *read_digits(const char *c, struct decimal *d)
{
    for (; is_digit(*c); c++) {
        d->digits += d->digits > 0 || *c != '0';
        if (d->digits <= DIGITS)
            d->mantissa = d->mantissa * 10 + (uint64_t)(*c - '0');
    }
    return c;
}

static const char *read_exponent(const char *c, int *exponent)
{
    const char *digit = c + 1 + (c[1] == '-' || c[1] == '+');
    int e = 0;
    if (!is_digit(*digit))
        return c;
    for (; is_digit(*digit); digit++)
        e = e < EXPONENT_MAX ? e * 10 + (*digit - '0') : e;
    *exponent += c[1] == '-' ? -e : e;
    return digit;
}

/* Exact where mantissa and power of ten are exact doubles: one rounding
 * (Clinger, "How to read floating point numbers accurately", 1990). */
static bool convert(const struct decimal *d, double *value)
{
    static const double power[] = {
        1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
        1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const int most = sizeof power / sizeof *power - 1;
    if (d->digits > DIGITS || d->mantissa > (uint64_t)1 << 53 ||
        d->exponent > most || d->exponent < -most)
        return false;
    double mantissa = (double)d->mantissa;
    *value = d->exponent < 0 ? mantissa / power[-d->exponent]
                             : mantissa * power[d->exponent];
    return true;
}

const char *number_read(const char *text, double *value)
{
    struct decimal d = {0};
    const char *c = read_digits(text, &d);
    size_t before = (size_t)(c - text);
    if (*c == '.') {
        const char *point = c;
        c = read_digits(c + 1, &d);
        ptrdiff_t places = c - point - 1;
        d.exponent = places < EXPONENT_MAX ? -(int)places : -EXPONENT_MAX;
        if (before == 0 && c == point + 1)
            return NULL;
    } else if (before == 0) {
        return NULL;
    }
    if (*c == 'e' || *c == 'E')
        c = read_exponent(c, &d.exponent);
    if (!convert(&d, value))
        *value = strtod(text, NULL);
    return c;
}
