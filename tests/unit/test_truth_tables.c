/* Pictures against every row of the tables of METHODS.md, section 13.
 *
 *     test_truth_tables                 the sample that `make test` runs
 *     test_truth_tables all [NAME]...   all rows, or those with such names
 *     test_truth_tables table [NAME]... the same as a table of Markdown
 *
 * A row passes with |z| < 4, z = (mean - truth) / sqrt(SE^2 + u^2) over 32
 * batches, at a standard error SE <= max(truth / 1000, u). By chance one row in
 * 3,000 has more (Student's t), one in five runs of all: such a row is done
 * again by four times the paths, others than before, and that counts; what is
 * wrong has twice the z then. Where a picture
 * would take more than PICTURE_SECONDS (2) of the processor for that, the
 * row's scene is walked through (truth_walk.h), if it may be. WALK=1 does
 * nothing but such walks, WALK=-1 nothing but pictures, which then are as good
 * as they get. What takes more than SECONDS_A_ROW (60), or than is left of
 * SECONDS_ALL for all rows, is `short`: the error it reached is told, and z
 * still holds. RELATIVE=1e-4 asks for more. BACKEND=cuda draws and walks on a
 * GPU, and seconds are the clock's. PIXELS=256 makes pictures larger than
 * 16 x 16, as far as all batches are done in time; FIRST_SECONDS=20 leaves them
 * out where the smallest would take longer and the row may be walked through.
 * Processes with the same QUEUE=file share the rows.
 *
 * Walks leave out the path through the whole scene, its boundaries above all.
 * So a picture that was given up counts too, by the same z, with whatever error
 * it has, if that is told well (KNOWN_ERROR). */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include "tests/unit/truth_scenes.h"
#include "tests/unit/truth_tables.h"

enum { MOST_ROWS = 1024 };

struct result {
    double mean, error, z, seconds;
    int spp;
    bool reached, again;
    double picture_z; /* of the picture too that a walk is in place of;
                               0: none                                     */
};

/* Of the truth: batches whose error is larger have too few events in them to
 * be distributed evenly, and so have those of rare events that are worth more
 * each. */
#define KNOWN_ERROR 0.05
#define KNOWN_EVENT 0.0025

static struct truth_row *new_row(struct truth_row *rows, int *count)
{
    assert_true(*count < MOST_ROWS);
    struct truth_row *r = &rows[(*count)++];
    memset(r, 0, sizeof *r);
    return r;
}

#define ROW(measure_of, truth_is, u_is, ...)                                   \
    struct truth_row *r = new_row(rows, count);                                \
    r->measure = measure_of;                                                   \
    r->truth = truth_is;                                                       \
    /* A picture is of floats. */                                              \
    r->u = fmax(u_is, 2e-6 * fabs(r->truth));                                  \
    snprintf(r->name, sizeof r->name, __VA_ARGS__)

#define ROWS(table) ((int)(sizeof(table) / sizeof *(table)))

static void add_t3(struct truth_row *rows, int *count)
{
    for (int i = 0; i < ROWS(truth_t3); i++) {
        ROW(batch_t3, truth_t3[i][1], 5e-10, "T3 tau=%g", truth_t3[i][0]);
        r->p[0] = truth_t3[i][0];
        r->sample = i == 2;
    }
}

static void add_t4(struct truth_row *rows, int *count)
{
    for (int i = 0; i < ROWS(truth_t4); i++)
        for (int k = 0; k < ROWS(truth_t4_g); k++) {
            double mu = truth_t4[i][0], gamma = truth_t4[i][1];
            ROW(batch_t4, truth_t4[i][2 + k], 0.0, "T4 mu=%g gamma=%g g=%g", mu,
                gamma, truth_t4_g[k]);
            r->p[0] = mu;
            r->p[1] = gamma;
            r->p[2] = truth_t4_g[k];
            r->sample = i % 6 == 1 && k == i / 6 + 1;
        }
}

/* How fast light dies away deep in a medium: by diffusion theory if need be. */
static double decay_of(double albedo, double g)
{
    if (albedo == 1.0)
        return 0.0;
    if (g == 0.0)
        return albedo > 0.0 ? case_root(albedo) : 0.99;
    return fmin(sqrt(3.0 * (1.0 - albedo) * (1.0 - albedo * g)), 0.98);
}

