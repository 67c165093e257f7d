/* Loaded before a test (LD_PRELOAD), it leaves that program the one case that
 * CASE names. */
#include <stdlib.h>

void cmocka_set_test_filter(const char *pattern);

__attribute__((constructor)) static void leave_one_case(void)
{
    cmocka_set_test_filter(getenv("CASE"));
}
