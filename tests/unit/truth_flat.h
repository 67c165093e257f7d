/* truth_flat.h - scenes as the stages read them, for tests of these. */
#ifndef TESTS_UNIT_TRUTH_FLAT_H
#define TESTS_UNIT_TRUTH_FLAT_H
#include "core/plan.h"
#include "core/prepare.h"
#include "tests/unit/truth.h"

static inline struct flat *truth_flat(const brume_scene *s)
{
    struct prepare job = {.scene = s, .threads = 1};
    struct flat *f = prepare_scene(&job, truth_error());
    assert_non_null(f);
    return f;
}

/* With the field that the plan lays out. */
static inline struct flat *truth_layout(const brume_scene *s,
                                        const struct brume_options *o)
{
    struct flat *f = truth_flat(s);
    assert_true(plan_layout(f, o, truth_error()));
    return f;
}

#endif
