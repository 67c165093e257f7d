#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>
#include "parser/naming.h"
#include "parser/option.h"
#include "tests/unit/temp_folder.h"

/* A run's options, read from words; released by `done`. */
static struct options options;
static struct diag diag;

#define READ(...) read_words((const char *const[]){__VA_ARGS__, NULL})

static bool read_words(const char *const *word)
{
    int count = 0;
    while (word[count])
        count++;
    diag_init(&diag);
    options_init(&options);
    return options_read_words(&options, count, word, &diag);
}

static void done(void)
{
    options_release(&options);
    diag_release(&diag);
}

#define ASSERT_ERROR(expected, ...)                                            \
    do {                                                                       \
        assert_false(READ(__VA_ARGS__));                                       \
        assert_int_equal(diag.code, BRUME_ERR_USAGE);                          \
        assert_string_equal(diag.first->text, expected);                       \
        done();                                                                \
    } while (0)

static void test_options__defaults(void **state)
{
    (void)state;
    assert_true(READ("s.pov"));
    assert_string_equal(options.input, "s.pov");
    assert_int_equal(options.width, 640);
    assert_int_equal(options.height, 480);
    assert_true(options.to_file);
    assert_int_equal(options.bits, 8);
    assert_int_equal(options.final_frame, 1);
    assert_true(options.final_clock == 1);
    assert_true(options.start_row < 0 && options.subset_end < 0);
    assert_true(options.console[OPTIONS_DEBUG]);
    assert_int_equal(options.warning_level, 10);
    assert_int_equal(options.action, OPTIONS_RENDER);
    done();
}

static void test_options__switches(void **state)
{
    (void)state;
    assert_true(READ("+W320", "-h240", "+Is.pov", "-Oout.png", "+ua", "-KC",
                     "+kff12", "+KFI3", "+KI0.5", "+KF2", "+HIhead.inc", "+WT2",
                     "+MV3.5", "+SC2", "+EC0.5"));
    assert_int_equal(options.width, 320);
    assert_int_equal(options.height, 240);
    assert_string_equal(options.input, "s.pov");
    assert_string_equal(options.output, "out.png");
    assert_true(options.alpha);
    assert_false(options.cyclic);
    assert_int_equal(options.final_frame, 12);
    assert_int_equal(options.initial_frame, 3);
    assert_true(options.initial_clock == 0.5 && options.final_clock == 2);
    assert_string_equal(options.header, "head.inc");
    assert_int_equal(options.threads, 2);
    assert_true(options.version == 3.5);
    assert_true(options.start_column == 2 && options.end_column == 0.5);
    done();
}

static void test_options__named(void **state)
{
    (void)state;
    assert_true(READ("Width=320", "HEIGHT=149.4569", "Output_Alpha=yes",
                     "Declare=Rad=0", "Declare=N=1e2", "Declare=Rad=-3.5",
                     "Input_File_Name='my scene.pov'", "Clock=0.25"));
    assert_int_equal(options.width, 320);
    assert_int_equal(options.height, 149);
    assert_true(options.alpha);
    assert_int_equal(options.declares, 2);
    assert_string_equal(options.declare[0].name, "Rad");
    assert_true(options.declare[0].value == -3.5);
    assert_true(options.declare[1].value == 100);
    assert_string_equal(options.input, "my scene.pov");
    assert_true(options.has_clock && options.clock == 0.25);
    done();
}

static void test_options__long(void **state)
{
    (void)state;
    assert_true(READ("--spp", "64", "--error=0.01", "--time", "2.5",
                     "--backend", "CPU", "--integrator", "path", "--transport",
                     "full", "--seed=18446744073709551615", "--memory", "1.5G",
                     "--stats", "out.json", "--threads", "3", "--allow-read",
                     "/a", "--allow-read=/b", "--allow-read", "/a",
                     "--explain=json"));
    assert_int_equal(options.spp, 64);
    assert_true(options.error == 0.01 && options.seconds == 2.5);
    assert_int_equal(options.backend, BRUME_BACKEND_CPU);
    assert_true(options.has_integrator && options.full_transport);
    assert_true(options.seed == UINT64_MAX);
    assert_true(options.memory == 3ull << 29);
    assert_string_equal(options.stats, "out.json");
    assert_int_equal(options.threads, 3);
    assert_int_equal(options.allow_read.count, 2);
    assert_string_equal(options.allow_read.item[1], "/b");
    assert_int_equal(options.action, OPTIONS_EXPLAIN_JSON);
    done();
}

