/* shard.h - which part of a film's frames this run renders: part `index` of
 * `count`, counted from 1. */
#ifndef PARSER_SHARD_H
#define PARSER_SHARD_H
#include <stdbool.h>
#include "lib/error.h"

struct shard {
    int index, count;           /* count 0: not given, the whole film      */
    bool slurm;                 /* both come from Slurm's variables        */
};

/* "I/N" or "slurm"; false: it is neither. */
bool shard_read(const char *text, struct shard *out);

/* Fills in what Slurm says: the tasks of a job array, each with as many parts
 * as the job step has tasks. False with err set (BRUME_ERR_USAGE) where this
 * is neither a task of an array nor of a step, or the array has gaps. */
bool shard_ask_slurm(struct shard *shard, struct brume_error *err);

/* The first of the part's frames among `frames` of them, counted from 0; of
 * part count + 1, one past the last. Parts are runs without a gap, their
 * lengths differ by one at most. */
int shard_start(const struct shard *shard, int frames, int index);
#endif
