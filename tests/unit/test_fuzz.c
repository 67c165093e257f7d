/* test_fuzz.c - inputs that once made a fuzzer stop, tried again. */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>
#include "tests/fuzz/fuzz.h"

typedef void fuzz_target(const uint8_t *data, size_t size);

static void try_file(const char *path, fuzz_target *target)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    uint8_t *room = malloc(1 << 20);
    assert_non_null(room);
    size_t size = fread(room, 1, 1 << 20, file);
    fclose(file);
    /* Of its own size, so that reading beyond it shows. */
    uint8_t *data = malloc(size ? size : 1);
    assert_non_null(data);
    memcpy(data, room, size);
    free(room);
    print_message("# %s\n", path);
    target(data, size);
    free(data);
}

/* All inputs of a folder; returns how many. */
static int try_folder(const char *folder, fuzz_target *target)
{
    char path[600];
    snprintf(path, sizeof path, "tests/fuzz/regressions/%s", folder);
    DIR *dir = opendir(path);
    int count = 0;
    assert_non_null(dir);
    for (struct dirent *entry; (entry = readdir(dir));) {
        if (entry->d_name[0] == '.')
            continue;
        snprintf(path, sizeof path, "tests/fuzz/regressions/%s/%s", folder,
                 entry->d_name);
        try_file(path, target);
        count++;
    }
    closedir(dir);
    return count;
}

static void test_fuzz__scenes(void **state)
{
    (void)state;
    assert_true(try_folder("parse", fuzz_scene) > 0);
}

static void test_fuzz__options(void **state)
{
    (void)state;
    assert_true(try_folder("options", fuzz_options) > 0);
}

static void test_fuzz__data_files(void **state)
{
    (void)state;
    assert_true(try_folder("data", fuzz_data) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fuzz__scenes),
        cmocka_unit_test(test_fuzz__options),
        cmocka_unit_test(test_fuzz__data_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
