#include "parser/manifest.h"
#include "lib/hash.h"
#include "lib/json.h"
#include "lib/memory.h"
#include "lib/stamp.h"
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { HASH_DIGITS = 17 };

/* The hash of a file that did not change since. */
struct known_file {
    char *path;
    struct stat was;
    uint64_t hash;
};

struct manifest {
    char *path;
    struct json **line; /* as they stand in the file                   */
    size_t lines, line_room;
    struct known_file *file;
    size_t files, file_room;
};

/* ---- hashes of files ---------------------------------------------------- */

static struct known_file *find_file(struct manifest *m, const char *path)
{
    for (size_t i = 0; i < m->files; i++)
        if (strcmp(m->file[i].path, path) == 0)
            return &m->file[i];
    struct known_file *grown = memory_grow(m->file, &m->file_room, m->files + 1,
                                           sizeof *grown, NULL);
    if (!grown)
        return NULL;
    m->file = grown;
    m->file[m->files] = (struct known_file){.path = strdup(path)};
    return m->file[m->files].path ? &m->file[m->files++] : NULL;
}

static bool hash_of(struct manifest *m, const char *path, char out[HASH_DIGITS])
{
    struct stat now;
    struct known_file *file;
    if (stat(path, &now) != 0 || !S_ISREG(now.st_mode) ||
        !(file = find_file(m, path)))
        return false;
    if (!stamp_is_same(&file->was, &now)) {
        memset(&file->was, 0, sizeof file->was);
        if (!hash_file(path, &file->hash, NULL))
            return false;
        file->was = now;
    }
    snprintf(out, HASH_DIGITS, "%016" PRIx64, file->hash);
    return true;
}

/* ---- reading ------------------------------------------------------------ */

/* What is no line of ours, as the torn end of one, is passed over. */
static bool keep_line(struct manifest *m, const char *text, size_t length,
                      struct brume_error *err)
{
    struct json *line = json_read(text, length);
    struct json **grown;
    if (!line)
        return true;
    grown = memory_grow(m->line, &m->line_room, m->lines + 1, sizeof *grown,
                        err);
    if (!grown) {
        json_free(line);
        return false;
    }
    m->line = grown;
    m->line[m->lines++] = line;
    return true;
}

static bool read_lines(struct manifest *m, struct brume_error *err)
{
    FILE *file = fopen(m->path, "rb");
    char *text = NULL;
    size_t room = 0;
    ssize_t length;
    bool good = true;
    if (!file)
        return errno == ENOENT ||
               brume_fail_file(err, m->path, "can't be read: %s",
                               strerror(errno));
    while (good && (length = getline(&text, &room, file)) > 0)
        good = keep_line(m, text, (size_t)length, err);
    free(text);
    fclose(file);
    return good;
}

struct manifest *manifest_open(const char *path, bool known,
                               struct brume_error *err)
{
    struct manifest *m = memory_new(1, sizeof *m, err);
    if (!m)
        return NULL;
    m->path = memory_string(path, err);
    if (m->path && (!known || read_lines(m, err)))
        return m;
    manifest_close(m);
    return NULL;
}

void manifest_close(struct manifest *m)
{
    if (!m)
        return;
    for (size_t i = 0; i < m->lines; i++)
        json_free(m->line[i]);
    for (size_t i = 0; i < m->files; i++)
        free(m->file[i].path);
    free(m->line);
    free(m->file);
    free(m->path);
    free(m);
}

/* ---- what is finished --------------------------------------------------- */

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static const struct json *line_of(const struct manifest *m, int number,
                                  const char *picture)
{
    for (size_t i = m->lines; i-- > 0;) {
        const char *named = json_get_text(m->line[i], "picture");
        if (json_get_count(m->line[i], "frame", UINT64_MAX) ==
                (uint64_t)number &&
            named && strcmp(named, base_name(picture)) == 0)
            return m->line[i];
    }
    return NULL;
}

static bool has_hash(struct manifest *m, const char *path, const char *hash)
{
    char now[HASH_DIGITS];
    return hash && hash_of(m, path, now) && strcmp(now, hash) == 0;
}

