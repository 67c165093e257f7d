/* number.h - decimal numbers of a text to doubles, correctly rounded. */
#ifndef LIB_NUMBER_H
#define LIB_NUMBER_H

#ifdef __cplusplus
extern "C" {
#endif

/* Reads a number without sign, `12`, `1.`, `.5` or `1.5e-3`, at the start of
 * a text that ends with NUL; returns what stands behind it, NULL where none
 * stands there. An `e` without digits is no part of the number. */
const char *number_read(const char *text, double *value);

#ifdef __cplusplus
}
#endif
#endif
