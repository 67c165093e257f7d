/* builtin.c - the functions of the language, as a table. */
#include "parser/builtin.h"
#include "parser/report.h"
#include "parser/utf8.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* A call under way. Arguments are converted as the signature says: `f` float,
 * `v` vector of three terms, `n` number as it is, `s` string. */
struct call {
    struct parser *parser;
    const char *word;
    const struct value *argument;
    int count;
    struct location at;
};

struct builtin {
    const char *word;
    const char *signature;     /* its last letter goes for all that follow */
    int least, most;           /* arguments                               */
    double (*plain)(double x); /* the function of one float, or NULL      */
    struct value (*run)(struct call *call);
};

enum { ANY = 1 << 20 };

static double argument(const struct call *call, int i)
{
    return call->argument[i].v[0];
}

static struct value domain_error(struct call *call, double x)
{
    parser_error(call->parser, call->at, "%s of %g is not defined", call->word,
                 x);
    return value_float(0);
}

/* ---- floats ------------------------------------------------------------ */

static const double PI = 3.14159265358979323846;

static double degrees(double x)
{
    return x * 180 / PI;
}

static double square(double x)
{
    return x * x;
}

static double radians(double x)
{
    return x * PI / 180;
}

static struct value run_sqrt(struct call *call)
{
    double x = argument(call, 0);
    return x < 0 ? domain_error(call, x) : value_float(sqrt(x));
}

static struct value run_ln(struct call *call)
{
    double x = argument(call, 0);
    return x <= 0 ? domain_error(call, x) : value_float(log(x));
}

static struct value run_log(struct call *call)
{
    double x = argument(call, 0);
    return x <= 0 ? domain_error(call, x) : value_float(log10(x));
}

/* An inverse of sine or cosine: the argument is held to [-1, 1]. */
static double unit_argument(struct call *call)
{
    double x = argument(call, 0);
    if (x < -1 || x > 1) {
        parser_warn(call->parser, call->at, "%s of %g: taken as %s of %d",
                    call->word, x, call->word, x < 0 ? -1 : 1);
    }
    return x < -1 ? -1 : x > 1 ? 1 : x;
}

static struct value run_asin(struct call *call)
{
    return value_float(asin(unit_argument(call)));
}

static struct value run_acos(struct call *call)
{
    return value_float(acos(unit_argument(call)));
}

static struct value run_acosh(struct call *call)
{
    double x = argument(call, 0);
    return x < 1 ? domain_error(call, x) : value_float(acosh(x));
}

static struct value run_atanh(struct call *call)
{
    double x = argument(call, 0);
    return x <= -1 || x >= 1 ? domain_error(call, x) : value_float(atanh(x));
}

static struct value run_atan2(struct call *call)
{
    return value_float(atan2(argument(call, 0), argument(call, 1)));
}

static struct value run_pow(struct call *call)
{
    double x = argument(call, 0), y = argument(call, 1);
    double power = pow(x, y);
    if (x == 0 && y == 0) {
        parser_error(call->parser, call->at, "pow(0, 0) is not defined");
        return value_float(0);
    }
    if (isnan(power) && !isnan(x) && !isnan(y)) {
        parser_warn(call->parser, call->at, "pow(%g, %g) is no number", x, y);
    }
    return value_float(power);
}

/* True, with a warning, if the second argument is 0. */
static bool divides_by_zero(struct call *call)
{
    if (argument(call, 1) != 0) {
        return false;
    }
    parser_warn(call->parser, call->at, "%s by zero gives infinity",
                call->word);
    return true;
}

static struct value run_div(struct call *call)
{
    return value_float(divides_by_zero(call)
                           ? HUGE_VAL
                           : trunc(argument(call, 0) / argument(call, 1)));
}

static struct value run_mod(struct call *call)
{
    return value_float(divides_by_zero(call)
                           ? HUGE_VAL
                           : fmod(argument(call, 0), argument(call, 1)));
}

static struct value run_min(struct call *call)
{
    double least = argument(call, 0);
    for (int i = 1; i < call->count; i++) {
        least = argument(call, i) < least ? argument(call, i) : least;
    }
    return value_float(least);
}

static struct value run_max(struct call *call)
{
    double most = argument(call, 0);
    for (int i = 1; i < call->count; i++) {
        most = argument(call, i) > most ? argument(call, i) : most;
    }
    return value_float(most);
}

