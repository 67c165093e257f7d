#include "parser/load.h"

#include <stdio.h>
#include <string.h>

#include "lib/df3.h"
#include "lib/grid.h"
#include "lib/mesh.h"
#include "lib/nvdb.h"
#include "lib/obj.h"
#include "lib/ply.h"
#include "parser/builder.h"
#include "parser/cache.h"

struct loaded_grid {
    struct loaded_grid *next;
    const char *path;
    char name[64];        /* of the grid in the file                 */
    double radius, voxel; /* as in struct data_file                  */
    int neighbors;
    enum grid_filter filter;
    int id;        /* in core                                 */
    transform fit; /* to_world's inverse, then its box to the
                                   unit cube                               */
    bool empty;    /* there is no box                         */
};

struct loaded_mesh {
    struct loaded_mesh *next;
    const char *path;
    struct model_mesh *mesh;
};

/* ---- the box of a grid ------------------------------------------------- */

/* In index space, of the centres of samples that are not the background. */
struct box {
    int32_t low[3], high[3];
};

static void widen(struct box *box, const int32_t p[3])
{
    for (int i = 0; i < 3; i++) {
        box->low[i] = p[i] < box->low[i] ? p[i] : box->low[i];
        box->high[i] = p[i] > box->high[i] ? p[i] : box->high[i];
    }
}

static bool has_brick(const struct box *box, const int32_t corner[3])
{
    for (int i = 0; i < 3; i++)
        if (corner[i] < box->low[i] || corner[i] + 7 > box->high[i])
            return false;
    return true;
}

static void widen_by_brick(struct box *box, const struct grid *grid,
                           int32_t slot, const int32_t corner[3])
{
    const float *voxel = slot >= 0
                             ? grid->voxel + (size_t)slot * GRID_BRICK_VOXELS
                             : NULL;
    float background = grid->tile[0];
    float tile = slot < 0 ? grid->tile[-1 - slot] : 0;

    for (int32_t i = 0; i < GRID_BRICK_VOXELS; i++) {
        int32_t p[3] = {corner[0] + i % 8, corner[1] + i / 8 % 8,
                        corner[2] + i / 64};
        if ((voxel ? voxel[i] : tile) != background)
            widen(box, p);
    }
}

static struct box box_of(const struct grid *grid)
{
    struct box box = {{INT32_MAX, INT32_MAX, INT32_MAX},
                      {INT32_MIN, INT32_MIN, INT32_MIN}};
    size_t brick = 0;

    for (int32_t z = 0; z < grid->bricks[2]; z++)
        for (int32_t y = 0; y < grid->bricks[1]; y++)
            for (int32_t x = 0; x < grid->bricks[0]; x++, brick++) {
                int32_t corner[3] = {grid->origin[0] + 8 * x,
                                     grid->origin[1] + 8 * y,
                                     grid->origin[2] + 8 * z};
                if (grid->slot[brick] != -1 && !has_brick(&box, corner))
                    widen_by_brick(&box, grid, grid->slot[brick], corner);
            }
    return box;
}

/* A sample fills its voxel: half a step on each side of its centre. */
static void find_fit(const struct grid *grid, struct loaded_grid *out)
{
    struct box box = box_of(grid);
    transform to_world, cube = transform_identity();

    memcpy(to_world.m, grid->to_world, sizeof to_world.m);
    out->empty = box.high[0] < box.low[0];
    out->fit = transform_identity();
    if (out->empty || !transform_inverse(&to_world, &out->fit))
        return;
    for (int i = 0; i < 3; i++) {
        double low = box.low[i] - 0.5, high = box.high[i] + 0.5;
        cube.m[i][i] = 1 / (high - low);
        cube.m[i][3] = -low / (high - low);
    }
    out->fit = transform_then(&out->fit, &cube);
}

/* ---- grids ------------------------------------------------------------- */

static bool is_particles(const struct data_file *file)
{
    return !strcmp(file->format, "particles");
}

static void warn_of_bad(struct parser *parser, const struct data_file *file,
                        const struct grid *grid)
{
    if (grid->bad_nan || grid->bad_inf || grid->bad_negative)
        parser_warn(parser, file->at,
                    "grid '%s' of '%s': %zu NaN, %zu infinite and %zu "
                    "negative %s",
                    grid->name, file->name.text, grid->bad_nan, grid->bad_inf,
                    grid->bad_negative,
                    is_particles(file) ? "particles are left out"
                                       : "voxels are taken as 0");
}

