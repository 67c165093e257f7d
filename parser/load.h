/* load.h - data files to core: density grids and meshes.
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

struct loader {
    struct loaded_grid *grids;
    struct loaded_mesh *meshes;
};

/* Fills the grid of `out` and the map from the grid's own world to that of
 * the density. The role picks the grid where the scene names none. */
bool load_density(struct parser *parser, const struct build_file *file,
                  enum vdb_role role, struct density *out);
struct model_mesh *load_mesh(struct parser *parser,
                             const struct build_file *file);

#endif
