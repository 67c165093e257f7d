/* photons.h - who emits photons, and how many each. */
#ifndef CORE_PHOTONS_H
#define CORE_PHOTONS_H
#include "core/flat.h"
#include "core/physics/lone_scene.h"
#include "core/physics/photon.h"

/* What the trace stage works on; the sources are owned. */
struct photons {
    photon_job job;
    photon_source *sources;
};

/* Photons of a field. */
uint64_t photons_asked(const struct brume_options *options);

/* Whether surfaces have light of their own. */
bool photons_glow(const flat_scene *scene);

/* Whether births look for surfaces. The pilots that share photons out do too,
 * on the host, so they ask for a tree there. */
bool photons_seek(const flat_scene *scene);

/* As lone_make. */
bool photons_lone(const flat_scene *scene, uint64_t seed, uint32_t frame,
                  lone_scene *out);

/* Lists the sources of the scene with their shares, for field `pass` of many,
 * or 0: none where nothing emits toward it. */
bool photons_plan(const struct flat *flat, const struct brume_options *options,
                  uint32_t pass, struct photons *out, struct brume_error *err);
/* One of two halves of its photons: two passes of half as many. */
void photons_halve(const photon_job *whole, int half, photon_job *out);
void photons_release(struct photons *photons);
#endif