static void warn_of_particles(struct parser *parser,
                              const struct data_file *file,
                              const struct grid *grid)
{
    if (grid->points == 0)
        parser_warn(parser, file->at, "'%s' has no particles with a mass",
                    file->name.text);
    else if (file->radius > 0 && grid->own_radii)
        parser_warn(parser, file->at,
                    "'radius' has no effect: the particles of '%s' have their "
                    "own",
                    file->name.text);
}

/* ---- formats ----------------------------------------------------------- */

static struct grid *load_vdb(const struct data_file *file, const char *path,
                             const char *name, enum grid_filter filter,
                             struct brume_error *err)
{
    (void)file;
    (void)filter;
    return vdb_load(path, name, VDB_DENSITY, err);
}

static struct grid *load_nvdb(const struct data_file *file, const char *path,
                              const char *name, enum grid_filter filter,
                              struct brume_error *err)
{
    (void)file;
    (void)filter;
    return nvdb_load(path, name, VDB_DENSITY, err);
}

static struct grid *load_df3(const struct data_file *file, const char *path,
                             const char *name, enum grid_filter filter,
                             struct brume_error *err)
{
    (void)file;
    (void)name;
    return df3_load(path, filter, err);
}

/* `name` is that of the property whose mean is wanted, or empty. */
static struct grid *load_particles(const struct data_file *file,
                                   const char *path, const char *name,
                                   enum grid_filter filter,
                                   struct brume_error *err)
{
    struct brume_particles particles = BRUME_PARTICLES_INIT;
    struct points *points = ply_load_points(path, *name ? name : NULL, err);

    (void)filter;
    if (!points)
        return NULL;
    particles.count = points->count;
    particles.at = points->at;
    particles.radius = points->radius;
    particles.mass = points->mass;
    particles.value = points->value;
    particles.default_radius = file->radius;
    particles.neighbors = file->neighbors;
    particles.voxel = file->voxel;
    struct brume_error own = {0};
    struct grid *grid = brume_particles_grid(&particles, &own);
    if (!grid)
        brume_fail(err, own.code, "'%s': %.900s", path, own.text);
    else if (*name)
        snprintf(grid->name, sizeof grid->name, "%s", name);
    points_free(points);
    return grid;
}

/* How a format's files are read; list is NULL where their grids are not of
 * names of their own. */
struct grid_format {
    const char *word;
    enum grid_filter filter; /* unless the scene says another         */
    struct vdb_list *(*list)(const char *path, struct brume_error *err);
    struct grid *(*load)(const struct data_file *file, const char *path,
                         const char *name, enum grid_filter filter,
                         struct brume_error *err);
};

static const struct grid_format grid_formats[] = {
    {"df3", GRID_NEAREST, NULL, load_df3},
    {"vdb", GRID_TRILINEAR, vdb_list_new, load_vdb},
    {"nvdb", GRID_TRILINEAR, nvdb_list_new, load_nvdb},
    {"particles", GRID_TRILINEAR, NULL, load_particles},
};

static const struct grid_format *format_of(const struct data_file *file)
{
    for (size_t i = 0; i < sizeof grid_formats / sizeof *grid_formats; i++)
        if (!strcmp(file->format, grid_formats[i].word))
            return &grid_formats[i];
    return NULL;
}

/* Which grid of the file is meant: the named one, or the one for the role. */
static bool choose_grid(struct parser *parser, const struct data_file *file,
                        const char *path, enum vdb_role role, char name[64])
{
    struct brume_error err = {0};
    struct vdb_list *list;

    memset(name, 0, 64);
    if (file->grid.text && file->grid.length > 63)
        return parser_error(parser, file->at,
                            "the name of the grid has more than 63 bytes");
    if (file->grid.text && file->grid.length > 0) {
        memcpy(name, file->grid.text, file->grid.length);
        return true;
    }
    if (is_particles(file) && role != VDB_DENSITY)
        strcpy(name, role == VDB_TEMPERATURE ? "temperature" : "flame");
    if (!format_of(file)->list)
        return true;
    list = format_of(file)->list(path, &err);
    const struct vdb_entry *entry = list ? vdb_choose(list, role, path, &err)
                                         : NULL;
    if (entry)
        memcpy(name, entry->name, 64);
    vdb_list_free(list);
    return entry || parser_relay(parser, file->at, &err);
}

static bool choose_filter(struct parser *parser, const struct data_file *file,
                          enum grid_filter *filter)
{
    int interpolate = file->interpolate;

    *filter = format_of(file)->filter;
    if (interpolate >= 0)
        *filter = interpolate == 0 ? GRID_NEAREST : GRID_TRILINEAR;
    if (interpolate <= 1)
        return true;
    return parser_error(parser, file->at,
                        "'interpolate %d' is not supported "
                        "yet, 0 and 1 are",
                        interpolate);
}

