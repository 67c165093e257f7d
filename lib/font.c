#include "lib/font.h"
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "lib/memory.h"

enum { SEGMENT = 8, FAILED = -1 };

/* The outlines so far. */
struct pen {
    double *numbers;
    size_t count, capacity;
    size_t glyph;           /* place of the number of its segments         */
    double x, y, scale;     /* the glyph's origin; the em of a unit        */
    double at[2], start[2]; /* of the contour                              */
    struct brume_error *err;
};

static bool put(struct pen *p, const double *numbers, size_t count)
{
    double *grown = memory_grow(p->numbers, &p->capacity, p->count + count,
                                sizeof *grown, p->err);
    if (!grown)
        return false;
    p->numbers = grown;
    memcpy(grown + p->count, numbers, count * sizeof *numbers);
    p->count += count;
    return true;
}

static void place(const struct pen *p, const FT_Vector *v, double out[2])
{
    out[0] = p->x + p->scale * (double)v->x;
    out[1] = p->y + p->scale * (double)v->y;
}

static int put_cubic(struct pen *p, const double a[2], const double b[2],
                     const double end[2])
{
    double segment[SEGMENT] = {p->at[0], p->at[1], a[0],   a[1],
                               b[0],     b[1],     end[0], end[1]};
    if (!put(p, segment, SEGMENT))
        return FAILED;
    p->numbers[p->glyph] += 1.0;
    memcpy(p->at, end, sizeof p->at);
    return 0;
}

/* The points of a third of the way from a to b, and of two. */
static int put_line(struct pen *p, const double end[2])
{
    double a[2], b[2];
    if (end[0] == p->at[0] && end[1] == p->at[1])
        return 0;
    for (int i = 0; i < 2; i++) {
        a[i] = p->at[i] + (end[i] - p->at[i]) / 3.0;
        b[i] = end[i] + (p->at[i] - end[i]) / 3.0;
    }
    return put_cubic(p, a, b, end);
}

static int move_to(const FT_Vector *to, void *user)
{
    struct pen *p = user;
    int failed = put_line(p, p->start);
    place(p, to, p->start);
    memcpy(p->at, p->start, sizeof p->at);
    return failed;
}

static int line_to(const FT_Vector *to, void *user)
{
    struct pen *p = user;
    double end[2];
    place(p, to, end);
    return put_line(p, end);
}

/* A parabola's control point is 3/2 as far from the ends as a cubic's. */
static int conic_to(const FT_Vector *control, const FT_Vector *to, void *user)
{
    struct pen *p = user;
    double c[2], end[2], a[2], b[2];
    place(p, control, c);
    place(p, to, end);
    for (int i = 0; i < 2; i++) {
        a[i] = p->at[i] + (c[i] - p->at[i]) * 2.0 / 3.0;
        b[i] = end[i] + (c[i] - end[i]) * 2.0 / 3.0;
    }
    return put_cubic(p, a, b, end);
}

static int cubic_to(const FT_Vector *first, const FT_Vector *second,
                    const FT_Vector *to, void *user)
{
    struct pen *p = user;
    double a[2], b[2], end[2];
    place(p, first, a);
    place(p, second, b);
    place(p, to, end);
    return put_cubic(p, a, b, end);
}

/* A blank has its place all the same: it counts in the extent of a text. */
static bool put_point(struct pen *p)
{
    p->at[0] = p->x;
    p->at[1] = p->y;
    return put_cubic(p, p->at, p->at, p->at) == 0;
}

/* Adds the outline of the face's glyph, and moves on by its advance. */
static bool put_glyph(struct pen *p, FT_Face face)
{
    const FT_Outline_Funcs funcs = {move_to, line_to, conic_to, cubic_to, 0, 0};
    const double none = 0.0;
    p->glyph = p->count;
    p->at[0] = p->at[1] = p->start[0] = p->start[1] = 0.0;
    if (!put(p, &none, 1) ||
        FT_Outline_Decompose(&face->glyph->outline, &funcs, p) != 0 ||
        put_line(p, p->start) != 0)
        return false;
    if (p->numbers[p->glyph] == 0.0 && !put_point(p))
        return false;
    p->x += p->scale * (double)face->glyph->metrics.horiAdvance;
    return true;
}

/* The next character of the text; bytes that are no UTF-8 are Latin-1. */
static uint32_t next_character(const char **text)
{
    const unsigned char *s = (const unsigned char *)*text;
    int more = s[0] >= 0xf0 ? 3 : s[0] >= 0xe0 ? 2 : s[0] >= 0xc0 ? 1 : 0;
    uint32_t c = s[0] & (more > 0 ? 0x3fu >> more : 0x7fu);
    for (int i = 1; i <= more; i++) {
        if ((s[i] & 0xc0) != 0x80) {
            more = 0;
            break;
        }
        c = c << 6 | (s[i] & 0x3fu);
    }
    *text += 1 + more;
    return more > 0 ? c : s[0];
}

