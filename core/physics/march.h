/* march.h - the straight line from the eye: what media emit toward it, the
 * plate and the background behind them, and how opaque all is. Deterministic,
 * but for media whose density is a function. */
#ifndef CORE_PHYSICS_MARCH_H
#define CORE_PHYSICS_MARCH_H
#include "core/physics/line.h"
#include "core/physics/plate.h"
#include "core/physics/shadow.h"
#include "core/physics/sky.h"

typedef struct {
    rgb radiance;           /* emission of media, plate and background     */
    rgb background;         /* the latter two's part of it                 */
    rgb opacity;            /* 1 - transmittance of all up to the plate, or
                               to the background                           */
    float depth;            /* distance of the first surface, or plate, that
                               is not wholly transparent; infinite if none */
    uint32_t overflow;      /* media that were left out                    */
} march_result;

/* A line on its way, segment by segment. */
typedef struct {
    vec3 o, d;
    line_jitter jitter;
    container_set inside;
    plate_view plate;       /* that is ahead                               */
    int32_t at_plate, behind;       /* it ends the segment; it is passed   */
    ray_hit after, hit;     /* the ends of the segment                     */
    rgb pass;               /* of the surfaces before it                   */
    line_integral line;
    line_flight flight;     /* through the segment's media                 */
    march_result out;
} march_state;

/* Along the unit vector d from o, whose containers are `inside`; the jitter is
 * for functions (line.h). Without a plate, unless one is set. */
HD void march_begin(march_state *m, const container_set *inside, vec3 o,
                    vec3 d, line_jitter jitter)
{
    m->o = o;
    m->d = d;
    m->jitter = jitter;
    m->inside = *inside;
    m->plate = plate_none();
    m->at_plate = m->behind = 0;
    m->after = hit_start(0.0f);
    m->pass = rgb_gray(1.0f);
    m->line = line_zero();
    m->out.radiance = m->out.background = m->out.opacity = rgb_gray(0.0f);
    m->out.depth = INFINITY;
}

/* To the next surface. True: through media, step by step. */
HD bool march_seek(const flat_scene *s, march_state *m)
{
    bvh_ray r = bvh_ray_make(m->o, m->d);
    m->hit = bvh_nearest(s, &r, &m->after, s->far);
    m->at_plate = plate_cuts(&m->plate, &m->hit);
    m->line.radiance = rgb_gray(0.0f);
    return line_begin(s, &m->inside, m->o, m->d, m->after.t, m->hit.t, 0.0f,
                      true, true, m->jitter, &m->line, &m->flight);
}

HD bool march_step(const flat_scene *s, march_state *m)
{
    return line_step(s, &m->flight, &m->line);
}

/* Exact for thin media where no surface is on the way. */
HD rgb march_opacity(const march_state *m)
{
    return rgb_add(rgb_sub(rgb_gray(1.0f), m->pass),
                   rgb_mul(m->pass, line_opacity(&m->line)));
}

/* The plate's own light, and what it lets pass; false: nothing. */
HD bool march_plate(march_state *m)
{
    rgb left = rgb_mul(m->pass, line_transmittance(&m->line));
    rgb own = rgb_mul(left, m->plate.color);
    m->out.radiance = rgb_add(m->out.radiance, own);
    m->out.background = rgb_add(m->out.background, own);
    m->out.opacity = march_opacity(m);
    m->behind = 1;
    if (m->out.depth == INFINITY && m->plate.pass < 1.0f)
        m->out.depth = m->plate.t;
    m->pass = rgb_scale(m->pass, m->plate.pass);
    plate_cross(&m->plate, &m->after);
    return !rgb_is_black(m->pass);
}

/* At the end of a segment, whose emission passes the surfaces before it.
 * False: that was the last. */
HD bool march_land(const flat_scene *s, march_state *m)
{
    m->out.radiance = rgb_add(m->out.radiance,
                              rgb_mul(m->line.radiance, m->pass));
    if (scene_may(MAY_PLATE) && m->at_plate)
        return march_plate(m);
    if (m->hit.shape < 0)
        return false;
    if (hit_material(s, &m->hit) >= 0) {
        bvh_ray r = bvh_ray_make(m->o, m->d);
        rgb through = hit_transparency(s, &r, &m->hit);
        if (m->out.depth == INFINITY && rgb_min(through) < 1.0f)
            m->out.depth = m->hit.t;
        m->pass = rgb_mul(m->pass, through);
    }
    if (rgb_is_black(m->pass))
        return false;
    shadow_cross(s, &m->hit, &m->inside);
    m->after = m->hit;
    return true;
}

/* What came of it. */
HD march_result march_end(const flat_scene *s, const march_state *m)
{
    march_result out = m->out;
    rgb left = rgb_mul(m->pass, line_transmittance(&m->line));
    out.overflow = m->line.overflow;
    rgb far = sky_radiance(s, m->d);
    /* A plate that is behind all covers the sky. */
    if (scene_may(MAY_PLATE))
        far = rgb_add(m->plate.color, rgb_scale(far, m->plate.pass));
    rgb far_part = rgb_mul(left, far);
    out.background = rgb_add(out.background, far_part);
    out.radiance = rgb_add(out.radiance, far_part);
    if (!scene_may(MAY_PLATE) || !m->behind)
        out.opacity = march_opacity(m);
    return out;
}

/* The whole of it. */
HD march_result march_line(const flat_scene *s, const container_set *inside,
                           vec3 o, vec3 d, line_jitter jitter)
{
    march_state m;
    march_begin(&m, inside, o, d, jitter);
    do {
        bool more = march_seek(s, &m);
        while (more)
            more = march_step(s, &m);
    } while (march_land(s, &m));
    return march_end(s, &m);
}

#endif
