/* scene.h - the flat scene that every stage reads, on the CPU and the GPU.
 *
 * Records hold indices into arrays, never pointers; the arrays are listed once
 * in SCENE_ARRAYS, which the host's struct, its release and an upload expand.
 * Lengths are in unit space: the scene scaled by a power of two (and moved, if
 * it lies far from the origin) so that its bounds are near 1; coefficients are
 * per unit-space length. core/prepare.c makes it. */
#ifndef CORE_PHYSICS_SCENE_H
#define CORE_PHYSICS_SCENE_H
#include "core/physics/blackbody.h"
#include "core/physics/camera.h"
#include "core/physics/hd.h"
#include "core/physics/machine_code.h"
#include "core/physics/may.h"
#include "core/physics/vec.h"

enum { FIELD_CONSTANT, FIELD_GRID, FIELD_FUNCTION };
enum { BRICK_SIDE = 9, BRICK_FLOATS = 729 };    /* 8^3 samples + upper apron */
enum { MAX_DENSITIES = 4, MAX_PLANES = 6 };

/* Phase functions of media that a field of light tells apart. */
enum { MAX_PHASES = 4 };
/* Media, and shapes with media, at one place that are followed. */
enum { MAX_ACTIVE = (SCENE_MAY & MAY_MANY) ? 16 : 1,
       MAX_CONTAINERS = MAX_ACTIVE };

/* Of coefficients, densities and what flights through them weigh: without
 * MAY_COLORS their channels are alike. */
HD rgb may_gray(rgb c)
{
    return scene_may(MAY_COLORS) ? c : rgb_gray(c.r);
}

/* A grid of bricks; samples at integers of index space. Each stored brick
 * carries one more layer of samples on its upper sides, so that a trilinear
 * lookup reads a single brick. */
typedef struct {
    int32_t origin[3], bricks[3];
    uint64_t slot;          /* first of its slots                          */
    uint64_t brick;         /* first of its stored bricks                  */
    uint64_t tile;          /* first of its constants; that one is outside */
    int32_t nearest;        /* 1: no interpolation                         */
    int32_t layout;         /* the first grid with the same origin, bricks and
                               `nearest`                                   */
    int32_t clip;           /* 1: zero outside of clip_min..clip_max       */
    float clip_min[3], clip_max[3];
} flat_grid;

/* A field that is evaluated where it is asked for. Its index space has
 * PROCEDURE_SIDE units to a side of the cells over which its bounds are
 * known; beyond them it is 0. */
enum { PROCEDURE_SIDE = 8 };

typedef struct {
    int32_t function;
    int32_t component;      /* the result that counts; -1: three, a colour */
    float origin[3], step[3];   /* index space to the function's           */
    int32_t cells[3];
    uint64_t bound;         /* first of the host's bounds                  */
} flat_procedure;

/* A function of position: a scalar, or a colour of a function. */
typedef struct {
    int32_t kind;
    int32_t grid;           /* of grids, or of procedures                  */
    int32_t colored;        /* 1: a colour; of grids, three in a row       */
    float scale;            /* a constant's value                          */
    affine to_index;        /* unit space to the index space of those      */
    int32_t lattice;        /* the first field with the same to_index      */
} flat_field;

/* Bounds of a medium over one cell of its majorant lattice. */
typedef struct {
    float density;          /* >= the density anywhere in the cell; of a
                               function as far as samples tell             */
    float rate;             /* emission samples per length; 0: none emitted */
    int32_t clear;          /* 1: no shape's boundary goes through the cell */
} majorant_cell;

/* A medium: coefficients at density 1, and its majorant lattice. */
typedef struct {
    rgb sigma_a, sigma_s;
    rgb sigma_t;            /* attenuation: sigma_a + extinction sigma_s   */
    rgb bound;              /* max(sigma_t, sigma_a + sigma_s)             */
    rgb emission;
    int32_t phase;          /* POV-Ray's number                            */
    float g;
    int32_t kind;           /* that one's place among those of the field   */
    int32_t densities, density[MAX_DENSITIES];
    float densest;          /* more counts as this: where it scatters, places
                               must differ from one event to the next      */
    int32_t uniform;        /* 1: no lattice, `outside` is everywhere      */
    int32_t emits;
    int32_t functions;      /* 1: some density is field_is_function        */
    int32_t sampled;        /* 1: some field is evaluated: line integrals
                               take samples                                */
    int32_t planes, plane_field[MAX_PLANES];    /* fields whose voxel planes
                               differ: an exact line integral stops at them */
    int32_t fire;           /* 1: the members below hold                   */
    int32_t temperature, amount;        /* fields; amount may be -1        */
    float kelvin_scale, kelvin_offset;
    float intensity;        /* luminance factor included                   */
    int32_t brightness, additive;
    int32_t lead;           /* the field whose grid the lattice follows    */
    affine to_cell;         /* unit space to lattice coordinates           */
    float origin[3];        /* index of the lead grid = side cell + origin */
    float side;             /* voxels of it along a side of a cell         */
    int32_t cells[3];
    uint64_t cell;          /* first of its majorant cells                 */
    majorant_cell outside;  /* bounds beyond the lattice                   */
    int32_t glow;           /* its emitter list, or -1                     */
    float kappa;            /* MIS constant of emission, per length        */
} flat_medium;

