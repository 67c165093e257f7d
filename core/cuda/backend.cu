/* The CUDA backend: the flat scene, the film and all lists lie in one device
 * allocation. */
#include <cstdio>
#include <new>
#include "core/cuda/backend.cuh"
#include "core/cuda/develop.cuh"
#include "core/cuda/lone.cuh"
#include "core/cuda/resident.cuh"

namespace
{

/* Paths of a launch, at most: few enough for a stop to be heard within a second
 * or so, many enough that threads find work when their first paths end. One
 * takes 160 bytes: there are few where memory is short. */
const size_t most_paths = 1u << 22;
const size_t few_paths = 1u << 18;

/* From the leanest to the one that can do all. */
const sample_stage *const kernels[] = {&sample_gray, &sample_media,
                                       &sample_glow, &sample_lit,
                                       &sample_fire, &sample_all};

const lines_stage *const line_kernels[] = {&lines_media, &lines_fire,
                                           &lines_lit, &lines_all};

const photon_stage *const photon_kernels[] = {&photons_media,  &photons_balls,
                                              &photons_colors, &photons_lit,
                                              &photons_fire,   &photons_all};

bool cuda_available(char *why, size_t size)
{
    int devices = 0;
    cudaError_t code = cudaGetDeviceCount(&devices);
    if (code == cudaSuccess && devices > 0)
        return true;
    snprintf(why, size, "%s",
             code != cudaSuccess ? cudaGetErrorString(code) : "there is none");
    return false;
}

int cuda_devices()
{
    int devices = 0;
    return cudaGetDeviceCount(&devices) == cudaSuccess ? devices : 0;
}

void cuda_use(int device)
{
    if (cudaSetDevice(device) != cudaSuccess)
        cudaGetLastError(); /* told where the device is opened */
}

void cuda_look(flat *f, const brume_options *options)
{
    f->looked = resident_look(&f->view, f->radiance, options->threads);
    f->forget = resident_forget;
}

void cuda_close(void *state)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    if (s) {
        device_arena_free(&s->arena);
        device_arena_free(&s->field);
        device_arena_free(&s->tree);
        device_clock_free(&s->clock);
        upload_free(&s->to);
    }
    delete s;
}

/* Whether an array of the scene stays on the device: the field does not, which
 * is written there. */
bool stays(const cuda_state *s, const void *array, size_t bytes)
{
    return resident_is_worth(s->kept, bytes) &&
           array != s->frame.flat->view.radiance;
}

/* Samples of one launch. */
uint32_t samples_per_launch(const cuda_state *s)
{
    bool single = (s->frame.stages->needs & MAY_SINGLE) != 0;
    return single ? most_samples : 2 * most_samples;
}

/* Rows of the film whose paths, so many a pixel, are of one launch; the
 * launches of all rows are about as large. */
int path_rows(const cuda_state *s, uint32_t samples)
{
    const film *f = s->frame.film;
    size_t all = static_cast<size_t>(f->y1 - f->y0);
    size_t row = static_cast<size_t>(f->x1 - f->x0) * samples;
    size_t most = row > 0 && row < s->most_paths ? s->most_paths / row : 1;
    size_t parts = (all + most - 1) / most;
    return static_cast<int>(parts > 0 ? (all + parts - 1) / parts : 1);
}

/* Paths of a launch. */
size_t paths_at_once(const cuda_state *s)
{
    const film *f = s->frame.film;
    size_t most = 0;
    for (uint32_t i = 1; i <= samples_per_launch(s); i++) {
        size_t paths = static_cast<size_t>(path_rows(s, i)) *
                       static_cast<size_t>(f->x1 - f->x0) * i;
        most = paths > most ? paths : most;
    }
    return most;
}

/* Bytes of the list of paths that leave the eye's line, if any can. */
size_t bent_bytes(const cuda_state *s)
{
    return s->frame.stages->path ? paths_at_once(s) * s->stage->bent_bytes : 0;
}

size_t paths_bytes(const cuda_state *s)
{
    return s->job.pixels.path
               ? device_round(paths_at_once(s) * sizeof *s->job.result) +
                     device_round(bent_bytes(s)) +
                     device_round(sizeof *s->job.queue)
               : 0;
}

