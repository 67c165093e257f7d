/* filter_view.h - one frame's field seen from the cells of another's. */
#ifndef CORE_FILTER_VIEW_H
#define CORE_FILTER_VIEW_H
#include "core/filter.h"

enum { FILTER_MAX_NUMBERS = 16, FILTER_CELLS = 512, FILTER_BLOCKS = 64 };

struct filter_view {
    const struct filter_field *field;   /* NULL: there is nothing to see   */
    bool aligned;               /* brick i is the other's i + brick         */
    double scale, shift[3];     /* of cells' numbers, 0 at the first middle */
    int brick[3];
    const struct flat *from;    /* set where the eye's place matters        */
    double turn;                /* cosine of the way's turn to it, at least */
};

/* The cells of a brick, as they lie in a field. */
struct filter_brick {
    const float *cells;         /* numbers each                             */
    const float *there;         /* of each cell 1, or 0: none; NULL: all    */
};

/* Where a brick's cells are put that lie in no field as they are wanted. */
struct filter_room {
    float own[FILTER_CELLS * FILTER_MAX_NUMBERS], there[FILTER_CELLS];
    float *kept;                /* ... in place of `own`, if not NULL       */
    float *cells;               /* the one of both that was filled          */
};

/* A field of other numbers than the flat scene's has nothing to see. */
void filter_view_init(struct filter_view *view, const struct flat *from,
                      const struct filter_field *field);

/* Where the first cells of a brick's blocks are in the lattice of a view's
 * field; NAN in the first number: nowhere. */
struct filter_places {
    float first[FILTER_BLOCKS][3];
};

/* The numbers in a brick of the flat scene's lattice, which begins at a cell;
 * `places` says where its blocks were, or is NULL: where they are. False: the
 * field has no cell there, or knows it from too different a side. */
bool filter_view_brick(const struct filter_view *view, const int corner[3],
                       const struct filter_places *places,
                       struct filter_room *room, struct filter_brick *out);

/* What the halves of the field's photons tell of a brick; NULL: nothing. */
const struct filter_power *filter_view_power(const struct filter_view *view,
                                             const int corner[3]);

/* The first cell of a brick. */
void filter_corner(const radiance_lattice *lattice, size_t brick, int at[3]);
#endif
