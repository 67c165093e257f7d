/* test_fault.c - the front end when an allocation fails, for each of them.
 *
 * malloc and its like are replaced for the whole program; the sanitizers have
 * replacements of their own, so there it is skipped. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "parser/parse.h"
#include <stdlib.h>
#include <string.h>

#ifndef __SANITIZE_ADDRESS__
static long left = -1; /* allocations until one fails; < 0: none does */

static bool fails(void)
{
    return left >= 0 && left-- == 0;
}

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);

void *malloc(size_t size)
{
    return fails() ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    return fails() ? NULL : __libc_calloc(count, size);
}

void *realloc(void *block, size_t size)
{
    return fails() ? NULL : __libc_realloc(block, size);
}

/* Deep enough for each stack to grow. */
static const char scene[] =
    "#declare A = ((((((((((((((((((((((((((((((((((((((((((((((((1))))))))"
    "))))))))))))))))))))))))))))))))))))))));\n"
    "#declare B = array[5000] #for (I, 0, 4999) #declare B[I] = <I,I,I>; "
    "#end\n"
    "#macro M(P, Q) #local L = concat(\"a\", P); #declare Q = L; #end\n"
    "#declare S = \"s\"; M(\"p\", S)\n"
    "#if (seed(1) = 0) #while (A < 3) #declare A = A + 1; #end #end\n"
    "#debug str(A, 0, 0)\n";

/* Reads the scene with the n-th allocation failing; false: there were not so
 * many. */
static bool read_failing(long n)
{
    struct parse_input in = {.path = "scene.pov",
                             .text = scene,
                             .length = sizeof scene - 1,
                             .ambient = PARSE_AMBIENT_INIT};
    struct parse_result result;
    struct diag diag;
    diag_init(&diag);
    left = n;
    bool done = parse_scene(&in, &result, &diag);
    bool failed = left < 0;
    left = -1;
    assert_true(done || diag.code == BRUME_ERR_MEMORY);
    assert_int_equal(done, diag.errors == 0);
    brume_scene_free(result.scene);
    diag_release(&diag);
    return failed;
}

static void test_each_allocation(void **state)
{
    (void)state;
    long n = 0;
    while (read_failing(n)) {
        n++;
    }
    assert_true(n > 12);
}
#else
static void test_each_allocation(void **state)
{
    (void)state;
    skip();
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_allocation)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
