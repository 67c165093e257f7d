/* solid_sor.h - a surface of revolution: the square of the distance from the
 * y axis is piecewise a cubic of the height.
 *
 * Data: number of segments, 1 if open (without caps), height of the middle,
 * radius of a ball around it; a segment is SOR_SEGMENT numbers: the heights
 * and squared radii of its ends, then the coefficients of the squared radius
 * in the height above its lower end. Three crossings a segment and two of the
 * caps at most; part is the segment, SOR_BOTTOM or SOR_TOP. */
#ifndef CORE_PHYSICS_SOLID_SOR_H
#define CORE_PHYSICS_SOLID_SOR_H
#include "core/physics/polynomial.h"
#include "core/physics/solid.h"

enum { SOR_HEAD = 4, SOR_SEGMENT = 8, SOR_CUBIC = 4 };
enum { SOR_BOTTOM = -1, SOR_TOP = -2 };

/* A stretch of the line between two heights, or the ends of its ball. */
typedef struct {
    double from, to;        /* u                                            */
    bool out_from, out_to;  /* outside there                                */
    bool end_from, end_to;  /* at a height, not at the ball                 */
} sor_stretch;

HD double sor_square(const solid_line *l, double u)
{
    double x = l->p.x + u * l->d.x, z = l->p.z + u * l->d.z;
    return x * x + z * z;
}

/* False where the line is never between the heights. */
HD bool sor_stretch_make(const double *segment, const solid_line *l,
                         sor_stretch *on)
{
    on->from = -l->half;
    on->to = l->half;
    on->out_from = on->out_to = true;
    on->end_from = on->end_to = false;
    if (l->d.y == 0.0)
        return l->p.y >= segment[0] && l->p.y < segment[1];
    int lower = l->d.y > 0.0 ? 0 : 1, upper = 1 - lower;
    double a = (segment[lower] - l->p.y) / l->d.y;
    double b = (segment[upper] - l->p.y) / l->d.y;
    if (a > on->from) {
        on->from = a;
        on->end_from = true;
        on->out_from = sor_square(l, a) - segment[2 + lower] >= 0.0;
    }
    if (b < on->to) {
        on->to = b;
        on->end_to = true;
        on->out_to = sor_square(l, b) - segment[2 + upper] >= 0.0;
    }
    return on->from < on->to;
}

/* Distance^2 - radius^2 as a polynomial of s, u = from + s (to - from). */
HD void sor_cubic(const double *segment, const solid_line *l,
                  const sor_stretch *on, double c[4])
{
    const double *f = segment + SOR_CUBIC;
    double h = on->to - on->from;
    double x = l->p.x + on->from * l->d.x, dx = h * l->d.x;
    double z = l->p.z + on->from * l->d.z, dz = h * l->d.z;
    double y = l->p.y + on->from * l->d.y - segment[0], dy = h * l->d.y;
    c[0] = x * x + z * z - polynomial_value(f, 3, y);
    c[1] = 2.0 * (x * dx + z * dz) -
           dy * (f[1] + y * (2.0 * f[2] + 3.0 * y * f[3]));
    c[2] = dx * dx + dz * dz - dy * dy * (f[2] + 3.0 * y * f[3]);
    c[3] = -dy * dy * dy * f[3];
}

/* A cap is met where the stretch that begins or ends there is inside. */
HD int sor_caps(const double *data, const solid_line *l, int segment,
                const sor_stretch *on, double *t, int *part, int n, int room)
{
    bool up = l->d.y > 0.0;
    int first = up ? 0 : (int)data[0] - 1, last = (int)data[0] - 1 - first;
    if (on->end_from && !on->out_from && segment == first)
        n = solid_insert(solid_line_t(l, on->from), up ? SOR_BOTTOM : SOR_TOP,
                         t, part, n, room);
    if (on->end_to && !on->out_to && segment == last)
        n = solid_insert(solid_line_t(l, on->to), up ? SOR_TOP : SOR_BOTTOM,
                         t, part, n, room);
    return n;
}

HD int sor_roots(const double *data, dvec3 o, dvec3 d, double *t, int *part,
                 int room)
{
    solid_line l;
    int n = 0, count = (int)data[0];
    bool open = data[1] != 0.0;
    if (!open)
        room &= ~1;
    if (!solid_line_make(o, d, dvec3_make(0.0, data[2], 0.0), data[3], &l))
        return 0;
    for (int i = 0; i < count; i++) {
        const double *segment = data + SOR_HEAD + SOR_SEGMENT * i;
        sor_stretch on;
        double c[4], s[5];
        if (!sor_stretch_make(segment, &l, &on))
            continue;
        sor_cubic(segment, &l, &on, c);
        int found = polynomial_link(c, 3, on.out_from, on.out_to, s);
        for (int k = 0; k < found; k++)
            n = solid_insert(solid_line_t(&l, on.from +
                                              s[k] * (on.to - on.from)),
                             i, t, part, n, room);
        if (!open)
            n = sor_caps(data, &l, i, &on, t, part, n, room);
    }
    return n;
}

HD dvec3 sor_normal(const double *data, dvec3 p, int part)
{
    if (part < 0 || part >= (int)data[0])
        return dvec3_make(0.0, part == SOR_BOTTOM ? -1.0 : 1.0, 0.0);
    const double *segment = data + SOR_HEAD + SOR_SEGMENT * part;
    double slope;
    polynomial_slope(segment + SOR_CUBIC, 3, p.y - segment[0], &slope);
    return dvec3_make(p.x, -0.5 * slope, p.z);
}

HD bool sor_inside(const double *data, dvec3 p)
{
    int count = (int)data[0];
    for (int i = 0; i < count; i++) {
        const double *segment = data + SOR_HEAD + SOR_SEGMENT * i;
        if (p.y >= segment[0] && p.y <= segment[1])
            return p.x * p.x + p.z * p.z <=
                   polynomial_value(segment + SOR_CUBIC, 3,
                                    p.y - segment[0]);
    }
    return false;
}

#endif
