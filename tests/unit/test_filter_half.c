/* What halves of a field's photons tell of its light and its noise, beside
 * what many fields do. */
#include <string.h>
#include "core/physics/half.h"
#include "tests/unit/filter_scene.h"

enum { FIELDS = 60, MANY = 1000000 };

/* A brick's blocks, less their mean; returns their sum. */
static double blocks_of(const struct filter_field *f, size_t brick,
                        double block[HALF_BLOCKS])
{
    size_t numbers = (size_t)f->lattice.numbers;
    double sum = 0.0;
    memset(block, 0, HALF_BLOCKS * sizeof *block);
    for (int i = 0; i < 512; i++) {
        int x = i & 7, y = i >> 3 & 7, z = i >> 6;
        const float *cell = f->cells + (brick * 512 + (size_t)i) * numbers +
                            f->lattice.fluence;
        for (int c = 0; c < 3; c++)
            block[((z >> 1) * 4 + (y >> 1)) * 4 + (x >> 1)] += (double)cell[c];
    }
    for (int i = 0; i < HALF_BLOCKS; i++)
        sum += block[i];
    for (int i = 0; i < HALF_BLOCKS; i++)
        block[i] -= sum / HALF_BLOCKS;
    return sum;
}

struct power {
    double detail, whole;
};

static size_t bricks_of(const struct filter_field *f)
{
    return f->count / 512 / (size_t)f->lattice.numbers;
}

/* Sums over fields of what blocks and bricks have, and of squares. */
enum { BRICKS = 512 };
struct moments {
    double block[2][BRICKS][HALF_BLOCKS], whole[2][BRICKS];
    int fields;
};

static void add_moments(const struct filter_field *f, struct moments *m)
{
    double block[HALF_BLOCKS];
    assert_in_range(bricks_of(f), 1, BRICKS);
    for (size_t b = 0; b < bricks_of(f); b++) {
        double sum = blocks_of(f, b, block);
        m->whole[0][b] += sum;
        m->whole[1][b] += sum * sum;
        for (int i = 0; i < HALF_BLOCKS; i++) {
            m->block[0][b][i] += block[i];
            m->block[1][b][i] += block[i] * block[i];
        }
    }
    m->fields++;
}

static double variance(double sum, double square, int n)
{
    return (square - sum * sum / n) / (n - 1);
}

static struct power noise_of(const struct moments *m)
{
    struct power p = {0.0, 0.0};
    for (size_t b = 0; b < BRICKS; b++) {
        p.whole += variance(m->whole[0][b], m->whole[1][b], m->fields);
        for (int i = 0; i < HALF_BLOCKS; i++)
            p.detail += variance(m->block[0][b][i], m->block[1][b][i],
                                 m->fields);
    }
    return p;
}

/* Of a field without noise. */
static struct power light_of(const struct filter_field *f)
{
    struct power p = {0.0, 0.0};
    double block[HALF_BLOCKS];
    for (size_t b = 0; b < bricks_of(f); b++) {
        double sum = blocks_of(f, b, block);
        p.whole += sum * sum;
        for (int i = 0; i < HALF_BLOCKS; i++)
            p.detail += block[i] * block[i];
    }
    return p;
}

static void add_told(const struct filter_field *f, struct power *light,
                     struct power *noise)
{
    for (size_t b = 0; b < bricks_of(f); b++) {
        light->detail += (double)f->power[b].detail / FIELDS;
        light->whole += (double)f->power[b].whole / FIELDS;
        noise->detail += (double)f->power[b].noise / FIELDS;
        noise->whole += (double)f->power[b].whole_noise / FIELDS;
    }
}

static void trace(uint64_t photons, uint32_t frame, struct filter_field *out)
{
    struct brume_options o = fog_options(5, frame);
    o.photons.adaptive = true;
    o.photons.count = photons;
    flat_free(fog_trace(fog_scene(&(struct fog){.lamp = 1.0}), &o, out));
}

static void check(const char *what, double told, double truth, double off)
{
    print_message("%s: %.4g, truth %.4g\n", what, told, truth);
    if (!(fabs(told / truth - 1.0) < off))
        fail_msg("%s: %.4g, truth %.4g", what, told, truth);
}

/* The light's energy is that of a field that has next to no noise, the noise's
 * that by which many fields differ. */
static void half__light_is_told_from_noise(void **state)
{
    (void)state;
    static struct moments moments;
    struct filter_field f;
    struct power told = {0.0, 0.0}, noise = {0.0, 0.0};
    trace(MANY, 1, &f);
    struct power light = light_of(&f);
    filter_release(&f);
    for (uint32_t i = 0; i < FIELDS; i++) {
        trace(2501, 100 + i, &f);
        add_told(&f, &told, &noise);
        add_moments(&f, &moments);
        filter_release(&f);
    }
    struct power truth = noise_of(&moments);
    check("detail", told.detail, light.detail, 0.03);
    check("wholes", told.whole, light.whole, 0.02);
    check("noise", noise.detail, truth.detail, 0.02);
    check("noise of wholes", noise.whole, truth.whole, 0.1);
}

/* Halves of three photons are one and two; of one there are none. */
static void half__few_photons(void **state)
{
    (void)state;
    for (uint64_t photons = 1; photons <= 3; photons++) {
        struct filter_field f;
        trace(photons, 5, &f);
        assert_true((f.power != NULL) == (photons > 1));
        for (size_t b = 0; f.power && b < bricks_of(&f); b++) {
            assert_true(isfinite(f.power[b].detail));
            assert_true(f.power[b].noise >= 0.0f);
        }
        filter_release(&f);
    }
}

/* Only filters that ask for them have halves. */
static void half__are_asked_for(void **state)
{
    (void)state;
    for (int adaptive = 0; adaptive < 2; adaptive++) {
        struct filter_field f;
        struct brume_options o = fog_options(5, 7);
        o.photons.adaptive = adaptive;
        o.photons.count = 999;
        struct flat *flat = fog_trace(fog_scene(&(struct fog){.lamp = 1.0}), &o,
                                      &f);
        assert_true((flat->half != NULL) == (bool)adaptive);
        if (adaptive)
            assert_float_equal(flat->half_part, 499.0 / 999.0, 1e-12);
        flat_free(flat);
        filter_release(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half__light_is_told_from_noise),
        cmocka_unit_test(half__few_photons),
        cmocka_unit_test(half__are_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
