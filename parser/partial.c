#include "parser/partial.h"
#include "lib/hash.h"
#include "lib/memory.h"
#include "lib/output.h"
#include "lib/timer.h"
#include "parser/origins.h"
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct entry {
    struct entry *next;
    uint32_t frame;
    char *path; /* of the part                                */
    uint64_t settings;
    struct parse_origins origins;
    bool resume;
};

struct partial_list {
    pthread_mutex_t lock;
    struct entry *entry;
    struct brume_keeper keeper;
};

/* ---- files -------------------------------------------------------------- */

/* What stands at the beginning; the hash is of all that follows it. */
struct head {
    char magic[16];
    uint64_t hash;
    uint64_t key; /* settings and files                         */
    uint64_t bytes;
    uint64_t count[8];
    double error;
    uint32_t samples, left, met, unused;
    char backend[64];
};

static const char magic[16] = "brume part 1\n";

static uint64_t hash_all(const struct head *head, const void *pixel)
{
    size_t skip = offsetof(struct head, key);
    uint64_t hash = hash_bytes(HASH_START, (const char *)head + skip,
                               sizeof *head - skip);
    return hash_bytes(hash, pixel, head->bytes);
}

/* Whether the part is of what the files hold now. */
static bool is_known(const struct entry *e)
{
    return !e->origins.incomplete && !origins_changed(&e->origins);
}

/* Of the settings and of what all files hold now. */
static uint64_t key_of(const struct entry *e)
{
    uint64_t hash = hash_bytes(HASH_START, &e->settings, sizeof e->settings);
    for (size_t i = 0; i < e->origins.read.count; i++) {
        uint64_t file = 0;
        hash = hash_text(hash, e->origins.read.path[i]);
        if (hash_file(e->origins.read.path[i], &file, NULL))
            hash = hash_bytes(hash, &file, sizeof file);
    }
    for (size_t i = 0; i < e->origins.missing.count; i++) {
        const char *path = e->origins.missing.path[i];
        bool there = access(path, F_OK) == 0;
        hash = hash_bytes(hash_text(hash, path), &there, sizeof there);
    }
    return hash;
}

/* False: it takes longer than it may, or fails. */
static bool write_pixels(const struct brume_part *part, double until, FILE *to)
{
    enum { PIECE = 1 << 24 };
    const char *at = part->pixel;
    for (size_t left = part->bytes, size; left > 0; left -= size, at += size) {
        size = left < PIECE ? left : PIECE;
        if (timer_seconds() > until || fwrite(at, 1, size, to) != size)
            return false;
    }
    return true;
}

static bool write_part(const struct entry *e, const struct brume_part *part)
{
    double until = part->seconds > 0.0 ? timer_seconds() + part->seconds
                                       : (double)INFINITY;
    struct brume_error err = {0};
    struct head head = {.key = key_of(e),
                        .bytes = part->bytes,
                        .error = part->error,
                        .samples = part->samples,
                        .left = part->left,
                        .met = part->met};
    memcpy(head.magic, magic, sizeof magic);
    memcpy(head.count, part->count, sizeof head.count);
    snprintf(head.backend, sizeof head.backend, "%s", part->backend);
    head.hash = hash_all(&head, part->pixel);
    struct output *out = output_open(e->path, &err);
    if (!out)
        return false;
    output_hurry(out);
    bool good = fwrite(&head, sizeof head, 1, output_stream(out)) == 1 &&
                write_pixels(part, until, output_stream(out));
    return output_close(out, good, &err);
}

static bool read_part(const struct entry *e, struct brume_part *part)
{
    struct head head;
    FILE *file = fopen(e->path, "rb");
    bool good = file && fread(&head, sizeof head, 1, file) == 1 &&
                memcmp(head.magic, magic, sizeof magic) == 0 &&
                head.bytes == part->bytes && head.samples > 0 &&
                memchr(head.backend, 0, sizeof head.backend) &&
                strcmp(head.backend, part->backend) == 0 &&
                fread(part->pixel, 1, part->bytes, file) == part->bytes &&
                head.hash == hash_all(&head, part->pixel) &&
                head.key == key_of(e);
    if (file)
        fclose(file);
    if (!good && file)
        memset(part->pixel, 0, part->bytes);
    if (!good)
        return false;
    part->samples = head.samples;
    part->left = head.left;
    part->met = head.met;
    part->error = head.error;
    memcpy(part->count, head.count, sizeof part->count);
    return true;
}

/* ---- the list ----------------------------------------------------------- */

/* Those of frames that are rendered stay. */
static struct entry *find(struct partial_list *list, uint32_t frame)
{
    pthread_mutex_lock(&list->lock);
    struct entry *e = list->entry;
    while (e && e->frame != frame)
        e = e->next;
    pthread_mutex_unlock(&list->lock);
    return e;
}

static void save(void *user, uint32_t frame, const struct brume_part *part)
{
    const struct entry *e = find(user, frame);
    if (e && is_known(e))
        write_part(e, part);
}

static bool load(void *user, uint32_t frame, struct brume_part *part)
{
    const struct entry *e = find(user, frame);
    return e && e->resume && is_known(e) && read_part(e, part);
}

struct partial_list *partial_new(struct brume_error *err)
{
    struct partial_list *list = memory_new(1, sizeof *list, err);
    if (!list)
        return NULL;
    pthread_mutex_init(&list->lock, NULL);
    list->keeper = (struct brume_keeper){list, save, load};
    return list;
}

static void free_entry(struct entry *e)
{
    parse_origins_release(&e->origins);
    free(e->path);
    free(e);
}

void partial_free(struct partial_list *list)
{
    if (!list)
        return;
    while (list->entry) {
        struct entry *next = list->entry->next;
        free_entry(list->entry);
        list->entry = next;
    }
    pthread_mutex_destroy(&list->lock);
    free(list);
}

const struct brume_keeper *partial_keeper(const struct partial_list *list)
{
    return list ? &list->keeper : NULL;
}

void partial_begin(struct partial_list *list, uint32_t frame,
                   const char *picture, uint64_t settings,
                   const struct parse_origins *origins, bool resume)
{
    struct entry *e = memory_new(1, sizeof *e, NULL);
    size_t size = strlen(picture) + sizeof ".part";
    if (!e)
        return;
    e->frame = frame;
    e->settings = settings;
    e->resume = resume;
    origins_merge(&e->origins, origins);
    e->path = malloc(size);
    if (!e->path) {
        free_entry(e);
        return;
    }
    snprintf(e->path, size, "%s.part", picture);
    pthread_mutex_lock(&list->lock);
    e->next = list->entry;
    list->entry = e;
    pthread_mutex_unlock(&list->lock);
}

void partial_end(struct partial_list *list, uint32_t frame, bool kept)
{
    pthread_mutex_lock(&list->lock);
    struct entry **at = &list->entry;
    while (*at && (*at)->frame != frame)
        at = &(*at)->next;
    struct entry *e = *at;
    if (e)
        *at = e->next;
    pthread_mutex_unlock(&list->lock);
    if (!e)
        return;
    if (!kept)
        unlink(e->path);
    free_entry(e);
}
