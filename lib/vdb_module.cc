#include "lib/vdb_module.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <blosc.h>
/* OpenVDB's templates here must be the same objects as in its library: with
 * hidden ones its std::call_once may run our copy of a function, which then
 * sets our copy of a static and leaves the library's unset. */
#pragma GCC visibility push(default)
#include <openvdb/openvdb.h>
#pragma GCC visibility pop
#include "lib/vdb_file.h"

namespace
{

using openvdb::Coord;
using openvdb::CoordBBox;

/* ---- common ---- */

/* Once, whatever thread comes first: the language guards local statics. */
void initialize()
{
    static const bool done = (openvdb::initialize(), true);
    static_cast<void>(done);
}

/* Runs `work`, which returns false with err set, and turns whatever it or
 * OpenVDB throws into an error too. */
template <typename Work>
bool guarded(const char *path, brume_error *err, Work work)
{
    try {
        initialize();
        return work();
    } catch (const std::bad_alloc &) {
        return brume_fail(err, BRUME_ERR_MEMORY, "no memory for '%s'", path);
    } catch (const std::ios_base::failure &) {
        return brume_fail_file(err, path, "ends too early or can't be read");
    } catch (const std::exception &e) {
        return brume_fail_file(err, path, "%s", e.what());
    } catch (...) {
        return brume_fail_file(err, path, "OpenVDB failed");
    }
}

struct grid_deleter {
    void operator()(grid *g) const
    {
        grid_free(g);
    }
};
using grid_owner = std::unique_ptr<grid, grid_deleter>;

/* ---- reading ---- */

struct file_owner : vdb_file {
    file_owner()
    {
        std::memset(static_cast<vdb_file *>(this), 0, sizeof(vdb_file));
    }
    ~file_owner()
    {
        vdb_file_close(this);
    }
};

/* The first grid of that name. */
const vdb_record *find(const vdb_file &file, const std::string &name)
{
    for (size_t i = 0; i < file.count; i++)
        if (vdb_file_named(&file.record[i].entry, name.c_str()))
            return &file.record[i];
    return nullptr;
}

/* The grid whose tree a grid has: itself, or the one it was copied from. */
const vdb_record *tree_of(const vdb_file &file, const vdb_record &r)
{
    if (!r.parent[0])
        return &r;
    for (size_t i = 0; i < file.count; i++)
        if (!std::strcmp(file.record[i].unique, r.parent) &&
            !file.record[i].parent[0])
            return &file.record[i];
    return nullptr;
}

bool check_record(const vdb_file &file, const vdb_record &r, bool vector,
                  brume_error *err)
{
    const vdb_entry &e = r.entry;
    if (!vdb_check_class(&e, file.path, err))
        return false;
    if (vector && !e.vector)
        return brume_fail_file(err, file.path,
                               "grid '%s' is of type %s (%s); a velocity is a "
                               "grid of vectors: vec3s or vec3d",
                               e.name, e.type, r.tree);
    if (!vector && !e.scalar)
        return brume_fail_file(err, file.path,
                               "grid '%s' is of type %s (%s);"
                               " a scalar grid is needed: float, double, "
                               "int32, int64 or bool",
                               e.name, e.type, r.tree);
    if (!std::strcmp(r.map, "NonlinearFrustumMap"))
        return brume_fail_file(err, file.path,
                               "grid '%s' is in the frustum "
                               "of a camera: resample it to a plain grid",
                               e.name);
    return true;
}

vdb_layout layout_of(const vdb_record &r)
{
    const std::string type = r.entry.type;
    vdb_layout layout = {};
    layout.compression = r.compression;
    const unsigned terms = r.entry.vector ? 3 : 1;
    layout.bits = type == "bool";
    layout.value = terms *
                   (layout.bits ? 1
                    : type == "double" || type == "int64" || type == "vec3d"
                        ? 8
                        : 4);
    bool real = type == "float" || type == "double" || r.entry.vector;
    layout.stored = real && r.entry.half ? 2 * terms : layout.value;
    return layout;
}

/* A stream on the file that throws at its end and knows what OpenVDB asks of
 * the streams it reads: the versions, the compression, that it can seek. */
class source
{
    openvdb::io::StreamMetadata::Ptr state;

  public:
    std::ifstream stream;