/* The medium of a scene without MAY_MANY, with the fields that it reads and
 * their grids: where they lie among the constants of a launch, a GPU computes
 * with them as they are, and loads nothing. */
typedef struct {
    flat_field field;       /* the first: its grid is found by it          */
    flat_grid grid;
} sole_field;

typedef struct {
    flat_medium medium;
    sole_field lead, density[MAX_DENSITIES], temperature, amount;
} sole_medium;

/* The voxels of an emitting medium as a light: a discrete distribution over
 * cells of index space of one grid-like lattice, brick by brick. */
typedef struct {
    int32_t medium;
    affine to_index;        /* unit space to the lattice                   */
    affine from_index;
    int32_t origin[3], bricks[3];   /* extent in bricks of 8^3             */
    uint64_t slot;          /* per brick: its number in the list, or -1    */
    uint64_t first, count;  /* bricks of the list: glow_bricks[first ...]  */
    float voxel_volume;
    float probability;      /* of choosing this list among all             */
    float power;            /* 4 pi times the weight of all lists          */
} flat_glow;

typedef struct {
    int32_t corner[3];      /* index of the lowest voxel                   */
    float cumulative;       /* probability of this and all bricks before   */
} glow_brick;

enum { SHAPE_HOLLOW = 1, SHAPE_INVERSE = 2, SHAPE_NO_SHADOW = 4,
       SHAPE_FLIPPED = 8 /* a mesh whose normals point inward */,
       SHAPE_OPEN = 16 /* its caps bound it, and are not seen */,
       SHAPE_UNSEEN = 32 /* it cuts, and is not seen */,
       SHAPE_ENDLESS = 64 /* far away on a line may be inside */,
       SHAPE_THIN = 128 /* it has no inside */ };

/* What is hit, and what holds media: a primitive, alone or as leaf of a
 * composite, or a composite, which is hit nowhere but through its leaves. */
typedef struct {
    int32_t kind;           /* SHAPE_* of shape.h, SOLID_* of solids.h,
                               SHAPE_MESH or SHAPE_COMPOSITE               */
    float params[4];        /* shape.h                                     */
    affine to_local;
    int32_t material, interior;     /* -1: none; a leaf's interior is that
                               of its container                            */
    int32_t flags;
    uint64_t triangle, triangles;   /* a mesh's                            */
    int32_t tree;           /* a mesh's own tree, if its inside is asked
                               for at many points, or -1                   */
    vec3 inside;            /* the direction in which its walls are counted */
    uint64_t number;        /* first of its numbers: the map to_local in
                               double, then a solid's data; in queries those
                               of shape.h follow instead                   */
    int32_t node;           /* of csg: a leaf's or the composite's, or -1  */
    int32_t container;      /* the shape whose interior it bounds          */
} flat_shape;

enum { NUMBERS_MAP = 12 };

enum { CSG_UNION, CSG_MERGE, CSG_INTERSECTION };

/* Of the tree of a composite; inversions are at its leaves. */
typedef struct {
    float lo[3], hi[3];     /* beyond it the node is wholly inside or out  */
    int32_t parent, first, next;    /* nodes, or -1                        */
    int32_t shape;          /* a leaf's, or -1                             */
    uint8_t op;
    uint8_t beyond;         /* 1: what is beyond the bounds is inside      */
} csg_node;

typedef struct {
    vec3 p[3];
    int32_t shape;
    int32_t smooth;         /* first of three normals, or -1               */
    int32_t unseen;         /* it closes a mesh that is seen as open       */
} flat_triangle;

typedef struct {
    int32_t checker;
    int32_t function;       /* of the pigment, at a point of to_pattern's
                               space: red, green, blue, filter, transmit; or
                               -1                                          */
    rgb color[2];
    float filter[2], transmit[2];
    affine to_pattern;
    rgb ambient, emission;  /* ambient: times ambient_light already        */
    float diffuse, brilliance, phong, phong_size, specular, roughness;
    float metallic;
} flat_material;

typedef struct {
    int32_t first, count;   /* of interior_media                           */
} flat_interior;

enum { LIGHT_POINT, LIGHT_SPOT, LIGHT_CYLINDER };
enum { LIGHT_NO_AREA, LIGHT_RECTANGLE, LIGHT_ELLIPSE, LIGHT_FACING_DISC };

