/* lines_kernel.cuh - the kernel of the straight lines from the eye. Lines of a
 * pixel are as long as one another and read the same voxels: threads beside one
 * another take them at once. LINES_STAGE names what is defined here, SCENE_MAY
 * what it can do. */
#include "core/cuda/count.cuh"
#include "core/cuda/tile.cuh"

namespace
{

/* Blocks that a multiprocessor must have room for: 128 registers a thread. */
#ifndef LINES_BLOCKS
#define LINES_BLOCKS 16
#endif

/* What came of a line, and its direction. */
struct line_result {
    march_result out;
    vec3 d;
};

/* The threads' next lines. Those of a warp meet at the end of a segment: while
 * they go along it, each step is taken by all that are not there yet. */
__device__ __forceinline__ void run_lines(const sample_job *job, pixel_liner *l)
{
    const flat_scene *s = &job->scene;
    if (l->next == PIXEL_TAKES)
        pixel_take(s, &job->pixels, l);
    while (__any_sync(~0u, l->next < PIXEL_ADDS)) {
        if (l->next == PIXEL_LANDS)
            pixel_land(s, l);
        if (l->next == PIXEL_SEEKS)
            pixel_seek(s, l);
        while (l->next == PIXEL_STEPS)
            pixel_step(s, l);
    }
}

/* A thread a line, `beside` of a pixel's; the first of these adds them, in
 * their order. */
__global__ void __launch_bounds__(block_size, LINES_BLOCKS)
sample_lines(const __grid_constant__ sample_job job, int beside)
{
    __shared__ line_result result[block_size];
    int lane = static_cast<int>(threadIdx.x), turn = lane % beside, x, y;
    size_t at;
    bool is = find_pixel(&job, beside, &x, &y, &at);
    track_counters count = {};
    pixel_liner l;
    pixel_lines_begin(&l, x, y, job.line + turn, is ? job.line_end : 0, beside);
    while (__any_sync(~0u, l.next != PIXEL_ENDS)) {
        run_lines(&job, &l);
        bool adds = l.next == PIXEL_ADDS;
        if (adds)
            result[lane] = {march_end(&job.scene, &l.march), l.march.d};
        __syncwarp();
        for (int i = 0; adds && turn == 0 && i < beside && l.number + i < l.end;
             i++)
            pixel_add_line(&job.scene, &job.pixels, l.number + i,
                           result[lane + i].d, &result[lane + i].out,
                           &job.pixel[at], &count);
        __syncwarp();
        if (adds)
            pixel_pass(&l);
    }
    count_add(job.count, &count);
}

/* As many threads a pixel as it has lines, or fewer: a power of two. */
void lines(const sample_job *job)
{
    uint32_t n = job->line_end - job->line;
    int beside = n >= 8 ? 8 : n >= 4 ? 4 : n >= 2 ? 2 : 1;
    sample_lines<<<find_blocks(job, beside, 1, 1), block_size>>>(*job, beside);
}

}

const lines_stage LINES_STAGE = {SCENE_MAY, lines};
