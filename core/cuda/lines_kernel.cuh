/* lines_kernel.cuh - the kernel of the straight lines from the eye. A thread
 * takes a pixel and runs its lines in order. LINES_STAGE names what is defined
 * here, SCENE_MAY what it can do. */
#include "core/cuda/count.cuh"
#include "core/cuda/tile.cuh"

namespace
{

/* Blocks that a multiprocessor must have room for: 128 registers a thread. */
#ifndef LINES_BLOCKS
#define LINES_BLOCKS 16
#endif

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
    count_add(job.count, &count);
}

void lines(const sample_job *job)
{
    sample_lines<<<find_blocks(job, 1, 1), block_size>>>(*job);
}

}

const lines_stage LINES_STAGE = {SCENE_MAY, lines};
