/* measure.h - the error of a scene's pictures against the time they take, for
 * each integrator and setting: `brume measure`. */
#ifndef PARSER_MEASURE_H
#define PARSER_MEASURE_H
#include <stdio.h>
#include "core/brume.h"
#include "lib/exr.h"

/* Settings that differ in their samples a pixel alone. */
struct measure_series {
    const char *name;
    enum brume_integrator integrator;
    bool unbiased;              /* the error is noise: as 1 / sqrt(spp)    */
};
extern const struct measure_series measure_series[];
extern const int measure_series_count;

enum { MEASURE_MAX_ROWS = 256, MEASURE_GOALS = 3 };
/* Seconds, if no other number is asked for. */
#define MEASURE_BUDGET 60
extern const double measure_goals[MEASURE_GOALS];

struct measure_row {
    int series, spp;
    double seconds, cpu_seconds;
    double prepare_seconds;     /* of those, whatever the samples          */
    double difference;          /* relRMSE against the reference           */
    double error;               /* ... less the reference's own noise      */
    double estimate;            /* what --error would have gone by         */
    bool front;                 /* no other row has less time and error    */
};

/* What to say to get a picture of that error. */
struct measure_advice {
    int series;                 /* -1: not known                           */
    int spp;
    double seconds, error;
    bool measured;              /* it is a row; else by 1 / sqrt(spp)      */
};

struct measure {
    /* Given. The options are those of each picture but for integrator,
     * samples, time and seed. */
    const char *scene;          /* its name, for titles                    */
    struct brume_options options;
    int only;                   /* an integrator, or -1: all               */
    double budget;              /* seconds for all, the reference's too    */
    const char *reference;      /* a picture to take, or NULL              */
    /* Files to write; NULL: none. */
    const char *picture_path, *csv_path, *svg_path;

    /* Found. */
    bool noise_known;
    double noise;               /* relRMSE of the reference; 0: unknown    */
    int reference_spp;          /* 0: it was taken                         */
    double reference_seconds;
    struct measure_row row[MEASURE_MAX_ROWS];
    int rows;
    struct measure_advice advice[MEASURE_GOALS];
};

/* Renders the reference, or reads it, then rows, one at least, while the
 * budget lasts; the reference and the table are on disk as soon as they are
 * there. False with err set: of the picture's size or file, of rendering,
 * BRUME_STOPPED. */
bool measure_run(struct measure *m, brume_scene *scene,
                 struct brume_error *err);

/* Marks the front and finds the advice, from the rows. */
void measure_conclude(struct measure *m);
/* relRMSE (DESIGN.md) of a picture, 3 floats a pixel, in a part of it. */
double measure_difference(const float *picture, const float *reference,
                          int width, const int part[4]);

/* The switches that a row or an advice stands for. */
void measure_switches(int series, int spp, char *text, size_t size);
void measure_table(const struct measure *m, FILE *to);
bool measure_csv(const struct measure *m, struct brume_error *err);
bool measure_svg(const struct measure *m, struct brume_error *err);
#endif