/* A line begins at the left edge of its first glyph, and pairs are kerned. */
static void approach(struct pen *p, FT_Face face, FT_UInt before, FT_UInt glyph,
                     bool first)
{
    FT_Vector kern = {0, 0};
    if (first)
        p->x = -p->scale * (double)face->glyph->metrics.horiBearingX;
    else if (FT_Get_Kerning(face, before, glyph, FT_KERNING_UNSCALED, &kern) ==
             0)
        p->x += p->scale * (double)kern.x;
}

static bool put_text(struct pen *p, FT_Face face, const char *path,
                     const char *text, const double offset[2])
{
    FT_UInt glyph = 0, before;
    const char *start = text;
    p->scale = 1.0 / (double)face->units_per_EM;
    while (*text) {
        bool first = text == start;
        uint32_t c = next_character(&text);
        before = glyph;
        glyph = FT_Get_Char_Index(face, c);
        if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE) != 0 ||
            face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
            return brume_fail_file(p->err, path,
                                   "the font has no outline for U+%04X", c);
        approach(p, face, before, glyph, first);
        if (!put_glyph(p, face))
            return brume_fail_file(p->err, path,
                                   "the outline of U+%04X cannot be read", c);
        p->x += offset[0];
        p->y += offset[1];
    }
    return true;
}

static bool with_library(FT_Library library, const char *path, const char *text,
                         const double offset[2], struct pen *pen)
{
    FT_Face face;
    if (FT_New_Face(library, path, 0, &face) != 0)
        return brume_fail_file(pen->err, path,
                               "this is no font that can be read");
    bool good = FT_IS_SCALABLE(face) && face->units_per_EM > 0
                    ? put_text(pen, face, path, text, offset)
                    : brume_fail_file(pen->err, path,
                                      "the font has no outlines");
    FT_Done_Face(face);
    return good;
}

bool font_outline(const char *path, const char *text, const double offset[2],
                  double **numbers, size_t *count, struct brume_error *err)
{
    FT_Library library;
    struct pen pen = {.err = err};
    if (FT_Init_FreeType(&library) != 0)
        return brume_fail(err, BRUME_ERR_MEMORY, "FreeType does not start");
    const double none = 0.0;
    bool good = with_library(library, path, text, offset, &pen) &&
                (pen.count > 0 || (put(&pen, &none, 1) && put_point(&pen)));
    FT_Done_FreeType(library);
    if (!good) {
        free(pen.numbers);
        return false;
    }
    *numbers = pen.numbers;
    *count = pen.count;
    return true;
}

/* ---- substitutes ------------------------------------------------------- */

static bool name_has(const char *name, const char *const *words)
{
    char low[256];
    size_t n = 0;
    for (; name[n] && n + 1 < sizeof low; n++)
        low[n] = (char)tolower((unsigned char)name[n]);
    low[n] = '\0';
    for (; *words; words++)
        if (strstr(low, *words))
            return true;
    return false;
}

bool font_substitute(const char *name, char *path, size_t size)
{
    static const char *const serif[] = {"tim",     "roman",    "serif", "cmr",
                                        "georgia", "garamond", NULL};
    static const char *const fixed[] = {"crystal", "cour",  "mono",
                                        "consol",  "fixed", NULL};
    static const char *const sans[] = {"sans", NULL};
    static const char *const patterns[] = {
        "/usr/share/fonts/truetype/liberation/Liberation%s-Regular.ttf",
        "/usr/share/fonts/truetype/liberation2/Liberation%s-Regular.ttf",
        "/usr/share/fonts/truetype/dejavu/DejaVu%s.ttf"};
    static const char *const kinds[3][2] = {
        {"Sans", "Sans"}, {"Serif", "Serif"}, {"Mono", "SansMono"}};
    int kind = name_has(name, fixed)  ? 2
               : name_has(name, sans) ? 0
                                      : name_has(name, serif);
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        const char *pattern = patterns[i];
        const char *mark = strstr(pattern, "%s");
        int length = snprintf(path, size, "%.*s%s%s", (int)(mark - pattern),
                              pattern, kinds[kind][i == 2], mark + 2);
        if (length > 0 && (size_t)length < size && access(path, R_OK) == 0)
            return true;
    }
    return false;
}
