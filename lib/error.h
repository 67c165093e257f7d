/* error.h - the one error type of the program, and its exit codes.
 *
 * A fallible function takes `struct brume_error *err` last and returns false
 * or NULL. The first error stays: later ones do not overwrite it. Errors that
 * do not come from a text have line 0. Installed with brume.h. */
#ifndef LIB_ERROR_H
#define LIB_ERROR_H
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The values are the program's exit codes. */
enum brume_code {
    BRUME_OK = 0,
    BRUME_ERR_SCENE = 1,    /* the scene is wrong                          */
    BRUME_ERR_USAGE = 2,    /* the command line or an option is wrong      */
    BRUME_ERR_LIMIT = 3,    /* a limit was reached                         */
    BRUME_ERR_ACCESS = 4,   /* reading or writing there is not allowed     */
    BRUME_ERR_FILE = 5,     /* a file could not be read or written         */
    BRUME_ERR_MEMORY = 6,   /* out of memory, or over --memory             */
    BRUME_ERR_DEVICE = 7,   /* the GPU failed                              */
    BRUME_STOPPED = 75      /* a signal or the caller stopped it; resumable */
};

struct brume_error {
    enum brume_code code;   /* BRUME_OK while nothing failed               */
    int line, column;       /* from 1; 0 when no text is at fault          */
    char file[512];         /* the text's name, or the data file's         */
    char text[1024];        /* lower case, names the value and the bound   */
};

#if defined(__GNUC__)
#define BRUME_PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define BRUME_PRINTF(f, a)
#endif

/* Records an error unless one is there already; always returns false.
 * `err` may be NULL. */
bool brume_fail(struct brume_error *err, enum brume_code code,
                const char *format, ...) BRUME_PRINTF(3, 4);

/* The same for a data file: BRUME_ERR_FILE with err->file set. The text also
 * names the file, as it may be printed at the scene's line. */
bool brume_fail_file(struct brume_error *err, const char *path,
                     const char *format, ...) BRUME_PRINTF(3, 4);

#ifdef __cplusplus
}
#endif
#endif
