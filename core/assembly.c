/* From shapes with parts to wholes, parts and nodes. No recursion: composites
 * may be nested as deep as memory goes. */
#include "core/assembly.h"
#include <stdlib.h>
#include <string.h>
#include "core/flat.h"
#include "core/physics/leaf.h"
#include "core/shapes.h"

/* Shapes may be parts of several others, so that few of them can make very
 * many leaves. */
enum { MAX_PARTS = 1 << 24 };

/* A shape to be laid out, and what it gets from what it is part of. */
struct task {
    int shape;
    matrix by;
    int material, interior;
    int whole, parent; /* or -1                                   */
    bool hollow, shadow;
    bool inverse, twisted; /* now; ever, by itself or above           */
    bool unseen;           /* part of a clip                          */
    bool clipped;          /* its own clips are laid out              */
    size_t glyph;          /* of a text, or LEAF_ALL                  */
};

struct work {
    const brume_scene *scene;
    struct assembly *out;
    struct task *tasks;
    size_t tasks_count, tasks_capacity;
    struct brume_error *err;
};

#define EXTEND(owner, list, err)                                               \
    flat_extend((void **)&(owner)->list, &(owner)->list##_capacity,            \
                &(owner)->list##_count, 1, sizeof *(owner)->list, err)

static bool push(struct work *w, const struct task *t)
{
    struct task *slot = EXTEND(w, tasks, w->err);
    if (slot)
        *slot = *t;
    return slot != NULL;
}

/* A new node at the end of its parent's children; -1 with err set. */
static int add_node(struct work *w, int parent, int op)
{
    struct node *n = EXTEND(w->out, nodes, w->err);
    if (!n)
        return -1;
    int id = (int)w->out->nodes_count - 1;
    n->op = op;
    n->parent = parent;
    n->first = n->last = n->next = n->part = -1;
    if (parent >= 0) {
        struct node *p = &w->out->nodes[parent];
        *(p->last < 0 ? &p->first : &w->out->nodes[p->last].next) = id;
        p->last = id;
    }
    return id;
}

static int add_whole(struct work *w, const struct task *t)
{
    struct whole *out = EXTEND(w->out, wholes, w->err);
    if (!out)
        return -1;
    out->node = -1;
    out->interior = t->interior;
    out->flags = (t->hollow ? SHAPE_HOLLOW : 0) |
                 (t->shadow ? 0 : SHAPE_NO_SHADOW);
    return (int)w->out->wholes_count - 1;
}

/* The node of an item of a whole, which becomes the whole's if it is the
 * first. */
static int place_node(struct work *w, const struct task *t, int op)
{
    int id = add_node(w, t->parent, op);
    if (id >= 0 && t->parent < 0)
        w->out->wholes[t->whole].node = id;
    return id;
}

static bool add_part(struct work *w, const struct task *t, const matrix *place,
                     bool alone)
{
    const struct brume_shape *s = &w->scene->shapes[t->shape];
    int node = alone ? -1 : place_node(w, t, CSG_UNION);
    if ((!alone && node < 0))
        return false;
    if (w->out->parts_count >= MAX_PARTS)
        return brume_fail(w->err, BRUME_ERR_LIMIT,
                          "more than %d parts of composites", MAX_PARTS);
    struct part *p = EXTEND(w->out, parts, w->err);
    if (!p)
        return false;
    struct whole *whole = &w->out->wholes[t->whole];
    struct leaf_request request = {w->scene, s, t->glyph,
                                   !alone || whole->interior >= 0, place};
    if (!leaf_make(&request, &w->out->arena, &p->leaf, w->err))
        return false;
    if (!alone)
        w->out->nodes[node].part = (int)w->out->parts_count - 1;
    p->material = t->material;
    p->whole = t->whole;
    p->node = node;
    p->flags = p->leaf.flags | (whole->flags & SHAPE_HOLLOW) |
               (t->shadow ? 0 : SHAPE_NO_SHADOW) |
               (t->inverse ? SHAPE_INVERSE : 0) |
               (t->unseen ? SHAPE_UNSEEN : 0);
    return true;
}

/* A composite's operation, inversions pushed down to its parts. What was ever
 * inverted shows no inner surfaces of unions, as POV-Ray's. */
static int operation(enum brume_shape_kind kind, const struct task *t)
{
    switch (kind) {
    case BRUME_SHAPE_INTERSECTION:
    case BRUME_SHAPE_DIFFERENCE:
        return t->inverse ? CSG_MERGE : CSG_INTERSECTION;
    case BRUME_SHAPE_MERGE:
        return t->inverse ? CSG_INTERSECTION : CSG_MERGE;
    default:
        return t->inverse   ? CSG_INTERSECTION
               : t->twisted ? CSG_MERGE
                            : CSG_UNION;
    }
}

/* The parts of a composite in the order of the scene: the last is pushed
 * first. */
static bool push_parts(struct work *w, const struct task *t,
                       const matrix *place)
{
    const struct brume_shape *s = &w->scene->shapes[t->shape];
    for (size_t i = s->part_count; i-- > 0;) {
        struct task part = *t;
        part.shape = s->parts[i];
        part.by = *place;
        part.clipped = false;
        part.glyph = LEAF_ALL;
        if (s->kind == BRUME_SHAPE_DIFFERENCE && i > 0) {
            part.inverse = !t->inverse;
            part.twisted = true;
        }
        if (!push(w, &part))
            return false;
    }
    return true;
}

/* A clipped shape is an intersection with what is not seen, whatever is
 * inverted around it. */
static bool push_clips(struct work *w, const struct task *t,
                       const matrix *place)
{
    const struct brume_shape *s = &w->scene->shapes[t->shape];
    struct task part = *t;
    part.parent = place_node(w, t, CSG_INTERSECTION);
    if (part.parent < 0)
        return false;
    for (size_t i = s->clip_count; i-- > 0;) {
        struct task clip = part;
        clip.shape = s->clips[i];
        clip.by = *place;
        clip.inverse = clip.twisted = clip.clipped = false;
        clip.unseen = true;
        if (!push(w, &clip))
            return false;
    }
    part.clipped = true;
    return push(w, &part);
}

/* A text is a union of its glyphs. */
static bool push_glyphs(struct work *w, const struct task *t)
{
    const struct brume_shape *s = &w->scene->shapes[t->shape];
    for (size_t i = 0; i < s->count; i += 1 + 8 * (size_t)s->data[i]) {
        struct task part = *t;
        part.glyph = i;
        if (!push(w, &part))
            return false;
    }
    return true;
}

static bool is_plain_union(const struct brume_shape *s)
{
    bool many = s->kind == BRUME_SHAPE_UNION || s->kind == BRUME_SHAPE_TEXT;
    return many && s->clip_count == 0 && !s->inverse;
}

static bool push_inner(struct work *w, const struct task *t,
                       const matrix *place)
{
    return shape_is_composite(&w->scene->shapes[t->shape])
               ? push_parts(w, t, place)
               : push_glyphs(w, t);
}

/* What the task's shape adds to what it has got. */
static void inherit(const struct brume_shape *s, struct task *t)
{
    if (s->material != BRUME_INHERIT)
        t->material = s->material;
    if (s->interior >= 0)
        t->interior = s->interior;
    t->hollow = t->hollow || s->hollow;
    t->shadow = t->shadow && s->shadow;
    if (s->inverse) {
        t->inverse = !t->inverse;
        t->twisted = true;
    }
}

/* A whole without an interior takes the first that a part has. */
static void lend_interior(struct work *w, const struct task *t,
                          const struct brume_shape *s)
{
    struct whole *whole = &w->out->wholes[t->whole];
    if (whole->interior >= 0 || s->interior < 0 || t->unseen)
        return;
    whole->interior = s->interior;
    whole->flags |= s->hollow ? SHAPE_HOLLOW : 0;
}

static bool lay_out(struct work *w, struct task t)
{
    const struct brume_shape *s = &w->scene->shapes[t.shape];
    matrix own = matrix_from(s->transform);
    matrix place = matrix_compose(&t.by, &own);
    bool glyph = t.glyph != LEAF_ALL;
    bool text = s->kind == BRUME_SHAPE_TEXT && !glyph;
    bool composite = shape_is_composite(s) || text;
    if (s->clip_count > 0 && !t.clipped) {
        if (t.whole < 0) {
            struct task top = t;
            inherit(s, &top);
            if ((t.whole = add_whole(w, &top)) < 0)
                return false;
        }
        return push_clips(w, &t, &place);
    }
    if (!glyph)
        inherit(s, &t);
    if (t.whole < 0 && composite && is_plain_union(s))
        return push_inner(w, &t, &place);
    bool alone = t.whole < 0 && !composite;
    if (t.whole < 0 && (t.whole = add_whole(w, &t)) < 0)
        return false;
    lend_interior(w, &t, s);
    if (!composite)
        return add_part(w, &t, &place, alone);
    t.parent = place_node(w, &t, operation(s->kind, &t));
    return t.parent >= 0 && push_inner(w, &t, &place);
}

static bool run(struct work *w, int shape)
{
    struct task first = {.shape = shape,
                         .by = matrix_identity(),
                         .material = -1,
                         .interior = -1,
                         .whole = -1,
                         .parent = -1,
                         .shadow = true,
                         .glyph = LEAF_ALL};
    bool good = push(w, &first);
    while (good && w->tasks_count > 0)
        good = lay_out(w, w->tasks[--w->tasks_count]);
    return good;
}

bool assembly_make(const brume_scene *scene, int shape, struct assembly *out,
                   struct brume_error *err)
{
    struct work w = {.scene = scene, .out = out, .err = err};
    *out = (struct assembly){0};
    arena_init(&out->arena, 0);
    bool good = true;
    if (shape >= 0)
        good = run(&w, shape);
    for (size_t i = 0; shape < 0 && good && i < scene->shapes_count; i++)
        good = scene->shapes[i].part || run(&w, (int)i);
    free(w.tasks);
    good = good && assembly_bound(out, err);
    if (!good)
        assembly_release(out);
    return good;
}

void assembly_release(struct assembly *a)
{
    for (size_t i = 0; i < a->parts_count; i++)
        leaf_release(&a->parts[i].leaf);
    free(a->parts);
    free(a->nodes);
    free(a->wholes);
    arena_release(&a->arena);
    *a = (struct assembly){0};
}
