/* sample_kernel.cuh - the kernels of the path stage. A thread takes a pixel and
 * runs its samples in order, so that a picture is the same from run to run.
 * SAMPLE_STAGE names what is defined here, SCENE_MAY what it can do. */
#include "core/cuda/sample.cuh"

namespace
{

const int block_width = 8, block_height = 4; /* a warp a tile */
const int block_size = block_width * block_height;
/* Blocks that a multiprocessor must have room for: 128 registers a thread. */
#ifndef LINES_BLOCKS
#define LINES_BLOCKS 16
#endif
const int blocks_at_once = 16;

/* Tiles of a block of paths, one below the other. */
const int path_tiles = 8;

/* The pixel of a thread; false: it has none. */
__device__ __forceinline__ bool find_pixel(const sample_job *job, int *x,
                                           int *y, size_t *at)
{
    *x = job->x0 + static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    *y = job->y0 + static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
    *at = static_cast<size_t>(*y - job->y0) *
              static_cast<size_t>(job->x1 - job->x0) +
          static_cast<size_t>(*x - job->x0);
    return *x < job->x1 && *y < job->y1;
}

__device__ __forceinline__ void add_counters(device_counters *sum,
                                             const track_counters *c)
{
#define X(name)                                                                \
    if (c->name > 0)                                                           \
        atomicAdd(&sum->name, static_cast<unsigned long long>(c->name));
    TRACK_COUNTERS(X)
#undef X
}

/* Threads of a warp meet at the end of a segment: while they go along it, each
 * step is taken by all that are not there yet. */
__global__ void __launch_bounds__(block_size, LINES_BLOCKS)
sample_lines(const __grid_constant__ sample_job job)
{
    const flat_scene *s = &job.scene;
    int x, y;
    size_t at;
    bool is = find_pixel(&job, &x, &y, &at);
    track_counters count = {};
    pixel_liner l;
    pixel_lines_begin(&l, x, y, job.first, job.samples);
    if (!is)
        l.next = PIXEL_ENDS;
    while (__any_sync(~0u, l.next != PIXEL_ENDS)) {
        if (l.next == PIXEL_LANDS)
            pixel_land(s, &l, &job.pixel[at], &count);
        if (l.next == PIXEL_TAKES)
            pixel_take(s, &job.pixels, &l);
        if (l.next == PIXEL_SEEKS)
            pixel_seek(s, &l);
        while (l.next == PIXEL_STEPS)
            pixel_step(s, &l);
    }
    add_counters(job.count, &count);
}

/* All warps of a block go from segment to segment together, so that they share
 * the instructions that are fetched. */
__global__ void __launch_bounds__(block_size *path_tiles,
                                  blocks_at_once / path_tiles)
sample_paths(const __grid_constant__ sample_job job)
{
    int x, y;
    size_t at;
    bool more = find_pixel(&job, &x, &y, &at), alive = false;
    track_counters count = {};
    path_state path;
    plate_view plate = plate_none();
    uint32_t i = job.first;
    while (__syncthreads_or(more)) {
        if (more && !alive)
            pixel_begin(&job.scene, &job.pixels, x, y, i++, &path, &plate,
                        &count);
        alive = more && single_segment(&job.scene, &path, &plate, &count);
        if (more && !alive) {
            pixel_end(&path, pixel_half((i - 1u) / job.pixels.share),
                      &job.pixel[at], &count);
            more = i < job.first + job.samples;
        }
    }
    add_counters(job.count, &count);
}

/* As many parts of that size as there must be, but one at least. */
unsigned parts_of(int whole, int size)
{
    return whole > size ? static_cast<unsigned>((whole + size - 1) / size) : 1u;
}

/* Blocks of so many tiles. */
dim3 find_blocks(const sample_job *job, int tiles)
{
    return dim3(parts_of(job->x1 - job->x0, block_width),
                parts_of(job->y1 - job->y0, block_height * tiles));
}

void lines(const sample_job *job)
{
    sample_lines<<<find_blocks(job, 1), dim3(block_width, block_height)>>>(
        *job);
}

void paths(const sample_job *job)
{
    sample_paths<<<find_blocks(job, path_tiles),
                   dim3(block_width, block_height * path_tiles)>>>(*job);
}

}

const sample_stage SAMPLE_STAGE = {SCENE_MAY, lines, paths};
