#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>
#include "parser/frames.h"
#include "parser/naming.h"

/* What POV-Ray 3.7.0.10 did with these switches, as it was measured. */

static struct options options;
static struct frames frames;

#define READ(...) read_words((const char *const[]){__VA_ARGS__, NULL})

static void read_words(const char *const *word)
{
    struct diag diag;
    int count = 0;
    while (word[count])
        count++;
    options_release(&options);
    options_init(&options);
    diag_init(&diag);
    assert_true(options_read_words(&options, count, word, &diag));
    diag_release(&diag);
    frames_init(&frames, &options);
}

static void assert_frames(int first, int last)
{
    assert_true(frames.animation);
    assert_int_equal(frames.first, first);
    assert_int_equal(frames.last, last);
}

static void assert_clock(int number, double clock, double delta)
{
    struct parse_ambient a;
    frames_ambient(&frames, &options, number, &a);
    assert_true(a.clock_on);
    assert_true(fabs(a.clock - clock) < 1e-12);
    assert_true(fabs(a.clock_delta - delta) < 1e-12);
}

static void test_frames__still(void **state)
{
    (void)state;
    struct parse_ambient a;
    READ("s.pov", "+KFI1", "+KFF1", "+KI3", "+KF5");
    assert_false(frames.animation);
    frames_ambient(&frames, &options, 0, &a);
    assert_true(a.clock == 0 && a.clock_delta == 0 && !a.clock_on);
    assert_true(a.frame_number == 0 && a.initial_frame == 0 &&
                a.final_frame == 0);
    assert_true(a.initial_clock == 0 && a.final_clock == 0);
    READ("s.pov", "+K0.5", "+W30", "+H20");
    frames_ambient(&frames, &options, 0, &a);
    assert_true(a.clock == 0.5 && a.clock_on);
    assert_true(a.image_width == 30 && a.image_height == 20);
    READ("s.pov", "+KFF0");
    assert_false(frames.animation);
    READ("s.pov", "+KFI0", "+KFF0");
    assert_false(frames.animation);
    READ("s.pov", "+SF3");
    assert_false(frames.animation);
}

static void test_frames__clock(void **state)
{
    (void)state;
    READ("s.pov", "+KFF3", "+K0.7");
    assert_frames(1, 3);
    assert_clock(1, 0, 0.5);
    assert_clock(2, 0.5, 0.5);
    assert_clock(3, 1, 0.5);
    READ("s.pov", "+KI3", "+KF5", "+KFF2");
    assert_clock(1, 3, 2);
    assert_clock(2, 5, 2);
    READ("s.pov", "+KFI0", "+KFF2");
    assert_frames(0, 2);
    assert_clock(1, 0.5, 0.5);
    READ("s.pov", "+KFI-2", "+KFF2");
    assert_frames(0, 2);
}

/* One interval more, and a final_frame that scenes see one too high. */
static void test_frames__cyclic(void **state)
{
    (void)state;
    struct parse_ambient a;
    READ("s.pov", "+KFI2", "+KFF4", "+KC");
    assert_frames(2, 4);
    assert_clock(2, 0, 1.0 / 3);
    assert_clock(4, 2.0 / 3, 1.0 / 3);
    frames_ambient(&frames, &options, 4, &a);
    assert_true(a.frame_number == 4 && a.initial_frame == 2 &&
                a.final_frame == 5);
    assert_int_equal(frames.digits, 1);
    READ("s.pov", "+KFI5", "+KC");
    assert_frames(5, 5);
    assert_clock(5, 0, 1);
}

/* POV-Ray divides by 0 here; the clock is the initial one. */
static void test_frames__one_frame(void **state)
{
    (void)state;
    READ("s.pov", "+KFI5", "+KFF5", "+KI2");
    assert_frames(5, 5);
    assert_clock(5, 2, 0);
    READ("s.pov", "+KFI3", "+KFF1");
    assert_frames(3, 3);
}

static void test_frames__subset(void **state)
{
    (void)state;
    READ("s.pov", "+KFF10", "+SF0.5", "+EF0.75");
    assert_frames(5, 7);
    assert_clock(5, 4.0 / 9, 1.0 / 9);
    READ("s.pov", "+KFF10", "+SF0.25", "+EF0.55");
    assert_frames(2, 5);
    READ("s.pov", "+KFF10", "+SF3", "+EF4");
    assert_frames(3, 4);
    READ("s.pov", "+KFF10", "+SF0.05", "+EF0.09");
    assert_frames(1, 1);
    READ("s.pov", "+KFI11", "+KFF20", "+SF0.5");
    assert_frames(11, 20);
    READ("s.pov", "+KFF10", "+EF1.0", "+SF0.0");
    assert_frames(1, 1);
    READ("s.pov", "+KFF3", "+SF3", "+EF1");
    assert_frames(3, 3);
    READ("s.pov", "+KFF3", "+EF9");
    assert_frames(1, 9);
    assert_clock(9, 4, 0.5);
    READ("s.pov", "+KFF4", "+SF5");
    assert_frames(5, 5);
    READ("s.pov", "+KFF100", "+SF0.29", "+EF0.29");
    assert_frames(29, 29);
    READ("s.pov", "+KFF9", "+SF2", "+STP3");
    assert_frames(2, 9);
    assert_int_equal(frames.step, 3);
}

static void assert_region(int x0, int y0, int x1, int y1)
{
    int r[4];
    struct brume_error err = {0};
    assert_true(frames_region(&options, r, &err));
    assert_int_equal(r[0], x0);
    assert_int_equal(r[1], y0);
    assert_int_equal(r[2], x1);
    assert_int_equal(r[3], y1);
}

#define SIZE "s.pov", "+W20", "+H16"

