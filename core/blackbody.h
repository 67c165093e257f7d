/* blackbody.h - fills the table of physics/blackbody.h, and asks it. */
#ifndef CORE_BLACKBODY_H
#define CORE_BLACKBODY_H
#include "core/physics/blackbody.h"

void blackbody_fill(blackbody_table *t);

/* Luminance in the unit of blackbody_rgb. */
double blackbody_luminance(const blackbody_table *t, float kelvin);

/* CIE 1931 X, Y, Z in cd/m2 by the sum itself; kelvin > 0. */
void blackbody_xyz(double kelvin, double xyz[3]);

#endif
