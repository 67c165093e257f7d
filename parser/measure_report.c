/* What was measured as a table, as CSV, as a plot. */
#include "lib/output.h"
#include "lib/plot.h"
#include "parser/measure.h"
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Noise that makes small errors, and its own estimate, doubtful. */
#define NOISY 0.03

static const char *integrator_name(enum brume_integrator integrator)
{
    switch (integrator) {
    case BRUME_INTEGRATOR_PATH:
        return "path";
    case BRUME_INTEGRATOR_PHOTON:
        return "photon";
    case BRUME_INTEGRATOR_PROGRESSIVE:
        return "progressive";
    }
    return "";
}

void measure_switches(const struct measure_setting *set, char *text,
                      size_t size)
{
    const struct measure_series *s = &measure_series[set->series];
    int n = snprintf(text, size, "--integrator %s",
                     integrator_name(s->integrator));
    if (s->paper)
        n += snprintf(text + n, size - (size_t)n, " --preset paper");
    if (set->photons > 0)
        n += snprintf(text + n, size - (size_t)n, " --photons %" PRIu64,
                      set->photons);
    if (set->spacing > 0.0)
        n += snprintf(text + n, size - (size_t)n, " --field-spacing %.6g",
                      set->spacing);
    snprintf(text + n, size - (size_t)n, " --spp %d", set->spp);
}

/* ---- the table ---------------------------------------------------------- */

static void print_reference(const struct measure *m, FILE *to)
{
    if (m->reference_spp)
        fprintf(to, "reference: path, %d samples a pixel, %.3g s",
                m->reference_spp, m->reference_seconds);
    else
        fprintf(to, "reference: %s", m->reference);
    if (m->noise_known)
        fprintf(to, "; its own noise: %.3g %%%s\n\n", 100.0 * m->noise,
                m->noise > NOISY ? " (a larger --budget gives a better one)"
                                 : "");
    else
        fputs("; its noise is not known, and counted as error\n\n", to);
}

static void print_rows(const struct measure *m, FILE *to)
{
    char switches[MEASURE_SWITCHES];
    bool told = false;
    fputs("    error    bias       seconds    CPU s      estimated  "
          "switches\n",
          to);
    for (int i = 0; i < m->rows; i++) {
        const struct measure_row *r = &m->row[i];
        bool doubt = measure_uncertain(m, r);
        measure_switches(&r->set, switches, sizeof switches);
        fprintf(to,
                "%c%c  %6.3g %%  %+6.2f %%  %-9.3g  %-9.3g  %6.3g %%   %s\n",
                r->front ? '*' : ' ', doubt ? '?' : ' ', 100.0 * r->error,
                100.0 * r->bias, r->seconds, r->cpu_seconds,
                100.0 * r->estimate, switches);
        told |= doubt;
    }
    fputs("* no other is both quicker and better\n", to);
    if (told)
        fputs("? hardly more than the reference's own noise\n", to);
}

static void print_advice(const struct measure *m, FILE *to)
{
    char switches[MEASURE_SWITCHES];
    fputs("\n", to);
    for (int i = 0; i < MEASURE_GOALS; i++) {
        const struct measure_advice *a = &m->advice[i];
        fprintf(to, "for %2.0f %%: ", 100.0 * measure_goals[i]);
        if (a->set.series < 0) {
            fputs("not reached\n", to);
            continue;
        }
        measure_switches(&a->set, switches, sizeof switches);
        fprintf(to, "%s (%.3g s%s)\n", switches, a->seconds,
                a->measured ? "" : ", extrapolated");
    }
}

void measure_table(const struct measure *m, FILE *to)
{
    print_reference(m, to);
    print_rows(m, to);
    print_advice(m, to);
}

/* ---- files -------------------------------------------------------------- */

static void write_csv(const struct measure *m, FILE *to)
{
    char switches[MEASURE_SWITCHES];
    fputs("series,switches,spp,photons,spacing,seconds,cpu_seconds,error,"
          "bias,difference,estimate,reference_noise,front\n",
          to);
    for (int i = 0; i < m->rows; i++) {
        const struct measure_row *r = &m->row[i];
        measure_switches(&r->set, switches, sizeof switches);
        fprintf(to, "%s,%s,%d,%" PRIu64 ",%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,",
                measure_series[r->set.series].name, switches, r->set.spp,
                r->set.photons, r->set.spacing, r->seconds, r->cpu_seconds,
                r->error, r->bias, r->difference);
        if (isfinite(r->estimate))
            fprintf(to, "%.6g", r->estimate);
        fputc(',', to);
        if (m->noise_known)
            fprintf(to, "%.6g", m->noise);
        fprintf(to, ",%d\n", r->front);
    }
}

bool measure_csv(const struct measure *m, struct brume_error *err)
{
    if (!m->csv_path)
        return true;
    struct output *o = output_open(m->csv_path, err);
    if (!o)
        return false;
    write_csv(m, output_stream(o));
    return output_commit(o, err);
}

/* The points of a series, or of the front in the order of their time. */
struct points {
    double x[MEASURE_MAX_ROWS], y[MEASURE_MAX_ROWS];
    size_t count;
};

static void add_point(struct points *p, const struct measure_row *row)
{
    size_t at = p->count++;
    while (at > 0 && p->x[at - 1] > row->seconds) {
        p->x[at] = p->x[at - 1];
        p->y[at] = p->y[at - 1];
        at--;
    }
    p->x[at] = row->seconds;
    p->y[at] = 100.0 * row->error;
}

/* `points` and `series` have room for the series and the front. */
static void write_svg(const struct measure *m, struct points *points,
                      struct plot_series *series, FILE *to)
{
    char title[256];
    double marks[MEASURE_GOALS];
    int front = measure_series_count;
    snprintf(title, sizeof title, "%s, %d x %d: error against time", m->scene,
             m->options.width, m->options.height);
    for (int i = 0; i < m->rows; i++) {
        add_point(&points[m->row[i].set.series], &m->row[i]);
        if (m->row[i].front)
            add_point(&points[front], &m->row[i]);
    }
    for (int i = 0; i <= front; i++)
        series[i] = (struct plot_series){
            .name = i == front ? "best" : measure_series[i].name,
            .x = points[i].x,
            .y = points[i].y,
            .count = points[i].count,
            .guide = i == front,
        };
    for (int i = 0; i < MEASURE_GOALS; i++)
        marks[i] = 100.0 * measure_goals[i];
    const struct plot plot = {
        title, "seconds",    "relRMSE, per cent", series, (size_t)front + 1,
        marks, MEASURE_GOALS};
    plot_svg(&plot, to);
}

bool measure_svg(const struct measure *m, struct brume_error *err)
{
    if (!m->svg_path)
        return true;
    size_t count = (size_t)measure_series_count + 1;
    struct points *points = calloc(count, sizeof *points);
    struct plot_series *series = calloc(count, sizeof *series);
    struct output *o = NULL;
    bool ok = points && series;
    if (!ok)
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    else
        ok = (o = output_open(m->svg_path, err)) != NULL;
    if (ok) {
        write_svg(m, points, series, output_stream(o));
        ok = output_commit(o, err);
    }
    free(points);
    free(series);
    return ok;
}