static void test_options__plates(void **state)
{
    struct arena arena;
    (void)state;
    arena_init(&arena, 0);
    assert_true(READ("--plate", "a%%b_%04d.exr", "--plate-layer=View",
                     "--plate-depth", "ray"));
    assert_string_equal(naming_numbered(options.plate, 37, &arena),
                        "a%b_0037.exr");
    assert_string_equal(options.plate_layer, "View");
    assert_int_equal(options.plate_depth, PARSE_DEPTH_RAY);
    done();
    assert_true(READ("--plate=%d"));
    assert_string_equal(naming_numbered(options.plate, 1234567890, &arena),
                        "1234567890");
    done();
    static const char *const wrong[] = {"%s.exr", "%4d", "%0d",
                                        "%d%d",   "a%",  "%010d"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_false(READ("--plate", wrong[i]));
        done();
    }
    assert_false(READ("--plate-depth", "far"));
    done();
    arena_release(&arena);
}

static void test_options__file_types(void **state)
{
    (void)state;
    assert_true(READ("s.pov", "+FN16"));
    assert_int_equal(options.format, OPTIONS_FORMAT_PNG);
    assert_int_equal(options.bits, 16);
    done();
    assert_true(READ("s.pov", "-Fe"));
    assert_int_equal(options.format, OPTIONS_FORMAT_EXR);
    assert_false(options.to_file);
    done();
    assert_true(READ("s.pov", "Output_File_Type=P", "Output_to_File=off"));
    assert_int_equal(options.format, OPTIONS_FORMAT_PPM);
    assert_true(options.has_format && !options.to_file);
    done();
    assert_true(READ("s.pov", "-F", "+F"));
    assert_true(options.to_file && !options.has_format);
    done();
}

static void test_options__streams(void **state)
{
    (void)state;
    assert_true(READ("-GA", "+GDdebug.txt", "Warning_File=on",
                     "Statistic_File=off", "Render_Console=on"));
    assert_true(options.console[OPTIONS_DEBUG]);
    assert_true(options.console[OPTIONS_RENDERING]);
    assert_false(options.console[OPTIONS_WARNING]);
    assert_string_equal(options.stream_file[OPTIONS_DEBUG], "debug.txt");
    assert_string_equal(options.stream_file[OPTIONS_WARNING], "WARNING.OUT");
    assert_null(options.stream_file[OPTIONS_STATISTICS]);
    done();
}

/* The command lines that POVRAY.md recorded. */
static void test_options__callers(void **state)
{
    (void)state;
    assert_true(READ("F.pov", "+H120", "+W160", "+Q9", "+A0.100000",
                     "Output_Alpha=on", "-D", "+Ldir", "Output_File_Type=N",
                     "+OF.png"));
    assert_int_equal(diag.warnings, 0);
    done();
    assert_true(READ("F.pov", "Output_File_Type=P", "+O-"));
    assert_string_equal(options.output, "-");
    done();
    assert_true(READ("-D", "+IF.pov", "+OF.png", "+W640", "+H480", "+A"));
    done();
    assert_true(READ("+SR2", "+ER0.5", "+FP", "+UA", "+FN", "+A", "+R3"));
    done();
    assert_true(READ("-D", "+A", "-O-", "+FP", "s.pov", "+K07"));
    assert_true(options.clock == 7);
    done();
    assert_true(READ("+A", "+V", "-D", "+X", "+kff50", "+kf2", "+kc"));
    assert_true(options.cyclic && options.final_frame == 50);
    done();
}

static void test_options__later_wins(void **state)
{
    (void)state;
    assert_true(READ("a.pov", "+W1", "b.pov", "Width=2", "+FN", "+FE"));
    assert_string_equal(options.input, "b.pov");
    assert_int_equal(options.width, 2);
    assert_int_equal(options.format, OPTIONS_FORMAT_EXR);
    done();
}

static void test_options__no_effect(void **state)
{
    (void)state;
    assert_true(READ("s.pov", "+Q3", "Pre_Scene_Command=rm", "File_Gamma=1",
                     "Pre_Scene_Return=I"));
    assert_int_equal(diag.warnings, 3);
    assert_string_equal(diag.first->text,
                        "+Q: no effect: pictures are rendered in full");
    done();
    assert_true(READ("s.pov", "+D0G", "-P", "+J0.5", "+MB25", "+TH",
                     "Display_Gamma=sRGB", "Palette=G", "-C", "-UF",
                     "Create_Ini=off"));
    assert_int_equal(diag.warnings, 0);
    done();
}

