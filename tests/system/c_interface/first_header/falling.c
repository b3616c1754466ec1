/* SPDX-License-Identifier: LGPL-2.1-or-later
 *
 * falling RUN: discs that fall freely, as examples/falling.c was written when the first header was the
 * only one: it names no member of the adapter that came later. */
#include <stdlib.h>
#include <string.h>
#include <turbidite/coupler/participant/turbidite.h>

static turbidite_grain* grains;
static size_t count;
static double gravity;

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
    return answer_with_all(answer);
}

static int advance(void* self, const turbidite_window* window, const turbidite_response* responses,
                   size_t response_count, turbidite_state* answer) {
    (void)self, (void)responses, (void)response_count;
    for (size_t i = 0; i < count; ++i) grains[i].velocity[1] -= gravity * window->step;
    return answer_with_all(answer);
}

/* No kicks without a fluid, and no grain spins. */
static int apply_kick(void* self, const turbidite_window* window, const turbidite_kick* kicks,
                      size_t kick_count, turbidite_state* answer) {
    (void)self, (void)kicks, (void)kick_count;
    for (size_t i = 0; i < count; ++i)
        for (int axis = 0; axis < 2; ++axis)
            grains[i].position[axis] += window->step * grains[i].velocity[axis];
    return answer_with_all(answer);
}

static const turbidite_adapter falling = {.name = "falling-c",
                                          .version = "1.0",
                                          .host_code = "C",
                                          .initialise = initialise,
                                          .advance = advance,
                                          .apply_kick = apply_kick};

int main(int argc, char** argv) {
    return turbidite_run_grains(&falling, &argc, &argv, argv[argc - 1]);
}
