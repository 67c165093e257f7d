/* lone_stream.h - the numbers of a photon of photon_lone.h: those of rng.h,
 * drawn ahead. */
#ifndef CORE_PHYSICS_LONE_STREAM_H
#define CORE_PHYSICS_LONE_STREAM_H
#include "core/physics/lone_scene.h"
#include "core/physics/photon_birth.h"

/* A GPU's threads draw blocks of numbers together, and take as many of the
 * words as they need. */
typedef struct {
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
#define LONE_NEEDS 7

/* How many words are there. */
HD int32_t lone_ready(const lone_stream *n)
{
    return (int32_t)(4u * n->drawn - n->next);
}

/* Draws a block of a photon's path, as rng_u32 has it, with what all photons'
 * rounds share. There is room for it where no more than LONE_WORDS - 4 words
 * are there. */
HD void lone_draw(const lone_scene *l, const uint32_t *path, lone_stream *n,
                  uint32_t *words)
{
    uint32_t c[4], first = 4u * n->drawn % LONE_WORDS;
    c[0] = path[0];
    c[1] = path[1];
    c[2] = PHOTON_PASS;
    c[3] = n->drawn++;
    for (int i = 0; i < RNG_ROUNDS; i++)
        rng_philox_round(c, l->round_key[2 * i], l->round_key[2 * i + 1]);
    for (uint32_t i = 0; i < 4u; i++)
        words[(first + i) * LONE_STRIDE] = c[i];
}

/* The i-th word from the next one on; i < 0: one that was taken. */
HD uint32_t lone_word(const lone_stream *n, const uint32_t *words, int i)
{
    return words[(n->next + (uint32_t)i) % LONE_WORDS * LONE_STRIDE];
}

/* The stream from the next word on. */
HD rng lone_random(const lone_scene *l, const uint32_t *path,
                   const lone_stream *n)
{
    rng r;
    r.key[0] = l->key[0];
    r.key[1] = l->key[1];
    r.counter[0] = path[0];
    r.counter[1] = path[1];
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

/* What a flight takes, in this order: a depth; at a tentative collision, the
 * depth to the next one, which is drawn before it is known whether the flight
 * goes on, and what happens. Where that is scattering two more words tell where
 * to. */
typedef struct {
    uint32_t depth[2], next[2], choice;
    int fly, collide;       /* words of the first; of all                  */
} lone_numbers;

/* Looks at what comes; `drawn`: the first depth is. */
HD lone_numbers lone_look(const lone_stream *m, const uint32_t *words,
                          bool drawn)
{
    lone_numbers n;
    n.depth[0] = lone_word(m, words, 0);
    n.depth[1] = rng_depth_is_end(n.depth[0]) ? lone_word(m, words, 1) : 0u;
    n.fly = drawn ? 0 : rng_depth_is_end(n.depth[0]) ? 2 : 1;
    n.next[0] = lone_word(m, words, n.fly);
    n.collide = n.fly + (rng_depth_is_end(n.next[0]) ? 3 : 2);
    n.next[1] = n.collide - n.fly > 2 ? lone_word(m, words, n.fly + 1) : 0u;
    n.choice = lone_word(m, words, n.collide - 1);
    return n;
}

#endif
