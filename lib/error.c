#include "lib/error.h"
#include <stdarg.h>
#include <stdio.h>

static bool record(struct brume_error *err, enum brume_code code,
                   const char *prefix, const char *format, va_list args)
{
    if (!err || err->code != BRUME_OK)
        return false;
    err->code = code;
    int n = snprintf(err->text, sizeof err->text, "%s", prefix);
    size_t used = n < (int)sizeof err->text ? (size_t)n : sizeof err->text - 1;
    vsnprintf(err->text + used, sizeof err->text - used, format, args);
    return true;
}

bool brume_fail(struct brume_error *err, enum brume_code code,
                const char *format, ...)
{
    va_list args;
    va_start(args, format);
    record(err, code, "", format, args);
    va_end(args);
    return false;
}

bool brume_fail_file(struct brume_error *err, const char *path,
                     const char *format, ...)
{
    char prefix[sizeof err->file + 4];
    snprintf(prefix, sizeof prefix, "'%.500s': ", path);
    va_list args;
    va_start(args, format);
    if (record(err, BRUME_ERR_FILE, prefix, format, args))
        snprintf(err->file, sizeof err->file, "%s", path);
    va_end(args);
    return false;
}