static void test_frames__region(void **state)
{
    (void)state;
    READ(SIZE);
    assert_region(0, 0, 20, 16);
    READ(SIZE, "+SC2", "+EC3", "+SR2", "+ER3");
    assert_region(1, 1, 3, 3);
    READ(SIZE, "+SC0.25", "+EC0.75", "+SR0.33", "+ER0.66");
    assert_region(5, 5, 15, 10);
    READ(SIZE, "+SC1", "+EC1", "+SR0", "+ER1.0");
    assert_region(0, 0, 20, 16);
    READ(SIZE, "+SC2.5", "+EC2.7", "+SR0.49", "+ER0.51");
    assert_region(1, 7, 2, 8);
    READ(SIZE, "+SC0.96", "+EC0.999", "+SC0.03", "+EC.5");
    assert_region(0, 0, 10, 16);
    READ(SIZE, "+SC20", "+EC20");
    assert_region(19, 0, 20, 16);
}

static void assert_no_region(const char *expected)
{
    int r[4];
    struct brume_error err = {0};
    assert_false(frames_region(&options, r, &err));
    assert_int_equal(err.code, BRUME_ERR_USAGE);
    assert_string_equal(err.text, expected);
}

static void test_frames__no_region(void **state)
{
    (void)state;
    READ(SIZE, "+SC21");
    assert_no_region("start column 21 lies beyond the last, 20");
    READ(SIZE, "+ER17");
    assert_no_region("end row 17 lies beyond the last, 16");
    READ(SIZE, "+SC5", "+EC3");
    assert_no_region("no column is left from 5 to 3");
    READ(SIZE, "+ER0");
    assert_no_region("no row is left from 1 to 0");
}

/* ---- names of pictures ------------------------------------------------- */

static void assert_picture(int number, const char *expected)
{
    struct arena arena;
    arena_init(&arena, 0);
    assert_string_equal(naming_picture(&options, &frames, number, &arena),
                        expected);
    arena_release(&arena);
}

static void test_naming__still(void **state)
{
    (void)state;
    READ("s.pov");
    assert_picture(0, "s.png");
    READ("sub/t.v2.pov", "+FE");
    assert_picture(0, "sub/t.v2.exr");
    READ("sub.d/scene");
    assert_picture(0, "sub.d/scene.png");
    READ("sub/t.pov", "+Ofoo");
    assert_picture(0, "foo.png");
    READ("sub/t.pov", "+Oout/");
    assert_picture(0, "out/t.png");
    READ("sub/t.pov", "+O./");
    assert_picture(0, "./t.png");
    READ("-");
    assert_picture(0, "stdin.png");
    READ("s.pov", "+O-");
    assert_picture(0, "-");
    READ("s.pov", "+O/dev/null", "+FE");
    assert_picture(0, "/dev/null");
}

static void test_naming__extension(void **state)
{
    (void)state;
    READ("s.pov", "+Oz.exr");
    assert_int_equal(naming_format(&options), OPTIONS_FORMAT_EXR);
    assert_picture(0, "z.exr");
    assert_null(naming_foreign(&options));
    READ("s.pov", "+Oz.PPM");
    assert_int_equal(naming_format(&options), OPTIONS_FORMAT_PPM);
    assert_picture(0, "z.PPM");
    READ("s.pov", "+Oz.exr", "+FN");
    assert_picture(0, "z.exr.png");
    assert_null(naming_foreign(&options));
    READ("s.pov", "+Oz.png", "Output_File_Type=E");
    assert_picture(0, "z.png.exr");
    READ("s.pov", "+Oz.b");
    assert_picture(0, "z.b.png");
    assert_null(naming_foreign(&options));
    READ("s.pov", "+Oz.jpg");
    assert_picture(0, "z.jpg.png");
    assert_string_equal(naming_foreign(&options), ".jpg");
    READ("s.pov", "+O.png");
    assert_picture(0, ".png.png");
}

static void test_naming__numbers(void **state)
{
    (void)state;
    READ("s.pov", "+KFF12", "+Oan.png");
    assert_picture(3, "an03.png");
    assert_picture(12, "an12.png");
    READ("d/s.pov", "+KFF100");
    assert_picture(7, "d/s007.png");
    READ("s.pov", "+KFF3", "+Oz.b");
    assert_picture(1, "z.b1.png");
    READ("s.pov", "+KFF9", "+EF12");
    assert_picture(12, "s12.png");
    READ("s.pov", "+KFI5", "+KFF5");
    assert_picture(5, "s5.png");
    READ("s.pov", "+KFI0", "+KFF2");
    assert_picture(0, "s0.png");
}

static void test_naming__folder(void **state)
{
    (void)state;
    struct arena arena;
    arena_init(&arena, 0);
    READ("a/s.pov");
    assert_string_equal(naming_folder(&options, &arena), "a/");
    READ("a/s.pov", "+Oz");
    assert_string_equal(naming_folder(&options, &arena), ".");
    READ("a/s.pov", "+O-");
    assert_string_equal(naming_folder(&options, &arena), ".");
    arena_release(&arena);
}

static int release(void **state)
{
    (void)state;
    options_release(&options);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frames__still),
        cmocka_unit_test(test_frames__clock),
        cmocka_unit_test(test_frames__cyclic),
        cmocka_unit_test(test_frames__one_frame),
        cmocka_unit_test(test_frames__subset),
        cmocka_unit_test(test_frames__region),
        cmocka_unit_test(test_frames__no_region),
        cmocka_unit_test(test_naming__still),
        cmocka_unit_test(test_naming__extension),
        cmocka_unit_test(test_naming__numbers),
        cmocka_unit_test(test_naming__folder),
    };
    return cmocka_run_group_tests(tests, NULL, release);
}
