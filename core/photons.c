#include "core/photons.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/physics/lone_make.h"
#include "lib/memory.h"

/* Births of each source by which its power is judged. */
#define PILOTS 512u

bool photons_glow(const flat_scene *s)
{
    for (uint64_t i = 0; i < s->shapes_count; i++)
        if (s->shapes[i].material >= 0) {
            const flat_material *m = &s->materials[s->shapes[i].material];
            if (!rgb_is_black(rgb_add(m->ambient, m->emission)))
                return true;
        }
    return false;
}

static bool uniform_media_emit(const flat_scene *s)
{
    for (uint64_t i = 0; i < s->media_count; i++)
        if (s->media[i].uniform && s->media[i].emits)
            return true;
    return false;
}

static void add_source(struct photons *p, int32_t kind, int32_t light)
{
    photon_source *s = &p->sources[p->job.sources++];
    s->kind = kind;
    s->light = light;
}

bool photons_seek(const flat_scene *s)
{
    return s->reach.walls || photons_glow(s) || uniform_media_emit(s);
}

bool photons_lone(const flat_scene *s, uint64_t seed, uint32_t frame,
                  lone_scene *out)
{
    return lone_make(s, seed, frame, out);
}

static void list_sources(const flat_scene *s, struct photons *p)
{
    for (uint64_t i = 0; i < s->lights_count; i++)
        add_source(p, PHOTON_LIGHT, (int32_t)i);
    if (s->environment && (s->sky_count > 0 || !rgb_is_black(s->background)))
        add_source(p, PHOTON_SKY, -1);
    if (s->glows_count > 0)
        add_source(p, PHOTON_GLOW, -1);
    if (photons_seek(s))
        add_source(p, PHOTON_BODY, -1);
}

/* Mean power of births, each channel by its size. */
static double judge_power(const flat_scene *s, const struct photons *p,
                          const photon_source *source, uint32_t stream)
{
    double sum = 0.0;
    track_counters count = {0};
    for (uint32_t i = 0; i < PILOTS; i++) {
        photon_state state;
        float u[PHOTON_DIMENSIONS];
        photon_place(&p->job, i, u);
        rng random = rng_make(p->job.seed, p->job.frame, PHOTON_PASS - 1u,
                              (uint64_t)stream * PILOTS + i);
        photon_birth(s, source, u, (i + 0.5) / PILOTS, random, &state, &count);
        rgb b = state.path.beta;
        double size = (fabs((double)b.r) + fabs((double)b.g) +
                       fabs((double)b.b)) /
                      3.0 * (double)state.nominal;
        sum += isfinite(size) ? size : 0.0;
    }
    return sum / PILOTS;
}

/* Keeps the sources that give something. */
static void share_out(const flat_scene *s, struct photons *p)
{
    int kept = 0;
    double all = 0.0, sum = 0.0;
    for (int i = 0; i < p->job.sources; i++) {
        photon_source source = p->sources[i];
        double power = judge_power(s, p, &source, (uint32_t)i);
        if (!(power > 0.0))
            continue;
        source.share = power;
        all += power;
        p->sources[kept++] = source;
    }
    p->job.sources = kept;
    p->job.power = all;
    for (int i = 0; i < kept; i++) {
        p->sources[i].share /= all;
        sum += p->sources[i].share;
        p->sources[i].cumulative = sum;
    }
}

uint64_t photons_asked(const struct brume_options *options)
{
    if (options->photons.count > 0)
        return options->photons.count;
    return options->integrator == BRUME_INTEGRATOR_PROGRESSIVE
               ? BRUME_DEFAULT_PASS_PHOTONS
               : BRUME_DEFAULT_PHOTONS;
}

/* Births of voxels keep their order: each pass has them elsewhere. */
static float turned(float shift, uint32_t pass)
{
    double turn = (double)shift + 0.61803398874989 * pass;
    return (float)(turn - floor(turn));
}

bool photons_plan(const struct flat *flat, const struct brume_options *options,
                  uint32_t pass, struct photons *out, struct brume_error *err)
{
    const flat_scene *s = &flat->view;
    memset(out, 0, sizeof *out);
    out->sources = memory_new(s->lights_count + 3, sizeof *out->sources, err);
    if (!out->sources)
        return false;
    out->job.source = out->sources;
    out->job.count = photons_asked(options);
    out->job.first = pass * out->job.count;
    out->job.seed = options->seed;
    out->job.frame = options->frame;
    rng random = rng_make(options->seed, options->frame, PHOTON_PASS - 2u, 0);
    for (int i = 0; i < PHOTON_DIMENSIONS; i++) {
        out->job.shift[i] = (uint64_t)rng_u32(&random) << 32;
        out->job.shift[i] |= rng_u32(&random);
    }
    out->job.shift_share = turned(rng_float(&random), pass);
    list_sources(s, out);
    share_out(s, out);
    return true;
}

void photons_halve(const photon_job *whole, int half, photon_job *out)
{
    uint64_t first = whole->count / 2;
    *out = *whole;
    out->count = half == 0 ? first : whole->count - first;
    out->first = whole->first + (half == 0 ? 0 : first);
    out->shift_share = turned(whole->shift_share, (uint32_t)half);
}

void photons_release(struct photons *photons)
{
    free(photons->sources);
    photons->sources = NULL;
}

void brume_photons_paper(struct brume_photon_options *options)
{
    options->gather = BRUME_GATHER_BALL;
    options->single = BRUME_SINGLE_FIELD;
    options->emission = BRUME_EMISSION_PHOTONS;
    options->far_plane = true;
}
