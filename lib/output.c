#include "lib/output.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include "lib/memory.h"

struct output {
    FILE *stream;
    char *path;      /* as the caller names it                         */
    char *target;    /* where links lead                               */
    char *temporary; /* NULL when the target is written in place       */
    bool hurried;
};

static bool fail(const char *path, int reason, struct brume_error *err)
{
    return brume_fail_file(err, path, "can't be written: %s", strerror(reason));
}

static void release(struct output *o)
{
    if (!o)
        return;
    free(o->temporary);
    free(o->target);
    free(o->path);
    free(o);
}

/* Length of the folder's part of a path, its last slash included. */
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* The folder that a path is in; false: its name is too long. */
static bool name_folder(const char *path, char folder[PATH_MAX])
{
    size_t length = folder_length(path);
    if (length >= PATH_MAX)
        return false;
    memcpy(folder, length > 0 ? path : ".", length > 0 ? length : 1);
    folder[length > 0 ? length : 1] = '\0';
    return true;
}

/* A file that is written is locked, so that nobody sweeps it away: false where
 * that happened before it was. Where there are no locks, nobody sweeps. */
static bool hold(int fd)
{
    struct stat st;
    (void)flock(fd, LOCK_EX);
    return fstat(fd, &st) != 0 || st.st_nlink > 0;
}

/* Makes a file that nobody else has, in the target's folder. Its name does
 * not grow with the target's, which may have the longest name allowed. */
static int open_temporary(struct output *o, mode_t mode)
{
    size_t folder = folder_length(o->target);
    size_t size = folder + 64;
    o->temporary = malloc(size);
    if (!o->temporary)
        return -1;
    for (unsigned n = 0; n < 10000; n++) {
        snprintf(o->temporary, size, "%.*s.brume-%ld-%u.tmp", (int)folder,
                 o->target, (long)getpid(), n);
        int fd = open(o->temporary, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC,
                      mode);
        if ((fd >= 0 && hold(fd)) || (fd < 0 && errno != EEXIST))
            return fd;
        if (fd >= 0)
            close(fd);
    }
    return -1;
}

/* The descriptor of an output whose path and target are set, or -1 with
 * errno telling why. */
static int open_descriptor(struct output *o)
{
    struct stat st;
    if (stat(o->target, &st) != 0)
        return open_temporary(o, 0666);
    if (!S_ISREG(st.st_mode))
        return open(o->target, O_WRONLY | O_CLOEXEC);
    if (access(o->target, W_OK) != 0)
        return -1;
    int fd = open_temporary(o, 0666);
    if (fd >= 0)
        (void)!fchmod(fd, st.st_mode & 07777);
    return fd;
}

struct output *output_open(const char *path, struct brume_error *err)
{
    struct output *o = memory_new(1, sizeof *o, err);
    if (!o)
        return NULL;
    o->path = memory_string(path, err);
    o->target = realpath(path, NULL);
    if (!o->target)
        o->target = memory_string(path, err);
    if (!o->path || !o->target) {
        release(o);
        return NULL;
    }
    int fd = open_descriptor(o);
    o->stream = fd >= 0 ? fdopen(fd, "wb") : NULL;
    if (o->stream)
        return o;
    fail(path, errno, err);
    if (fd >= 0) {
        close(fd);
        if (o->temporary)
            unlink(o->temporary);
    }
    release(o);
    return NULL;
}

FILE *output_stream(struct output *o)
{
    return o->stream;
}

const char *output_name(const struct output *o)
{
    return o->temporary ? o->temporary : o->target;
}

void output_hurry(struct output *o)
{
    o->hurried = true;
}

/* Whether it is called as open_temporary calls files. */
static bool is_temporary(const char *name)
{
    long process;
    unsigned number;
    int end = 0;
    return sscanf(name, ".brume-%ld-%u.tmp%n", &process, &number, &end) == 2 &&
           end > 0 && name[end] == '\0';
}

/* What is locked here is written by nobody; if the name is still its own, it
 * was left there: who writes keeps the lock until the file has another. */
static void sweep_one(int folder, const char *name)
{
    struct stat st, now;
    int fd = openat(folder, name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0)
        return;
    if (fstat(fd, &st) == 0 && S_ISREG(st.st_mode) &&
        flock(fd, LOCK_EX | LOCK_NB) == 0 &&
        fstatat(folder, name, &now, AT_SYMLINK_NOFOLLOW) == 0 &&
        now.st_ino == st.st_ino && now.st_dev == st.st_dev)
        unlinkat(folder, name, 0);
    close(fd);
}

void output_sweep(const char *path)
{
    char folder[PATH_MAX];
    if (!name_folder(path, folder))
        return;
    DIR *dir = opendir(folder);
    const struct dirent *entry;
    while (dir && (entry = readdir(dir)))
        if (is_temporary(entry->d_name))
            sweep_one(dirfd(dir), entry->d_name);
    if (dir)
        closedir(dir);
}

/* Pipes and devices can't be synced, which is no failure of the writing. */
static bool flush_to_disk(FILE *stream, bool hurried)
{
    if (fflush(stream) != 0 || ferror(stream))
        return false;
    return hurried || fsync(fileno(stream)) == 0 || errno == EINVAL ||
           errno == EROFS || errno == ENOTSUP;
}

/* The name is on the disk only when its folder is; where a folder can't be
 * synced the file is complete all the same. */
static void sync_folder(const char *path)
{
    char folder[PATH_MAX];
    if (!name_folder(path, folder))
        return;
    int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0)
        return;
    (void)fsync(fd);
    close(fd);
}

bool output_commit(struct output *o, struct brume_error *err)
{
    /* Keeps the lock until the file has its name. */
    int held = fcntl(fileno(o->stream), F_DUPFD_CLOEXEC, 0);
    errno = 0;
    bool ok = flush_to_disk(o->stream, o->hurried);
    int reason = errno ? errno : EIO;
    if (fclose(o->stream) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    if (ok && o->temporary && rename(o->temporary, o->target) != 0) {
        ok = false;
        reason = errno;
    }
    if (held >= 0)
        close(held);
    if (!ok) {
        fail(o->path, reason, err);
        if (o->temporary)
            unlink(o->temporary);
    } else if (o->temporary && !o->hurried) {
        sync_folder(o->target);
    }
    release(o);
    return ok;
}

void output_discard(struct output *o)
{
    if (!o)
        return;
    fclose(o->stream);
    if (o->temporary)
        unlink(o->temporary);
    release(o);
}

bool output_close(struct output *o, bool ok, struct brume_error *err)
{
    if (ok)
        return output_commit(o, err);
    output_discard(o);
    return false;
}

bool output_write(const char *path, const void *bytes, size_t size,
                  struct brume_error *err)
{
    struct output *o = output_open(path, err);
    if (!o)
        return false;
    fwrite(bytes, 1, size, o->stream);
    return output_commit(o, err);
}
