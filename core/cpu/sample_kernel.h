/* sample_kernel.h - the lines and paths of a row of pixels. CPU_STAGE names
 * what is defined here, SCENE_MAY what it can do. */
#include "core/cpu/sample.h"

static void sample_row(const struct cpu_state *s, int y, film_pixel *row,
                       track_counters *count)
{
    const struct film *film = s->frame.film;
    const flat_scene *scene = &s->frame.flat->view;
    for (int x = film->x0; x < film->x1; x++, row++) {
        pixel_lines_run(scene, &s->job, x, y, film->samples, s->samples, row,
                        count);
        pixel_paths_run(scene, &s->job, x, y, film->samples, s->samples, row,
                        count);
    }
}

const struct cpu_stage CPU_STAGE = {SCENE_MAY, sample_row};
