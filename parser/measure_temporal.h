/* measure_temporal.h - how much an animation flickers, how much its filter
 * blurs and what it takes: `brume measure --temporal`. */
#ifndef PARSER_MEASURE_TEMPORAL_H
#define PARSER_MEASURE_TEMPORAL_H
#include <stdint.h>
#include <stdio.h>
#include "lib/error.h"
#include "parser/flicker.h"

struct reel;

enum { MEASURE_FILTERS = 5 };
/* The reference has so many times the photons and the samples. */
enum { MEASURE_MORE_PHOTONS = 64, MEASURE_MORE_SAMPLES = 16 };
/* Samples of a pixel, if no other number is asked for. */
enum { MEASURE_SPP = 16 };

struct measure_temporal {
    int spp;                    /* given; 0: MEASURE_SPP                   */
    uint64_t photons;           /* given; 0: as the scene says             */
    const char *csv_path;       /* or NULL                                 */
    /* Found. */
    int frames;
    struct measure_filter {
        const char *name;       /* as --temporal has it                    */
        struct flicker flicker;
        double seconds;         /* a frame, mean                           */
        double filter_seconds;
        uint64_t ring;          /* bytes                                   */
    } filter[MEASURE_FILTERS];
    double reference_seconds;
};

/* Renders the frames of the reel once for the reference, once for each filter;
 * what fails is told by it. */
enum brume_code measure_temporal_run(struct measure_temporal *m,
                                     struct reel *reel);
void measure_temporal_table(const struct measure_temporal *m, FILE *to);

#endif
