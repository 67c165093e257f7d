/* Pieces of arrays: all of it once, and the same where the contents are. */
#include <stdlib.h>
#include <string.h>
#include "lib/chunk.h"
#include "tests/unit/truth.h"

enum { SIZE = 4 << 20 };

static unsigned char *make_array(size_t size, uint64_t seed)
{
    unsigned char *array = malloc(size);
    assert_non_null(array);
    for (size_t i = 0; i < size; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        array[i] = (unsigned char)(seed >> 56);
    }
    return array;
}

static struct chunk *cut(const void *array, size_t size, size_t *count)
{
    struct chunk *list = chunk_list(array, size, 3, count, truth_error());
    assert_non_null(list);
    return list;
}

/* Bytes of one list's pieces that the other has, too. */
static size_t shared(const struct chunk *a, size_t as, const struct chunk *b,
                     size_t bs)
{
    size_t sum = 0;
    for (size_t i = 0; i < as; i++) {
        size_t j = 0;
        while (j < bs && (b[j].hash != a[i].hash || b[j].size != a[i].size))
            j++;
        sum += j < bs ? a[i].size : 0;
    }
    return sum;
}

static void chunk__covers_all_once(void **state)
{
    (void)state;
    static const size_t sizes[] = {0, 1, 3, CHUNK_LEAST, CHUNK_LEAST + 5, SIZE};
    unsigned char *array = make_array(SIZE, 1);
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        size_t count, at = 0;
        struct chunk *list = cut(array, sizes[s], &count);
        for (size_t i = 0; i < count; i++) {
            assert_int_equal(list[i].from, at);
            assert_true(list[i].size > 0 && list[i].size <= CHUNK_MOST);
            assert_true(i + 1 == count || list[i].size > CHUNK_LEAST ||
                        (at + list[i].size) % CHUNK_SPAN == 0);
            assert_true(at / CHUNK_SPAN ==
                        (at + list[i].size - 1) / CHUNK_SPAN);
            at += list[i].size;
        }
        assert_int_equal(at, sizes[s]);
        free(list);
    }
    free(array);
}

/* What is put in, taken out or changed at one place costs the pieces there. */
static void chunk__parts_may_move(void **state)
{
    (void)state;
    enum { MORE = 4 * 12345, AT = SIZE / 3 };
    unsigned char *array = make_array(SIZE, 2);
    unsigned char *other = make_array(SIZE + MORE, 3);
    size_t count, others;
    struct chunk *list = cut(array, SIZE, &count);
    assert_in_range(count, SIZE / 131072, SIZE / 32768);
    memcpy(other, array, AT);
    memcpy(other + AT + MORE, array + AT, SIZE - AT);
    struct chunk *longer = cut(other, SIZE + MORE, &others);
    print_message("%zu pieces; shared %zu of %d\n", count,
                  shared(longer, others, list, count), SIZE);
    assert_true(shared(longer, others, list, count) > SIZE - 4 * CHUNK_MOST);
    free(longer);
    memcpy(other, array, SIZE);
    other[AT] ^= 1;
    longer = cut(other, SIZE, &others);
    size_t same = shared(longer, others, list, count);
    assert_true(same < SIZE && same > SIZE - 3 * CHUNK_MOST);
    free(longer);
    free(list);
    free(array);
    free(other);
}

static void chunk__of_zeros(void **state)
{
    (void)state;
    unsigned char *array = calloc(SIZE, 1);
    size_t count;
    struct chunk *list = cut(array, SIZE, &count);
    assert_in_range(count, SIZE / CHUNK_MOST, SIZE / CHUNK_LEAST);
    free(list);
    free(array);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chunk__covers_all_once),
        cmocka_unit_test(chunk__parts_may_move),
        cmocka_unit_test(chunk__of_zeros),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