    source(const vdb_file &file, const vdb_record &r)
        : state(std::make_shared<openvdb::io::StreamMetadata>())
    {
        namespace io = openvdb::io;
        stream.exceptions(std::ios_base::failbit | std::ios_base::badbit);
        stream.open(file.path, std::ios_base::in | std::ios_base::binary);
        state->setSeekable(true);
        io::setStreamMetadataPtr(stream, state, /*transfer=*/false);
        io::setVersion(stream,
                       openvdb::VersionId(file.library[0], file.library[1]),
                       file.version);
        io::setDataCompression(stream, r.compression);
        io::setHalfFloat(stream, r.entry.half);
        io::setGridClass(stream, openvdb::GRID_UNKNOWN);
        stream.seekg(static_cast<std::streamoff>(r.transform_at));
    }
};

openvdb::GridBase::Ptr read_grid(vdb_file &file, const vdb_record &r)
{
    source from(file, r);
    auto grid = openvdb::GridBase::createGrid(r.tree);
    grid->setSaveFloatAsHalf(r.entry.half);
    grid->readTransform(from.stream);
    const auto tree_at = static_cast<uint64_t>(from.stream.tellg());
    const vdb_layout layout = layout_of(r);
    if (!vdb_file_check_tree(&file, tree_at, &layout))
        return nullptr;
    grid->readTopology(from.stream);
    grid->readBuffers(from.stream);
    return grid;
}

/* OpenVDB's points are rows, p' = p M; ours are columns. */
bool copy_transform(const openvdb::GridBase &from, grid &to,
                    const vdb_file &file, brume_error *err)
{
    const auto m = from.transform().baseMap()->getAffineMap()->getMat4();
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            to.to_world[i][j] = m(j, i);
            if (!std::isfinite(to.to_world[i][j]))
                return brume_fail_file(err, file.path,
                                       "grid '%s' has a "
                                       "transform that is not finite",
                                       to.name);
        }
    return m.det() != 0 || brume_fail_file(err, file.path,
                                           "grid '%s' has a transform that "
                                           "flattens it",
                                           to.name);
}

int32_t brick_floor(int32_t x)
{
    return x & ~(GRID_BRICK - 1);
}

/* An empty grid that covers the box, or one brick of background. */
grid *make_grid(const CoordBBox &active, float background, const vdb_file &file,
                const vdb_record &r, brume_error *err)
{
    int32_t origin[3] = {0, 0, 0}, bricks[3] = {1, 1, 1};
    for (int i = 0; i < 3 && !active.empty(); i++) {
        origin[i] = brick_floor(active.min()[i]);
        int64_t last = brick_floor(active.max()[i]);
        bricks[i] = static_cast<int32_t>((last - origin[i]) / GRID_BRICK + 1);
    }
    brume_error own = {};
    grid *g = grid_new(origin, bricks, background, &own);
    if (!g)
        brume_fail(err, own.code, "'%s': grid '%s': %.900s", file.path,
                   r.entry.name, own.text);
    return g;
}

/* Of the brick at i. */
Coord corner(const grid &g, const Coord &i)
{
    return Coord(g.origin[0] + GRID_BRICK * i.x(),
                 g.origin[1] + GRID_BRICK * i.y(),
                 g.origin[2] + GRID_BRICK * i.z());
}

CoordBBox extent(const grid &g)
{
    const Coord end(g.bricks[0], g.bricks[1], g.bricks[2]);
    return CoordBBox(corner(g, Coord(0)), corner(g, end).offsetBy(-1));
}

/* A scalar as it is, or that component of a vector. */
template <typename Value> float part_of(const Value &value, int)
{
    return static_cast<float>(value);
}

template <typename T> float part_of(const openvdb::math::Vec3<T> &v, int part)
{
    return static_cast<float>(v[part]);
}

/* OpenVDB's leaves have z fastest, our bricks x. */
template <typename Leaf> void copy_leaf(const Leaf &leaf, int part, float *to)
{
    for (openvdb::Index i = 0; i < GRID_BRICK_VOXELS; i++) {
        const Coord in = Leaf::offsetToLocalCoord(i);
        to[in.x() + GRID_BRICK * (in.y() + GRID_BRICK * in.z())] = part_of(
            leaf.getValue(i), part);
    }
}

/* Bricks along x, from the one at `at` on, of the tile there, which is no leaf.
 * Of what is not stored at all the depth is -1. */
template <typename Tree, typename Access>
int tile_bricks(Access &from, const Coord &at)
{
    using Upper = typename Tree::RootNodeType::ChildNodeType;
    const int sides[] = {Upper::DIM, Upper::ChildNodeType::DIM, GRID_BRICK};
    const int side = sides[std::max(from.getValueDepth(at), 0)];
    return (side - (at.x() & (side - 1))) / GRID_BRICK;
}

/* Leaves, and tiles of any level, active or not. */
template <typename Tree, typename Access>
bool copy_row(Access &from, int y, int z, int part, grid &g, brume_error *err)
{
    for (int x = 0; x < g.bricks[0];) {
        const Coord at = corner(g, Coord(x, y, z));
        if (const auto *leaf = from.probeConstLeaf(at)) {
            float *to = grid_brick(&g, x++, y, z, err);
            if (!to)
                return false;
            copy_leaf(*leaf, part, to);
            continue;
        }
        const float value = part_of(from.getValue(at), part);
        const int end = std::min(x + tile_bricks<Tree>(from, at), g.bricks[0]);
        for (; value != g.tile[0] && x < end; x++)
            if (!grid_set_tile(&g, x, y, z, value, err))
                return false;
        x = end;
    }
    return true;
}