static void plan_slab(struct truth_row *r, double cosine, double albedo,
                      double g, double depth, bool reflected)
{
    bool shallow = depth < 3.0 || albedo < 0.95;
    r->plan = (struct walk_plan){
        .space = WALK_SLAB,
        .start = -1.0,
        .cosine = cosine,
        .depth = depth,
        .target = reflected ? 0.0 : depth,
        .edge = 0.71 / (1.0 - g),
        .decay = decay_of(albedo, g),
        .g = g,
        .loss = 1.0 - albedo,
        .wide = reflected && g > 0.0 ? (shallow ? 0.3 : 0.1) : 0.0};
}

static void plan_space(struct truth_row *r, double albedo, double distance)
{
    r->plan = (struct walk_plan){.space = WALK_SPACE,
                                 .cosine = 1.0,
                                 .target = distance,
                                 .decay = decay_of(albedo, 0.0),
                                 .loss = 1.0 - albedo};
}

static void add_t5(struct truth_row *rows, int *count)
{
    for (int i = 0; i < ROWS(truth_t5); i++)
        for (int k = 0; k < ROWS(truth_t5_r); k++) {
            double truth = truth_t5[i][1 + k];
            /* The shell's width is allowed for to 2e-5. */
            ROW(batch_t5, truth, 2e-5 * truth, "T5 albedo=%g r=%g",
                truth_t5[i][0], truth_t5_r[k]);
            r->p[0] = truth_t5[i][0];
            r->p[1] = truth_t5_r[k];
            plan_space(r, r->p[0], r->p[1]);
            r->sample = (i == 0 && k == 2) || (i == 4 && k == 1);
        }
}

static void add_t5_lamp(struct truth_row *rows, int *count)
{
    for (int k = 0; k < 3; k++) {
        ROW(batch_t5_lamp, truth_t5[5][1 + k], 0.0, "T5 lamp albedo=0.9 r=%g",
            truth_t5_r[k]);
        r->p[0] = 0.9;
        r->p[1] = truth_t5_r[k];
    }
}

static void add_t6(struct truth_row *rows, int *count)
{
    for (int i = 0; i < ROWS(truth_t6); i++)
        for (int k = 0; k < 2 * ROWS(truth_t6_tau); k++) {
            double tau = truth_t6_tau[k / 2];
            const double *t = truth_t6[i];
            ROW(batch_t6, t[2 + k], 5e-7, "T6 %c g=%g albedo=%g tau=%g",
                k % 2 ? 'T' : 'R', t[0], t[1], tau);
            r->p[0] = t[0];
            r->p[1] = t[1];
            r->p[2] = tau;
            r->p[3] = k % 2 == 0;
            plan_slab(r, 1.0, t[1], t[0], tau, k % 2 == 0);
            r->rare = 1.0;
            r->sample = (i == 0 && k == 4) || (i == 7 && k == 1) ||
                        (i == 20 && k == 5);
        }
    for (int i = 0; i < 2 * ROWS(truth_t6_radiance); i++) {
        const double *t = truth_t6_radiance[i / 2];
        ROW(batch_t6_radiance, t[2 + i % 2], 5e-8, "T6 %s %g<-%g",
            i % 2 ? "transmitted" : "reflected", t[0], t[1]);
        r->p[0] = t[0];
        r->p[1] = i % 2 ? -t[1] : t[1];
        r->sample = i == 3;
    }
}

static void add_t7_t9(struct truth_row *rows, int *count)
{
    for (int i = 0; i < ROWS(truth_t7_slab); i++) {
        ROW(batch_t7_slab, truth_t7_slab[i][1], 5e-8, "T7 slab mu=%g",
            truth_t7_slab[i][0]);
        r->p[0] = truth_t7_slab[i][0];
        r->sample = i == 2;
    }
    for (int i = 0; i < ROWS(truth_t7_sphere); i++) {
        ROW(batch_ball, truth_t7_sphere[i][1], 5e-9, "T7 ball tau=%g",
            truth_t7_sphere[i][0]);
        r->p[0] = truth_t7_sphere[i][0];
        r->sample = i == 3;
    }
    for (int i = 0; i < 3 * ROWS(truth_t9); i++) {
        const double *t = truth_t9[i / 3];
        ROW(batch_ball, t[1 + i % 3], 2e-5, "T9 tau=%g albedo=%g", t[0],
            truth_t9_albedo[i % 3]);
        r->p[0] = t[0];
        r->p[1] = truth_t9_albedo[i % 3];
        r->sample = i == 7;
    }
}

