/* sample_kernel.cuh - the kernels of the path stage. Paths are taken by a
 * thread each, and leave their light in a list, which is added up in order at
 * last: so a picture is the same from run to run. SAMPLE_STAGE names what is
 * defined here, SCENE_MAY what it can do. */
#include "core/cuda/count.cuh"
#include "core/cuda/tile.cuh"

namespace
{

/* Tiles that a multiprocessor must have room for: 128 registers a thread. */
const int tiles_at_once = 16;

/* Tiles of a block of paths, one below the other. */
const int path_tiles = 8;

/* A path that has left the eye's line, as it is where it begins anew. */
struct bent_path {
    rgb beta, r_u, radiance;
    vec3 o, d;
    float p_dir;
    int32_t driver, spread;
    container_set inside;
    rng random;
    unsigned result;
};

__host__ __device__ inline unsigned find_pixels(const sample_job *job)
{
    return static_cast<unsigned>(job->x1 - job->x0) *
           static_cast<unsigned>(job->y1 - job->y0);
}

__device__ __forceinline__ bent_path *bent_paths(const sample_job *job)
{
    return static_cast<bent_path *>(job->bent);
}

__device__ __forceinline__ void put_path(const sample_job *job, unsigned i,
                                         const path_state *p, unsigned result)
{
    bent_paths(job)[i] = {p->beta,   p->r_u,    p->radiance, p->o,
                          p->d,      p->p_dir,  p->driver,   p->spread,
                          p->inside, p->random, result};
}

/* Returns where its light is to be left. */
__device__ __forceinline__ unsigned get_path(const sample_job *job, unsigned i,
                                             path_state *p)
{
    const bent_path *from = bent_paths(job) + i;
    path_begin(p, from->o, from->d, &from->inside, false, from->random);
    p->random = from->random;
    p->beta = from->beta;
    p->r_u = from->r_u;
    p->radiance = from->radiance;
    p->p_dir = from->p_dir;
    p->driver = from->driver;
    p->spread = from->spread;
    p->boost = 1.0f;
    return from->result;
}

/* The sample of a thread's path, of those of the job. Where lights are sought
 * along the eye's line, all pixels take their samples in the order of the
 * places where they are: lines to there are as long as beside it. */
__device__ __forceinline__ unsigned find_sample(const sample_job *job, int x,
                                                int y)
{
    const unsigned n = job->samples, rank = blockIdx.z;
    if (n == 1 || !single_does(&job->scene))
        return rank;
    uint64_t index = pixel_index(&job->pixels, x, y);
    float place[most_samples];
    for (unsigned i = 0; i < most_samples; i++)
        place[i] = i < n ? pixel_along(&job->pixels, index, job->first + i)
                         : 2.0f;
    unsigned found = 0;
    for (unsigned i = 0; i < most_samples; i++) {
        unsigned before = 0;
        for (unsigned k = 0; k < most_samples; k++)
            before += place[k] < place[i] || (place[k] == place[i] && k < i);
        found = before == rank ? i : found;
    }
    return found;
}

/* Paths from the eye; those that leave its line are listed, or go on here. All
 * warps of a block go from segment to segment together, so that they share the
 * instructions that are fetched. */
__global__ void __launch_bounds__(block_size *path_tiles,
                                  tiles_at_once / path_tiles)
sample_paths(const __grid_constant__ sample_job job)
{
    int x, y;
    size_t at;
    bool alive = find_pixel(&job, 1, &x, &y, &at);
    track_counters count = {};
    path_state path;
    plate_view plate = plate_none();
    unsigned result = 0;
    if (alive) {
        unsigned i = find_sample(&job, x, y);
        result = i * find_pixels(&job) + static_cast<unsigned>(at);
        pixel_begin(&job.scene, &job.pixels, x, y, job.first + i, &path, &plate,
                    &count);
    }
    while (__syncthreads_or(alive)) {
        bool ends = false;
        if (alive) {
            alive = single_segment(&job.scene, &path, &plate, &count);
            ends = !alive;
        }
        bool bends = alive && !path.straight && job.bent;
        unsigned i = take_numbers(&job.queue->listed, bends);
        if (bends)
            put_path(&job, i, &path, result);
        if (ends)
            job.result[result] = path.radiance;
        alive = alive && !bends;
    }
    count_add(job.count, &count);
}

/* What has left them, taken from the list by threads that stay. */
__global__ void __launch_bounds__(block_size *path_tiles,
                                  tiles_at_once / path_tiles)
sample_bent(const __grid_constant__ sample_job job)
{
    unsigned result = 0, n = job.queue->listed;
    bool alive = false, more = true;
    track_counters count = {};
    path_state path;
    plate_view plate = plate_none();
    for (;;) {
        bool asks = more && !alive;
        unsigned i = take_numbers(&job.queue->taken, asks);
        if (asks) {
            more = alive = i < n;
            if (alive)
                result = get_path(&job, i, &path);
        }
        if (!__syncthreads_or(alive))
            break;
        if (alive) {
            path.straight = 0;
            path.beta = path_gray(path.beta);
            path.r_u = may_gray(path.r_u);
            alive = single_segment(&job.scene, &path, &plate, &count);
            if (!alive)
                job.result[result] = path.radiance;
        }
    }
    count_add(job.count, &count);
}

/* In the order of the samples. */
__global__ void __launch_bounds__(block_size *path_tiles)
add_paths(const __grid_constant__ sample_job job)
{
    unsigned n = find_pixels(&job);
    unsigned at = blockIdx.x * blockDim.x + threadIdx.x;
    track_counters count = {};
    for (unsigned i = 0; at < n && i < job.samples; i++)
        pixel_end(job.result[i * n + at],
                  pixel_half((job.first + i) / job.pixels.share),
                  &job.pixel[at], &count);
    count_add(job.count, &count);
}

/* A list is worth it where there are many paths: of one sample those that leave
 * the eye's line would begin when all others have ended. */
void paths(const sample_job *job)
{
    const int threads = block_size * path_tiles;
    const unsigned blocks = static_cast<unsigned>(job->processors) *
                            (tiles_at_once / path_tiles);
    sample_job j = *job;
    if (j.samples == 1)
        j.bent = nullptr;
    cudaMemsetAsync(j.queue, 0, sizeof *j.queue);
    sample_paths<<<find_blocks(&j, 1, path_tiles, j.samples), threads>>>(j);
    if (j.bent)
        sample_bent<<<blocks, threads>>>(j);
    add_paths<<<parts_of(static_cast<int>(find_pixels(&j)), threads),
                threads>>>(j);
}

}

const sample_stage SAMPLE_STAGE = {SCENE_MAY, sizeof(bent_path), paths};
