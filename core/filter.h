/* filter.h - the field of scattered light as a mean over the frames of a film.
 *
 * Fields live in the scene's space: where two frames have other cells, those
 * of one are interpolated at the middles of the other's. */
#ifndef CORE_FILTER_H
#define CORE_FILTER_H
#include "core/filter_half.h"

/* What is kept of a frame. */
struct filter_field {
    radiance_lattice lattice;
    camera eye;
    double unit, centre[3];     /* as in struct flat                       */
    int32_t *slots;
    float *cells;               /* lattice.numbers each                    */
    float *drift;               /* as in struct flat, or NULL              */
    struct filter_power *power; /* of each brick that is there, or NULL    */
    size_t bricks, count;       /* of slots, of numbers in cells           */
    double noise;               /* variance of a number over its mean, where
                                   all channels have the same              */
};

/* A copy of the field of a frame that was traced; `power` is that of its mean
 * photon. */
bool filter_keep(const struct flat *flat, double power,
                 struct filter_field *out, struct brume_error *err);
void filter_release(struct filter_field *field);
uint64_t filter_bytes(const struct filter_field *field);

/* What filter_adapt works in, kept from frame to frame, as the system takes
 * longer to give the memory than the filter to fill it. Zero to begin with;
 * one caller at a time. */
struct filter_scratch {
    struct filter_stats *stats[2];
    struct filter_places *places;
    struct filter_common *common[2];
    struct filter_weights *weights;
    struct filter_side *side;
    struct filter_desk *desk;
    float *kept;
    bool *found;
    size_t stats_room[2], places_room, common_room[2], weights_room, side_room,
        desk_room, kept_room, found_room;
};
void filter_scratch_release(struct filter_scratch *scratch);

/* Fills the field of a frame with the weighted mean of those of 2 reach + 1
 * frames, NULL where there is none. Weights are made to sum to 1 over those
 * that have a cell where one is wanted. False: no memory. */
bool filter_mean(struct flat *flat, const struct filter_field *const *fields,
                 const double *weights, int reach, int threads,
                 struct brume_error *err);

/* The same with weights of its own for each cell, see filter_adapt.c; the
 * frame's own field is in the middle. */
bool filter_adapt(struct flat *flat, const struct filter_field *const *fields,
                  int reach, int threads, struct filter_scratch *scratch,
                  struct brume_error *err);
#endif
