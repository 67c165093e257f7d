/* lone_stream.h - the numbers of a photon of photon_lone.h: those of rng.h,
 * drawn ahead. */
#ifndef CORE_PHYSICS_LONE_STREAM_H
#define CORE_PHYSICS_LONE_STREAM_H
#include "core/physics/lone_scene.h"
#include "core/physics/photon_birth.h"

/* A GPU's threads draw blocks of numbers together, and take as many of the
 * words as they need. */
typedef struct {
    uint32_t path[2];
    uint32_t next;          /* word of the stream                          */
    uint32_t drawn;         /* blocks, from the first one on               */
} lone_stream;

/* The last words that were drawn, the i-th at i % LONE_WORDS * LONE_STRIDE: on
 * a GPU threads have theirs side by side. */
#define LONE_WORDS 16u
#ifdef __CUDACC__
#define LONE_STRIDE 128u
#else
#define LONE_STRIDE 1u
#endif

/* Words that are there before a flight, for it and what happens at its end. */
#define LONE_NEEDS 5

/* How many words are there. */
HD int32_t lone_ready(const lone_stream *n)
{
    return (int32_t)(4u * n->drawn - n->next);
}

/* Draws a block, as rng_u32 has it, with what all photons' rounds share. There
 * is room for it where no more than LONE_WORDS - 4 words are there. */
HD void lone_draw(const lone_scene *l, lone_stream *n, uint32_t *words)
{
    uint32_t c[4], first = 4u * n->drawn % LONE_WORDS;
    c[0] = n->path[0];
    c[1] = n->path[1];
    c[2] = PHOTON_PASS;
    c[3] = n->drawn++;
    for (int i = 0; i < RNG_ROUNDS; i++)
        rng_philox_round(c, l->round_key[2 * i], l->round_key[2 * i + 1]);
    for (uint32_t i = 0; i < 4u; i++)
        words[(first + i) * LONE_STRIDE] = c[i];
}

HD uint32_t lone_word(const lone_stream *n, const uint32_t *words, uint32_t i)
{
    return words[(n->next + i) % LONE_WORDS * LONE_STRIDE];
}

/* The stream from the next word on. */
HD rng lone_random(const lone_scene *l, const lone_stream *n)
{
    rng r;
    r.key[0] = l->key[0];
    r.key[1] = l->key[1];
    r.counter[0] = n->path[0];
    r.counter[1] = n->path[1];
    r.counter[2] = PHOTON_PASS;
    r.counter[3] = n->next / 4u;
    r.used = 4u;
    for (uint32_t i = n->next % 4u; i > 0u; i--)
        rng_u32(&r);
    return r;
}

/* Goes on where `r` is: what has been drawn of its block is drawn anew. */
HD void lone_set_random(lone_stream *n, const rng *r)
{
    n->next = 4u * r->counter[3] + r->used - 4u;
    n->drawn = n->next / 4u;
}

/* What may be taken, in this order: a depth; at a tentative collision, the
 * depth to the next one, which is drawn before it is known whether the flight
 * goes on, and what happens; where that is scattering, where to. */
typedef struct {
    uint32_t depth[2], next[2], choice, turn[2];
    uint32_t fly, collide;  /* words of the first; with the next two       */
} lone_numbers;

/* Where a depth needs two words. */
HD_APART lone_numbers lone_look_far(const lone_scene *l, lone_stream from,
                                    bool drawn)
{
    lone_numbers n;
    rng r = lone_random(l, &from);
    n.depth[0] = n.depth[1] = n.fly = 0u;
    if (!drawn) {
        n.depth[0] = rng_u32(&r);
        n.depth[1] = rng_depth_is_end(n.depth[0]) ? rng_u32(&r) : 0u;
        n.fly = rng_depth_is_end(n.depth[0]) ? 2u : 1u;
    }
    n.next[0] = rng_u32(&r);
    n.next[1] = rng_depth_is_end(n.next[0]) ? rng_u32(&r) : 0u;
    n.collide = n.fly + (rng_depth_is_end(n.next[0]) ? 3u : 2u);
    n.choice = rng_u32(&r);
    n.turn[0] = rng_u32(&r);
    n.turn[1] = rng_u32(&r);
    return n;
}

/* Looks at what comes, of LONE_NEEDS words that are there; `drawn`: a depth
 * is. */
HD lone_numbers lone_look(const lone_scene *l, const lone_stream *m,
                          const uint32_t *words, bool drawn)
{
    lone_numbers n;
    n.fly = drawn ? 0u : 1u;
    n.collide = n.fly + 2u;
    n.depth[0] = lone_word(m, words, 0u);
    n.next[0] = lone_word(m, words, n.fly);
    n.choice = lone_word(m, words, n.fly + 1u);
    n.turn[0] = lone_word(m, words, n.fly + 2u);
    n.turn[1] = lone_word(m, words, n.fly + 3u);
    n.depth[1] = n.next[1] = 0u;
    if (rng_depth_is_end(n.depth[0]) || rng_depth_is_end(n.next[0]))
        n = lone_look_far(l, *m, drawn);
    return n;
}

#endif
