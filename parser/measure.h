/* measure.h - the error of a scene's pictures against the time they take, for
 * each integrator and setting: `brume measure`. */
#ifndef PARSER_MEASURE_H
#define PARSER_MEASURE_H
#include <stdio.h>
#include "core/brume.h"
#include "lib/exr.h"

/* Pictures that differ in their samples and photons alone. */
struct measure_series {
    const char *name;
    enum brume_integrator integrator;
    bool unbiased;              /* the error goes away with the samples    */
    bool paper;                 /* the published choices                   */
    double cells;               /* their side over the scene's own         */
};
extern const struct measure_series measure_series[];
extern const int measure_series_count;

enum { MEASURE_MAX_ROWS = 256, MEASURE_GOALS = 3,
       MEASURE_SWITCHES = 160 /* characters */ };
/* Seconds, if no other number is asked for. */
#define MEASURE_BUDGET 60
extern const double measure_goals[MEASURE_GOALS];

/* With what a picture is rendered. */
struct measure_setting {
    int series, spp;
    uint64_t photons;           /* 0: none, or as many as ever for each of
                                   many fields                             */
    double spacing;             /* side of a cell; 0: the scene's own      */
};

struct measure_row {
    struct measure_setting set;
    double seconds, cpu_seconds;
    double prepare_seconds;     /* of those, whatever the setting          */
    double photon_seconds;      /* ... for photons                         */
    double difference;          /* relRMSE against the reference           */
    double error;               /* ... less the reference's own noise      */
    double bias;                /* of the picture's mean, relative         */
    double estimate;            /* what --error would have gone by         */
    bool front;                 /* no other row has less time and error    */
};

/* What to say to get a picture of that error. */
struct measure_advice {
    struct measure_setting set; /* series -1: not known                    */
    double seconds, error;
    bool measured;              /* it is a row; else the rows' slope goes on */
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

/* Whether a row tells little: its error is a small part of what the
 * reference's noise adds to it. */
bool measure_uncertain(const struct measure *m, const struct measure_row *row);
/* Marks the front and finds the advice, from the rows. */
void measure_conclude(struct measure *m);
/* relRMSE (DESIGN.md) of a picture, 3 floats a pixel, in a part of it. */
double measure_difference(const float *picture, const float *reference,
                          int width, const int part[4]);

/* The switches that a setting stands for. */
void measure_switches(const struct measure_setting *set, char *text,
                      size_t size);
void measure_table(const struct measure *m, FILE *to);
bool measure_csv(const struct measure *m, struct brume_error *err);
bool measure_svg(const struct measure *m, struct brume_error *err);
#endif
