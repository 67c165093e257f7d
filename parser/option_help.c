/* --help, from the table. */
#include "parser/option.h"
#include <string.h>

enum { HELP_COLUMN = 37, WIDTH = 79 };

static bool is_heading(const struct option *o)
{
    return !o->plus && !o->ini && !o->name;
}

static void add(char *line, size_t size, const char *a, const char *b,
                const char *between, const char *value)
{
    size_t used = strlen(line);
    snprintf(line + used, size - used, "%s%s%s%s%s", used ? ", " : "", a, b,
             value ? between : "", value ? value : "");
}

/* All the ways to write an option: "+WTN, Work_Threads=N, --threads N". */
static void spell(const struct option *o, char *line, size_t size)
{
    *line = '\0';
    const char *value = o->value;
    bool optional = value && *value == '[';
    if (o->plus)
        add(line, size, "+", o->plus, "", value);
    if (o->ini)
        add(line, size, o->ini, "", "=", optional || !value ? "on" : value);
    if (o->name)
        add(line, size, "--", o->name, optional ? "" : " ", value);
}

static void print_row(const struct option *o, FILE *to)
{
    char names[128];
    spell(o, names, sizeof names);
    if (strlen(names) + 4 <= HELP_COLUMN)
        fprintf(to, "  %-*s%s\n", HELP_COLUMN - 2, names, o->help);
    else
        fprintf(to, "  %s\n%*s%s\n", names, HELP_COLUMN, "", o->help);
}

/* Rows without an explanation stand together; returns the first after. */
static int print_list(int row, FILE *to)
{
    size_t column = 0;
    for (; row < option_count; row++) {
        const struct option *o = &option_table[row];
        char names[128];
        if (is_heading(o) || o->help)
            break;
        spell(o, names, sizeof names);
        size_t length = strlen(names) + 2;
        bool fits = column > 0 && column + length <= WIDTH;
        fprintf(to, "%s%s", fits ? "; " : column ? ";\n  " : "  ", names);
        column = fits ? column + length : length;
    }
    fputc('\n', to);
    return row;
}

void options_help(FILE *to)
{
    fputs("usage: brume [option]... scene.pov | scene.ini[section] | -\n\n"
          "Renders a scene, or the frames of an animation. Switches begin "
          "with + or - and\ntake their value without a blank between; -X "
          "turns off what +X turns on. INI\noptions stand in INI files or on "
          "the command line. Case does not matter.\nbrume(1) tells more.\n",
          to);
    for (int row = 0; row < option_count;) {
        const struct option *o = &option_table[row];
        if (is_heading(o)) {
            fprintf(to, "\n%s:\n", o->help);
            row++;
        } else if (o->help) {
            print_row(o, to);
            row++;
        } else {
            row = print_list(row, to);
        }
    }
}