static void test_options__bad_values(void **state)
{
    (void)state;
    ASSERT_ERROR("+W: 0 is not in the range 1 to 16777216", "+W0");
    ASSERT_ERROR("+W: '20x' is not a number", "+W20x");
    ASSERT_ERROR("Width: 'nan' is not a number", "Width=nan");
    ASSERT_ERROR("Width: a value is missing", "Width=");
    ASSERT_ERROR("+K: '0x10' is not a number", "+K0x10");
    ASSERT_ERROR("+K: '1e999' is not a number", "+K1e999");
    ASSERT_ERROR("+R: 1e30 is out of bounds", "+R1e30");
    ASSERT_ERROR("+W: a value is missing; it follows without a blank: +Wn",
                 "+W", "320");
    ASSERT_ERROR("Verbose: 'maybe' is neither on nor off", "Verbose=maybe");
    ASSERT_ERROR("Declare: 'foo' is not a number, and only numbers can be "
                 "declared here",
                 "Declare=N=foo");
    ASSERT_ERROR("Declare: '9=1' is not NAME=NUMBER", "Declare=9=1");
    ASSERT_ERROR("--memory: '0' is not a number of bytes, which K, M, G or T "
                 "may follow",
                 "--memory", "0");
    ASSERT_ERROR("--seed: '-1' is not a whole number from 0 to 2^64 - 1",
                 "--seed=-1");
    ASSERT_ERROR("--spp: a value is missing", "--spp");
    ASSERT_ERROR("--shard: '3/2' is neither part I of N, as 2/5, nor 'slurm'",
                 "--shard", "3/2");
    ASSERT_ERROR("--shard: '0/2' is neither part I of N, as 2/5, nor 'slurm'",
                 "--shard", "0/2");
    ASSERT_ERROR("--version: no value is expected, '3' was given",
                 "--version=3");
    ASSERT_ERROR("--backend: 'gpu' is not one of auto, cpu, cuda", "--backend",
                 "gpu");
    ASSERT_ERROR("+F: 'Q' is no file type; N is PNG, E OpenEXR, P PPM", "+FQ");
    ASSERT_ERROR("+F: '17' is not a number of bits from 5 to 16", "+FN17");
    ASSERT_ERROR("-D: 'isplay' is not a display mode", "-display");
}

static void test_options__not_yet(void **state)
{
    (void)state;
    ASSERT_ERROR("--preview: not supported yet", "--preview");
    ASSERT_ERROR("+F: file type 'J' is not supported yet; N is PNG, E "
                 "OpenEXR, P PPM",
                 "+FJ");
}

static void assert_suggests(const char *word, const char *hint)
{
    assert_false(READ(word));
    if (hint)
        assert_string_equal(diag.first->hint, hint);
    else
        assert_null(diag.first->hint);
    done();
}

static void test_options__suggestions(void **state)
{
    (void)state;
    assert_suggests("--tread", "did you mean '--threads'?");
    assert_suggests("-threads", "did you mean '--threads'?");
    assert_suggests("--xyzzy", NULL);
    assert_suggests("Widht=3", "did you mean 'Width'?");
    assert_suggests("Antialas=on", "did you mean 'Antialias'?");
    assert_suggests("+ZZ", NULL);
}

/* One error after another, not the first alone. */
static void test_options__all_errors(void **state)
{
    (void)state;
    assert_false(READ("+W0", "s.pov", "--nonsense-of-mine", "+H0"));
    assert_int_equal(diag.errors, 3);
    assert_string_equal(options.input, "s.pov");
    done();
}

/* A number whose low and high are both 0 has no range; names are unique, and
 * no switch hides behind another that takes no value. */
static void test_options__table(void **state)
{
    (void)state;
    for (int i = 0; i < option_count; i++) {
        const struct option *o = &option_table[i];
        if (!o->plus && !o->ini && !o->name) {
            assert_non_null(o->help);
            continue;
        }
        assert_non_null(o->set);
        assert_true(o->at >= OPTION_NOWHERE &&
                    o->at < (long)sizeof(struct options));
        assert_true(o->low <= o->high);
        for (int j = 0; j < i; j++) {
            const struct option *p = &option_table[j];
            assert_false(o->plus && p->plus && !strcmp(o->plus, p->plus));
            assert_false(o->ini && p->ini && !strcmp(o->ini, p->ini));
            assert_false(o->name && p->name && !strcmp(o->name, p->name));
        }
    }
}

static void test_options__help_names_every_option(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    options_help(to);
    fclose(to);
    for (int i = 0; i < option_count; i++) {
        const struct option *o = &option_table[i];
        char name[64];
        snprintf(name, sizeof name, "--%s", o->name ? o->name : "");
        assert_non_null(strstr(text, o->ini ? o->ini : name));
        snprintf(name, sizeof name, "+%s", o->plus ? o->plus : "");
        assert_non_null(strstr(text, name));
    }
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n"))
        assert_true(strlen(line) <= 80);
    free(text);
}

/* ---- INI files --------------------------------------------------------- */

static void write_file(const char *path, const char *text)
{
    FILE *to = fopen(path, "w");
    assert_non_null(to);
    fputs(text, to);
    fclose(to);
}

