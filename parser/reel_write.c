#include "parser/reel_write.h"
#include "lib/thread.h"
#include "lib/timer.h"
#include "parser/naming.h"
#include "parser/picture.h"
#include <string.h>

/* What an EXR says of itself: nothing that differs from run to run. */
enum { TEXTS = 6, TEXT_SIZE = 64 };

static size_t describe(const struct reel *reel, const struct reel_record *r,
                       struct exr_text text[TEXTS],
                       char value[TEXTS][TEXT_SIZE])
{
    size_t count = 0;
    const char *slash = strrchr(reel->options->input, '/');
    text[count++] = (struct exr_text){"software", "Brume " BRUME_VERSION};
    text[count++] = (struct exr_text){
        "scene",
        slash ? slash + 1 : reel->options->input,
    };
    if (reel->frames.animation) {
        snprintf(value[count], TEXT_SIZE, "%d", r->number);
        text[count] = (struct exr_text){"frame", value[count]};
        count++;
    }
    if (r->clock_on) {
        snprintf(value[count], TEXT_SIZE, "%.17g", r->clock);
        text[count] = (struct exr_text){"clock", value[count]};
        count++;
    }
    snprintf(value[count], TEXT_SIZE, "%d", r->stats.spp);
    text[count] = (struct exr_text){"samplesPerPixel", value[count]};
    count++;
    snprintf(value[count], TEXT_SIZE, "%.6g", r->stats.error);
    text[count] = (struct exr_text){"relativeError", value[count]};
    return count + 1;
}

static bool write_frame(struct reel_write *w)
{
    const struct reel *reel = w->reel;
    const struct options *options = reel->options;
    struct reel_record *record = w->record;
    struct exr_text text[TEXTS];
    char value[TEXTS][TEXT_SIZE];
    struct picture picture = {
        .frame = &w->frame,
        .format = naming_format(options),
        .bits = options->bits,
        .alpha = options->alpha,
        .text = text,
        .texts = describe(reel, record, text, value),
        .threads = options->threads,
    };
    if (!options->to_file)
        return true;
    double start = timer_seconds();
    bool ok = picture_write(&picture, record->picture, reel->events->out,
                            &w->err);
    record->seconds_write = timer_seconds() - start;
    return ok;
}

static void *run(void *context)
{
    struct reel_write *w = context;
    w->good = write_frame(w);
    return NULL;
}

static bool goes_beside(const struct options *o)
{
    return o->to_file && !brume_film_in_turn(o->threads, o->memory);
}

void reel_write_begin(struct reel_write *w)
{
    w->beside = goes_beside(w->reel->options) &&
                thread_begin(&w->thread, run, w) == 0;
    if (!w->beside)
        run(w);
}

bool reel_write_end(struct reel_write *w)
{
    if (w->beside)
        pthread_join(w->thread, NULL);
    w->beside = false;
    brume_frame_free(&w->frame);
    return w->good;
}