template <typename Tree>
bool copy_bricks(const Tree &tree, int part, grid &g, brume_error *err)
{
    openvdb::tree::ValueAccessor<const Tree> from(tree);
    for (int z = 0; z < g.bricks[2]; z++)
        for (int y = 0; y < g.bricks[1]; y++)
            if (!copy_row<Tree>(from, y, z, part, g, err))
                return false;
    return true;
}

/* A component of a staggered grid lies half a voxel below the middle. */
void shift_face(grid &g, int part)
{
    for (int i = 0; i < 3; i++)
        g.to_world[i][3] -= 0.5 * g.to_world[i][part];
}

/* A grid of scalars, or of the vectors' component `part`. */
template <typename Grid>
grid *convert(const openvdb::GridBase &base, int part, const vdb_file &file,
              const vdb_record &r, brume_error *err)
{
    const auto &tree = static_cast<const Grid &>(base).tree();
    CoordBBox active;
    tree.evalActiveVoxelBoundingBox(active);
    grid_owner g(
        make_grid(active, part_of(tree.background(), part), file, r, err));
    if (!g)
        return nullptr;
    std::snprintf(g->name, sizeof g->name, "%s", r.entry.name);
    if (!copy_transform(base, *g, file, err) ||
        !copy_bricks(tree, part, *g, err))
        return nullptr;
    g->any_sign = r.entry.vector;
    if (r.entry.vector && r.entry.kind == VDB_STAGGERED)
        shift_face(*g, part);
    grid_finish(g.get());
    return g.release();
}

grid *convert_any(const openvdb::GridBase &base, int part, const vdb_file &file,
                  const vdb_record &r, brume_error *err)
{
    if (base.isType<openvdb::Vec3SGrid>())
        return convert<openvdb::Vec3SGrid>(base, part, file, r, err);
    if (base.isType<openvdb::Vec3DGrid>())
        return convert<openvdb::Vec3DGrid>(base, part, file, r, err);
    if (base.isType<openvdb::FloatGrid>())
        return convert<openvdb::FloatGrid>(base, part, file, r, err);
    if (base.isType<openvdb::DoubleGrid>())
        return convert<openvdb::DoubleGrid>(base, part, file, r, err);
    if (base.isType<openvdb::Int32Grid>())
        return convert<openvdb::Int32Grid>(base, part, file, r, err);
    if (base.isType<openvdb::Int64Grid>())
        return convert<openvdb::Int64Grid>(base, part, file, r, err);
    return convert<openvdb::BoolGrid>(base, part, file, r, err);
}

/* The tree of a grid with its own transform; *r: its record. */
openvdb::GridBase::Ptr open_grid(vdb_file &file, const std::string &name,
                                 bool vector, const vdb_record **r,
                                 brume_error *err)
{
    *r = find(file, name);
    if (!*r) {
        brume_fail_file(err, file.path, "has no grid named '%s'", name.c_str());
        return nullptr;
    }
    const vdb_record *owner = tree_of(file, **r);
    if (!owner) {
        brume_fail_file(err, file.path,
                        "grid '%s' shares the tree of a grid "
                        "that is not there",
                        name.c_str());
        return nullptr;
    }
    if (!check_record(file, **r, vector, err) ||
        !check_record(file, *owner, vector, err))
        return nullptr;
    auto base = read_grid(file, *owner);
    if (base && owner != *r) {
        source from(file, **r);
        base->readTransform(from.stream);
    }
    return base;
}

grid *load(vdb_file &file, const std::string &name, brume_error *err)
{
    const vdb_record *r = nullptr;
    auto base = open_grid(file, name, false, &r, err);
    return base ? convert_any(*base, 0, file, *r, err) : nullptr;
}

bool load_vectors(vdb_file &file, const std::string &name, grid *component[3],
                  brume_error *err)
{
    const vdb_record *r = nullptr;
    auto base = open_grid(file, name, true, &r, err);
    grid_owner part[3];
    for (int i = 0; base && i < 3; i++) {
        part[i].reset(convert_any(*base, i, file, *r, err));
        if (!part[i])
            return false;
    }
    for (int i = 0; base && i < 3; i++)
        component[i] = part[i].release();
    return base != nullptr;
}

/* ---- writing ---- */

