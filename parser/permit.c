#include "parser/permit.h"
#include "lib/memory.h"
#include "parser/source.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- folders ----------------------------------------------------------- */

/* What of a resolved path lies below a folder that is as the user wrote it;
 * "" for the folder itself, NULL if it does not lie there. */
static const char *below(const char *path, const char *folder)
{
    char real[PATH_MAX];
    if (!realpath(*folder ? folder : ".", real)) {
        return NULL;
    }
    size_t length = strcmp(real, "/") == 0 ? 0 : strlen(real);
    if (strncmp(path, real, length) != 0) {
        return NULL;
    }
    return path[length] == '/' ? path + length + 1
           : path[length]      ? NULL
                               : path + length;
}

static bool lies_in(const char *path, const char *folder)
{
    const char *rest = below(path, folder);
    return rest && *rest;
}

static bool lies_in_any(const char *path, const char *const *folder,
                        size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (lies_in(path, folder[i])) {
            return true;
        }
    }
    return false;
}

static struct parse_written_file *written_file(const struct parse_input *in,
                                               const char *real)
{
    for (size_t i = 0; in->written && i < in->written->count; i++) {
        if (strcmp(in->written->file[i].path, real) == 0) {
            return &in->written->file[i];
        }
    }
    return NULL;
}

static bool may_read(const struct parser *parser, const char *real)
{
    const struct parse_input *in = parser->in;
    const char *own = parser->sources ? parser->source[0]->folder : "";
    return lies_in(real, own) ||
           lies_in_any(real, in->library, in->libraries) ||
           lies_in_any(real, in->allow_read, in->allow_reads) ||
           written_file(in, real) != NULL;
}

bool permit_reads(const struct parser *parser, const char *path)
{
    char real[PATH_MAX];
    return realpath(path, real) && may_read(parser, real);
}

bool permit_wrote(const struct parser *parser, const char *path)
{
    char real[PATH_MAX];
    return parser->in->written && parser->in->written->count > 0 &&
           realpath(path, real) && written_file(parser->in, real);
}

/* A shell's or another program's settings are nothing for a scene to write. */
static bool is_hidden(const char *rest)
{
    return *rest == '.' || strstr(rest, "/.");
}

/* Whether files may be written at a resolved path. */
static bool may_write(const struct parser *parser, const char *real)
{
    const struct parse_input *in = parser->in;
    for (size_t i = 0; i < in->allow_writes; i++) {
        const char *rest = below(real, in->allow_write[i]);
        if (rest && !is_hidden(rest)) {
            return true;
        }
    }
    return false;
}

/* ---- what was opened --------------------------------------------------- */

/* The resolved path of an open file. Where the system does not tell, that of
 * `path`, if it is the same file. */
static bool path_of(int file, const char *path, char real[PATH_MAX])
{
    char link[64];
    struct stat opened, named;
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t length = readlink(link, real, PATH_MAX - 1);
    if (length > 0) {
        real[length] = 0;
        return true;
    }
    return realpath(path, real) && fstat(file, &opened) == 0 &&
           stat(real, &named) == 0 && opened.st_dev == named.st_dev &&
           opened.st_ino == named.st_ino;
}

