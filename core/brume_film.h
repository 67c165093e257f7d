/* brume_film.h - a part of brume.h: the frames of a film, rendered by threads
 * of their own while the caller reads the next scene and writes the last
 * picture. Where the options ask for it, the field of light that is scattered
 * often is a mean over neighbouring frames; each field is computed once and
 * kept while it is needed. A picture depends on the frames within its reach
 * alone, whichever others the film has. While one frame is rendered others are
 * prepared and their fields filtered, unless the options give it one thread or
 * a limit of memory: who hands over many at once holds them all. One thread
 * calls. */
#ifndef CORE_BRUME_FILM_H
#define CORE_BRUME_FILM_H

struct brume_film;

/* Frames on each side over which weights are found if no number is given. */
enum { BRUME_ADAPTIVE_REACH = 8 };

/* May be NULL; called by brume_film_next, in its thread. */
struct brume_film_events {
    void *user;
    /* False ends all with BRUME_STOPPED. */
    bool (*progress)(void *user, const struct brume_progress *progress);
    void (*warn)(void *user, const char *text);
};

BRUME_API struct brume_film *
brume_film_new(const struct brume_film_events *events, struct brume_error *err);
/* How many frames are worked at, at once, each on a device of its own where
 * there are GPUs; before the first is pushed. At first it is one. */
enum { BRUME_MAX_WORKERS = 64 };
BRUME_API bool brume_film_workers(struct brume_film *film, int count,
                                  struct brume_error *err);
/* GPUs that frames with these options can be dealt to; 0: the CPU renders
 * them, and `why` (of `size` bytes) says why. */
BRUME_API int brume_film_devices(const struct brume_options *options, char *why,
                                 size_t size);
/* Starts the device of frames with these options while the caller reads the
 * first of them; of use before the first is pushed. What fails is told then. */
BRUME_API void brume_film_begin(struct brume_film *film,
                                const struct brume_options *options);
/* Stops what is under way. */
BRUME_API void brume_film_free(struct brume_film *film);

/* Sets the published weights of 1, 3 or 5 taps; false: there are none of so
 * many. */
BRUME_API bool brume_film_taps(struct brume_photon_options *options, int taps);

/* Whether what could be done at once is done in turn: a limit of memory is to
 * hold whichever thread is how far. */
static inline bool brume_film_in_turn(int threads, uint64_t memory)
{
    return threads == 1 || memory > 0;
}

/* How many frames on each side a picture with these options needs. */
BRUME_API int brume_film_reach(const struct brume_options *options);

/* Hands over the scene of frame options->frame, which the film frees, if it
 * fails too; in any order, each once until it is forgotten. `picture`: one
 * will be asked for; else only its field is needed. */
BRUME_API bool brume_film_push(struct brume_film *film, brume_scene *scene,
                               const struct brume_options *options,
                               bool picture, struct brume_error *err);

/* Asks for the picture of a frame that was pushed. Of the frames within its
 * reach those from `first` to `last`, which is as far as the film goes, have
 * been pushed too. */
BRUME_API bool brume_film_ask(struct brume_film *film, uint32_t frame,
                              uint32_t first, uint32_t last,
                              struct brume_error *err);

/* Frames below this one are not needed once what was asked for is done. */
BRUME_API bool brume_film_forget(struct brume_film *film, uint32_t below,
                                 struct brume_error *err);

/* Waits for the next of the pictures that were asked for, in their order. */
BRUME_API bool brume_film_next(struct brume_film *film,
                               struct brume_frame *frame,
                               struct brume_error *err);

#endif
