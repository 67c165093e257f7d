/* radiance.h - the lattice of the field of scattered light, laid out for a
 * scene before any photon flies. */
#ifndef CORE_RADIANCE_H
#define CORE_RADIANCE_H
#include "core/flat.h"

/* Chooses the cells of flat->view.field and makes room for them in the flat
 * scene; as coarse as the memory that the options leave asks for. */
bool radiance_layout(struct flat *flat, const struct brume_options *options,
                     struct brume_error *err);

/* The same for the field of pass `pass` of many, in place of the one before:
 * its cells are smaller, and lie elsewhere. */
bool radiance_renew(struct flat *flat, const struct brume_options *options,
                    uint32_t pass, struct brume_error *err);

/* Cells of the field; 0 without one. */
size_t radiance_cells(const struct flat *flat);

/* Numbers of a cell when a picture is drawn of the field: where it is filtered,
 * light straight from lights comes behind what filters had to do with, as it
 * has no noise that they would take (radiance_keeps_lit). */
int radiance_drawn_numbers(const struct flat *flat,
                           const struct brume_options *options);

/* Makes room for these. */
bool radiance_widen(struct flat *flat, const struct brume_options *options,
                    struct brume_error *err);

/* Blocks of 2^3 cells of a field whose bricks are all alike. */
size_t radiance_blocks(const struct flat *flat);

/* Bytes of the sums that photons are added up in. */
uint64_t radiance_sum_bytes(const struct flat *flat);

/* What a sum is multiplied by to be the field's number: `unit` is the power of
 * the mean photon. */
double radiance_scale(const radiance_lattice *field, double unit);

/* From sums to the field. */
void radiance_resolve(struct flat *flat, const int64_t *sum, double unit);

/* Whether cells shall hold light straight from lights, of which paths then seek
 * the rest. */
bool radiance_keeps_lit(const struct flat *flat,
                        const struct brume_options *options);
#endif
