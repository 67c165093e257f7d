/* The CUDA backend: the flat scene and the film lie in one device allocation;
 * a thread takes a pixel and runs its samples in order, so that a picture is
 * the same from run to run. */
#include <cstdio>
#include <cstdlib>
#include <new>
#include "core/cuda/device.cuh"
extern "C" {
#include "core/backend.h"
}

namespace
{

/* Samples of one launch: short enough for a stop to be heard within a second
 * or so, long enough that threads find work when their first paths end. */
const uint32_t samples_per_launch = 8;
const int block_width = 8, block_height = 4; /* a warp a tile */

struct cuda_state {
    backend_frame frame;
    device_arena arena;
    flat_scene scene; /* its pointers are the device's           */
    film_pixel *pixel;
    pixel_counters *count;
    pixel_job job;
};

struct film_part {
    int x0, y0, x1, y1;
};

__device__ void add_counter(uint64_t *sum, uint64_t value)
{
    if (value > 0)
        atomicAdd(reinterpret_cast<unsigned long long *>(sum),
                  static_cast<unsigned long long>(value));
}

__device__ void add_counters(pixel_counters *sum, const pixel_counters *c)
{
    add_counter(&sum->track.paths, c->track.paths);
    add_counter(&sum->track.rays, c->track.rays);
    add_counter(&sum->track.shadow_rays, c->track.shadow_rays);
    add_counter(&sum->track.collisions, c->track.collisions);
    add_counter(&sum->track.lookups, c->track.lookups);
    add_counter(&sum->track.majorant_exceeded, c->track.majorant_exceeded);
    add_counter(&sum->track.overflow, c->track.overflow);
    add_counter(&sum->rejected, c->rejected);
}

__global__ void sample_pixels(flat_scene scene, pixel_job job, film_part part,
                              uint32_t first, uint32_t n, film_pixel *pixel,
                              pixel_counters *sum)
{
    int x = part.x0 + static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    int y = part.y0 + static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
    if (x >= part.x1 || y >= part.y1)
        return;
    size_t at = static_cast<size_t>(y - part.y0) *
                    static_cast<size_t>(part.x1 - part.x0) +
                static_cast<size_t>(x - part.x0);
    pixel_counters count = {};
    pixel_run(&scene, &job, x, y, first, n, &pixel[at], &count);
    add_counters(sum, &count);
}

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

void cuda_close(void *state)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    if (s)
        device_arena_free(&s->arena);
    delete s;
}

size_t frame_bytes(const cuda_state *s)
{
    const flat_scene *view = &s->frame.flat->view;
    size_t bytes = device_round(sizeof(pixel_counters)) +
                   device_round(film_pixels(s->frame.film) *
                                sizeof(film_pixel));
#define X(type, name) bytes += device_round(view->name##_count * sizeof(type));
    SCENE_ARRAYS(X)
#undef X
    return bytes;
}

/* Copies every array of the scene and points the device's view at them. */
bool upload(cuda_state *s, brume_error *err)
{
    const flat_scene *from = &s->frame.flat->view;
    bool good = true;
    s->scene = *from;
#define X(type, name)                                                          \
    if (good) {                                                                \
        size_t bytes = from->name##_count * sizeof(type);                      \
        void *to = device_take(&s->arena, bytes);                              \
        good = device_check(                                                   \
            cudaMemcpy(to, from->name, bytes, cudaMemcpyHostToDevice),         \
            "uploading " #name, err);                                          \
        s->scene.name = static_cast<const type *>(to);                         \
    }
    SCENE_ARRAYS(X)
#undef X
    return good;
}

bool start_film(cuda_state *s, brume_error *err)
{
    size_t bytes = film_pixels(s->frame.film) * sizeof(film_pixel);
    s->pixel = static_cast<film_pixel *>(device_take(&s->arena, bytes));
    s->count = static_cast<pixel_counters *>(
        device_take(&s->arena, sizeof(pixel_counters)));
    return device_check(cudaMemset(s->pixel, 0, bytes), "clearing the film",
                        err);
}

void *cuda_open(const backend_frame *frame, brume_error *err)
{
    cuda_state *s = new (std::nothrow) cuda_state();
    if (!s) {
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
        return nullptr;
    }
    s->frame = *frame;
    s->job.width = frame->options->width;
    s->job.height = frame->options->height;
    s->job.seed = frame->options->seed;
    s->job.frame = frame->options->frame;
    s->job.path = frame->stages->path || frame->stages->single;
    if (device_arena_new(&s->arena, frame_bytes(s), err) && upload(s, err) &&
        start_film(s, err))
        return s;
    cuda_close(s);
    return nullptr;
}

bool launch(cuda_state *s, uint32_t first, uint32_t n, brume_error *err)
{
    const film *f = s->frame.film;
    film_part part = {f->x0, f->y0, f->x1, f->y1};
    dim3 block(block_width, block_height);
    dim3 grid((f->x1 - f->x0 + block_width - 1) / block_width,
              (f->y1 - f->y0 + block_height - 1) / block_height);
    sample_pixels<<<grid, block>>>(s->scene, s->job, part, first, n, s->pixel,
                                   s->count);
    return device_check(cudaGetLastError(), "launching the path stage", err) &&
           device_check(cudaDeviceSynchronize(), "the path stage", err);
}

bool read_counts(cuda_state *s, brume_stats *out, brume_error *err)
{
    pixel_counters c;
    if (!device_check(
            cudaMemcpy(&c, s->count, sizeof c, cudaMemcpyDeviceToHost),
            "reading the counters", err))
        return false;
    out->paths += c.track.paths;
    out->rays += c.track.rays;
    out->shadow_rays += c.track.shadow_rays;
    out->collisions += c.track.collisions;
    out->lookups += c.track.lookups;
    out->majorant_exceeded += c.track.majorant_exceeded;
    out->overflow += c.track.overflow;
    out->rejected += c.rejected;
    return true;
}

bool cuda_sample(void *state, uint32_t count, brume_stats *stats,
                 brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    const film *f = s->frame.film;
    if (film_pixels(f) == 0)
        return true;
    if (!device_check(cudaMemset(s->count, 0, sizeof *s->count),
                      "clearing the counters", err))
        return false;
    for (uint32_t done = 0; done < count;) {
        uint32_t n = count - done < samples_per_launch ? count - done
                                                       : samples_per_launch;
        if (!launch(s, f->samples + done, n, err))
            return false;
        done += n;
        if (!s->frame.tick(s->frame.user, static_cast<double>(done) / count))
            return true;
    }
    return device_check(cudaMemcpy(f->pixel, s->pixel,
                                   film_pixels(f) * sizeof(film_pixel),
                                   cudaMemcpyDeviceToHost),
                        "reading the film", err) &&
           read_counts(s, stats, err);
}

}

extern "C" const struct backend backend_cuda = {
    "cuda",  cuda_available, cuda_open,  nullptr,
    nullptr, cuda_sample,    cuda_close,
};