static void test_options__ini(void **state)
{
    (void)state;
    write_file("a.ini", "Width=40 ; pixels\n+H30 +Is.pov\n--spp=9\n[low]\n"
                        "Width=20\n[high]\nWidth=80\n[LOW]\nHeight=15\n");
    assert_true(READ("a.ini"));
    assert_int_equal(options.width, 40);
    assert_int_equal(options.height, 30);
    assert_int_equal(options.spp, 9);
    assert_string_equal(options.input, "s.pov");
    assert_null(options.input_folder);
    done();
    assert_true(READ("a.ini[Low]", "+H7"));
    assert_int_equal(options.width, 20);
    assert_int_equal(options.height, 7);
    done();
    assert_true(READ("+W5", "a"));
    assert_int_equal(options.width, 40);
    done();
    assert_false(READ("a.ini[none]"));
    assert_string_equal(diag.first->text, "'a.ini' has no section [none]");
    done();
}

static void test_options__ini_place(void **state)
{
    (void)state;
    write_file("b.ini", "Width=40\n   Hieght=3 ; what\n");
    assert_false(READ("b.ini"));
    assert_string_equal(diag.first->file, "b.ini");
    assert_int_equal(diag.first->line, 2);
    assert_int_equal(diag.first->column, 4);
    assert_non_null(strstr(diag.first->excerpt, "Hieght=3"));
    assert_string_equal(diag.first->hint, "did you mean 'Height'?");
    assert_int_equal(options.width, 40);
    done();
}

static void test_options__ini_within_ini(void **state)
{
    (void)state;
    write_file("c.ini", "Width=1\nd.ini[x]\n");
    write_file("d.ini", "Height=1\n[x]\nHeight=2\nInput_File_Name=s.pov\n");
    assert_true(READ("c.ini"));
    assert_int_equal(options.width, 1);
    assert_int_equal(options.height, 2);
    done();
    write_file("e.ini", "f.ini\n");
    write_file("f.ini", "Width=1\n./e.ini\n");
    assert_false(READ("e.ini"));
    assert_int_equal(diag.errors, 1);
    assert_string_equal(diag.first->text,
                        "'./e.ini' would be read within itself");
    assert_string_equal(diag.first->file, "f.ini");
    done();
}

static void test_options__ini_doubles(void **state)
{
    (void)state;
    char text[512] = "";
    for (char c = 'a'; c <= 'p'; c++)
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 "[%c]\ng.ini[%c]\ng.ini[%c]\n", c, c + 1, c + 1);
    strcat(text, "[q]\nWidth=3\n");
    write_file("g.ini", text);
    assert_false(READ("g.ini[a]"));
    assert_int_equal(diag.code, BRUME_ERR_LIMIT);
    done();
}

static void test_options__ini_missing(void **state)
{
    (void)state;
    assert_false(READ("none.ini"));
    assert_int_equal(diag.code, BRUME_ERR_FILE);
    done();
    assert_false(READ("/.ini"));
    assert_int_equal(diag.code, BRUME_ERR_FILE);
    done();
    write_file("w.ini", "Width:22\n");
    ASSERT_ERROR("'Width:22' is neither name=value, nor a switch, nor an INI "
                 "file",
                 "w.ini");
}

static void test_options__ini_is_found(void **state)
{
    (void)state;
    setenv("HOME", folder, 1);
    unsetenv("XDG_CONFIG_HOME");
    options_init(&options);
    assert_null(options_find_ini(&options));
    write_file("povray.ini", "");
    assert_string_equal(options_find_ini(&options), "povray.ini");
    write_file("brume.ini", "");
    assert_string_equal(options_find_ini(&options), "brume.ini");
    options_release(&options);
    remove("povray.ini");
    remove("brume.ini");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_options__defaults),
        cmocka_unit_test(test_options__switches),
        cmocka_unit_test(test_options__named),
        cmocka_unit_test(test_options__long),
        cmocka_unit_test(test_options__plates),
        cmocka_unit_test(test_options__file_types),
        cmocka_unit_test(test_options__streams),
        cmocka_unit_test(test_options__callers),
        cmocka_unit_test(test_options__later_wins),
        cmocka_unit_test(test_options__no_effect),
        cmocka_unit_test(test_options__bad_values),
        cmocka_unit_test(test_options__not_yet),
        cmocka_unit_test(test_options__suggestions),
        cmocka_unit_test(test_options__all_errors),
        cmocka_unit_test(test_options__table),
        cmocka_unit_test(test_options__help_names_every_option),
        cmocka_unit_test(test_options__ini),
        cmocka_unit_test(test_options__ini_place),
        cmocka_unit_test(test_options__ini_within_ini),
        cmocka_unit_test(test_options__ini_doubles),
        cmocka_unit_test(test_options__ini_missing),
        cmocka_unit_test(test_options__ini_is_found),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
