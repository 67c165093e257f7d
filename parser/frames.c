#include "parser/frames.h"

static int max(int a, int b)
{
    return a > b ? a : b;
}

/* In float, as POV-Ray: 0.29 of 100 is 29 there, not 28.999999999999996. */
static int part_of(double fraction, int whole)
{
    return (int)((float)fraction * (float)whole);
}

/* A subset's end as it was given: a fraction of the last frame, or a number;
 * below 0 for none. */
static int frame_number(double given, int final, int otherwise)
{
    if (given < 0)
        return otherwise;
    return given < 1 ? part_of(given, final) : (int)given;
}

static int digits_of(int number)
{
    int digits = 1;
    while (number /= 10)
        digits++;
    return digits;
}

void frames_init(struct frames *frames, const struct options *options)
{
    int initial = max(options->initial_frame, 0);
    int final = max(options->final_frame, initial);
    *frames = (struct frames){.step = 1, .digits = 1};
    if (initial == final && final <= 1)
        return;
    frames->animation = true;
    frames->initial = initial;
    frames->final = final;
    frames->first = max(frame_number(options->subset_start, final, initial),
                        initial);
    frames->last = max(frame_number(options->subset_end, final, final),
                       frames->first);
    frames->step = options->frame_step;
    frames->digits = digits_of(final);
}

void frames_shard(struct frames *frames, const struct shard *shard)
{
    int count = (frames->last - frames->first) / frames->step + 1;
    int start = shard_start(shard, count, shard->index);
    int end = shard_start(shard, count, shard->index + 1);
    frames->none = start >= end;
    frames->last = frames->first + (end - 1) * frames->step;
    frames->first += start * frames->step;
}

void frames_ambient(const struct frames *frames, const struct options *options,
                    int number, struct parse_ambient *ambient)
{
    *ambient = (struct parse_ambient){
        .clock = options->clock,
        .clock_on = options->has_clock,
        .image_width = options->width,
        .image_height = options->height,
    };
    if (!frames->animation)
        return;
    /* A cyclic film has one more interval; POV-Ray lets scenes see that as
     * one more frame. */
    int final = frames->final + (options->cyclic ? 1 : 0);
    int intervals = final - frames->initial;
    double length = options->final_clock - options->initial_clock;
    ambient->clock_on = true;
    ambient->clock_delta = intervals ? length / intervals : 0;
    ambient->clock = options->initial_clock;
    if (intervals)
        ambient->clock += length * (number - frames->initial) / intervals;
    ambient->frame_number = number;
    ambient->initial_frame = frames->initial;
    ambient->final_frame = final;
    ambient->initial_clock = options->initial_clock;
    ambient->final_clock = options->final_clock;
}

/* The first of the pixels: a fraction below 1, or counted from 1. */
static int region_start(double given, int size)
{
    if (given < 0)
        return 0;
    return given < 1 ? part_of(given, size) : (int)given - 1;
}

/* One past the last of them: for an end 1 is all, as in POV-Ray. */
static int region_end(double given, int size)
{
    if (given < 0)
        return size;
    return given <= 1 ? part_of(given, size) : (int)given;
}

static bool read_side(const char *what, double from, double to, int size,
                      int *start, int *end, struct brume_error *err)
{
    *start = region_start(from, size);
    *end = region_end(to, size);
    if (*start >= size)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "start %s %g lies beyond the last, %d", what, from,
                          size);
    if (*end > size)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "end %s %g lies beyond the last, %d", what, to, size);
    if (*start >= *end)
        return brume_fail(err, BRUME_ERR_USAGE, "no %s is left from %d to %d",
                          what, *start + 1, *end);
    return true;
}

bool frames_region(const struct options *options, int region[4],
                   struct brume_error *err)
{
    return read_side("column", options->start_column, options->end_column,
                     options->width, &region[0], &region[2], err) &&
           read_side("row", options->start_row, options->end_row,
                     options->height, &region[1], &region[3], err);
}
