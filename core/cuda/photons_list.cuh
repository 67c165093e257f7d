/* photons_list.cuh - what the kernels that trace photons share: the lists in
 * which these wait, what they leave in the field, and what is counted. */
#include "core/cuda/count.cuh"
#include "core/cuda/photons.cuh"

namespace
{

/* Words of a photon in a list. Beside a word lies that of the next photon, so
 * that threads share the transactions in which they write and read photons. */
const int state_words = sizeof(photon_state) / sizeof(uint4);

__device__ __forceinline__ void put_photon(const trace_job *job, int turn,
                                           unsigned i, const photon_state *p)
{
    uint4 word[state_words];
    uint4 *at = static_cast<uint4 *>(job->list[turn]) + i;
    memcpy(word, p, sizeof *p);
    for (int k = 0; k < state_words; k++)
        at[static_cast<size_t>(k) * job->room] = word[k];
}

__device__ __forceinline__ photon_state get_photon(const trace_job *job,
                                                   int turn, unsigned i)
{
    uint4 word[state_words];
    const uint4 *at = static_cast<const uint4 *>(job->list[turn]) + i;
    photon_state p;
    for (int k = 0; k < state_words; k++)
        word[k] = at[static_cast<size_t>(k) * job->room];
    memcpy(&p, word, sizeof p);
    return p;
}

/* Of a flight, to be laid. */
struct stretch {
    vec3 o, d;
    float from, to;
    rgb power;
};

/* Stores the events that wait of a warp's threads, all of them here: one after
 * the other, each thread in cells of its own. */
__device__ __forceinline__ void store(const flat_scene *s,
                                      const radiance_event *event,
                                      photon_counters *count)
{
    int lane = threadIdx.x % warp_size;
    if (!scene_may(MAY_BALLS) || !s->field.ball)
        return;
    unsigned all = __ballot_sync(~0u, count->tally.waits != 0);
    count->tally.waits = 0;
    __syncwarp();
    for (; all != 0u; all &= all - 1u) {
        int owner = __ffs(all) - 1;
        const radiance_event *e = &event[owner];
        radiance_box b = radiance_box_of(s, e->p);
        int wide = b.hi[0] - b.lo[0] + 1, high = b.hi[1] - b.lo[1] + 1;
        int cells = wide * high * (b.hi[2] - b.lo[2] + 1);
        bool stored = false;
        if (wide <= 0 || high <= 0)
            cells = 0;
        for (int i = lane; i < cells; i += warp_size)
            if (radiance_splat_cell(s, count->tally.sum, e, &b,
                                    b.lo[0] + i % wide,
                                    b.lo[1] + i / wide % high,
                                    b.lo[2] + i / (wide * high)))
                stored = true;
        stored = __any_sync(~0u, stored);
        if (lane == owner && stored)
            count->stored++;
    }
    __syncwarp();
}

__device__ __forceinline__ void write_counts(const trace_job *job,
                                             const photon_counters *c)
{
    photon_totals *total = job->total;
    count_add(&total->track, &c->track);
    count_warp(&total->photons, c->photons);
    count_warp(&total->events, c->events);
    count_warp(&total->bounces, c->bounces);
    count_warp(&total->stored, c->stored);
    count_warp(&total->clipped, c->tally.clipped);
    count_books(total, &c->books);
}

}
