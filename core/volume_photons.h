/* volume_photons.h - a part of brume.h: ways to compute light, and photons. */
#ifndef CORE_VOLUME_PHOTONS_H
#define CORE_VOLUME_PHOTONS_H

/* Path: unbiased. Photon: photons are traced into a field of the light that is
 * scattered more than once, which the eye's rays then read; what is wrong with
 * it is only what the cells of the field blur. Progressive: a field of its own
 * for each sample of a pixel, with cells that shrink, and what they blur with
 * them. */
enum brume_integrator { BRUME_INTEGRATOR_PATH, BRUME_INTEGRATOR_PHOTON,
                        BRUME_INTEGRATOR_PROGRESSIVE };
enum brume_backend { BRUME_BACKEND_AUTO, BRUME_BACKEND_CPU,
                     BRUME_BACKEND_CUDA };

#define BRUME_DEFAULT_PHOTONS 1000000
/* For each field of many. */
#define BRUME_DEFAULT_PASS_PHOTONS 100000

/* How the integrator photon keeps the light that is scattered; 0 is the
 * default of each. */
enum brume_gather {
    BRUME_GATHER_TALLY,         /* lengths of flights in cells              */
    BRUME_GATHER_BALL           /* events within `radius` of their middles,
                                   weighed for the eye                      */
};
enum brume_single {             /* light straight from lights              */
    BRUME_SINGLE_RAY,           /* sampled along the eye's rays             */
    BRUME_SINGLE_FIELD          /* in the cells                             */
};
enum brume_emission {           /* of media                                 */
    BRUME_EMISSION_LINE,        /* exact along the eye's rays               */
    BRUME_EMISSION_PHOTONS      /* births count as events; with ball only   */
};
/* The most frames that a mean over time is taken of: 8 on each side. */
enum { BRUME_MAX_TAPS = 17, BRUME_MAX_REACH = BRUME_MAX_TAPS / 2 };

struct brume_photon_options {
    uint64_t count;             /* emitted for a field; 0: the default      */
    enum brume_gather gather;
    enum brume_single single;
    enum brume_emission emission;
    double radius;              /* of the ball, scene units; 0: two cells   */
    double spacing;             /* of cells, scene units; 0: chosen         */
    double depth;               /* of cells that differ in size: their optical
                                   thickness, at most; 0: all of one size  */
    bool everywhere;            /* also cells that the eye cannot see       */
    bool far_plane;             /* not those behind all that it can see     */
    /* Of films (brume_film.h): the field is a mean over so many frames, an odd
     * number, with these weights, the middle one the frame's own; 0 or 1: of
     * each frame alone. Their sum need not be 1. Adaptive: with weights
     * that are found for each cell, by noise and change; with tally only. */
    int taps;
    bool adaptive;
    double weight[BRUME_MAX_TAPS];
    bool unmoved;               /* adaptive: velocities have no say         */
    bool film_cells;            /* as with a filter, without one too        */
};
#define BRUME_PHOTONS_INIT                                                    \
    {0, BRUME_GATHER_TALLY, BRUME_SINGLE_RAY, BRUME_EMISSION_LINE, 0, 0, 0,    \
     false, false, 0, false, {0}, false, false}

/* `preset paper`: the published choices of each stage (Cha, Yi and Ihm 2010);
 * counts, sizes and filters stay. */
BRUME_API void brume_photons_paper(struct brume_photon_options *options);

/* Photons of a frame. Power in units of the mean photon's, means of the
 * channels: emitted + units = media + surfaces + walls + escaped + roulette
 * + dropped. */
struct brume_photon_stats {
    uint64_t traced, events, bounces;   /* events: scatterings in media    */
    uint64_t stored;            /* events and births that balls gather     */
    uint64_t clipped;           /* deposits too large to be added up; 0    */
    double emitted;
    double units;               /* what POV-Ray's units of light, in which
                                   power depends on the place, add         */
    double media, surfaces;     /* absorbed                                */
    double walls;               /* came straight to surfaces without an end,
                                   which give light by themselves          */
    double escaped;
    double roulette;            /* what chance took more than it gave      */
    double dropped;             /* of photons with more than 65536 events  */
    uint64_t cells;             /* of the field                            */
    double side;                /* of a cell, in scene units               */
    uint64_t bytes;             /* of the field, its sums included         */
    uint64_t ring;              /* bytes of fields kept for the filter     */
    bool drifts;                /* it follows velocities                   */
    double seconds, seconds_filter;
};

#endif
