/* check.h - checks of what enters the scene: true, or false with err set. */
#ifndef CORE_CHECK_H
#define CORE_CHECK_H
#include <stdbool.h>
#include <stddef.h>
#include "lib/error.h"

bool check_finite(const double *v, size_t n, const char *what,
                  struct brume_error *err);
bool check_not_negative(const double *v, size_t n, const char *what,
                        struct brume_error *err);
/* An id below `count`, or -1 where it is `optional`. */
bool check_id(int id, size_t count, bool optional, const char *what,
              struct brume_error *err);
bool check_transform(const double m[3][4], const char *what,
                     struct brume_error *err);
#endif
