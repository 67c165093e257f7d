/* load.h - data files to core: density grids, meshes and pictures.
 *
 * Each grid of a file and each mesh is read once for a scene, however many
 * statements name it. What is wrong is reported at the file's name in the
 * scene, with the reader's code (BRUME_ERR_FILE and others). */
#ifndef PARSER_LOAD_H
#define PARSER_LOAD_H
#include "lib/vdb.h"
#include "parser/build.h"
#include "parser/model.h"

struct loaded_grid;
struct loaded_mesh;
struct loaded_image;
struct raster;

/* A file as the scene names it: `vdb "file" "grid" interpolate N fit up z`, or
 * `particles "file" "property" radius R neighbors N voxel S`. */
struct data_file {
    const char *format;         /* the word: df3, vdb, nvdb, particles; ply,
                                   obj                                     */
    struct string name, grid;   /* grid.text NULL: none named              */
    struct location at;         /* of the file's name                      */
    int interpolate;            /* -1: the format's default                */
    bool fit, up_z;
    double radius, voxel;       /* of particles; 0: not given              */
    int neighbors;
};
struct data_file data_file(const char *format, struct string name,
                           struct location at);

struct loader {
    struct loaded_grid *grids;
    struct loaded_mesh *meshes;
    struct loaded_image *images;
};

/* Fills the grid of `out` and the map from the grid's own world to that of
 * the pattern. The role picks the grid where the scene names none. */
bool load_density(struct parser *parser, const struct data_file *file,
                  enum vdb_role role, struct pattern *out);
/* Gives core the components of a velocity of a file, or of one that is the
 * same everywhere. False: reported. */
bool load_velocity(struct parser *parser, const struct data_file *file,
                   int grid[3]);
bool load_steady(struct parser *parser, const double velocity[3], int grid[3],
                 struct location at);
struct model_mesh *load_mesh(struct parser *parser,
                             const struct data_file *file);

/* load_image.c. A picture by the word of its format; NULL: by its name's
 * ending. NULL: reported; where all errors are told a missing file is only
 * warned of. */
struct raster *load_raster(struct parser *parser, const char *format,
                           struct string name, struct location at);
/* How core shall use the picture of an image_map or image_pattern. False: it
 * has none, which is reported. */
bool load_image(struct parser *parser, const struct pattern *pattern,
                struct brume_image_use *use);
/* What a function that stands for a picture gives in a cell: at its middle,
 * rows from the top, as POV-Ray makes a picture of it. False: reported. */
bool load_cell(struct parser *parser, const struct function *function,
               int column, int row, double out[BRUME_MAX_RESULTS],
               struct location at);

#endif
