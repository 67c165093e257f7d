/* sample.h - the path stage of the CPU: rows of pixels, by code made for what
 * the scene holds (may.h). Each sample_NAME.c is sample_kernel.h for others. */
#ifndef CORE_CPU_SAMPLE_H
#define CORE_CPU_SAMPLE_H
#include "core/cpu/cpu.h"

struct cpu_stage {
    int may;                    /* MAY_* of the scenes that it can do      */
    void (*row)(const struct cpu_state *s, int y, film_pixel *row,
                track_counters *count);
};

extern const struct cpu_stage cpu_plain, cpu_lit, cpu_all;
#endif