size_t frame_bytes(const cuda_state *s)
{
    const flat_scene *view = &s->frame.flat->view;
    size_t bytes = device_round(sizeof(device_counters)) +
                   device_round(film_pixels(s->frame.film) *
                                sizeof(film_pixel)) +
                   develop_bytes(s) + photons_bytes(s) + paths_bytes(s);
#define X(type, name)                                                          \
    if (!stays(s, view->name, view->name##_count * sizeof(type)))              \
        bytes += device_round(view->name##_count * sizeof(type));
    SCENE_ARRAYS(X)
#undef X
    return bytes;
}

/* NULL with err set. The field has nothing yet. */
const void *upload_array(cuda_state *s, const void *from, size_t bytes,
                         brume_error *err)
{
    if (stays(s, from, bytes))
        return resident_take(s->kept, from, bytes, err);
    void *to = device_take(&s->arena, bytes);
    bool good = from == s->frame.flat->view.radiance ||
                upload_put(&s->to, s->arena.base, to, from, bytes, err);
    return good ? to : nullptr;
}

bool clear_field(cuda_state *s, brume_error *err)
{
    size_t bytes = s->frame.flat->view.radiance_count * sizeof *s->cells;
    s->cells = const_cast<float *>(s->job.scene.radiance);
    return device_check(cudaMemsetAsync(s->cells, 0, bytes),
                        "clearing the field", err);
}

sole_field describe_field(const flat_scene *from, int field)
{
    sole_field out = {};
    if (field < 0)
        return out;
    out.field = from->fields[field];
    if (out.field.kind == FIELD_GRID)
        out.grid = from->grids[out.field.grid];
    return out;
}

/* The records of the only medium, if there is one. */
void describe_sole(const flat_scene *from, sole_medium *to)
{
    if (from->media_count != 1)
        return;
    const flat_medium *m = from->media;
    to->medium = *m;
    to->lead = describe_field(from, m->lead);
    for (int i = 0; i < m->densities; i++)
        to->density[i] = describe_field(from, m->density[i]);
    to->temperature = describe_field(from, m->fire ? m->temperature : -1);
    to->amount = describe_field(from, m->fire ? m->amount : -1);
}

/* Frames that an array may be waited for: where fields are filtered each is
 * opened twice, with those within reach between, and two that are ahead. */
int frames_between(const cuda_state *s)
{
    int reach = brume_film_reach(s->frame.options);
    return reach > 0 ? 1 + 2 * (reach + 2) : 1;
}

/* Copies every array of the scene and points the device's view at them. */
bool upload(cuda_state *s, brume_error *err)
{
    const flat_scene *from = &s->frame.flat->view;
    bool good = true;
    s->job.scene = *from;
    describe_sole(from, &s->job.scene.sole);
    resident_begin(s->kept, &s->to, s->frame.options->threads,
                   static_cast<resident_looked *>(s->frame.flat->looked));
    device_clock_mark(&s->clock, 0);
#define X(type, name)                                                          \
    if (good) {                                                                \
        const void *to = upload_array(s, from->name,                           \
                                      from->name##_count * sizeof(type), err); \
        good = to != nullptr;                                                  \
        s->job.scene.name = static_cast<const type *>(to);                     \
    }
    SCENE_ARRAYS(X)
#undef X
    good = good && upload_flush(&s->to, err) && clear_field(s, err);
    resident_end(s->kept, frames_between(s));
    return good && device_clock_stop(&s->clock, 1, "the upload", err) &&
           device_clock_add(&s->clock, 0, &s->spent.upload);
}

void start_paths(cuda_state *s)
{
    sample_job *job = &s->job;
    size_t bent = bent_bytes(s);
    job->processors = s->processors;
    if (!job->pixels.path)
        return;
    job->result = static_cast<rgb *>(
        device_take(&s->arena, paths_at_once(s) * sizeof *job->result));
    job->queue = static_cast<path_queue *>(
        device_take(&s->arena, sizeof *job->queue));
    if (bent > 0)
        job->bent = device_take(&s->arena, bent);
}

bool start_film(cuda_state *s, brume_error *err)
{
    size_t bytes = film_pixels(s->frame.film) * sizeof(film_pixel);
    s->job.pixel = static_cast<film_pixel *>(device_take(&s->arena, bytes));
    s->job.count = static_cast<device_counters *>(
        device_take(&s->arena, sizeof(device_counters)));
    start_paths(s);
    develop_open(s);
    if (s->frame.film->samples > 0)
        return device_check(cudaMemcpy(s->job.pixel, s->frame.film->pixel,
                                       bytes, cudaMemcpyHostToDevice),
                            "uploading the film", err);
    return device_check(cudaMemset(s->job.pixel, 0, bytes), "clearing the film",
                        err);
}

/* The first of a list that can do all that the scene needs. */
template <typename stage>
const stage *choose(const stage *const *list, int needs)
{
    while (needs & ~(*list)->may)
        list++;
    return *list;
}

/* The stage for photons of one gray medium in one container, or NULL. */
const photon_stage *choose_lone(cuda_state *s)
{
    const brume_options *o = s->frame.options;
    int needs = s->frame.stages->needs & ~TRACE_IGNORES;
    if (!s->frame.stages->photons || (needs & ~(MAY_FIELD | MAY_TINTS)) ||
        !photons_lone(&s->frame.flat->view, o->seed, o->frame, &s->lone))
        return nullptr;
    return needs & MAY_TINTS ? &lone_tints : &lone_gray;
}

void choose_photons(cuda_state *s)
{
    int needs = s->frame.stages->needs;
    const photon_stage *lone = choose_lone(s);
    s->photons = choose(photon_kernels, needs & ~PHOTONS_IGNORE);
    s->births = lone ? lone : s->photons;
    s->tracer = lone ? lone : choose(photon_kernels, needs & ~TRACE_IGNORES);
    s->one_color = (s->tracer->may & MAY_TINTS) == 0;
}

void describe_job(sample_job *job, const backend_frame *frame)
{
    const film *f = frame->film;
    job->pixels = backend_pixels(frame);
    job->x0 = f->x0;
    job->y0 = f->y0;
    job->x1 = f->x1;
    job->y1 = f->y1;
}

/* What is asked of the device, and its clock. */
bool open_device(cuda_state *s, brume_error *err)
{
    int bytes = 0;
    if (!device_clock_new(&s->clock, err) ||
        !device_number(cudaDevAttrMultiProcessorCount, &s->processors, err) ||
        !device_number(cudaDevAttrMaxSharedMemoryPerBlockOptin, &bytes, err))
        return false;
    s->trace_threads = s->tracer->threads;
    while (s->trace_threads > 32 &&
           static_cast<size_t>(s->trace_threads / 32) * s->tracer->warp_bytes >
               static_cast<size_t>(bytes))
        s->trace_threads /= 2;
    return true;
}

/* Those of the job, so many rows at a time. */
void launch_paths(const cuda_state *s)
{
    sample_job part = s->job;
    int rows = path_rows(s, part.samples);
    int wide = part.x1 - part.x0;
    for (int y = s->job.y0; y < s->job.y1; y += rows) {
        part.y0 = y;
        part.y1 = y + rows < s->job.y1 ? y + rows : s->job.y1;
        part.pixel = s->job.pixel + static_cast<size_t>(y - s->job.y0) *
                                        static_cast<size_t>(wide);
        s->stage->paths(&part);
    }
}

/* As photons_warm. */
bool sample_warm(cuda_state *s, brume_error *err)
{
    sample_job none = s->job;
    none.x1 = none.x0;
    none.samples = 2; /* whose paths may be listed */
    s->liner->lines(&none);
    if (s->job.pixels.path)
        s->stage->paths(&none);
    return device_wait("opening", err);
}

bool warm(cuda_state *s, brume_error *err)
{
    return sample_warm(s, err) && photons_warm(s, err) && develop_warm(s, err);
}

void *try_open(const backend_frame *frame, size_t paths, brume_error *err)
{
    cuda_state *s = new (std::nothrow) cuda_state();
    if (!s) {
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
        return nullptr;
    }
    device_keep_memory();
    s->frame = *frame;
    s->most_paths = paths;
    s->kept = resident_of(frame->options->still);
    s->reserved = device_reserved(resident_pool(s->kept));
    s->stage = choose(kernels, frame->stages->needs & ~MAY_TINTS);
    s->liner = choose(line_kernels,
                      frame->stages->needs & ~(LINES_IGNORE | MAY_TINTS));
    choose_photons(s);
    describe_job(&s->job, frame);
    if (open_device(s, err) &&
        upload_new(&s->to, s->frame.options->threads, resident_spare(s->kept),
                   err) &&
        device_arena_new(&s->arena, frame_bytes(s), err) && upload(s, err) &&
        tree_scene_build(s, err) && start_film(s, err) &&
        photons_open(s, err) && warm(s, err))
        return s;
    cuda_close(s);
    return nullptr;
}

/* Again with nothing of other frames and fewer paths at a time, where there is
 * no room. */
void *cuda_open(const backend_frame *frame, brume_error *err)
{
    void *state = try_open(frame, most_paths, err);
    if (state || err->code != BRUME_ERR_MEMORY)
        return state;
    resident_set *kept = resident_of(frame->options->still);
    resident_empty(kept);
    /* Stacks of kernels are not taken from what was set aside. */
    device_trim(resident_pool(kept));
    *err = {};
    return try_open(frame, few_paths, err);
}

/* Hands over the times since this was done last. */
void give_times(cuda_state *s, brume_device_seconds *out)
{
    out->upload += s->spent.upload;
    out->tree += s->spent.tree;
    out->trace += s->spent.trace;
    out->gather += s->spent.gather;
    out->lines += s->spent.lines;
    out->paths += s->spent.paths;
    s->spent = {};
}

/* Hands over what memory was set aside since this was done last. */
void give_memory(cuda_state *s, brume_stats *out)
{
    uint64_t now = device_reserved(resident_pool(s->kept));
    out->allocated += (now > s->reserved ? now - s->reserved : 0) +
                      s->to.set_aside;
    s->reserved = now;
    s->to.set_aside = 0;
}

bool read_counts(cuda_state *s, brume_stats *out, brume_error *err)
{
    device_counters c;
    if (!device_check(
            cudaMemcpy(&c, s->job.count, sizeof c, cudaMemcpyDeviceToHost),
            "reading the counters", err))
        return false;
    cuda_add_track(&c, out);
    give_times(s, &out->device);
    give_memory(s, out);
    return true;
}

/* The samples that the job asks for. */
bool sample_some(cuda_state *s, brume_error *err)
{
    bool path = s->job.pixels.path != 0;
    device_clock_mark(&s->clock, 0);
    s->liner->lines(&s->job);
    device_clock_mark(&s->clock, 1);
    if (path)
        launch_paths(s);
    return device_check(cudaGetLastError(), "launching the path stage", err) &&
           device_clock_stop(&s->clock, 2, "the path stage", err) &&
           device_clock_add(&s->clock, 0, &s->spent.lines) &&
           device_clock_add(&s->clock, 1, &s->spent.paths);
}

bool cuda_sample(void *state, uint32_t *samples, brume_stats *stats,
                 brume_error *err)
{
    uint32_t count = *samples;
    cuda_state *s = static_cast<cuda_state *>(state);
    const film *f = s->frame.film;
    stats->uploaded += resident_uploaded(s->kept);
    resident_trees(s->kept, &stats->trees_built, &stats->trees_kept);
    if (film_pixels(f) == 0)
        return true;
    if (!device_check(cudaMemset(s->job.count, 0, sizeof *s->job.count),
                      "clearing the counters", err))
        return false;
    const uint32_t most = samples_per_launch(s);
    for (uint32_t done = 0; done < count;) {
        uint32_t n = count - done < most ? count - done : most;
        s->job.first = f->samples + done;
        s->job.samples = n;
        s->job.line = film_lines(f, s->job.first);
        s->job.line_end = film_lines(f, s->job.first + n);
        if (!sample_some(s, err))
            return false;
        done += n;
        if (!s->frame.tick(s->frame.user, static_cast<double>(done) / count)) {
            *samples = done;
            break;
        }
    }
    if (!s->job.pixels.path)
        stats->paths += film_pixels(f) * *samples;
    return read_counts(s, stats, err);
}

}

void cuda_add_track(const device_counters *c, brume_stats *out)
{
#define X(name) out->name += c->name;
    TRACK_COUNTERS(X)
#undef X
}

extern "C" const struct backend backend_cuda = {
    "cuda",       cuda_available, cuda_look,  cuda_open,  cuda_trace,
    cuda_gather,  cuda_halve,     cuda_take,  cuda_put,   cuda_sample,
    cuda_survey,  cuda_develop,   cuda_fetch, cuda_close, cuda_renew,
    cuda_devices, cuda_use,       true,
};
