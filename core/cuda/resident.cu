#include "core/cuda/resident.cuh"
#include <new>
#include <cstdlib>
#include <cstring>
extern "C" {
#include "lib/chunk.h"
#include "lib/hash.h"
#include "lib/memory.h"
}

namespace
{

const size_t worth = 1u << 20;

struct resident {
    resident *next;
    size_t bytes;
    uint64_t hash;
    char *device;
    chunk *piece; /* of its bytes                              */
    size_t pieces;
    int age;         /* frames since it was taken last             */
    bool made, told; /* the device fills it; it is full             */
    resident_note note;
};

}

namespace
{

/* An array's pieces, and what they are all together. */
struct contents {
    chunk *piece;
    size_t pieces;
    uint64_t hash;
};

enum {
    ARRAYS = 0
#define X(type, name) +1
    SCENE_ARRAYS(X)
#undef X
};

}

struct resident_looked {
    const void *host[ARRAYS];
    contents what[ARRAYS];
    int count;
};

struct resident_set {
    cudaMemPool_t pool;
    resident *first;
    uploader *to;
    int threads;
    const resident_looked *looked;
    std::atomic<char *> spare{nullptr}; /* what uploads go through         */
    uint64_t uploaded, built, had;
};

namespace
{

void forget(resident *r)
{
    device_free(r->device);
    free(r->piece);
    delete r;
}

/* Those not taken for more than `age` frames. */
void drop(resident_set *set, int age)
{
    resident **at = &set->first;
    while (*at) {
        resident *r = *at;
        if (r->age <= age) {
            at = &r->next;
            continue;
        }
        *at = r->next;
        forget(r);
    }
}

void release(void *set)
{
    resident_set *it = static_cast<resident_set *>(set);
    drop(it, -1);
    cudaFreeHost(it->spare.load());
    device_pool_free(it->pool);
    delete it;
}

/* Where there is no room, what this frame does not use goes, once it has been
 * copied from. */
bool allocate(resident_set *set, resident *r, brume_error *err)
{
    void *memory = nullptr;
    cudaError_t code = device_new_from(set->pool, &memory, r->bytes);
    if (code != cudaSuccess) {
        cudaGetLastError();
        if (!upload_flush(set->to, err))
            return false;
        drop(set, 0);
        code = device_new_from(set->pool, &memory, r->bytes);
    }
    r->device = static_cast<char *>(memory);
    return device_check(code, "allocating the frame", err);
}

/* A piece that the device has. */
struct place {
    uint64_t hash;
    size_t size;
    const char *device;
};

int compare(const void *a, const void *b)
{
    const place *x = static_cast<const place *>(a),
                *y = static_cast<const place *>(b);
    if (x->hash != y->hash)
        return x->hash < y->hash ? -1 : 1;
    return (x->size > y->size) - (x->size < y->size);
}

/* All of them, by their hash; NULL with err set. */
place *list_places(const resident_set *set, size_t *count, brume_error *err)
{
    *count = 0;
    for (const resident *r = set->first; r; r = r->next)
        *count += r->pieces;
    place *list = static_cast<place *>(memory_new(*count, sizeof *list, err));
    place *to = list;
    for (const resident *r = set->first; list && r; r = r->next)
        for (size_t i = 0; i < r->pieces; i++)
            *to++ = {r->piece[i].hash, r->piece[i].size,
                     r->device + r->piece[i].from};
    if (list)
        qsort(list, *count, sizeof *list, compare);
    return list;
}

/* Bytes of neighbouring pieces that go to the device in one copy. */
struct parcel {
    size_t from, size;
    const char *source; /* on the device; NULL: on the host          */
};

bool send(resident_set *set, const resident *r, const parcel *p,
          const void *host, brume_error *err)
{
    bool there = p->source != nullptr;
    const char *from = there ? p->source
                             : static_cast<const char *>(host) + p->from;
    char *to = r->device + p->from;
    set->uploaded += there ? 0 : p->size;
    return there ? upload_move(set->to, r->device, to, from, p->size, err)
                 : upload_put(set->to, r->device, to, from, p->size, err);
}

bool send_pieces(resident_set *set, const resident *r, const void *host,
                 const place *places, size_t count, brume_error *err)
{
    parcel p = {0, 0, nullptr};
    for (size_t i = 0; i < r->pieces; i++) {
        const chunk *c = &r->piece[i];
        place key = {c->hash, c->size, nullptr};
        const place *found = static_cast<const place *>(
            bsearch(&key, places, count, sizeof key, compare));
        const char *source = found ? found->device : nullptr;
        bool follows = p.source ? source == p.source + p.size : !source;
        if (!follows) {
            if (!send(set, r, &p, host, err))
                return false;
            p = {c->from, 0, source};
        }
        p.size += c->size;
    }
    return send(set, r, &p, host, err);
}

/* What is there in some other array comes from it. */
bool fill(resident_set *set, resident *r, const void *host, brume_error *err)
{
    size_t count;
    place *places = list_places(set, &count, err);
    bool good = places && send_pieces(set, r, host, places, count, err);
    free(places);
    return good;
}

/* With memory, and nothing in it. */
resident *make(resident_set *set, size_t bytes, uint64_t hash, brume_error *err)
{
    resident *r = new (std::nothrow) resident();
    if (!r) {
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
        return nullptr;
    }
    r->bytes = bytes;
    r->hash = hash;
    if (allocate(set, r, err))
        return r;
    forget(r);
    return nullptr;
}

resident *link(resident_set *set, resident *r)
{
    r->next = set->first;
    return set->first = r;
}

bool look(const void *host, size_t bytes, int threads, contents *out,
          brume_error *err)
{
    out->piece = chunk_list(host, bytes, threads, &out->pieces, err);
    out->hash = HASH_START;
    for (size_t i = 0; out->piece && i < out->pieces; i++)
        out->hash = hash_bytes(out->hash, &out->piece[i].hash,
                               sizeof out->piece[i].hash);
    return out->piece != nullptr;
}

/* A copy of what is known of it, or what a look tells. */
bool know(const resident_set *set, const void *host, size_t bytes,
          contents *out, brume_error *err)
{
    const resident_looked *l = set->looked;
    int i = 0;
    while (l && i < l->count && l->host[i] != host)
        i++;
    if (!l || i == l->count)
        return look(host, bytes, set->threads, out, err);
    *out = l->what[i];
    out->piece = static_cast<chunk *>(
        memory_new(out->pieces, sizeof *out->piece, err));
    if (out->piece)
        memcpy(out->piece, l->what[i].piece, out->pieces * sizeof *out->piece);
    return out->piece != nullptr;
}

resident *find(const resident_set *set, size_t bytes, uint64_t hash)
{
    resident *r = set->first;
    while (r && (r->made || r->bytes != bytes || r->hash != hash))
        r = r->next;
    return r;
}

/* Takes the pieces, too. */
resident *add(resident_set *set, size_t bytes, const contents *c,
              const void *host, brume_error *err)
{
    resident *r = make(set, bytes, c->hash, err);
    if (!r) {
        free(c->piece);
        return nullptr;
    }
    r->piece = c->piece;
    r->pieces = c->pieces;
    if (fill(set, r, host, err))
        return link(set, r);
    forget(r);
    return nullptr;
}

}

