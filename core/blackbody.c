/* blackbody.c - Planck's law seen by the CIE 1931 standard observer. */
#include "core/blackbody.h"
#include <math.h>

/* CODATA 2018, exact by the definition of the units. */
static const double planck = 6.62607015e-34;  /* J s   */
static const double light_speed = 299792458;  /* m/s   */
static const double boltzmann = 1.380649e-23; /* J/K   */

static const double lumens_per_watt = 683; /* K_m   */

/* Colour matching functions of the 2-degree observer [CIE 1931], from 360 to
 * 830 nm in steps of 5 nm: x, y, z. */
enum { CIE_FIRST_NM = 360, CIE_STEP_NM = 5, CIE_COUNT = 95 };
/* clang-format off */
static const double cie[CIE_COUNT][3] = {
    {0.0001299, 3.917e-6, 0.0006061}, {0.0002321, 6.965e-6, 0.001086},
    {0.0004149, 1.239e-5, 0.001946}, {0.0007416, 2.202e-5, 0.003486},
    {0.001368, 3.9e-5, 0.006450001}, {0.002236, 6.4e-5, 0.01054999},
    {0.004243, 0.00012, 0.02005001}, {0.00765, 0.000217, 0.03621},
    {0.01431, 0.000396, 0.06785001}, {0.02319, 0.00064, 0.1102},
    {0.04351, 0.00121, 0.2074}, {0.07763, 0.00218, 0.3713},
    {0.13438, 0.004, 0.6456}, {0.21477, 0.0073, 1.0390501},
    {0.2839, 0.0116, 1.3856}, {0.3285, 0.01684, 1.62296},
    {0.34828, 0.023, 1.74706}, {0.34806, 0.0298, 1.7826},
    {0.3362, 0.038, 1.77211}, {0.3187, 0.048, 1.7441},
    {0.2908, 0.06, 1.6692}, {0.2511, 0.0739, 1.5281},
    {0.19536, 0.09098, 1.28764}, {0.1421, 0.1126, 1.0419},
    {0.09564, 0.13902, 0.8129501}, {0.05795001, 0.1693, 0.6162},
    {0.03201, 0.20802, 0.46518}, {0.0147, 0.2586, 0.3533},
    {0.0049, 0.323, 0.272}, {0.0024, 0.4073, 0.2123},
    {0.0093, 0.503, 0.1582}, {0.0291, 0.6082, 0.1117},
    {0.06327, 0.71, 0.07824999}, {0.1096, 0.7932, 0.05725001},
    {0.1655, 0.862, 0.04216}, {0.2257499, 0.9148501, 0.02984},
    {0.2904, 0.954, 0.0203}, {0.3597, 0.9803, 0.0134},
    {0.4334499, 0.9949501, 0.008749999}, {0.5120501, 1, 0.005749999},
    {0.5945, 0.995, 0.0039}, {0.6784, 0.9786, 0.002749999},
    {0.7621, 0.952, 0.0021}, {0.8425, 0.9154, 0.0018},
    {0.9163, 0.87, 0.001650001}, {0.9786, 0.8163, 0.0014},
    {1.0263, 0.757, 0.0011}, {1.0567, 0.6949, 0.001},
    {1.0622, 0.631, 0.0008}, {1.0456, 0.5668, 0.0006},
    {1.0026, 0.503, 0.00034}, {0.9384, 0.4412, 0.00024},
    {0.8544499, 0.381, 0.00019}, {0.7514, 0.321, 0.0001},
    {0.6424, 0.265, 4.999999e-5}, {0.5419, 0.217, 3e-5},
    {0.4479, 0.175, 2e-5}, {0.3608, 0.1382, 1e-5},
    {0.2835, 0.107, 0}, {0.2187, 0.0816, 0},
    {0.1649, 0.061, 0}, {0.1212, 0.04458, 0},
    {0.0874, 0.032, 0}, {0.0636, 0.0232, 0},
    {0.04677, 0.017, 0}, {0.0329, 0.01192, 0},
    {0.0227, 0.00821, 0}, {0.01584, 0.005723, 0},
    {0.01135916, 0.004102, 0}, {0.008110916, 0.002929, 0},
    {0.005790346, 0.002091, 0}, {0.004109457, 0.001484, 0},
    {0.002899327, 0.001047, 0}, {0.00204919, 0.00074, 0},
    {0.001439971, 0.00052, 0}, {0.0009999493, 0.0003611, 0},
    {0.0006900786, 0.0002492, 0}, {0.0004760213, 0.0001719, 0},
    {0.0003323011, 0.00012, 0}, {0.0002348261, 8.48e-5, 0},
    {0.0001661505, 6e-5, 0}, {0.000117413, 4.24e-5, 0},
    {8.307527e-5, 3e-5, 0}, {5.870652e-5, 2.12e-5, 0},
    {4.150994e-5, 1.499e-5, 0}, {2.935326e-5, 1.06e-5, 0},
    {2.067383e-5, 7.4657e-6, 0}, {1.455977e-5, 5.2578e-6, 0},
    {1.025398e-5, 3.7029e-6, 0}, {7.221456e-6, 2.6078e-6, 0},
    {5.085868e-6, 1.8366e-6, 0}, {3.581652e-6, 1.2934e-6, 0},
    {2.522525e-6, 9.1093e-7, 0}, {1.776509e-6, 6.4153e-7, 0},
    {1.251141e-6, 4.5181e-7, 0},
};
/* clang-format on */

