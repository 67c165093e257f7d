/* filter_view.h - one frame's field seen from the cells of another's. */
#ifndef CORE_FILTER_VIEW_H
#define CORE_FILTER_VIEW_H
#include "core/filter.h"

enum { FILTER_MAX_NUMBERS = 16 };

struct filter_view {
    const struct filter_field *field;   /* NULL: there is nothing to see   */
    bool aligned;               /* cell i is the other's i + shift          */
    double scale, shift[3];     /* of cells' numbers, 0 at the first middle */
    int offset[3];
    float gain;                 /* from its unit of length to the other's   */
    const struct flat *from;    /* set where the eye's place matters        */
    double turn;                /* of the way to it, in radians, at most    */
};

/* A field of other numbers than the flat scene's has nothing to see. */
void filter_view_init(struct filter_view *view, const struct flat *from,
                      const struct filter_field *field);

/* The numbers at the middle of a cell of the flat scene's lattice. False: the
 * field has no cell there, or knows it from too different a side. */
bool filter_view_cell(const struct filter_view *view, const int at[3],
                      float out[FILTER_MAX_NUMBERS]);

/* The first cell of a brick. */
void filter_corner(const radiance_lattice *lattice, size_t brick, int at[3]);
#endif
