/* SPDX-License-Identifier: LGPL-2.1-or-later
 *
 * falling RUN: the smallest adapter in C, discs or spheres that fall freely and touch nothing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <turbidite/coupler/participant/turbidite.h>

static turbidite_grain* grains;
static size_t count;
static int axes = 2;
static double gravity, fluid_density, radius_ratio, shift;

static int answer_with_all(turbidite_state* answer) {
    memcpy(turbidite_grains(answer, count), grains, count * sizeof *grains);
    return 0;
}

static int initialise(void* self, const turbidite_settings* settings, const turbidite_grain* given,
                      size_t given_count, turbidite_state* answer) {
    (void)self;
    count = given_count;
    grains = malloc(count * sizeof *grains);
    if (grains == NULL && count > 0) return turbidite_fail("out of memory", 0), 1;
    memcpy(grains, given, count * sizeof *grains);
    gravity = turbidite_real(settings, "run.gravity");
    fluid_density = turbidite_flag(settings, "fluid.enabled")
                        ? turbidite_real(settings, "run.fluid_density")
                        : 0.0;
    /* The liquid may see a grain smaller or larger than it is. */
    radius_ratio = turbidite_real(settings, "fluid.hydrodynamic_radius");
    if (turbidite_has(settings, "run.dimension")) axes = 3;
    if (turbidite_has(settings, "run.surface_shift"))
        shift = turbidite_real(settings, "run.surface_shift");
    return answer_with_all(answer);
}

/* (M - m_f)/cM of step 4: 1 where the liquid sees the grain as large as it is. */
static double weight_over_inertia(const turbidite_grain* grain) {
    const double seen = pow(radius_ratio + shift / grain->radius, axes);
    return (grain->density - fluid_density) / (grain->density - seen * fluid_density);
}

static int advance(void* self, const turbidite_window* window, const turbidite_response* responses,
                   size_t response_count, turbidite_state* answer) {
    (void)self, (void)responses, (void)response_count;
    for (size_t i = 0; i < count; ++i) {
        if (grains[i].density <= fluid_density) return turbidite_fail("a grain floats", 1), 1;
        grains[i].velocity[1] -= weight_over_inertia(&grains[i]) * gravity * window->step;
    }
    return answer_with_all(answer);
}

/* By step w, of angle |step w| about its direction: the product of two quaternions (w, x, y, z). */
static void turn(double q[4], const double w[3], double step) {
    const double angle = step * sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    const double c = cos(angle / 2), part = angle > 0 ? sin(angle / 2) / angle : 0.5;
    const double s[] = {part * step * w[0], part * step * w[1], part * step * w[2]};
    const double p[] = {q[0], q[1], q[2], q[3]};
    q[0] = c * p[0] - s[0] * p[1] - s[1] * p[2] - s[2] * p[3];
    q[1] = c * p[1] + s[0] * p[0] + s[1] * p[3] - s[2] * p[2];
    q[2] = c * p[2] + s[1] * p[0] + s[2] * p[1] - s[0] * p[3];
    q[3] = c * p[3] + s[2] * p[0] + s[0] * p[2] - s[1] * p[1];
}

static int apply_kick(void* self, const turbidite_window* window, const turbidite_kick* kicks,
                      size_t kick_count, turbidite_state* answer) {
    (void)self;
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < kick_count; ++k)
            if (kicks[k].id == grains[i].id) {
                memcpy(grains[i].velocity, kicks[k].velocity, sizeof kicks[k].velocity);
                memcpy(grains[i].angular_velocity, kicks[k].angular_velocity,
                       sizeof kicks[k].angular_velocity);
            }
        for (int axis = 0; axis < axes; ++axis)
            grains[i].position[axis] += window->step * grains[i].velocity[axis];
        turn(grains[i].orientation, grains[i].angular_velocity, window->step);
    }
    return answer_with_all(answer);
}

/* All that a window passes to the next one. */
static int save(void* self, turbidite_bytes* state) {
    (void)self;
    memcpy(turbidite_room(state, count * sizeof *grains), grains, count * sizeof *grains);
    return 0;
}

static int restore(void* self, const void* state, size_t size) {
    (void)self;
    if (size != count * sizeof *grains) return turbidite_fail("another number of grains", 0), 1;
    memcpy(grains, state, size);
    return 0;
}

static const char* const shapes[] = {"disc", "sphere", NULL};

static const turbidite_adapter falling = {.name = "falling-c",
                                          .version = "1.0",
                                          .host_code = "C",
                                          .shapes = shapes,
                                          .initialise = initialise,
                                          .advance = advance,
                                          .apply_kick = apply_kick,
                                          .save = save,
                                          .restore = restore,
                                          .dimensions = TURBIDITE_BOTH_DIMENSIONS,
                                          .knows = TURBIDITE_KNOWS_NO_MORE};

int main(int argc, char** argv) {
    return turbidite_run_grains(&falling, &argc, &argv, argv[argc - 1]);
}
