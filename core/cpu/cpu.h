/* cpu.h - what the stages of the CPU backend share. */
#ifndef CORE_CPU_CPU_H
#define CORE_CPU_CPU_H
#include <stdatomic.h>
#include "core/backend.h"

struct cpu_stage;

struct cpu_state {
    struct backend_frame frame;
    pixel_job job;
    const struct cpu_stage *stage;
    int threads;
    track_counters *count;      /* of each thread                          */
    int64_t *sum;               /* of the field's cells, or NULL; room for as
                                   many floats, where the field is there   */
    uint32_t samples;           /* of this call                            */
    atomic_size_t rows_done;
    atomic_bool stop;
};

/* trace.c */
bool cpu_trace(void *state, const photon_job *job, struct brume_stats *stats,
               struct brume_error *err);

/* gather.c */
bool cpu_halve(void *state, double unit, float *blocks,
               struct brume_error *err);
bool cpu_gather(void *state, double unit, struct brume_error *err);

/* backend.c */
void cpu_add_track(const track_counters *c, struct brume_stats *out);
#endif
