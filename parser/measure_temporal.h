/* measure_temporal.h - how much an animation flickers, how much its filters
 * blur and what they take: `brume measure --temporal`. */
#ifndef PARSER_MEASURE_TEMPORAL_H
#define PARSER_MEASURE_TEMPORAL_H
#include <stdint.h>
#include <stdio.h>
#include "lib/error.h"
#include "parser/flicker.h"
#include "parser/options.h"

struct reel;

enum { MEASURE_FILTERS = 5 };
enum { MEASURE_ROWS = OPTIONS_MOST_PHOTONS * MEASURE_FILTERS };
/* Each of the two references has so many times the most photons and the
 * samples. */
enum { MEASURE_MORE_PHOTONS = 8, MEASURE_MORE_SAMPLES = 8 };
/* Samples of a pixel, if no other number is asked for. */
enum { MEASURE_SPP = 16 };

/* Of the energy of the reference's changes, what is lost against no filter
 * with the same noise. */
struct measure_loss {
    double mean;                /* of the repeats                          */
    double error;               /* its standard error; NAN: of one         */
    double square;              /* sum of squared differences from the mean */
};

/* One number of photons with one filter; means over the repeats. */
struct measure_filter {
    uint64_t photons;
    const char *name;           /* as --temporal has it                    */
    int repeats;                /* films with noise of their own           */
    struct flicker flicker;
    struct measure_loss detail, motion;
    double seconds;             /* a frame, mean                           */
    double filter_seconds;
    uint64_t ring;              /* bytes                                   */
};

struct measure_temporal {
    int spp;                    /* given; 0: MEASURE_SPP                   */
    uint64_t photons[OPTIONS_MOST_PHOTONS]; /* each is measured; the first
                                   is 0: as the scene says                 */
    int repeat;                 /* films of the fewest photons; 0: one     */
    int taps;                   /* of the one filter to be measured beside
                                   none; 0: all                            */
    const char *csv_path;       /* or NULL                                 */
    /* Found. */
    int frames;
    struct measure_filter row[MEASURE_ROWS];   /* none first, of each number  */
    int rows;
    struct flicker noise;       /* of one reference against the other      */
    double reference_seconds;   /* of one                                  */
};

/* Renders the frames of the reel twice for the reference, then with each
 * filter; what fails is told by it. */
enum brume_code measure_temporal_run(struct measure_temporal *m,
                                     struct reel *reel);
void measure_temporal_table(const struct measure_temporal *m, FILE *to);

#endif
