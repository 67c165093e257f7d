/* plot.h - points and lines on two logarithmic axes, as an SVG picture. */
#ifndef LIB_PLOT_H
#define LIB_PLOT_H
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct plot_series {
    const char *name;           /* in the legend                           */
    const double *x, *y;        /* points that are not finite and above 0
                                   are left out                            */
    size_t count;
    bool guide;                 /* a wide pale line, without points        */
};

struct plot {
    const char *title, *x_name, *y_name;    /* UTF-8                       */
    const struct plot_series *series;
    size_t count;
    const double *marks;        /* dotted lines at these y                 */
    size_t mark_count;
};

/* Writes the picture; nothing in it depends on anything but the plot. Without
 * a point to show the axes are empty. The stream tells whether it worked. */
void plot_svg(const struct plot *plot, FILE *to);
#endif
