/* test_backend.c - which backend opens a frame; these only tell whether they
 * can. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>
#include "core/backend.h"
#include "core/flat.h"

static int opened;

static void *open_well(const struct backend_frame *frame,
                       struct brume_error *err)
{
    (void)frame;
    (void)err;
    return &opened;
}

static void *open_full(const struct backend_frame *frame,
                       struct brume_error *err)
{
    (void)frame;
    brume_fail(err, BRUME_ERR_MEMORY, "no room for %d paths", 7);
    return NULL;
}

static void *open_broken(const struct backend_frame *frame,
                         struct brume_error *err)
{
    (void)frame;
    brume_fail(err, BRUME_ERR_DEVICE, "broken");
    return NULL;
}

static const struct backend well = {.name = "well", .open = open_well};
static const struct backend full = {.name = "full", .open = open_full};
static const struct backend broken = {.name = "broken", .open = open_broken};

struct opening {
    const struct backend *b;
    struct brume_error err;
    char text[BACKEND_TEXT];
    void *state;
};

static struct opening open_so(const struct backend *b,
                              const struct backend *spare)
{
    struct flat flat = {0};
    struct backend_frame frame = {.flat = &flat};
    struct opening o = {.b = b};
    o.state = backend_open(&o.b, spare, &frame, o.text, &o.err);
    return o;
}

/* What failed before is no error of the frame. */
static void backend__gives_way_where_memory_is_too_small(void **state)
{
    (void)state;
    struct opening o = open_so(&full, &well);
    assert_ptr_equal(o.state, &opened);
    assert_ptr_equal(o.b, &well);
    assert_int_equal(o.err.code, BRUME_OK);
    assert_string_equal(o.text, "no room for 7 paths; the CPU renders instead");
}

static void backend__stays_where_it_opens(void **state)
{
    (void)state;
    struct opening o = open_so(&well, &full);
    assert_ptr_equal(o.state, &opened);
    assert_ptr_equal(o.b, &well);
    assert_string_equal(o.text, "");
}

static void backend__has_to_be_another(void **state)
{
    (void)state;
    struct opening o = open_so(&full, NULL);
    assert_null(o.state);
    assert_int_equal(o.err.code, BRUME_ERR_MEMORY);
    assert_string_equal(o.text, "");
    o = open_so(&full, &full);
    assert_null(o.state);
    assert_int_equal(o.err.code, BRUME_ERR_MEMORY);
}

static void backend__that_is_broken_gives_no_way(void **state)
{
    (void)state;
    struct opening o = open_so(&broken, &well);
    assert_null(o.state);
    assert_int_equal(o.err.code, BRUME_ERR_DEVICE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(backend__gives_way_where_memory_is_too_small),
        cmocka_unit_test(backend__stays_where_it_opens),
        cmocka_unit_test(backend__has_to_be_another),
        cmocka_unit_test(backend__that_is_broken_gives_no_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
