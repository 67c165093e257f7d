/* particles.h - a part of brume.h: grids of points that carry a medium. */
#ifndef CORE_PARTICLES_H
#define CORE_PARTICLES_H

enum { BRUME_MAX_NEIGHBORS = 1024 };

/* Points, each over a ball of radius r: at a distance d its mass has the
 * density 315/(64 pi r^3) (1 - d^2/r^2)^3, whose integral is the mass
 * (Mueller, Charypar and Gross 2003, equation 20). */
struct brume_particles {
    size_t count;
    const double *at;           /* x y z of each                           */
    const double *radius;       /* of each; NULL: default_radius           */
    const double *mass;         /* of each; NULL: 1                        */
    const double *value;        /* NULL: the grid is of density; else of the
                                   mean of these, weighted by density, as of
                                   temperatures                            */
    double default_radius;      /* 0: none, the neighbours alone tell      */
    int neighbors;              /* n: a radius is widened to the distance of
                                   the n-th nearest point, but at most to 8
                                   times the median of these distances; 0: 32
                                   where there is no radius, else none     */
    double voxel;               /* side of a voxel; 0: a third of the median
                                   radius, or more where the grid would have
                                   over 2^20 bricks or the sum too many
                                   samples                                 */
    int threads;                /* 0: as many as processors                */
};
#define BRUME_PARTICLES_INIT {0, NULL, NULL, NULL, NULL, 0, 0, 0, 0}

/* The density of particles as a grid, freed by grid_free, or NULL with err set.
 * The sum of its samples times a voxel's volume is the sum of the masses: each
 * ball's samples are scaled to its mass, and balls of less than 1.5 voxels are
 * widened to that. Points with a NaN, infinite or negative number (but for
 * coordinates below 0) are left out and counted in bad_nan, bad_inf and
 * bad_negative; `points` counts the others that have a mass. The grid depends
 * neither on the number of threads nor, but for the last bit, on the order of
 * points.
 * BRUME_ERR_SCENE where nothing tells a radius: a single point, or all at one
 * place; BRUME_ERR_LIMIT where a grid of these voxels would be too large. */
BRUME_API struct grid *
brume_particles_grid(const struct brume_particles *particles,
                     struct brume_error *err);
#endif