void fill_leaf(openvdb::FloatTree &tree, const grid &g, const Coord &at,
               const float *brick)
{
    auto *leaf = tree.touchLeaf(at);
    using Leaf = openvdb::FloatTree::LeafNodeType;
    for (openvdb::Index i = 0; i < GRID_BRICK_VOXELS; i++) {
        const Coord in = Leaf::offsetToLocalCoord(i);
        const float value =
            brick[in.x() + GRID_BRICK * (in.y() + GRID_BRICK * in.z())];
        if (value == g.tile[0])
            leaf->setValueOff(i, value);
        else
            leaf->setValueOn(i, value);
    }
}

void fill_tree(openvdb::FloatTree &tree, const grid &g)
{
    const int32_t *slot = g.slot;
    for (int z = 0; z < g.bricks[2]; z++)
        for (int y = 0; y < g.bricks[1]; y++)
            for (int x = 0; x < g.bricks[0]; x++, slot++) {
                const Coord at = corner(g, Coord(x, y, z));
                if (*slot >= 0)
                    fill_leaf(tree, g, at,
                              g.voxel + static_cast<size_t>(*slot) *
                                            GRID_BRICK_VOXELS);
                else if (*slot != -1)
                    tree.addTile(1, at, g.tile[-1 - *slot], true);
            }
}

openvdb::math::Transform::Ptr transform_of(const grid &g)
{
    openvdb::Mat4R m(openvdb::Mat4R::identity());
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            m(j, i) = g.to_world[i][j];
    return openvdb::math::Transform::createLinearTransform(m);
}

openvdb::FloatGrid::Ptr to_openvdb(const grid &g, bool half)
{
    auto out = openvdb::FloatGrid::create(g.tile[0]);
    out->setTransform(transform_of(g));
    out->setName(g.name);
    out->setGridClass(openvdb::GRID_FOG_VOLUME);
    out->setSaveFloatAsHalf(half);
    fill_tree(out->tree(), g);
    return out;
}

/* Three grids of components as one of vectors, all of whose voxels are active.
 */
openvdb::Vec3SGrid::Ptr vectors_of(const grid *const part[3], bool half)
{
    const grid &g = *part[0];
    auto out = openvdb::Vec3SGrid::create(openvdb::Vec3f(0.0f));
    out->setTransform(transform_of(g));
    out->setName(g.name);
    out->setSaveFloatAsHalf(half);
    auto to = out->getAccessor();
    const CoordBBox whole = extent(g);
    for (auto at = whole.begin(); at; ++at) {
        const Coord c = *at;
        openvdb::Vec3f v;
        for (int i = 0; i < 3; i++)
            v[i] = grid_sample(part[i], c.x(), c.y(), c.z());
        to.setValueOn(c, v);
    }
    return out;
}

/* ---- the calls ---- */

grid *load_named(const char *path, const char *name, brume_error *err)
{
    grid *result = nullptr;
    brume_error own = {};
    guarded(path, &own, [&] {
        file_owner file;
        if (vdb_file_open(&file, path, &own))
            result = load(file, name, &own);
        return result != nullptr;
    });
    if (!result && err && err->code == BRUME_OK)
        *err = own;
    return result;
}

bool load_velocity(const char *path, const char *name, grid *component[3],
                   brume_error *err)
{
    brume_error own = {};
    bool good = guarded(path, &own, [&] {
        file_owner file;
        return vdb_file_open(&file, path, &own) &&
               load_vectors(file, name, component, &own);
    });
    if (!good && err && err->code == BRUME_OK)
        *err = own;
    return good;
}

bool save(const char *path, const char *name, const grid *const *grids,
          size_t count, int flags, brume_error *err)
{
    return guarded(path, err, [&] {
        openvdb::GridCPtrVec list;
        const bool half = flags & VDB_SAVE_HALF;
        for (size_t i = 0; i < count; i++)
            if (grids[i]->any_sign && i + 2 < count) {
                list.push_back(vectors_of(grids + i, half));
                i += 2;
            } else {
                list.push_back(to_openvdb(*grids[i], half));
            }
        openvdb::io::File file(name);
        uint32_t how = openvdb::io::COMPRESS_ACTIVE_MASK;
        if (flags & VDB_SAVE_ZIP)
            how |= openvdb::io::COMPRESS_ZIP;
        file.setCompression(how);
        file.write(list);
        return true;
    });
}

size_t unpack(const void *from, size_t size, void *to, size_t room)
{
    size_t made = 0;
    if (blosc_cbuffer_validate(from, size, &made) < 0 || made > room ||
        blosc_decompress_ctx(from, to, made, 1) != static_cast<int>(made))
        return 0;
    return made;
}

} /* namespace */

/* By VDB_MODULE_SYMBOL. */
extern "C" __attribute__((visibility("default")))
const vdb_module brume_vdb_module = {unpack, load_named, load_velocity, save};