static bool is_regular(int file)
{
    struct stat status;
    return fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

static int fail_open(struct parser *parser, struct location at,
                     const char *path, const char *what, int why)
{
    parser_fail(
        parser,
        why == EACCES || why == EPERM ? BRUME_ERR_ACCESS : BRUME_ERR_FILE, at,
        NULL, "'%s' could not be %s: %s", path, what, strerror(why));
    return -1;
}

static int refuse_read(struct parser *parser, struct location at,
                       const char *path)
{
    parser_fail(parser, BRUME_ERR_ACCESS, at,
                "give its folder with --allow-read",
                "reading '%s' is not allowed: it is neither in the scene's "
                "folder nor on the library path",
                path);
    return -1;
}

int permit_open_any(struct parser *parser, struct location at, const char *path)
{
    int file = open(path, O_RDONLY | O_CLOEXEC);
    return file < 0 ? fail_open(parser, at, path, "opened", errno) : file;
}

int permit_open_text(struct parser *parser, struct location at,
                     const char *path)
{
    char real[PATH_MAX], link[64];
    int kept = permit_kept(parser, path);
    snprintf(link, sizeof link, "/proc/self/fd/%d", kept);
    int file = open(kept < 0 ? path : link, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (kept >= 0 && file >= 0) {
        return file;
    }
    if (file < 0) {
        return fail_open(parser, at, path, "opened", errno);
    }
    if (path_of(file, path, real) && is_regular(file) &&
        may_read(parser, real)) {
        return file;
    }
    close(file);
    return refuse_read(parser, at, path);
}

/* ---- writing ----------------------------------------------------------- */

static int refuse_write(struct parser *parser, struct location at,
                        const char *path)
{
    parser_fail(parser, BRUME_ERR_ACCESS, at,
                "give its folder with --allow-write",
                "writing '%s' is not allowed: it is not in the output "
                "folder, or hidden",
                path);
    return -1;
}

/* The folder of a path, resolved, and the name in it. False: there is no such
 * folder. */
static bool resolve_folder(const char *path, char folder[PATH_MAX],
                           const char **name)
{
    char copy[PATH_MAX];
    const char *slash = strrchr(path, '/');
    *name = slash ? slash + 1 : path;
    snprintf(copy, sizeof copy, "%.*s", slash ? (int)(slash - path) + 1 : 1,
             slash ? path : ".");
    return realpath(copy, folder);
}

/* folder/name, or false: too long. */
static bool join(char path[PATH_MAX], const char *folder, const char *name)
{
    size_t length = strlen(folder);
    bool slash = length > 0 && folder[length - 1] != '/';
    return snprintf(path, PATH_MAX, "%s%s%s", folder, slash ? "/" : "", name) <
           PATH_MAX;
}

/* What came of a try to write: allowed or not, and the error if it failed. */
struct attempt {
    int file; /* -1: none                                */
    bool denied;
    int why; /* errno                                   */
    char real[PATH_MAX];
};

/* The resolved path of a file to be written. False: there is none. */
static bool resolve_output(const char *path, char real[PATH_MAX])
{
    char folder[PATH_MAX];
    const char *name;
    struct stat status;
    if (!resolve_folder(path, folder, &name)) {
        return false;
    }
    bool named = *name && strcmp(name, "..") != 0 && strcmp(name, ".") != 0;
    if (!named || !join(real, folder, name)) {
        errno = named ? ENAMETOOLONG : EISDIR;
        return false;
    }
    return lstat(real, &status) != 0 || !S_ISLNK(status.st_mode) ||
           realpath(path, real);
}

/* Copies what is there already. */
static bool copy_file(int from, int to)
{
    char bytes[4096];
    ssize_t count;
    while ((count = read(from, bytes, sizeof bytes)) > 0) {
        if (write(to, bytes, (size_t)count) != count) {
            return false;
        }
    }
    return count == 0;
}

/* A file without a name, with what the named one in a folder has if it is to
 * be appended to; or what is kept of that already. */
static int open_aside(int folder, const char *name, bool append, int kept)
{
    if (append && kept >= 0) {
        return lseek(kept, 0, SEEK_END) < 0 ? -1
                                            : fcntl(kept, F_DUPFD_CLOEXEC, 0);
    }
    FILE *aside = tmpfile();
    int file = aside ? fcntl(fileno(aside), F_DUPFD_CLOEXEC, 0) : -1;
    if (aside) {
        fclose(aside);
    }
    int old = append && file >= 0
                  ? openat(folder, name, O_RDONLY | O_CLOEXEC | O_NONBLOCK)
                  : -1;
    if (old >= 0) {
        copy_file(old, file);
        close(old);
    }
    return file;
}

/* In the folder that was resolved, and through no link. */
static void open_output(const struct parser *parser, struct attempt *attempt,
                        bool append)
{
    char folder[PATH_MAX], now[PATH_MAX];
    const char *name;
    int at = resolve_folder(attempt->real, folder, &name)
                 ? open(folder, O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)
                 : -1;
    attempt->why = errno;
    if (at < 0) {
        return;
    }
    attempt->denied = !path_of(at, folder, folder) ||
                      !join(now, folder, name) || !may_write(parser, now);
    if (!attempt->denied && parser->in->dry) {
        const struct parse_written_file *old = written_file(parser->in, now);
        struct stat status;
        attempt->denied = fstatat(at, name, &status, AT_SYMLINK_NOFOLLOW) ==
                              0 &&
                          !S_ISREG(status.st_mode);
        attempt->file = open_aside(at, name, append, old ? old->kept : -1);
        attempt->why = errno;
    } else if (!attempt->denied) {
        int how = O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
        attempt->file = openat(at, name, how | (append ? O_APPEND : 0), 0666);
        attempt->why = errno;
    }
    close(at);
}

/* Tries `name` in a folder. */
static void try_output(const struct parser *parser, const char *folder,
                       const char *name, bool append, struct attempt *attempt)
{
    char path[PATH_MAX];
    attempt->file = -1;
    attempt->denied = false;
    attempt->why = ENAMETOOLONG;
    if (!join(path, *name == '/' ? "" : folder, name)) {
        return;
    }
    if (!resolve_output(path, attempt->real)) {
        attempt->why = errno;
        return;
    }
    attempt->denied = !may_write(parser, attempt->real);
    if (!attempt->denied) {
        open_output(parser, attempt, append);
    }
    if (attempt->file >= 0 && !is_regular(attempt->file)) {
        close(attempt->file);
        attempt->file = -1;
        attempt->denied = true;
    }
}

/* Keeps the path for as long as the film lasts. */
static bool note_written(struct parser *parser, struct location at,
                         const char *real)
{
    struct parse_written *written = parser->in->written;
    struct brume_error err = {0};
    if (!written || written_file(parser->in, real)) {
        return true;
    }
    struct parse_written_file *grown = memory_grow(
        written->file, &written->room, written->count + 1, sizeof *grown, &err);
    char *copy = grown ? memory_string(real, &err) : NULL;
    written->file = grown ? grown : written->file;
    if (!copy) {
        return parser_relay(parser, at, &err);
    }
    written->file[written->count++] = (struct parse_written_file){copy, -1};
    return true;
}

int permit_kept(const struct parser *parser, const char *path)
{
    char real[PATH_MAX];
    const struct parse_written_file *file = NULL;
    if (parser->in->dry && resolve_output(path, real)) {
        file = written_file(parser->in, real);
    }
    return file ? file->kept : -1;
}

/* What is written aside from now on stands for the file. */
static int keep_aside(struct parser *parser, const char *real, int file,
                      bool append)
{
    struct parse_written_file *entry = written_file(parser->in, real);
    if (!parser->in->dry || !entry || (append && entry->kept >= 0)) {
        return file;
    }
    if (entry->kept >= 0) {
        close(entry->kept);
    }
    entry->kept = file;
    return fcntl(file, F_DUPFD_CLOEXEC, 0);
}

int permit_open_output(struct parser *parser, struct location at,
                       struct string name, bool append, const char **path)
{
    const struct parse_input *in = parser->in;
    struct attempt attempt;
    try_output(parser, ".", name.text, append, &attempt);
    bool denied = attempt.denied;
    if (attempt.file < 0 && name.text[0] != '/' && in->allow_writes > 0) {
        const char *out = in->allow_write[in->allow_writes - 1];
        try_output(parser, out, name.text, append, &attempt);
        denied = denied || attempt.denied;
    }
    int file = attempt.file;
    if (file < 0) {
        return denied
                   ? refuse_write(parser, at, name.text)
                   : fail_open(parser, at, name.text, "written", attempt.why);
    }
    *path = arena_copy(&parser->arena, attempt.real, strlen(attempt.real));
    if ((append || ftruncate(file, 0) == 0) && *path &&
        note_written(parser, at, attempt.real)) {
        return keep_aside(parser, attempt.real, file, append);
    }
    close(file);
    if (!parser->failed) {
        fail_open(parser, at, name.text, "written", errno);
    }
    return -1;
}