static bool files_are_same(struct manifest *m, const struct json *line)
{
    struct json *files = json_get(line, "files");
    struct json *missing = json_get(line, "missing");
    const char *path, *hash;
    void *at = NULL;
    bool same = files && missing;
    while (same && json_next(files, &at, &path, &hash))
        same = has_hash(m, path, hash);
    for (size_t i = 0; same && (path = json_item_text(missing, i)); i++)
        same = access(path, F_OK) != 0;
    return same;
}

bool manifest_has(struct manifest *m, int number, uint64_t settings,
                  const char *picture, bool *writes)
{
    char text[HASH_DIGITS];
    const struct json *line = line_of(m, number, picture);
    const char *then = line ? json_get_text(line, "settings") : NULL;
    snprintf(text, sizeof text, "%016" PRIx64, settings);
    if (!then || strcmp(then, text) != 0 || !files_are_same(m, line) ||
        !has_hash(m, picture, json_get_text(line, "hash")))
        return false;
    *writes = json_get_flag(line, "writes", true);
    return true;
}

/* ---- adding ------------------------------------------------------------- */

static bool put_origins(struct manifest *m, struct json *line,
                        const struct parse_origins *origins)
{
    struct json *files = json_new_object(), *missing = json_new_array();
    char hash[HASH_DIGITS];
    bool good = true;
    for (size_t i = 0; good && i < origins->read.count; i++) {
        const char *path = origins->read.path[i];
        good = json_put_text(files, path,
                             hash_of(m, path, hash) ? hash : "unreadable");
    }
    for (size_t i = 0; good && i < origins->missing.count; i++)
        good = json_put_text(missing, NULL, origins->missing.path[i]);
    good = json_put(line, "files", files) && good;
    return json_put(line, "missing", missing) && good;
}

/* Without `missing` where not all origins are known: no run takes it as
 * finished. */
static struct json *make_line(struct manifest *m,
                              const struct manifest_entry *e)
{
    char hash[HASH_DIGITS], settings[HASH_DIGITS];
    struct json *line = json_new_object();
    snprintf(settings, sizeof settings, "%016" PRIx64, e->settings);
    bool good = json_put_count(line, "frame", (uint64_t)e->number) &&
                (!e->clock_on || json_put_number(line, "clock", e->clock)) &&
                json_put_text(line, "picture", base_name(e->picture)) &&
                hash_of(m, e->picture, hash) &&
                json_put_text(line, "hash", hash) &&
                json_put_text(line, "brume", BRUME_VERSION) &&
                json_put_text(line, "settings", settings) &&
                json_put_text(line, "backend", e->stats->backend) &&
                json_put_count(line, "spp", (uint64_t)e->stats->spp) &&
                json_put_number(line, "error", e->stats->error) &&
                json_put_count(line, "photons", e->stats->photons.traced) &&
                json_put_number(line, "seconds", e->seconds) &&
                json_put_flag(line, "writes", e->writes) &&
                (!e->known || put_origins(m, line, e->origins));
    if (good)
        return line;
    json_free(line);
    return NULL;
}

/* One write at the end of the file, behind the torn line of a run that was
 * killed, if there is one. */
static bool append(const char *path, const char *text, struct brume_error *err)
{
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    int fd = open(path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    char last = '\n';
    bool good = fd >= 0;
    if (good) {
        (void)fcntl(fd, F_SETLKW, &lock);
        off_t end = lseek(fd, 0, SEEK_END);
        good = end <= 0 || pread(fd, &last, 1, end - 1) == 1;
    }
    size_t size = strlen(text);
    good = good && (last == '\n' || write(fd, "\n", 1) == 1) &&
           write(fd, text, size) == (ssize_t)size;
    int reason = errno;
    if (fd >= 0 && close(fd) != 0 && good) {
        good = false;
        reason = errno;
    }
    return good ||
           brume_fail_file(err, path, "can't be written: %s", strerror(reason));
}

bool manifest_add(struct manifest *m, const struct manifest_entry *entry,
                  struct brume_error *err)
{
    struct json *line = make_line(m, entry);
    char *text = line ? json_line(line, err) : NULL;
    json_free(line);
    if (!text)
        return brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    bool good = append(m->path, text, err);
    free(text);
    return good;
}