typedef struct {
    int32_t kind;
    int32_t parallel;       /* along the axis; cylinders are               */
    vec3 position, axis;
    rgb color;
    float inner, outer;     /* radius and falloff: cosines, or lengths     */
    float tightness;
    float fade_distance, fade_power;
    int32_t area;           /* LIGHT_RECTANGLE ...                         */
    int32_t illumination;   /* the area counts in more than shadows        */
    vec3 side[2];           /* the area's axes; of a disc, side[0] is its
                               diameter long                               */
    int32_t shadows, media_interaction, media_attenuation;
    int32_t local;          /* has a place, and falls off from there       */
    float blunt;            /* but little within this distance             */
    float cumulative;       /* probability of this and all before          */
} flat_light;

/* A picture around the scene; as a light it is chosen texel by texel. */
typedef struct {
    int32_t width, height;
    int32_t smooth;         /* interpolated                                */
    affine to_map, from_map;    /* rotations and scales of directions      */
    float jacobian;         /* |determinant| of to_map                     */
    int32_t lights;         /* some texel is to be chosen                  */
    int32_t function;       /* of the world's unit direction: the radiance,
                               not the texels'; or -1                      */
} flat_sky;

/* One texel of it. Its alias [Walker 1977; Vose 1991] is taken instead with
 * probability 1 - keep. */
typedef struct {
    rgb radiance;
    float keep;
    uint32_t alias;
    float density;          /* of choosing it, per solid angle of the map  */
} sky_texel;

/* A pixel of a plate: a picture made elsewhere, which the eye alone sees. */
typedef struct {
    rgb color;              /* associated with its alpha                   */
    float pass;             /* 1 - alpha                                   */
    float depth;            /* infinite: behind all that there is          */
} plate_pixel;

/* Light that has been scattered, in cells of a cubic lattice over the media; in
 * bricks of 8^3, where something scatters. A cell holds what is asked of it:
 * Int p L toward the eye for each phase function p of the media; the fluence
 * Int L; the vector flux. In unit space. */
typedef struct {
    float origin[3];        /* unit space: the lattice's lowest corner     */
    float side;             /* of a cell                                   */
    float per_side;         /* 1 / side                                    */
    int32_t bricks[3];
    int32_t numbers;        /* of a cell: of each of these 3, of eye and lit
                               for each p, and 9 of the flux, x y z of each
                               channel; 0: no field                        */
    int32_t eye, fluence, flux;     /* place of the first, or -1           */
    int32_t phases;         /* how many p there are                        */
    int32_t phase[MAX_PHASES];
    float g[MAX_PHASES];
    int32_t refined;        /* 1: a brick's cells are the larger the thinner its
                               media are, see radiance_slot                */
    int32_t ball;           /* 1: instead, what all media scatter toward the
                               eye, by events within `radius`, and per
                               thickness, see ball_cell.h                  */
    float radius;
    float far;              /* none farther along the view; or infinite    */
    int32_t straight;       /* 1: only the eye's straight lines read it    */
    int32_t single;         /* 1: light straight from lights is in it      */
    int32_t lit;            /* place of all light that goes on to the eye,
                               that straight from lights too, of which paths
                               seek the rest along its rays; 0: they seek
                               all                                         */
    int32_t births;         /* place of how many of the media's emission
                               photons were born for each that should have
                               been; 0: it is not asked for                */
} radiance_lattice;

/* What photons are sent to. */
typedef struct {
    vec3 centre;            /* of a ball that holds all bounded parts      */
    float radius;
    int32_t media;          /* 1: media go on beyond it                    */
    int32_t walls;          /* 1: surfaces do                              */
    float lo[3], hi[3];     /* where media scatter; lo > hi: nowhere       */
} scene_reach;

typedef struct {
    float lo[3], hi[3];
} bvh_box;

/* Node of the BVH, with the boxes of up to BVH_WIDTH children. A leaf has count
 * > 0 items from `first` of bvh_items; a child with none is the node `first`.
 * Where there is no child the box is infinitely far away: no ray gets there. */
enum { BVH_WIDTH = 4 };
enum { BVH_LEAF = 4 };      /* items of a leaf, at most                    */

typedef struct {
    float lo[3][BVH_WIDTH], hi[3][BVH_WIDTH];
    uint32_t first[BVH_WIDTH], count[BVH_WIDTH];
} bvh_node;

/* Node of the kd-tree. A leaf has kind - KD_LEAF items from `first` of
 * kd_items; an inner node is split across axis `kind`, and its children are
 * `first`, below, and `first` + 1. */
enum { KD_LEAF = 3 };

typedef struct {
    float split;
    uint32_t first, kind;
} kd_node;

