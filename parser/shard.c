#include "parser/shard.h"
#include <errno.h>
#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PARTS = 1000000000 };

static bool read_number(const char *text, const char *end, long low, long *out)
{
    char *stop;
    if (*text < '0' || *text > '9')
        return false;
    errno = 0;
    *out = strtol(text, &stop, 10);
    return errno == 0 && stop == end && *out >= low && *out <= MOST_PARTS;
}

bool shard_read(const char *text, struct shard *out)
{
    const char *slash = strchr(text, '/');
    long index, count;
    *out = (struct shard){.slurm = strcmp(text, "slurm") == 0};
    if (out->slurm)
        return true;
    if (!slash || !read_number(text, slash, 1, &index) ||
        !read_number(slash + 1, slash + strlen(slash), 1, &count) ||
        index > count)
        return false;
    out->index = (int)index;
    out->count = (int)count;
    return true;
}

/* ---- Slurm -------------------------------------------------------------- */

/* False: the variable is not there. One that is no number is told in err. */
static bool variable(const char *name, long *out, struct brume_error *err)
{
    const char *text = getenv(name);
    if (!text || !*text)
        return false;
    if (read_number(text, text + strlen(text), 0, out))
        return true;
    return brume_fail(err, BRUME_ERR_USAGE, "%s is '%s', not a number", name,
                      text);
}

static bool needs(const char *name, long *out, struct brume_error *err)
{
    return variable(name, out, err) ||
           brume_fail(err, BRUME_ERR_USAGE,
                      "--shard slurm: %s is not set though this is a task of "
                      "an array or a step",
                      name);
}

/* Tasks min, min + step ... of an array; all must be in it. */
static bool ask_array(struct shard *s, long task, struct brume_error *err)
{
    long low, high, step, count;
    if (!needs("SLURM_ARRAY_TASK_MIN", &low, err) ||
        !needs("SLURM_ARRAY_TASK_MAX", &high, err) ||
        !needs("SLURM_ARRAY_TASK_STEP", &step, err) ||
        !needs("SLURM_ARRAY_TASK_COUNT", &count, err))
        return false;
    if (step < 1 || task < low || task > high || (task - low) % step != 0 ||
        (high - low) / step + 1 != count)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "--shard slurm: an array of %ld tasks from %ld to "
                          "%ld by %ld has gaps: no part could be told from it",
                          count, low, high, step);
    s->index = (int)((task - low) / step) + 1;
    s->count = (int)count;
    return true;
}

/* The tasks of a step share each part. A batch script has a rank too, but no
 * step of several tasks. */
static bool ask_step(struct shard *s, long tasks, struct brume_error *err)
{
    long rank;
    if (!needs("SLURM_PROCID", &rank, err))
        return false;
    if (tasks < 1 || rank >= tasks || s->count > MOST_PARTS / tasks)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "--shard slurm: task %ld of %ld is none", rank,
                          tasks);
    s->index = (int)((s->index - 1) * tasks + rank) + 1;
    s->count = (int)(s->count * tasks);
    return true;
}

bool shard_ask_slurm(struct shard *shard, struct brume_error *err)
{
    long task, tasks;
    bool array = variable("SLURM_ARRAY_TASK_ID", &task, err);
    bool step = variable("SLURM_STEP_NUM_TASKS", &tasks, err);
    shard->index = shard->count = 1;
    if (err->code)
        return false;
    if (!array && !step)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "--shard slurm: this is neither a task of a job "
                          "array (SLURM_ARRAY_TASK_ID) nor of a job step "
                          "(SLURM_STEP_NUM_TASKS)");
    return (!array || ask_array(shard, task, err)) &&
           (!step || ask_step(shard, tasks, err));
}

/* ---- parts -------------------------------------------------------------- */

int shard_start(const struct shard *shard, int frames, int index)
{
    if (shard->count < 1)
        return index > shard->index ? frames : 0;
    return (int)((int64_t)frames * (index - 1) / shard->count);
}