resident_set *resident_of(brume_still *still)
{
    void **slot = still ? still_device(still, release) : nullptr;
    if (slot && !*slot) {
        resident_set *set = new (std::nothrow) resident_set();
        if (set)
            set->pool = device_pool_new();
        *slot = set;
    }
    return slot ? static_cast<resident_set *>(*slot) : nullptr;
}

cudaMemPool_t resident_pool(const resident_set *set)
{
    return set ? set->pool : nullptr;
}

std::atomic<char *> *resident_spare(resident_set *set)
{
    return set ? &set->spare : nullptr;
}

bool resident_is_worth(const resident_set *set, size_t bytes)
{
    return set && bytes >= worth;
}

namespace
{

void add_look(resident_looked *l, const void *host, size_t bytes, int threads)
{
    brume_error none = {};
    l->host[l->count] = host;
    l->count += look(host, bytes, threads, &l->what[l->count], &none);
}

}

resident_looked *resident_look(const flat_scene *scene, const void *but,
                               int threads)
{
    resident_looked *l = new (std::nothrow) resident_looked();
#define X(type, name)                                                          \
    if (l && scene->name != but &&                                             \
        scene->name##_count * sizeof(type) >= worth)                           \
        add_look(l, scene->name, scene->name##_count * sizeof(type), threads);
    SCENE_ARRAYS(X)
#undef X
    return l;
}

void resident_forget(void *looked)
{
    resident_looked *l = static_cast<resident_looked *>(looked);
    for (int i = 0; i < l->count; i++)
        free(l->what[i].piece);
    delete l;
}

void resident_begin(resident_set *set, uploader *to, int threads,
                    const resident_looked *looked)
{
    if (set) {
        set->to = to;
        set->threads = threads;
        set->looked = looked;
    }
    for (resident *r = set ? set->first : nullptr; r; r = r->next)
        r->age++;
}

const void *resident_take(resident_set *set, const void *host, size_t bytes,
                          brume_error *err)
{
    contents c;
    if (!know(set, host, bytes, &c, err))
        return nullptr;
    resident *r = find(set, bytes, c.hash);
    if (r)
        free(c.piece);
    else
        r = add(set, bytes, &c, host, err);
    if (!r)
        return nullptr;
    r->age = 0;
    return r->device;
}

void resident_end(resident_set *set, int before)
{
    if (!set)
        return;
    drop(set, before);
    set->looked = nullptr;
}

void resident_empty(resident_set *set)
{
    if (set)
        drop(set, -1);
}

bool resident_hash(const resident_set *set, const void *device, uint64_t *hash)
{
    const resident *r = set ? set->first : nullptr;
    while (r && (r->made || r->device != device))
        r = r->next;
    if (r)
        *hash = r->hash;
    return r != nullptr;
}

namespace
{

resident *find_made(resident_set *set, uint64_t hash)
{
    resident *r = set->first;
    while (r && (!r->made || r->hash != hash))
        r = r->next;
    return r;
}

}

void *resident_find(resident_set *set, uint64_t hash, resident_note *note)
{
    resident *r = find_made(set, hash);
    if (!r || !r->told)
        return nullptr;
    r->age = 0;
    *note = r->note;
    return r->device;
}

void *resident_room(resident_set *set, uint64_t hash, size_t bytes,
                    brume_error *err)
{
    resident *r = make(set, bytes, hash, err);
    if (!r)
        return nullptr;
    r->made = true;
    return link(set, r)->device;
}

void resident_say(resident_set *set, uint64_t hash, const resident_note *note)
{
    resident *r = find_made(set, hash);
    r->note = *note;
    r->told = true;
}

void resident_tree(resident_set *set, bool built)
{
    if (set)
        ++*(built ? &set->built : &set->had);
}

void resident_trees(resident_set *set, uint64_t *built, uint64_t *kept)
{
    if (!set)
        return;
    *built += set->built;
    *kept += set->had;
    set->built = set->had = 0;
}

uint64_t resident_uploaded(resident_set *set)
{
    uint64_t bytes = set ? set->uploaded : 0;
    if (set)
        set->uploaded = 0;
    return bytes;
}
