#include <stdio.h>
#include "core/backend.h"
#include "core/brume_film.h"
#include "core/order.h"

#ifndef BRUME_CUDA
static bool cuda_available(char *why, size_t size)
{
    snprintf(why, size, "this brume was built without a CUDA backend");
    return false;
}

static const struct backend backend_cuda = {.name = "cuda",
                                            .available = cuda_available};
#endif

const struct backend *backend_choose(const struct brume_options *o,
                                     struct brume_error *err)
{
    char why[256] = "";
    bool lacks = o->integrator == BRUME_INTEGRATOR_PROGRESSIVE &&
                 !backend_cuda.renew;
    if (o->backend == BRUME_BACKEND_CPU ||
        (o->backend == BRUME_BACKEND_AUTO && lacks))
        return &backend_cpu;
    if (backend_cuda.available(why, sizeof why))
        return &backend_cuda;
    if (o->backend == BRUME_BACKEND_AUTO)
        return &backend_cpu;
    brume_fail(err, BRUME_ERR_DEVICE, "no GPU can be used: %s", why);
    return NULL;
}

void backend_look(struct flat *flat, const struct brume_options *options)
{
    struct brume_error none = {0};
    const struct backend *b = options->still ? backend_choose(options, &none)
                                             : NULL;
    if (b && b->look)
        b->look(flat, options);
}

void backend_use_device(const struct brume_options *options, int device)
{
    struct brume_error none = {0};
    const struct backend *b = backend_choose(options, &none);
    if (b && b->use && device < b->devices())
        b->use(device);
}

int brume_film_devices(const struct brume_options *options, char *why,
                       size_t size)
{
    struct brume_error err = {0};
    const struct backend *b = backend_choose(options, &err);
    snprintf(why, size, "%s", err.text);
    if (b && b->devices)
        return b->devices();
    if (options->backend == BRUME_BACKEND_CPU)
        snprintf(why, size, "the CPU is asked for");
    else if (b && backend_cuda.available(why, size))
        snprintf(why, size, "it can't run this integrator yet");
    return 0;
}

/* A tree that was left to a backend is built here for one that builds none. */
static void *open_one(const struct backend *b,
                      const struct backend_frame *frame,
                      struct brume_error *err)
{
    return b->builds || order_build(frame->flat, err) ? b->open(frame, err)
                                                      : NULL;
}

void *backend_open(const struct backend **b, const struct backend *spare,
                   const struct backend_frame *frame, char *text,
                   struct brume_error *err)
{
    void *state = open_one(*b, frame, err);
    if (state || !spare || *b == spare || err->code != BRUME_ERR_MEMORY)
        return state;
    snprintf(text, BACKEND_TEXT, "%s; the CPU renders instead", err->text);
    *err = (struct brume_error){0};
    *b = spare;
    return open_one(spare, frame, err);
}
