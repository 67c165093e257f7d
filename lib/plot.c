#include "lib/plot.h"
#include <math.h>

enum {
    WIDTH = 760,
    HEIGHT = 500,
    LEFT = 70,
    TOP = 44,
    RIGHT = 180,
    BOTTOM = 54
};

static const char *const colors[] = {"#1b6ca8", "#c8511b", "#3a8a3f",
                                     "#7b4ba0", "#a8841b", "#b03060",
                                     "#2a9d9d", "#555555"};
enum { COLORS = sizeof colors / sizeof *colors };

/* Logarithms of what the axes begin and end with. */
struct frame {
    double low[2], high[2];
};

static bool shown(double x, double y)
{
    return isfinite(x) && isfinite(y) && x > 0.0 && y > 0.0;
}

static void widen(struct frame *f, int axis, double value)
{
    f->low[axis] = fmin(f->low[axis], log10(value));
    f->high[axis] = fmax(f->high[axis], log10(value));
}

static struct frame find_frame(const struct plot *p)
{
    struct frame f = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t s = 0; s < p->count; s++)
        for (size_t i = 0; i < p->series[s].count; i++)
            if (shown(p->series[s].x[i], p->series[s].y[i])) {
                widen(&f, 0, p->series[s].x[i]);
                widen(&f, 1, p->series[s].y[i]);
            }
    for (int a = 0; a < 2; a++) {
        if (!(f.low[a] <= f.high[a])) {
            f.low[a] = -1.0;
            f.high[a] = 0.0;
        }
        double room = fmax(0.05 * (f.high[a] - f.low[a]), 0.1);
        f.low[a] -= room;
        f.high[a] += room;
    }
    return f;
}

static double place_x(const struct frame *f, double x)
{
    double t = (log10(x) - f->low[0]) / (f->high[0] - f->low[0]);
    return LEFT + t * (WIDTH - LEFT - RIGHT);
}

static double place_y(const struct frame *f, double y)
{
    double t = (log10(y) - f->low[1]) / (f->high[1] - f->low[1]);
    return HEIGHT - BOTTOM - t * (HEIGHT - TOP - BOTTOM);
}

static void write_text(const char *text, FILE *to)
{
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '&')
            fputs("&amp;", to);
        else if (c == '<')
            fputs("&lt;", to);
        else if (c == '>')
            fputs("&gt;", to);
        else if (c >= ' ' || c == '\t')
            fputc(c, to);
    }
}

static void write_label(double x, double y, const char *where, const char *text,
                        FILE *to)
{
    fprintf(to, "<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, where);
    write_text(text, to);
    fputs("</text>\n", to);
}

/* A line of the grid and its number. */
static void write_tick(const struct frame *f, int axis, double value,
                       bool named, FILE *to)
{
    char text[32];
    double at = axis ? place_y(f, value) : place_x(f, value);
    const char *color = named ? "#bbb" : "#e6e6e6";
    snprintf(text, sizeof text, "%g", value);
    if (axis) {
        fprintf(to, "<path d=\"M%d %.1fH%d\" stroke=\"%s\"/>\n", LEFT, at,
                WIDTH - RIGHT, color);
        if (named)
            write_label(LEFT - 6, at + 4, "text-anchor=\"end\"", text, to);
    } else {
        fprintf(to, "<path d=\"M%.1f %dV%d\" stroke=\"%s\"/>\n", at, TOP,
                HEIGHT - BOTTOM, color);
        if (named)
            write_label(at, HEIGHT - BOTTOM + 18, "text-anchor=\"middle\"",
                        text, to);
    }
}

/* All of 1 to 9 in a decade; named are 1, and 2 and 5 where there is room. */
static void write_axis(const struct frame *f, int axis, FILE *to)
{
    double span = f->high[axis] - f->low[axis];
    for (double d = floor(f->low[axis]); d <= f->high[axis]; d++)
        for (int i = 1; i < 10; i++) {
            double at = d + log10(i);
            bool named = i == 1 || (span < 2.5 && (i == 2 || i == 5));
            if (at < f->low[axis] || at > f->high[axis] ||
                (span > 6.0 && i > 1))
                continue;
            write_tick(f, axis, i * pow(10.0, d), named, to);
        }
}

static void write_line(const struct frame *f, const struct plot_series *s,
                       const char *color, FILE *to)
{
    bool begun = false;
    for (size_t i = 0; i < s->count; i++) {
        if (!shown(s->x[i], s->y[i]))
            continue;
        fprintf(to, begun ? "L%.1f %.1f" : "<path d=\"M%.1f %.1f",
                place_x(f, s->x[i]), place_y(f, s->y[i]));
        begun = true;
    }
    if (begun)
        fprintf(to, "\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\"/>\n",
                color, s->guide ? "9\" stroke-opacity=\"0.25" : "1.5");
    for (size_t i = 0; !s->guide && i < s->count; i++)
        if (shown(s->x[i], s->y[i]))
            fprintf(to,
                    "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n",
                    place_x(f, s->x[i]), place_y(f, s->y[i]), color);
}

static void write_series(const struct plot *p, const struct frame *f, FILE *to)
{
    for (size_t s = 0; s < p->count; s++) {
        const char *color = p->series[s].guide ? "#333" : colors[s % COLORS];
        double y = TOP + 10 + 18.0 * (double)s;
        write_line(f, &p->series[s], color, to);
        fprintf(to,
                "<path d=\"M%d %.1fh18\" stroke=\"%s\" stroke-width=\"3\"/>\n",
                WIDTH - RIGHT + 10, y, color);
        write_label(WIDTH - RIGHT + 34, y + 4, "", p->series[s].name, to);
    }
}

static void write_marks(const struct plot *p, const struct frame *f, FILE *to)
{
    for (size_t i = 0; i < p->mark_count; i++) {
        double at = log10(p->marks[i]);
        if (at > f->low[1] && at < f->high[1])
            fprintf(to,
                    "<path d=\"M%d %.1fH%d\" stroke=\"#c33\" "
                    "stroke-dasharray=\"2 4\"/>\n",
                    LEFT, place_y(f, p->marks[i]), WIDTH - RIGHT);
    }
}

void plot_svg(const struct plot *plot, FILE *to)
{
    struct frame f = find_frame(plot);
    fprintf(to,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" "
            "height=\"%d\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\" "
            "font-size=\"12\">\n"
            "<rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n",
            WIDTH, HEIGHT, WIDTH, HEIGHT, WIDTH, HEIGHT);
    write_label(LEFT, TOP - 18, "font-size=\"15\"", plot->title, to);
    write_axis(&f, 0, to);
    write_axis(&f, 1, to);
    write_marks(plot, &f, to);
    write_series(plot, &f, to);
    write_label(0.5 * (LEFT + WIDTH - RIGHT), HEIGHT - 14,
                "text-anchor=\"middle\"", plot->x_name, to);
    fprintf(to, "<g transform=\"translate(18 %d) rotate(-90)\">",
            (TOP + HEIGHT - BOTTOM) / 2);
    write_label(0, 0, "text-anchor=\"middle\"", plot->y_name, to);
    fputs("</g>\n</svg>\n", to);
}