/* B/T at s = 1/T, W/(m2 sr m K): analytic at s = 0, where it is the limit of
 * Rayleigh and Jeans; its slope goes to *slope. */
static double planck_over_t(double s, double wavelength, double *slope)
{
    const double c2 = planck * light_speed / boltzmann;
    double x = c2 * s / wavelength, grown = expm1(x);
    double scale = 2 * planck * light_speed * light_speed / pow(wavelength, 5);
    *slope = -0.5 * scale;
    if (x == 0)
        return scale * wavelength / c2;
    /* s / (e^x - 1), of which the slope at 0 is -1/2. */
    if (x > 1e-4)
        *slope = scale * (1 - x * (1 + 1 / grown)) / grown;
    return scale * s / grown;
}

static void xyz_over_t(double s, double xyz[3], double slope[3])
{
    for (int k = 0; k < 3; k++)
        xyz[k] = slope[k] = 0;
    for (int i = 0; i < CIE_COUNT; i++) {
        double wavelength = (CIE_FIRST_NM + i * CIE_STEP_NM) * 1e-9, d;
        double value = planck_over_t(s, wavelength, &d);
        for (int k = 0; k < 3; k++) {
            double weight = lumens_per_watt * CIE_STEP_NM * 1e-9 * cie[i][k];
            xyz[k] += weight * value;
            slope[k] += weight * d;
        }
    }
}

void blackbody_xyz(double kelvin, double xyz[3])
{
    double slope[3];
    xyz_over_t(1 / kelvin, xyz, slope);
    for (int k = 0; k < 3; k++)
        xyz[k] *= kelvin;
}

static void rec709(const double xyz[3], double scale, double out[3])
{
    static const double map[3][3] = {
        {3.24096994, -1.53738318, -0.49861076},
        {-0.96924364, 1.8759675, 0.04155506},
        {0.05563008, -0.20397696, 1.05697151},
    };
    for (int k = 0; k < 3; k++)
        out[k] = scale *
                 (map[k][0] * xyz[0] + map[k][1] * xyz[1] + map[k][2] * xyz[2]);
}

/* The colour over T at node i, and its slope there for a step of one node. */
static void fill_node(int i, double value[3], double slope[3])
{
    const double step = 1.0 / (BLACKBODY_LOWEST_KELVIN * BLACKBODY_PIECES);
    double xyz[3], d[3];
    xyz_over_t(i * step, xyz, d);
    rec709(xyz, 1 / BLACKBODY_UNIT, value);
    rec709(d, step / BLACKBODY_UNIT, slope);
}

void blackbody_fill(blackbody_table *t)
{
    double value[2][3], slope[2][3];
    fill_node(0, value[0], slope[0]);
    for (int i = 0; i < BLACKBODY_PIECES; i++) {
        const double *a = value[i & 1], *b = value[~i & 1];
        const double *da = slope[i & 1], *db = slope[~i & 1];
        fill_node(i + 1, value[~i & 1], slope[~i & 1]);
        for (int k = 0; k < 3; k++) {
            double d = b[k] - a[k];
            t->piece[i].rgb[0][k] = (float)a[k];
            t->piece[i].rgb[1][k] = (float)da[k];
            t->piece[i].rgb[2][k] = (float)(3 * d - 2 * da[k] - db[k]);
            t->piece[i].rgb[3][k] = (float)(da[k] + db[k] - 2 * d);
        }
    }
}

double blackbody_luminance(const blackbody_table *t, float kelvin)
{
    return (double)rgb_luminance(blackbody_rgb(t, kelvin));
}
