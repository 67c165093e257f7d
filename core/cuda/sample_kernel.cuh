/* sample_kernel.cuh - the kernels of the path stage. A thread takes a pixel and
 * runs its samples in order, so that a picture is the same from run to run.
 * SAMPLE_STAGE names what is defined here, SCENE_MAY what it can do. */
#include "core/cuda/sample.cuh"

namespace
{

const int block_width = 8, block_height = 4; /* a warp a tile */
const int block_size = block_width * block_height;
/* Blocks that a multiprocessor must have room for: 128 registers a thread. */
const int blocks_at_once = 16;

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

__global__ void __launch_bounds__(block_size, blocks_at_once)
sample_lines(const __grid_constant__ sample_job job)
{
    int x, y;
    size_t at;
    if (!find_pixel(&job, &x, &y, &at))
        return;
    track_counters count = {};
    pixel_lines_run(&job.scene, &job.pixels, x, y, job.first, job.samples,
                    &job.pixel[at], &count);
    add_counters(job.count, &count);
}

__global__ void __launch_bounds__(block_size, blocks_at_once)
sample_paths(const __grid_constant__ sample_job job)
{
    int x, y;
    size_t at;
    if (!find_pixel(&job, &x, &y, &at))
        return;
    track_counters count = {};
    pixel_paths_run(&job.scene, &job.pixels, x, y, job.first, job.samples,
                    &job.pixel[at], &count);
    add_counters(job.count, &count);
}

void launch(const sample_job *job)
{
    dim3 block(block_width, block_height);
    dim3 grid((job->x1 - job->x0 + block_width - 1) / block_width,
              (job->y1 - job->y0 + block_height - 1) / block_height);
    sample_lines<<<grid, block>>>(*job);
    sample_paths<<<grid, block>>>(*job);
}

}

const sample_stage SAMPLE_STAGE = {SCENE_MAY, launch};