static void add_t8(struct truth_row *rows, int *count)
{
    const double cosine[3] = {0.1, 0.5, 1.0};
    for (int i = 0; i < ROWS(truth_t8); i++) {
        const double *t = truth_t8[i];
        double depth = half_space_depth(t[0]);
        bool white = t[0] == 1.0;
        for (int k = 0; k < 3; k++) {
            double l = t[0] * t[1 + k] * t[1 + k] / (8.0 * TRUTH_PI);
            ROW(batch_t8_h, l, 1e-7 * l, "T8 H albedo=%g mu=%g", t[0],
                cosine[k]);
            r->p[0] = t[0];
            r->p[1] = cosine[k];
            r->p[2] = white ? t[1 + k] : 0.0;
            plan_slab(r, cosine[k], t[0], 0.0, depth, true);
            r->sample = i == 5 && k == 0;
        }
        for (int k = 0; k < 3; k++) {
            ROW(batch_t8_plane, t[6 - k], 5e-8, "T8 plane albedo=%g mu=%g",
                t[0], cosine[k]);
            r->p[0] = t[0];
            r->p[1] = cosine[k];
            r->p[2] = white ? t[1 + k] : 0.0;
            plan_slab(r, cosine[k], t[0], 0.0, depth, true);
            r->sample = i == 2 && k == 2;
        }
        /* Gauss's rule of 8 is good to 2e-5. */
        ROW(batch_t8_sphere, t[7], 2e-5, "T8 sphere albedo=%g", t[0]);
        r->p[0] = t[0];
        r->p[2] = white ? 4.0 / sqrt(3.0) : 0.0;
        plan_slab(r, 0.0, t[0], 0.0, depth, true);
    }
}

static void add_t13(struct truth_row *rows, int *count)
{
    for (int i = 0; i < ROWS(truth_t13); i++)
        for (int c = 0; c < 4; c++) {
            const double *t = truth_t13[i];
            double ratio = t[1] / 3.0725e9;
            ROW(batch_t13, c < 3 ? t[2 + c] : ratio,
                c < 3 ? 5e-6 : 4e-5 * ratio, "T13 T=%g %s", t[0],
                c < 3 ? (const char *[]){"R/Y", "G/Y", "B/Y"}[c] : "Y");
            r->p[0] = t[0];
            r->p[1] = c;
            r->sample = i == 1 || i == 8;
        }
}

static int all_rows(struct truth_row *rows)
{
    int count = 0;
    add_t3(rows, &count);
    add_t4(rows, &count);
    add_t5(rows, &count);
    add_t5_lamp(rows, &count);
    add_t6(rows, &count);
    add_t7_t9(rows, &count);
    add_t8(rows, &count);
    add_t13(rows, &count);
    return count;
}

static void run_batches(const struct truth_row *row, int spp, uint32_t *frame,
                        struct result *out)
{
    double sum = 0.0, squares = 0.0;
    struct batches b = {
        .count = BATCHES, .spp = spp, .frame = *frame, .stride = 1};
    row->measure(row, &b);
    *frame += BATCHES;
    for (int i = 0; i < BATCHES; i++) {
        double off = b.mean[i] - row->truth;
        sum += off;
        squares += off * off;
    }
    double mean = sum / BATCHES;
    out->spp = spp;
    out->mean = row->truth + mean;
    out->error = sqrt(fmax(squares / BATCHES - mean * mean, 0.0) /
                      (BATCHES - 1));
    out->z = mean / hypot(out->error, row->u);
}

