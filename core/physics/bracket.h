/* bracket.h - roots of functions of one number, by asking for values.
 *
 * There are no function pointers here, so that the caller has the loop:
 *
 *     bracket b = bracket_make(low, high, positive_at_high);
 *     while (bracket_step(&b, f(b.t), slope_of_f(b.t)))
 *         ;
 *
 * leaves in b.t the root between two points of different signs. Newton's steps
 * as long as each is less than half of the one before, else bisection. Zero
 * counts as positive. */
#ifndef CORE_PHYSICS_BRACKET_H
#define CORE_PHYSICS_BRACKET_H
#include <math.h>
#include "core/physics/hd.h"

enum { BRACKET_STEPS = 200 };           /* never reached but by NaN         */

typedef struct {
    double t;               /* where to ask for the function                */
    double low, high;
    double before, least;   /* the last step; when it is small enough       */
    bool rising;            /* positive at `high`                           */
    int left;               /* steps                                        */
} bracket;

HD bracket bracket_make(double low, double high, bool rising)
{
    bracket b;
    b.low = low;
    b.high = high;
    b.t = 0.5 * (low + high);
    b.before = high - low;
    b.least = 1e-17 * (high - low);
    b.rising = rising;
    b.left = BRACKET_STEPS;
    return b;
}

/* Takes value and slope at b->t; false when b->t is the root. */
HD bool bracket_step(bracket *b, double f, double slope)
{
    if ((f >= 0.0) == b->rising)
        b->high = b->t;
    else
        b->low = b->t;
    double next = b->t - f / slope;
    if (!(next >= b->low && next <= b->high &&
          fabs(next - b->t) < 0.5 * b->before))
        next = 0.5 * (b->low + b->high);
    b->before = fabs(next - b->t);
    b->t = next;
    return --b->left > 0 && b->before > b->least + 2e-16 * fabs(next);
}

enum { TURNING_AT_A, TURNING_AT_B, TURNING_SEEKS, TURNING_FIRST,
       TURNING_LAST };

/* The same for a function with one extremum at most from a to b: `root` are
 * its roots there, `count` none, one or two. Two need the extremum, which is
 * sought by bisection of the slope until the sign is the other one. */
typedef struct {
    double t;               /* where to ask for the function                */
    double root[2];
    int count;
    double a, b, low, high, turn, slope;
    bool positive;          /* at a                                         */
    bracket at;
    int phase;              /* TURNING_...                                  */
    int left;
} turning;

HD turning turning_make(double a, double b)
{
    turning s;
    s.t = s.a = s.low = a;
    s.b = s.high = b;
    s.turn = s.slope = s.root[0] = s.root[1] = 0.0;
    s.count = 0;
    s.positive = false;
    s.at = bracket_make(a, b, false);
    s.phase = TURNING_AT_A;
    s.left = 64;
    return s;
}

HD bool turning_bracket(turning *s, double low, double high, bool last)
{
    s->at = bracket_make(low, high, last && s->phase != TURNING_AT_B
                                        ? s->positive : !s->positive);
    s->phase = last ? TURNING_LAST : TURNING_FIRST;
    s->t = s->at.t;
    return true;
}

/* The value at b: a root between, perhaps two, or surely none. */
HD bool turning_at_b(turning *s, double f, double slope)
{
    if ((f >= 0.0) != s->positive)
        return turning_bracket(s, s->a, s->b, true);
    s->phase = TURNING_SEEKS;
    s->t = 0.5 * (s->a + s->b);
    return s->positive ? s->slope < 0.0 && slope > 0.0
                       : s->slope > 0.0 && slope < 0.0;
}

HD bool turning_seek(turning *s, double f, double slope)
{
    if ((f >= 0.0) != s->positive) {
        s->turn = s->t;
        return turning_bracket(s, s->a, s->t, false);
    }
    if ((slope < 0.0) == s->positive)
        s->low = s->t;
    else
        s->high = s->t;
    s->t = 0.5 * (s->low + s->high);
    return --s->left > 0;
}

/* Takes value and slope at s->t; false when all roots are found. */
HD bool turning_step(turning *s, double f, double slope)
{
    switch (s->phase) {
    case TURNING_AT_A:
        s->positive = f >= 0.0;
        s->slope = slope;
        s->t = s->b;
        s->phase = TURNING_AT_B;
        return true;
    case TURNING_AT_B:
        return turning_at_b(s, f, slope);
    case TURNING_SEEKS:
        return turning_seek(s, f, slope);
    default:
        break;
    }
    bool more = bracket_step(&s->at, f, slope);
    s->t = s->at.t;
    if (more)
        return true;
    s->root[s->count++] = s->t;
    return s->phase == TURNING_FIRST &&
           turning_bracket(s, s->turn, s->b, true);
}

#endif