static struct value run_select(struct call *call)
{
    double x = argument(call, 0);
    int chosen = x < 0 ? 1 : x > 0 && call->count == 4 ? 3 : 2;
    return call->argument[chosen];
}

/* A float as the integer that bitwise functions see: what does not fit is the
 * least one, as the processors do it that POV-Ray runs on. */
static int32_t integer(double x)
{
    double whole = trunc(x);
    bool fits = whole >= INT32_MIN && whole <= INT32_MAX;
    return fits ? (int32_t)whole : INT32_MIN;
}

static struct value run_bitwise(struct call *call)
{
    int32_t bits = integer(argument(call, 0));
    char kind = call->word[strlen("bitwise_")];
    for (int i = 1; i < call->count; i++) {
        int32_t other = integer(argument(call, i));
        bits = kind == 'a'   ? bits & other
               : kind == 'o' ? bits | other
                             : bits ^ other;
    }
    return value_float(bits);
}

/* ---- random streams ---------------------------------------------------- */

/* x <- x 1812433253 + 12345 mod 2^32, found by probing POV-Ray 3.7. */
static struct value run_rand(struct call *call)
{
    struct parser *parser = call->parser;
    double which = argument(call, 0);
    if (!(which >= 0 && which < (double)parser->randoms)) {
        parser_error(parser, call->at,
                     "there is no random stream %g: "
                     "seed() begins one",
                     which);
        return value_float(0);
    }
    uint32_t *state = &parser->random[(size_t)which];
    *state = *state * 1812433253u + 12345u;
    return value_float(*state / 4294967295.0);
}

static struct value run_seed(struct call *call)
{
    struct parser *parser = call->parser;
    void *random = parser->random;
    if (!arena_grow(&parser->arena, &random, &parser->random_room,
                    parser->randoms + 1, sizeof *parser->random)) {
        report_no_memory(parser);
        return value_float(0);
    }
    parser->random = random;
    parser->random[parser->randoms] = (uint32_t)integer(argument(call, 0));
    return value_float((double)parser->randoms++);
}

/* ---- vectors ----------------------------------------------------------- */

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static struct value run_vdot(struct call *call)
{
    return value_float(dot(call->argument[0].v, call->argument[1].v));
}

static struct value run_vlength(struct call *call)
{
    return value_float(sqrt(dot(call->argument[0].v, call->argument[0].v)));
}

