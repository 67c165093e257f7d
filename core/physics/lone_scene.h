/* lone_scene.h - what is alike for all photons of one even medium in one
 * container (photon_lone.h). */
#ifndef CORE_PHYSICS_LONE_SCENE_H
#define CORE_PHYSICS_LONE_SCENE_H
#include "core/physics/rng.h"
#include "core/physics/scene.h"

/* Places no farther than this from the origin have no more rounding than
 * lone_scene.deep leaves room for. */
#define LONE_NEAR 16.0f

typedef struct {
    affine to_local;        /* of the container, shape 0                   */
    int32_t ball;           /* it is one; else a box                       */
    float deep;             /* what is no farther from its middle than this,
                               in its own space, is surely inside          */
    int32_t covered;        /* the field's lattice holds all that is inside */
    uint32_t key[2];        /* of the streams of numbers                   */
    uint32_t round_key[2 * RNG_ROUNDS];     /* ... in each round of a block
                               of them                                     */
    int32_t peaked;         /* cells hold what goes to the eye alone, by the
                               law of Henyey and Greenstein, g >= 0:       */
    float law[3];           /* law[2] / x^1.5, x = law[0] + law[1] (1 - c) */
    flat_medium medium;
    float driver;           /* its majorant                                */
    float per_driver, per_side;     /* 1 over it, and over a cell's side   */
    float sigma_s, sigma_a; /* what happens at tentative collisions        */
    float ratio;            /* what scattering changes weights by          */
    int32_t nulls;          /* nulls may happen, and change them by        */
    float null_beta, null_r;
} lone_scene;

#endif