static struct loaded_grid *find_grid(struct parser *parser,
                                     const struct data_file *file,
                                     const char *path, const char *name,
                                     enum grid_filter filter)
{
    struct loaded_grid *known = parser->builder->loader.grids;

    for (; known; known = known->next)
        if (!strcmp(known->path, path) && !strcmp(known->name, name) &&
            known->filter == filter && known->radius == file->radius &&
            known->neighbors == file->neighbors && known->voxel == file->voxel)
            break;
    return known;
}

static bool send_grid(struct parser *parser, const struct data_file *file,
                      struct grid *grid, struct loaded_grid *out)
{
    struct brume_error err = {0};

    warn_of_bad(parser, file, grid);
    if (is_particles(file))
        warn_of_particles(parser, file, grid);
    find_fit(grid, out);
    out->id = brume_share_grid(parser->out->scene, grid, &err);
    return out->id >= 0 || parser_relay(parser, file->at, &err);
}

static void release_grid(void *grid)
{
    grid_free(grid);
}

/* A share of the cache's, or from the file. */
static struct grid *read_grid(struct parser *parser,
                              const struct data_file *file,
                              const struct loaded_grid *as,
                              struct brume_error *err)
{
    struct parse_cache *cache = parser->in->cache;
    char key[192];
    snprintf(key, sizeof key, "%s %s %d %.17g %.17g %d", file->format, as->name,
             (int)as->filter, as->radius, as->voxel, as->neighbors);
    struct grid *grid = cache_find(cache, as->path, key);
    if (grid)
        return grid_share(grid);
    grid = format_of(file)->load(file, as->path, as->name, as->filter, err);
    if (grid)
        grid->filter = as->filter;
    if (grid && cache_put(cache, as->path, key, grid, release_grid))
        grid_share(grid);
    return grid;
}

static struct loaded_grid *load_grid(struct parser *parser,
                                     const struct data_file *file,
                                     const char *path, const char *name,
                                     enum grid_filter filter)
{
    struct loaded_grid *out = parser_alloc(parser, sizeof *out);
    struct brume_error err = {0};

    if (!out)
        return NULL;
    out->path = path;
    memcpy(out->name, name, sizeof out->name);
    out->filter = filter;
    out->radius = file->radius;
    out->neighbors = file->neighbors;
    out->voxel = file->voxel;
    struct grid *grid = read_grid(parser, file, out, &err);
    if (!grid) {
        parser_relay(parser, file->at, &err);
        return NULL;
    }
    bool sent = send_grid(parser, file, grid, out);
    grid_free(grid);
    if (!sent)
        return NULL;
    out->next = parser->builder->loader.grids;
    parser->builder->loader.grids = out;
    return out;
}

/* A right-handed world with z up, as Blender's, seen from a left-handed one
 * with y up: (x, y, z) becomes (x, z, y). */
static const transform swap_y_and_z = {
    {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}}};

static void place_grid(struct parser *parser, const struct data_file *file,
                       const struct loaded_grid *grid, struct pattern *out)
{
    out->grid = grid->id;
    out->grid_by = file->fit ? grid->fit : transform_identity();
    if (file->up_z)
        out->grid_by = transform_then(&out->grid_by, &swap_y_and_z);
    if (file->fit && grid->empty)
        parser_warn(parser, file->at,
                    "grid '%s' of '%s' is empty: there is "
                    "nothing to fit",
                    grid->name, file->name.text);
}

bool load_density(struct parser *parser, const struct data_file *file,
                  enum vdb_role role, struct pattern *out)
{
    enum grid_filter filter;
    char name[64];

    if (!strcmp(file->format, "df3") && (file->fit || file->grid.text))
        return parser_error(parser, file->at,
                            "a df3 file has no grid to "
                            "name or to fit: it fills the unit cube");
    const char *path = parser_find_file(parser, file->at, file->name,
                                        PARSER_DATA);
    if (!path || !choose_filter(parser, file, &filter) ||
        !choose_grid(parser, file, path, role, name))
        return false;
    struct loaded_grid *grid = find_grid(parser, file, path, name, filter);
    if (!grid)
        grid = load_grid(parser, file, path, name, filter);
    if (!grid)
        return false;
    place_grid(parser, file, grid, out);
    return true;
}

/* ---- velocities -------------------------------------------------------- */

static bool send_components(struct parser *parser,
                            struct grid *const component[3], int grid[3],
                            struct location at)
{
    struct brume_error err = {0};

