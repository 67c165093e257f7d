#include "lib/error.h"
#include <stdarg.h>
#include <stdio.h>

bool brume_fail(struct brume_error *err, enum brume_code code,
                const char *format, ...)
{
    if (!err || err->code != BRUME_OK)
        return false;
    err->code = code;
    va_list args;
    va_start(args, format);
    vsnprintf(err->text, sizeof err->text, format, args);
    va_end(args);
    return false;
}