/* Of the processor; where a GPU works, of the clock. */
static double seconds_now(void)
{
    struct timespec t;
    bool gpu = batch_backend() == BRUME_BACKEND_CUDA;
    clock_gettime(gpu ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* A number from the environment, or what is so without it. */
static double setting(const char *name, double otherwise)
{
    const char *text = getenv(name);
    return text ? atof(text) : otherwise;
}

/* Of events so rare that none was seen in a picture, one counts. */
static double unseen(const struct truth_row *row, int spp)
{
    return row->walked ? 0.0
                       : row->rare / ((double)spp * BATCHES * batch_pixels() *
                                      batch_pixels());
}

/* Grows as its own pilot: batches that were too small are thrown away, so that
 * those that count have a size fixed before they ran. Gives up, if it
 * may, where `seconds` would not do. */
static void run_so(const struct truth_row *row, uint32_t *frame, double seconds,
                   bool gives_up, struct result *out)
{
    double target = fmax(setting("RELATIVE", 1e-3) * fabs(row->truth), row->u);
    /* A single sample would lie in the middle of its pixel. */
    double start = seconds_now(), want = 2.0;
    do {
        double before = seconds_now();
        run_batches(row, (int)ceil(want), frame, out);
        double used = seconds_now() - before;
        double rare = unseen(row, out->spp);
        out->reached = fmax(out->error, rare) <= target;
        double more = 1.25 * (out->error / target) * (out->error / target);
        more = fmax(more, 1.1 * rare / target);
        double fits = (seconds - (seconds_now() - start)) / used;
        if (out->reached || fits < 1.5 || (gives_up && more > fits))
            break;
        want = out->spp * fmin(fmin(fmax(more, 1.3), 50.0), fits);
    } while (want < 1e6);
}

static bool is_off(double z)
{
    return !(fabs(z) < 4.0);
}

/* One that is off has another try, as far as its time goes. */
static void run_checked(const struct truth_row *row, uint32_t *frame,
                        double seconds, bool gives_up, struct result *out)
{
    double start = seconds_now();
    run_so(row, frame, seconds, gives_up, out);
    double used = seconds_now() - start;
    out->again = out->reached && is_off(out->z) && 5.0 * used < seconds;
    if (out->again)
        run_batches(row, 4 * out->spp, frame, out);
}

static double batch_seconds(const struct truth_row *row, uint32_t frame)
{
    double start = seconds_now();
    struct batches b = {.count = 1, .spp = 2, .frame = frame, .stride = 1};
    row->measure(row, &b);
    return seconds_now() - start;
}

/* Pixels, a power of two, of which batches of two samples are done in time: a
 * part of their time goes with the pixels, the other is that of few. The
 * seconds that the fewest take. */
static double choose_side(const struct truth_row *row, uint32_t *frame,
                          double seconds)
{
    int most = (int)setting("PIXELS", BATCH_PIXELS);
    double few = 0.0;
    for (*batch_side() = BATCH_PIXELS; *batch_side() < most;
         *batch_side() *= 2) {
        double used = batch_seconds(row, (*frame)++);
        few = few > 0.0 ? few : used;
        if ((few + 4.0 * (used - few)) * BATCHES > seconds)
            break;
    }
    return few * BATCHES;
}

static bool may_walk(const struct truth_row *row)
{
    return row->plan.space != WALK_NOWHERE;
}

/* The row's pictures. False: its walk has to do, as none were drawn or their
 * error is not known well. */
static bool run_pictures(const struct truth_row *row, uint32_t *frame,
                         double seconds, struct result *out)
{
    double least = choose_side(row, frame, seconds);
    if (!may_walk(row)) {
        run_checked(row, frame, seconds, false, out);
        return true;
    }
    if (least > setting("FIRST_SECONDS", INFINITY))
        return false;
    run_so(row, frame, fmin(seconds, setting("PICTURE_SECONDS", 2.0)), true,
           out);
    return out->reached || (out->error < KNOWN_ERROR * row->truth &&
                            unseen(row, out->spp) < KNOWN_EVENT * row->truth);
}

/* False: there is nothing to tell. */
static bool run_row(struct truth_row *row, uint32_t frame, double seconds,
                    struct result *out)
{
    int how = (int)setting("WALK", 0.0);
    double start = seconds_now();
    bool drawn = how <= 0 && run_pictures(row, &frame, seconds, out);
    out->picture_z = drawn ? out->z : 0.0;
    if (how >= 0 && may_walk(row) && !out->reached) {
        if (how > 0)
            *batch_side() = (int)setting("PIXELS", BATCH_PIXELS);
        row->walked = true;
        run_checked(row, &frame, seconds, false, out);
    }
    if (how < 0 && may_walk(row))
        out->reached = true;
    out->seconds = seconds_now() - start;
    return drawn || row->walked;
}

/* No two rows share their random numbers; SEED moves them all. */
static uint32_t first_frame(int row)
{
    return (uint32_t)setting("SEED", 0.0) * 100003u + ((uint32_t)row << 20);
}

/* How many were taken by those that share a file. */
static int take_of(const char *name)
{
    int file = open(name, O_RDWR | O_CREAT, 0600), taken = 0;
    assert_true(file >= 0 && lockf(file, F_LOCK, 0) == 0);
    if (pread(file, &taken, sizeof taken, 0) != sizeof taken)
        taken = 0;
    int after = taken + 1;
    assert_true(pwrite(file, &after, sizeof after, 0) == sizeof after);
    close(file);
    return taken;
}

/* About how many events a path has, which is how long its row takes: as many
 * as absorption or the way out let it have. */
static double events_of(const struct truth_row *row)
{
    const struct walk_plan *p = &row->plan;
    double way = p->space == WALK_SLAB ? p->depth * (1.0 - p->g)
                                       : 30.0 + p->target;
    return may_walk(row) ? fmin(1.0 / fmax(p->loss, 1e-9), way * way) : 0.0;
}

static int compare_events(const void *a, const void *b)
{
    const struct truth_row *x = *(const struct truth_row *const *)a,
                           *y = *(const struct truth_row *const *)b;
    double more = events_of(x) - events_of(y);
    return more != 0.0 ? (more < 0.0) - (more > 0.0) : (x < y) - (x > y);
}

/* Of so many rows the next, or NULL. Processes that share a file take the
 * longest first, so that none waits for another. */
static struct truth_row *next_row(struct truth_row *rows, int count)
{
    static struct truth_row *order[MOST_ROWS];
    static int next;
    const char *queue = getenv("QUEUE");
    int taken = queue ? take_of(queue) : next++;
    if (!order[0]) {
        for (int i = 0; i < count; i++)
            order[i] = &rows[i];
        if (queue)
            qsort(order, (size_t)count, sizeof *order, compare_events);
    }
    return taken < count ? order[taken] : NULL;
}

static bool asked(const char *name, int count, char **words)
{
    for (int i = 0; i < count; i++)
        if (strstr(name, words[i]))
            return true;
    return count == 0;
}

static bool holds(const struct result *r)
{
    return !is_off(r->z) && !is_off(r->picture_z);
}

static void report(const struct truth_row *row, const struct result *r,
                   bool table)
{
    double relative = row->truth == 0.0 ? 0.0 : r->error / row->truth;
    const char *by = row->walked ? "walk" : "picture";
    const char *end = r->again ? ", again" : r->reached ? "" : ", short";
    char picture[32] = "-";
    if (r->picture_z != 0.0)
        snprintf(picture, sizeof picture, "%+.2f", r->picture_z);
    if (table)
        printf("| %s | %.9g | %.9g | %.1e | %+.2f | %s | %.1f | %s%s |\n",
               row->name, row->truth, r->mean, relative, r->z, picture,
               r->seconds, by, end);
    else
        printf("%sok %s: %.9g, truth %.9g, SE %.1e of it, z %+.2f, "
               "of its picture %s, %.1f s, %s%s\n",
               holds(r) ? "" : "not ", row->name, r->mean, row->truth, relative,
               r->z, picture, r->seconds, by, end);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    static struct truth_row rows[MOST_ROWS];
    int count = all_rows(rows), bad = 0;
    bool table = argc > 1 && strcmp(argv[1], "table") == 0;
    bool sample = argc < 2;
    double seconds = setting("SECONDS_A_ROW", 60.0), start = seconds_now();
    double all = setting("SECONDS_ALL", INFINITY);
    if (table)
        printf("| row | truth | mean | SE / truth | z | z of its picture | "
               "CPU s | by |\n"
               "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
    for (struct truth_row *row; (row = next_row(rows, count));) {
        struct result r = {0};
        if (sample ? !row->sample : !asked(row->name, argc - 2, argv + 2))
            continue;
        double left = fmax(all - (seconds_now() - start), 0.0);
        if (!run_row(row, first_frame((int)(row - rows)), fmin(seconds, left),
                     &r))
            continue;
        report(row, &r, table);
        bad += !holds(&r) || (sample && !r.reached);
    }
    return bad > 0;
}