    for (int i = 0; i < 3; i++) {
        grid[i] = brume_add_grid(parser->out->scene, component[i], &err);
        if (grid[i] < 0)
            return parser_relay(parser, at, &err);
    }
    return true;
}

/* The cache has all three, or none of them. */
static bool find_components(struct parser *parser, const char *path,
                            char key[3][88], struct grid *component[3])
{
    bool all = true;

    for (int i = 0; i < 3; i++) {
        component[i] = cache_find(parser->in->cache, path, key[i]);
        all = all && component[i];
    }
    return all;
}

bool load_velocity(struct parser *parser, const struct data_file *file,
                   int grid[3])
{
    struct brume_error err = {0};
    struct grid *component[3];
    char name[64], key[3][88];
    bool kept[3] = {true, true, true};
    const char *path = parser_find_file(parser, file->at, file->name,
                                        PARSER_DATA);

    if (!path || !choose_grid(parser, file, path, VDB_VELOCITY, name))
        return false;
    for (int i = 0; i < 3; i++)
        snprintf(key[i], sizeof key[i], "velocity %c %s", "xyz"[i], name);
    if (!find_components(parser, path, key, component)) {
        if (!vdb_load_velocity(path, name, component, &err))
            return parser_relay(parser, file->at, &err);
        for (int i = 0; i < 3; i++)
            kept[i] = cache_put(parser->in->cache, path, key[i], component[i],
                                release_grid);
    }
    for (int i = 0; i < 3; i++)
        warn_of_bad(parser, file, component[i]);
    bool sent = send_components(parser, component, grid, file->at);
    for (int i = 0; i < 3; i++)
        if (!kept[i])
            grid_free(component[i]);
    return sent;
}

bool load_steady(struct parser *parser, const double velocity[3], int grid[3],
                 struct location at)
{
    static const int32_t origin[3] = {0, 0, 0}, bricks[3] = {1, 1, 1};
    struct brume_error err = {0};
    struct grid *component[3];
    bool good = true;

    for (int i = 0; i < 3; i++) {
        component[i] = grid_new(origin, bricks, (float)velocity[i], &err);
        good = good && component[i];
        for (int k = 0; component[i] && k < 3; k++)
            component[i]->to_world[k][k] = 1;
        if (component[i])
            component[i]->any_sign = true;
    }
    good = good ? send_components(parser, component, grid, at)
                : parser_relay(parser, at, &err);
    for (int i = 0; i < 3; i++)
        grid_free(component[i]);
    return good;
}

/* ---- meshes ------------------------------------------------------------ */

static void release_mesh(void *mesh)
{
    mesh_free(mesh);
}

/* A share of the cache's, or from the file. */
static struct mesh *read_mesh(struct parser *parser,
                              const struct data_file *file, const char *path,
                              struct brume_error *err)
{
    struct parse_cache *cache = parser->in->cache;
    struct mesh *mesh = cache_find(cache, path, file->format);

    if (mesh) {
        parser->out->counts.meshes_kept++;
        return mesh_share(mesh);
    }
    parser->out->counts.meshes_read++;
    mesh = !strcmp(file->format, "ply") ? ply_load(path, err)
                                        : obj_load(path, err);
    if (mesh && cache_put(cache, path, file->format, mesh, release_mesh))
        mesh_share(mesh);
    return mesh;
}

static struct model_mesh *
take_mesh(struct parser *parser, const struct data_file *file, const char *path)
{
    struct model_mesh *out = parser_alloc(parser, sizeof *out);
    struct brume_error err = {0};

    if (!out)
        return NULL;
    out->id = -1;
    out->mesh = read_mesh(parser, file, path, &err);
    if (!out->mesh) {
        parser_relay(parser, file->at, &err);
        return NULL;
    }
    out->next = parser->builder->meshes;
    parser->builder->meshes = out;
    return out;
}

struct model_mesh *load_mesh(struct parser *parser,
                             const struct data_file *file)
{
    struct loaded_mesh *known = parser->builder->loader.meshes;
    const char *path = parser_find_file(parser, file->at, file->name,
                                        PARSER_DATA);

    if (!path)
        return NULL;
    for (; known; known = known->next)
        if (!strcmp(known->path, path))
            return known->mesh;
    struct model_mesh *mesh = take_mesh(parser, file, path);
    struct loaded_mesh *entry = parser_alloc(parser, sizeof *entry);
    if (!mesh || !entry)
        return NULL;
    entry->path = path;
    entry->mesh = mesh;
    entry->next = parser->builder->loader.meshes;
    parser->builder->loader.meshes = entry;
    return mesh;
}
