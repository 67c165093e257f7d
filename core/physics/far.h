/* far.h - the effective far plane: how deep the eye looks into media.
 *
 * Of each pixel's ray, the distance at which its opacity reaches 0.9999, it
 * meets an opaque surface or plate, or leaves the last medium; the farthest of
 * all is where the field of scattered light may end (PAPER.md, section 4). Most
 * rays need only tell that they see nothing beyond what others do: they are
 * looked at from there on. */
#ifndef CORE_PHYSICS_FAR_H
#define CORE_PHYSICS_FAR_H
#include "core/physics/line.h"
#include "core/physics/pixel.h"
#include "core/physics/shadow.h"

/* Optical depth of an opacity of 0.9999. */
#define FAR_DEPTH 9.2103404

/* Parts in which a stretch between two surfaces is looked at; a ray's distance
 * is told to a part of it, and never too near. */
enum { FAR_PARTS = 24 };

HD double far_thinnest(const line_integral *l)
{
    double a = l->tau[0] < l->tau[1] ? l->tau[0] : l->tau[1];
    return a < l->tau[2] ? a : l->tau[2];
}

/* What is asked of a ray: how far it goes, of which `axis` of each length
 * counts; beyond `known` alone if that is more than 0, and then no more than
 * whether it does. */
typedef struct {
    float axis, known;
} far_query;

/* Goes on to t1; true: nothing is seen behind *far. `depth`: optical depth at
 * which it is opaque. */
HD bool far_stretch(const flat_scene *s, const container_set *set, vec3 o,
                    vec3 d, float t0, float t1, double depth,
                    const far_query *q, line_integral *line, float *far)
{
    float step = (t1 - t0) / (float)FAR_PARTS;
    for (int i = 0; i < FAR_PARTS; i++) {
        double before = line->tau[0] + line->tau[1] + line->tau[2];
        float end = i < FAR_PARTS - 1 ? t0 + step * (float)(i + 1) : t1;
        if (end * q->axis <= q->known)
            continue;
        line_integrate(s, set, o, d, t0 + step * (float)i, end, 0.0f, false,
                       false, line_jitter_make(0.5f, 0.5f), line);
        bool more = line->tau[0] + line->tau[1] + line->tau[2] > before;
        if (more)
            *far = end;
        if ((more && q->known > 0.0f) || far_thinnest(line) >= depth)
            return true;
    }
    return false;
}

/* Of the ray o + t d whose containers are `set`; 0 where it meets no medium, or
 * none beyond what is known. */
HD float far_of_ray(const flat_scene *s, container_set set, vec3 o, vec3 d,
                    plate_view plate, const far_query *q)
{
    bvh_ray r = bvh_ray_make(o, d);
    ray_hit after = hit_start(0.0f);
    line_integral line = line_zero();
    float far = 0.0f, pass = 1.0f;
    for (;;) {
        ray_hit h = bvh_nearest(s, &r, &after, s->far);
        bool at_plate = plate_cuts(&plate, &h);
        /* What surfaces leave is opaque the sooner. */
        double depth = FAR_DEPTH + (double)fm_log(pass);
        if (far_stretch(s, &set, o, d, after.t, h.t, depth, q, &line, &far) ||
            (h.shape < 0 && !at_plate))
            return far;
        if (at_plate)
            pass *= plate.pass;
        else if (hit_material(s, &h) >= 0)
            pass *= rgb_max(hit_transparency(s, &r, &h));
        if (!(pass > 1e-4f))
            return far;
        if (at_plate) {
            plate_cross(&plate, &after);
            continue;
        }
        shadow_cross(s, &h, &set);
        after = h;
    }
}

/* Of the middle of pixel (x, y) of a picture, along the direction of view; 0
 * where that is no farther than `known`, for less than to tell how far. */
HD float far_of_pixel(const flat_scene *s, int32_t width, int32_t height,
                      int32_t x, int32_t y, float known)
{
    vec3 o, d;
    container_set set;
    far_query q;
    camera_ray(&s->view, ((float)x + 0.5f) / (float)width - 0.5f,
               0.5f - ((float)y + 0.5f) / (float)height, &o, &d);
    pixel_containers(s, o, d, &set);
    plate_view plate = plate_seen(s, (uint64_t)y * (uint64_t)width +
                                     (uint64_t)x, d);
    q.axis = vec3_dot(d, vec3_normalize(s->view.direction));
    q.known = known;
    if (known > 0.0f && far_of_ray(s, set, o, d, plate, &q) == 0.0f)
        return 0.0f;
    q.known = 0.0f;
    return far_of_ray(s, set, o, d, plate, &q) * q.axis;
}

#endif