static void cross(const double *a, const double *b, double *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static struct value run_vcross(struct call *call)
{
    double v[3];
    cross(call->argument[0].v, call->argument[1].v, v);
    return value_vector(3, v);
}

/* The unit vector, or the zero vector with a warning. */
static struct value normalized(struct call *call, const struct value *value)
{
    double length = sqrt(dot(value->v, value->v));
    struct value unit = *value;
    if (length == 0) {
        parser_warn(call->parser, call->at, "%s of a vector of length 0",
                    call->word);
        return unit;
    }
    for (int i = 0; i < 3; i++) {
        unit.v[i] /= length;
    }
    return unit;
}

static struct value run_vnormalize(struct call *call)
{
    return normalized(call, &call->argument[0]);
}

static void turn(double *a, double *b, double angle)
{
    double c = cos(radians(angle)), s = sin(radians(angle)), old = *a;
    *a = old * c - *b * s;
    *b = old * s + *b * c;
}

/* About x, then y, then z. */
static struct value run_vrotate(struct call *call)
{
    struct value v = call->argument[0];
    const double *angle = call->argument[1].v;
    turn(&v.v[1], &v.v[2], angle[0]);
    turn(&v.v[2], &v.v[0], angle[1]);
    turn(&v.v[0], &v.v[1], angle[2]);
    return v;
}

/* Rodrigues: v cos + (k x v) sin + k (k.v)(1 - cos). */
static struct value run_vaxis_rotate(struct call *call)
{
    struct value v = call->argument[0];
    struct value k = normalized(call, &call->argument[1]);
    double angle = radians(argument(call, 2));
    double along = dot(k.v, v.v), side[3];
    if (dot(k.v, k.v) == 0) {
        return v;
    }
    cross(k.v, v.v, side);
    for (int i = 0; i < 3; i++) {
        v.v[i] = v.v[i] * cos(angle) + side[i] * sin(angle) +
                 k.v[i] * along * (1 - cos(angle));
    }
    return v;
}

static struct value run_vturbulence(struct call *call)
{
    double v[3];

    brume_turbulence(call->argument[3].v, argument(call, 2), argument(call, 0),
                     argument(call, 1), v);
    return value_vector(3, v);
}

/* ---- strings ----------------------------------------------------------- */

static struct value copy_string(struct call *call, const char *text,
                                size_t length)
{
    char *copy = parser_alloc(call->parser, length + 1);
    if (copy && length) {
        memcpy(copy, text, length);
    }
    return value_string(copy ? copy : "", copy ? length : 0);
}

static struct string string_argument(const struct call *call, int i)
{
    return call->argument[i].string;
}

static struct value run_asc(struct call *call)
{
    struct string s = string_argument(call, 0);
    size_t size;
    return value_float(s.length ? utf8_decode(s.text, s.length, &size) : 0);
}

static struct value run_chr(struct call *call)
{
    double code = argument(call, 0);
    char text[4];
    if (!(code >= 0 && code <= 0x10FFFF)) {
        return domain_error(call, code);
    }
    return copy_string(call, text, utf8_encode((uint32_t)code, text));
}

static struct value run_concat(struct call *call)
{
    size_t length = 0;
    for (int i = 0; i < call->count; i++) {
        length += string_argument(call, i).length;
    }
    char *text = parser_alloc(call->parser, length + 1);
    size_t at = 0;
    for (int i = 0; text && i < call->count; i++) {
        struct string s = string_argument(call, i);
        memcpy(text + at, s.text, s.length);
        at += s.length;
    }
    return value_string(text ? text : "", at);
}

/* The format of str and vstr from their width and precision: a negative width
 * pads with zeros, a negative precision is that of printf. */
static bool number_format(struct call *call, int first, char *format,
                          size_t room)
{
    enum { WIDEST = 400 };
    double width = trunc(argument(call, first));
    double precision = trunc(argument(call, first + 1));
    if (!(fabs(width) <= WIDEST) || !(fabs(precision) <= WIDEST)) {
        parser_error(call->parser, call->at,
                     "%s: width %g and precision %g "
                     "must be within %d",
                     call->word, width, precision, WIDEST);
        return false;
    }
    int used = snprintf(format, room, "%%%s%d", width < 0 ? "0" : "",
                        abs((int)width));
    snprintf(format + used, room - (size_t)used, precision < 0 ? "f" : ".%df",
             (int)precision);
    return true;
}

enum { NUMBER_ROOM = 1200 }; /* 309 digits, a point and 400 more        */

/* `format` comes from number_format. */
static int write_number(char *text, const char *format, double x)
{
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    return snprintf(text, NUMBER_ROOM, format, x);
#pragma GCC diagnostic pop
}

static struct value run_str(struct call *call)
{
    char format[32], text[NUMBER_ROOM];
    if (!number_format(call, 1, format, sizeof format)) {
        return value_string("", 0);
    }
    int length = write_number(text, format, argument(call, 0));
    return copy_string(call, text, (size_t)length);
}

static struct value run_vstr(struct call *call)
{
    double asked = trunc(argument(call, 0));
    int terms = asked > VALUE_TERMS ? VALUE_TERMS : asked >= 1 ? (int)asked : 1;
    struct value v = call->argument[1];
    struct string between = string_argument(call, 2);
    char format[32];
    if (!number_format(call, 3, format, sizeof format)) {
        return value_string("", 0);
    }
    char *text = parser_alloc(call->parser,
                              VALUE_TERMS * (NUMBER_ROOM + between.length));
    size_t at = 0;
    for (int i = 0; text && i < terms; i++) {
        if (i > 0) {
            memcpy(text + at, between.text, between.length);
            at += between.length;
        }
        at += (size_t)write_number(text + at, format, v.v[i]);
    }
    return value_string(text ? text : "", at);
}

/* Days since the year 2000, as strftime writes them, in Greenwich. */
static struct value run_datetime(struct call *call)
{
    enum { LONGEST = 1024, DAYS = 2900000 };
    static const int64_t start = 946684800;
    double days = argument(call, 0);
    struct string format = call->count > 1
                               ? string_argument(call, 1)
                               : (struct string){"%Y-%m-%d %H:%M:%SZ", 18};
    char text[LONGEST];
    struct tm tm;
    if (!(fabs(days) <= DAYS)) {
        return domain_error(call, days);
    }
    time_t seconds = (time_t)(start + (int64_t)floor(days * 86400 + 0.5));
    gmtime_r(&seconds, &tm);
    tm.tm_isdst = -1; /* no zone is told                         */
    tm.tm_zone = "";
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    size_t length = strftime(text, sizeof text, format.text, &tm);
#pragma GCC diagnostic pop
    if (length == 0) {
        parser_error(call->parser, call->at,
                     "datetime: this format gives nothing, or more than %d "
                     "bytes",
                     LONGEST);
    }
    return copy_string(call, text, length);
}

static struct value run_strcmp(struct call *call)
{
    return value_float(value_compare_strings(string_argument(call, 0),
                                             string_argument(call, 1)));
}

static struct value run_strlen(struct call *call)
{
    struct string s = string_argument(call, 0);
    return value_float((double)utf8_count(s.text, s.length));
}

/* ASCII letters only, as in POV-Ray. */
static struct value run_change_case(struct call *call)
{
    struct string s = string_argument(call, 0);
    bool up = strcmp(call->word, "strupr") == 0;
    char *text = parser_alloc(call->parser, s.length + 1);
    for (size_t i = 0; text && i < s.length; i++) {
        char c = s.text[i];
        bool change = up ? c >= 'a' && c <= 'z' : c >= 'A' && c <= 'Z';
        text[i] = (char)(change ? c ^ 0x20 : c);
    }
    return value_string(text ? text : "", text ? s.length : 0);
}

static struct value run_substr(struct call *call)
{
    struct string s = string_argument(call, 0);
    double first = trunc(argument(call, 1)), count = trunc(argument(call, 2));
    size_t length = utf8_count(s.text, s.length);
    if (!(first >= 1 && count >= 0 && first - 1 + count <= (double)length)) {
        parser_error(call->parser, call->at,
                     "substr: %g characters from "
                     "character %g of a string of %zu",
                     count, first, length);
        return value_string("", 0);
    }
    size_t start = utf8_cut(s.text, s.length, (size_t)first - 1);
    return copy_string(
        call, s.text + start,
        utf8_cut(s.text + start, s.length - start, (size_t)count));
}

static struct value run_val(struct call *call)
{
    struct string s = string_argument(call, 0);
    char text[64];
    size_t length = s.length < sizeof text ? s.length : sizeof text - 1;
    memcpy(text, s.text, length);
    text[length] = 0;
    return value_float(strtod(text, NULL));
}

static struct value run_file_exists(struct call *call)
{
    return value_float(
        parser_file_exists(call->parser, call->at, string_argument(call, 0)));
}

/* ---- the table --------------------------------------------------------- */

static const struct builtin table[] = {
    {"abs", "f", 1, 1, fabs, NULL},
    {"acos", "f", 1, 1, NULL, run_acos},
    {"acosh", "f", 1, 1, NULL, run_acosh},
    {"asc", "s", 1, 1, NULL, run_asc},
    {"asin", "f", 1, 1, NULL, run_asin},
    {"asinh", "f", 1, 1, asinh, NULL},
    {"atan", "f", 1, 1, atan, NULL},
    {"atan2", "f", 2, 2, NULL, run_atan2},
    {"atanh", "f", 1, 1, NULL, run_atanh},
    {"bitwise_and", "f", 2, ANY, NULL, run_bitwise},
    {"bitwise_or", "f", 2, ANY, NULL, run_bitwise},
    {"bitwise_xor", "f", 2, ANY, NULL, run_bitwise},
    {"ceil", "f", 1, 1, ceil, NULL},
    {"chr", "f", 1, 1, NULL, run_chr},
    {"concat", "s", 1, ANY, NULL, run_concat},
    {"cos", "f", 1, 1, cos, NULL},
    {"cosh", "f", 1, 1, cosh, NULL},
    {"datetime", "fs", 1, 2, NULL, run_datetime},
    {"degrees", "f", 1, 1, degrees, NULL},
    {"div", "f", 2, 2, NULL, run_div},
    {"exp", "f", 1, 1, exp, NULL},
    {"file_exists", "s", 1, 1, NULL, run_file_exists},
    {"floor", "f", 1, 1, floor, NULL},
    {"int", "f", 1, 1, trunc, NULL},
    {"ln", "f", 1, 1, NULL, run_ln},
    {"log", "f", 1, 1, NULL, run_log},
    {"max", "f", 1, ANY, NULL, run_max},
    {"min", "f", 1, ANY, NULL, run_min},
    {"mod", "f", 2, 2, NULL, run_mod},
    {"pow", "f", 2, 2, NULL, run_pow},
    {"radians", "f", 1, 1, radians, NULL},
    {"rand", "f", 1, 1, NULL, run_rand},
    {"seed", "f", 1, 1, NULL, run_seed},
    {"select", "fn", 3, 4, NULL, run_select},
    {"sin", "f", 1, 1, sin, NULL},
    {"sinh", "f", 1, 1, sinh, NULL},
    {"sqr", "f", 1, 1, square, NULL},
    {"sqrt", "f", 1, 1, NULL, run_sqrt},
    {"str", "f", 3, 3, NULL, run_str},
    {"strcmp", "s", 2, 2, NULL, run_strcmp},
    {"strlen", "s", 1, 1, NULL, run_strlen},
    {"strlwr", "s", 1, 1, NULL, run_change_case},
    {"strupr", "s", 1, 1, NULL, run_change_case},
    {"substr", "sf", 3, 3, NULL, run_substr},
    {"tan", "f", 1, 1, tan, NULL},
    {"tanh", "f", 1, 1, tanh, NULL},
    {"val", "s", 1, 1, NULL, run_val},
    {"vaxis_rotate", "vvf", 3, 3, NULL, run_vaxis_rotate},
    {"vcross", "v", 2, 2, NULL, run_vcross},
    {"vdot", "v", 2, 2, NULL, run_vdot},
    {"vlength", "v", 1, 1, NULL, run_vlength},
    {"vnormalize", "v", 1, 1, NULL, run_vnormalize},
    {"vrotate", "v", 2, 2, NULL, run_vrotate},
    {"vstr", "fnsff", 5, 5, NULL, run_vstr},
    {"vturbulence", "fffv", 4, 4, NULL, run_vturbulence}};

static int by_word(const void *word, const void *row)
{
    return strcmp(word, ((const struct builtin *)row)->word);
}

static const struct builtin *find(const char *word)
{
    return bsearch(word, table, sizeof table / sizeof *table, sizeof *table,
                   by_word);
}

bool builtin_exists(const char *word)
{
    return find(word) != NULL;
}

/* ---- calls ------------------------------------------------------------- */

static bool count_fits(const struct call *call, const struct builtin *row)
{
    if (call->count >= row->least && call->count <= row->most) {
        return true;
    }
    const char *how = row->least == row->most    ? ""
                      : call->count < row->least ? "at least "
                                                 : "at most ";
    int wanted = call->count < row->least ? row->least : row->most;
    return parser_error(call->parser, call->at,
                        "%s takes %s%d argument%s, %d given", row->word, how,
                        wanted, wanted == 1 ? "" : "s", call->count);
}

/* Converts one argument; false: it is of the wrong kind, reported. */
static bool convert(const struct call *call, int i, char kind, struct value *to)
{
    static const struct {
        char kind;
        const char *name;
    } names[] = {{'f', "a float"},
                 {'v', "a vector"},
                 {'n', "a number"},
                 {'s', "a string"}};
    const struct value *value = &call->argument[i];
    bool number = value->kind == VALUE_NUMBER;
    bool fits = kind == 's'
                    ? !number
                    : number && (kind == 'n' ||
                                 value->terms <= (kind == 'f' ? 1 : 3) ||
                                 (kind == 'v' && value->terms == VALUE_TERMS));
    const char *wanted = "";
    for (int j = 0; j < 4; j++) {
        wanted = names[j].kind == kind ? names[j].name : wanted;
    }
    *to = kind == 'v' && number ? value_promote(*value, 3) : *value;
    return fits || parser_error(call->parser, call->at,
                                "argument %d of %s must be %s, not a %s%s",
                                i + 1, call->word, wanted, value_name(value),
                                kind == 'v' && number ? " of 4 terms" : "");
}

/* The arguments lie on the parser's stack, where they may be changed until
 * something is pushed; no function pushes. */
struct value builtin_call(struct parser *parser, const struct name *function,
                          const struct value *argument, int count,
                          struct location at)
{
    const struct builtin *row = find(function->text);
    struct call call = {parser, function->text, argument, count, at};
    struct value *to = parser->stack + parser->stacked;
    if (!row || !count_fits(&call, row)) {
        return value_float(0);
    }
    const char *kind = row->signature;
    for (int i = 0; i < count; i++) {
        if (!convert(&call, i, *kind, &to[i])) {
            return value_float(0);
        }
        kind += kind[1] != 0;
    }
    return row->plain ? value_float(row->plain(argument[0].v[0]))
                      : row->run(&call);
}
