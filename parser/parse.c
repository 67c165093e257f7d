#include "parser/parse.h"
#include "parser/build.h"
#include "parser/cache.h"
#include "parser/expander.h"
#include "parser/parser.h"
#include "parser/reader.h"
#include "parser/report.h"
#include "parser/source.h"
#include "parser/stream.h"
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static const double VERSION_DEFAULT = 3.7;

/* ---- predeclared names ------------------------------------------------- */

/* What may be done with a name: POV-Ray has some as words, some as names. */
enum predeclared { RESERVED, CONSTANT, VARIABLE };

static bool predeclare(struct parser *parser, const char *word,
                       struct value value, enum predeclared how)
{
    struct name *name = symbols_name(&parser->symbols, word, strlen(word));
    struct symbol *symbol = name ? symbols_declare(&parser->symbols, name)
                                 : NULL;
    if (!symbol) {
        return report_no_memory(parser);
    }
    symbol->constant = how != VARIABLE;
    symbol->reserved = how == RESERVED;
    symbol->value = value;
    return true;
}

/* Brume's version as a number: 0.1 of "0.1.0". */
static double brume_version(void)
{
    double major = 0, minor = 0, scale = 1;
    const char *c = BRUME_VERSION;
    for (; *c >= '0' && *c <= '9'; c++) {
        major = major * 10 + (*c - '0');
    }
    for (c += *c == '.'; *c >= '0' && *c <= '9'; c++) {
        minor = minor * 10 + (*c - '0');
        scale *= 10;
    }
    return major + minor / scale;
}

static double days_since_2000(void)
{
    static const double start = 946684800, day = 86400;
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return ((double)now.tv_sec - start) / day;
}

static bool predeclare_floats(struct parser *parser)
{
    const struct parse_ambient *ambient = &parser->in->ambient;
    const struct {
        const char *word;
        double value;
        enum predeclared how;
    } floats[] = {{"pi", 3.14159265358979323846, RESERVED},
                  {"true", 1, RESERVED},
                  {"yes", 1, RESERVED},
                  {"on", 1, RESERVED},
                  {"false", 0, RESERVED},
                  {"no", 0, RESERVED},
                  {"off", 0, RESERVED},
                  {"version", parser->version, RESERVED},
                  {"now", days_since_2000(), RESERVED},
                  {"clock", ambient->clock, RESERVED},
                  {"clock_delta", ambient->clock_delta, CONSTANT},
                  {"clock_on", ambient->clock_on, RESERVED},
                  {"frame_number", ambient->frame_number, CONSTANT},
                  {"initial_clock", ambient->initial_clock, CONSTANT},
                  {"final_clock", ambient->final_clock, CONSTANT},
                  {"initial_frame", ambient->initial_frame, CONSTANT},
                  {"final_frame", ambient->final_frame, CONSTANT},
                  {"image_width", ambient->image_width, CONSTANT},
                  {"image_height", ambient->image_height, CONSTANT}};
    for (size_t i = 0; i < sizeof floats / sizeof *floats; i++) {
        if (!predeclare(parser, floats[i].word, value_float(floats[i].value),
                        floats[i].how)) {
            return false;
        }
    }
    return true;
}

static bool predeclare_vectors(struct parser *parser)
{
    const struct {
        const char *word;
        int terms;
        double v[4];
    } vectors[] = {{"x", 3, {1, 0, 0}}, {"y", 3, {0, 1, 0}},
                   {"z", 3, {0, 0, 1}}, {"t", 4, {0, 0, 0, 1}},
                   {"u", 2, {1, 0}},    {"v", 2, {0, 1}}};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
        if (!predeclare(parser, vectors[i].word,
                        value_vector(vectors[i].terms, vectors[i].v),
                        RESERVED)) {
            return false;
        }
    }
    return true;
}

/* Those of the command line may be declared anew, as in POV-Ray. */
static bool predeclare_given(struct parser *parser)
{
    const struct parse_input *in = parser->in;
    for (size_t i = 0; i < in->declares; i++) {
        if (!predeclare(parser, in->declare[i].name,
                        value_float(in->declare[i].value), VARIABLE)) {
            return false;
        }
    }
    return predeclare(parser, "brume", value_float(brume_version()),
                      VARIABLE) &&
           predeclare(parser, "input_file_name",
                      value_string(in->path, strlen(in->path)), CONSTANT);
}

/* ---- the scene --------------------------------------------------------- */

/* Half of what the machine has, so that a scene that wants ever more ends with
 * a diagnostic and not by the system's hand; never more than 4 GiB. */
static size_t default_memory(void)
{
    const size_t most = (size_t)4 << 30;
    long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    size_t half = pages > 0 && size > 0 ? (size_t)pages / 2 * (size_t)size
                                        : most;
    return half < most ? half : most;
}

static struct parse_limits limits_of(const struct parse_input *in)
{
    struct parse_limits limits = in->limits;
    limits.include_depth = limits.include_depth ? limits.include_depth : 64;
    limits.macro_depth = limits.macro_depth ? limits.macro_depth : 65536;
    limits.iterations = limits.iterations ? limits.iterations : 1000000000;
    limits.tokens = limits.tokens ? limits.tokens : 10000000000;
    limits.memory = limits.memory ? limits.memory : default_memory();
    return limits;
}

static struct name_table *kept_names(const struct parser *parser)
{
    struct kept *kept = cache_kept(parser->in->cache);
    return kept ? &kept->names : NULL;
}

static bool read_scene(struct parser *parser)
{
    return (symbols_init(&parser->symbols, &parser->arena,
                         kept_names(parser)) ||
            report_no_memory(parser)) &&
           predeclare_floats(parser) && predeclare_vectors(parser) &&
           predeclare_given(parser) && build_begin(parser) &&
           expander_run(parser) && stream_close_all(parser) &&
           build_finish(parser);
}

static bool begin_scene(struct parser *parser)
{
    struct brume_error err = {0};
    parser->out->scene = brume_scene_new(&err);
    return parser->out->scene ||
           diag_error(parser->diag, err.code, "%s", err.text);
}

bool parse_scene(const struct parse_input *in, struct parse_result *out,
                 struct diag *diag)
{
    struct parser parser = {.in = in, .out = out, .diag = diag};
    *out = (struct parse_result){.scene = NULL};
    parser.limits = limits_of(in);
    parser.version = in->version > 0 ? in->version : VERSION_DEFAULT;
    arena_init(&parser.arena, parser.limits.memory);
    cache_begin(in->cache);
    bool done = begin_scene(&parser) && read_scene(&parser) &&
                diag->errors == 0;
    if (!done) {
        brume_scene_free(out->scene);
        out->scene = NULL;
    }
    out->version = parser.version;
    build_release(&parser);
    cache_end(in->cache);
    stream_release(&parser);
    reader_release(&parser);
    source_release(&parser);
    arena_release(&parser.arena);
    return done;
}

void parse_written_release(struct parse_written *written)
{
    for (size_t i = 0; i < written->count; i++) {
        free(written->file[i].path);
        if (written->file[i].kept >= 0) {
            close(written->file[i].kept);
        }
    }
    free(written->file);
    *written = (struct parse_written){0};
}
