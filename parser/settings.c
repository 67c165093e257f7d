#include "parser/settings.h"
#include "lib/hash.h"
#include "parser/naming.h"
#include <inttypes.h>
#include <stdarg.h>
#include <string.h>

struct settings {
    uint64_t hash;
};

BRUME_PRINTF(2, 3)
static void put(struct settings *s, const char *format, ...)
{
    char text[256];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    s->hash = hash_text(s->hash, text);
}

static void put_text(struct settings *s, const char *name, const char *text)
{
    s->hash = hash_text(hash_text(s->hash, name), text ? text : "");
}

static void put_scene(struct settings *s, const struct options *o)
{
    const char *slash = o->input ? strrchr(o->input, '/') : NULL;
    put_text(s, "scene", slash ? slash + 1 : o->input);
    put_text(s, "header", o->header);
    put(s, "version %.17g full %d", o->version, o->full_transport);
    put_text(s, "plate", o->plate);
    put_text(s, "layer", o->plate_layer);
    put(s, "depth %d", o->plate_depth);
    for (size_t i = 0; i < o->declares; i++) {
        put_text(s, "declare", o->declare[i].name);
        put(s, "%.17g", o->declare[i].value);
    }
}

static void put_picture(struct settings *s, const struct options *o)
{
    put(s, "size %d %d part %.17g %.17g %.17g %.17g", o->width, o->height,
        o->start_column, o->end_column, o->start_row, o->end_row);
    put(s, "format %d bits %d alpha %d", (int)naming_format(o), o->bits,
        o->alpha);
}

static void put_rendering(struct settings *s, const struct options *o)
{
    put(s, "backend %d integrator %d %d preset %d", (int)o->backend,
        o->has_integrator, (int)o->integrator, o->preset);
    put(s, "spacing %.17g depth %.17g", o->field_spacing, o->field_depth);
    put(s, "temporal %d adaptive %d", o->taps, o->adaptive);
    for (int i = 0; !o->adaptive && i < o->taps; i++)
        put(s, "%.17g", o->weight[i]);
    put(s, "spp %d error %.17g seconds %.17g", o->spp, o->error, o->seconds);
    put(s, "seed %" PRIu64 " memory %" PRIu64 " photons %" PRIu64, o->seed,
        o->memory, o->photons);
}

static void put_clock(struct settings *s, const struct options *o,
                      const struct frames *frames, int number)
{
    struct parse_ambient a;
    frames_ambient(frames, o, number, &a);
    put(s, "film %d frame %d clock %d %.17g %.17g", frames->animation, number,
        a.clock_on, a.clock, a.clock_delta);
    put(s, "from %.17g %.17g to %.17g %.17g", a.initial_frame, a.initial_clock,
        a.final_frame, a.final_clock);
}

uint64_t settings_hash(const struct options *options,
                       const struct frames *frames, int number)
{
    struct settings s = {.hash = HASH_START};
    put_text(&s, "brume", BRUME_VERSION);
    put_scene(&s, options);
    put_picture(&s, options);
    put_rendering(&s, options);
    put_clock(&s, options, frames, number);
    return s.hash;
}