#define SCENE_ARRAYS(X)                                                       \
    X(flat_grid, grids)                                                       \
    X(int32_t, slots)                                                         \
    X(float, voxels)                                                          \
    X(float, tiles)                                                           \
    X(flat_procedure, procedures)                                             \
    X(flat_field, fields)                                                     \
    X(flat_medium, media)                                                     \
    X(majorant_cell, cells)                                                   \
    X(flat_glow, glows)                                                       \
    X(int32_t, glow_slots)                                                    \
    X(glow_brick, glow_bricks)                                                \
    X(float, glow_voxels)       /* 512 a brick: cumulative within it */       \
    X(flat_interior, interiors)                                               \
    X(int32_t, interior_media)                                                \
    X(flat_shape, shapes)                                                     \
    X(int32_t, unbounded)       /* shapes outside of the tree */              \
    X(flat_triangle, triangles)                                               \
    X(vec3, normals)                                                          \
    X(csg_node, csg)                                                          \
    X(double, numbers)                                                        \
    X(machine_instruction, code)    /* of functions */                        \
    X(machine_function, functions)                                            \
    X(flat_image, images)                                                     \
    X(float, texels)                                                          \
    X(float, pool)                                                            \
    X(double, exact_pool)       /* of queries */                              \
    X(flat_material, materials)                                               \
    X(flat_light, lights)                                                     \
    X(flat_sky, sky)            /* one, or none: the background is all */     \
    X(sky_texel, sky_texels)                                                  \
    X(plate_pixel, plate)       /* of the whole picture, by rows; or none */  \
    X(bvh_node, bvh)                                                          \
    X(uint32_t, bvh_items)      /* shape, or shapes_count + triangle */       \
    X(kd_node, kd)                                                            \
    X(uint32_t, kd_items)       /* as bvh_items */                            \
    X(blackbody_table, blackbody)                                             \
    X(int32_t, camera_containers)   /* the shapes that hold the eye */        \
    X(int32_t, radiance_slots)      /* per brick, see radiance_slot */        \
    X(float, radiance)

/* Passed by value to every stage. */
typedef struct {
#define X(type, name) const type *name; uint64_t name##_count;
    SCENE_ARRAYS(X)
#undef X
    camera view;
    scene_reach reach;
    radiance_lattice field;
    rgb background;
    int32_t eye_on_face;    /* 1: of some container: each ray has to look
                               where it goes                               */
    int32_t atmosphere;     /* an interior, or -1                          */
    int32_t plate_ray;      /* 1: its depths are along rays, not along the
                               view direction                              */
    int32_t media_multiple, surfaces_indirect, environment, physical_units;
    int32_t scatters;       /* some medium has sigma_s > 0                 */
    int32_t local_lights;   /* some light is local                         */
    int32_t bvh_root;       /* of the BVH of what rays look for, or -1     */
    int32_t kd_stack;       /* entries of the ring that kd_search keeps    */
    bvh_box kd_box;         /* what the kd-tree is in                      */
    const void *host_grids; /* of queries: the scene's (machine.h)         */
    sole_medium sole;       /* on a device, see scene_medium               */
    float unit;             /* unit-space lengths per scene unit           */
    float far;              /* where rays end                              */
} flat_scene;

/* Whether the medium's records are read from `sole`. */
#ifdef __CUDACC__
#define SCENE_SOLE (!(SCENE_MAY & (MAY_MANY | MAY_FUNCTIONS)))
#else
#define SCENE_SOLE 0
#endif

HD const flat_medium *scene_medium(const flat_scene *s, int i)
{
    return SCENE_SOLE ? &s->sole.medium : &s->media[i];
}

/* Fields of a medium: `sole` is the one, of the sole medium. */
HD const flat_field *scene_field(const flat_scene *s, int i,
                                 const sole_field *sole)
{
    return SCENE_SOLE ? &sole->field : &s->fields[i];
}

HD const flat_field *scene_lead(const flat_scene *s, const flat_medium *m)
{
    return scene_field(s, m->lead, &s->sole.lead);
}

HD const flat_field *scene_density(const flat_scene *s, const flat_medium *m,
                                   int i)
{
    return scene_field(s, m->density[i], &s->sole.density[i]);
}

HD const flat_field *scene_temperature(const flat_scene *s,
                                       const flat_medium *m)
{
    return scene_field(s, m->temperature, &s->sole.temperature);
}

HD const flat_field *scene_amount(const flat_scene *s, const flat_medium *m)
{
    return scene_field(s, m->amount, &s->sole.amount);
}

/* The grid of a field that these gave. */
HD const flat_grid *scene_grid(const flat_scene *s, const flat_field *f)
{
    return SCENE_SOLE ? &((const sole_field *)f)->grid : &s->grids[f->grid];
}

#endif
