#include "parser/stats.h"
#include "lib/json.h"
#include "lib/output.h"
#include "parser/explain.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void stats_line(const struct reel_record *r, FILE *to)
{
    const struct brume_stats *s = &r->stats;
    const char *name = r->picture ? r->picture : "no picture";
    double seconds = r->seconds_parse + s->seconds_prepare + s->seconds_render +
                     r->seconds_write;
    char error[32] = "unknown", bytes[32];
    if (isfinite(s->error))
        snprintf(error, sizeof error, "%.2g %%", 100 * s->error);
    fprintf(to,
            "%s: %d samples a pixel, error %s, %.3g s (scene %.3g, "
            "preparing %.3g, rendering %.3g), %s, %s\n",
            strcmp(name, "-") == 0 ? "standard output" : name, s->spp, error,
            seconds, r->seconds_parse, s->seconds_prepare, s->seconds_render,
            explain_bytes(s->bytes, bytes, sizeof bytes), s->backend);
}

static bool put_seconds(struct json *json, const struct reel_record *r)
{
    const struct brume_stats *s = &r->stats;
    struct json *seconds = json_new_object();
    bool ok = json_put_number(seconds, "parse", r->seconds_parse) &&
              json_put_number(seconds, "prepare", s->seconds_prepare) &&
              json_put_number(seconds, "render", s->seconds_render) &&
              json_put_number(seconds, "write", r->seconds_write);
    return json_put(json, "seconds", seconds) && ok;
}

static bool put_parsed(struct json *json, const struct parse_counts *c)
{
    struct json *out = json_new_object();
    bool ok = json_put_count(out, "texts_read", c->texts_read) &&
              json_put_count(out, "texts_kept", c->texts_kept) &&
              json_put_count(out, "meshes_read", c->meshes_read) &&
              json_put_count(out, "meshes_kept", c->meshes_kept);
    return json_put(json, "parsed", out) && ok;
}

static bool put_counts(struct json *json, const struct brume_stats *s)
{
    return json_put_text(json, "backend", s->backend) &&
           json_put_count(json, "spp", (uint64_t)s->spp) &&
           json_put_number(json, "error", s->error) &&
           json_put_count(json, "paths", s->paths) &&
           json_put_count(json, "rays", s->rays) &&
           json_put_count(json, "shadow_rays", s->shadow_rays) &&
           json_put_count(json, "collisions", s->collisions) &&
           json_put_count(json, "lookups", s->lookups) &&
           json_put_count(json, "majorant_exceeded", s->majorant_exceeded) &&
           json_put_count(json, "rejected", s->rejected) &&
           json_put_count(json, "trees_built", s->trees_built) &&
           json_put_count(json, "trees_kept", s->trees_kept) &&
           json_put_count(json, "device", (uint64_t)s->worker) &&
           json_put_count(json, "uploaded", s->uploaded) &&
           json_put_count(json, "allocated", s->allocated) &&
           json_put_count(json, "bytes", s->bytes);
}

/* Powers are parts of what was emitted. */
static bool put_photons(struct json *json, const struct brume_photon_stats *p)
{
    double of = p->emitted > 0.0 ? p->emitted : 1.0;
    double rest = p->emitted + p->units - p->media - p->surfaces - p->walls -
                  p->escaped - p->roulette - p->dropped;
    struct json *out = json_new_object(), *books = json_new_object();
    bool ok = json_put_count(out, "traced", p->traced) &&
              json_put_count(out, "events", p->events) &&
              json_put_count(out, "bounces", p->bounces) &&
              json_put_count(out, "stored", p->stored) &&
              json_put_count(out, "clipped", p->clipped) &&
              json_put_count(out, "cells", p->cells) &&
              json_put_number(out, "side", p->side) &&
              json_put_count(out, "bytes", p->bytes) &&
              json_put_count(out, "ring", p->ring) &&
              json_put_number(out, "seconds", p->seconds) &&
              json_put_number(out, "seconds_filter", p->seconds_filter) &&
              json_put_number(books, "units", p->units / of) &&
              json_put_number(books, "media", p->media / of) &&
              json_put_number(books, "surfaces", p->surfaces / of) &&
              json_put_number(books, "walls", p->walls / of) &&
              json_put_number(books, "escaped", p->escaped / of) &&
              json_put_number(books, "roulette", p->roulette / of) &&
              json_put_number(books, "dropped", p->dropped / of) &&
              json_put_number(books, "rest", rest / of);
    ok = json_put(out, "books", books) && ok;
    return json_put(json, "photons", out) && ok;
}

static bool put_device(struct json *json, const struct brume_device_seconds *d)
{
    struct json *out = json_new_object();
    bool ok = json_put_number(out, "upload", d->upload) &&
              json_put_number(out, "tree", d->tree) &&
              json_put_number(out, "trace", d->trace) &&
              json_put_number(out, "gather", d->gather) &&
              json_put_number(out, "lines", d->lines) &&
              json_put_number(out, "paths", d->paths);
    return json_put(json, "device_seconds", out) && ok;
}

static struct json *frame_json(const struct reel_record *r)
{
    struct json *json = json_new_object();
    bool ok = json_put_count(json, "frame", (uint64_t)r->number) &&
              json_put_number(json, "clock", r->clock) &&
              (!r->picture || json_put_text(json, "picture", r->picture)) &&
              put_counts(json, &r->stats) && put_seconds(json, r) &&
              put_parsed(json, &r->parsed) &&
              (r->stats.device.upload <= 0.0 ||
               put_device(json, &r->stats.device)) &&
              (r->stats.photons.traced == 0 ||
               put_photons(json, &r->stats.photons));
    if (ok)
        return json;
    json_free(json);
    return NULL;
}

static bool put_run(struct json *json, const struct reel *reel,
                    enum brume_code code)
{
    const struct options *o = reel->options;
    return json_put_text(json, "brume", BRUME_VERSION) &&
           json_put_text(json, "scene", o->input ? o->input : "") &&
           json_put_count(json, "width", (uint64_t)o->width) &&
           json_put_count(json, "height", (uint64_t)o->height) &&
           json_put_count(json, "seed", o->seed) &&
           json_put_count(json, "exit_code", (uint64_t)code);
}

bool stats_write(const struct reel *reel, enum brume_code code,
                 const char *path, struct brume_error *err)
{
    struct json *json = json_new_object(), *frames = json_new_array();
    bool ok = put_run(json, reel, code);
    for (size_t i = 0; ok && i < reel->records; i++)
        ok = json_put(frames, NULL, frame_json(&reel->record[i]));
    ok = json_put(json, "frames", frames) && ok;
    char *text = ok ? json_text(json, err) : NULL;
    if (!text)
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    ok = text && output_write(path, text, strlen(text), err);
    free(text);
    json_free(json);
    return ok;
}
