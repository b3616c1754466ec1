/* SPDX-License-Identifier: LGPL-2.1-or-later
 *
 * The grains side of the participant library in C. It is adapter.hpp with the same meaning of every
 * call (docs/write-an-adapter.md); units and fields are those of coupler/protocol/records.hpp.
 *
 *     int main(int argc, char **argv) {
 *         turbidite_adapter mine = {.self = &code, .name = "my-code", ...};
 *         return turbidite_run_grains(&mine, &argc, &argv, argv[argc - 1]);
 *     }
 */
#ifndef TURBIDITE_H
#define TURBIDITE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int64_t id;
    int32_t shape;    /* index into the table of shapes */
    int32_t material; /* 0: contact.*, 1: first of run.materials */
    int32_t prescribed;
    double radius, density;
    double position[3];
    double orientation[4]; /* w, x, y, z */
    double velocity[3], angular_velocity[3];
    double contact_impulse[3], contact_angular_impulse[3];
    double announced_impulse[3], announced_angular_impulse[3];
} turbidite_grain;

typedef struct {
    int64_t id;
    double velocity[3], angular_velocity[3];
    double multiplier_impulse[3], multiplier_angular_impulse[3];
    double force[3], torque[3];
} turbidite_kick;

/* Of `joint`: inertia is a symmetric 6 x 6 matrix, its upper triangle by rows. */
typedef struct {
    int64_t id;
    double velocity[3], angular_velocity[3];
    double inertia[21];
    double mismatch;
} turbidite_response;

typedef struct {
    int64_t index;
    double time, step;
    int32_t write_output;
} turbidite_window;

/* NaN stands for none in residual, quad, max and contact_violation, and is there at first. */
typedef struct {
    int64_t contacts, iterations, removed;
    double residual, max_penetration, wall_seconds;
    int32_t converged;
    double quad, max, contact_violation;
} turbidite_report;

#define TURBIDITE_SLIDING 1
#define TURBIDITE_ROLLING 2

typedef struct {
    int64_t a, b; /* b: the larger id, or the grain at a wall; a is then of no meaning */
    int32_t wall; /* -1: a is a grain */
    int32_t feature;
    int32_t status; /* bits of TURBIDITE_SLIDING, TURBIDITE_ROLLING */
    double gap, length;
    double point[3], normal[3], branch[3];
    double impulse[3], rolling_impulse[3];
} turbidite_contact;

/* kind is a null pointer past the end of the table of shapes. */
typedef struct {
    const char* kind;
    const double* vertices; /* x, y[, z] of unit circumradius */
    size_t count;           /* of numbers */
} turbidite_shape;

typedef struct turbidite_settings turbidite_settings; /* valid during the call that receives it */
typedef struct turbidite_state turbidite_state;       /* what a call returns to the coupler */
typedef struct turbidite_bytes turbidite_bytes;       /* a state to be saved */

/* Values of the resolved case (turbidite keys) and run.*; a key that is missing or of another type
 * makes the present call fail, and returns 0. */
int turbidite_has(const turbidite_settings* settings, const char* key);
double turbidite_real(const turbidite_settings* settings, const char* key);
int64_t turbidite_integer(const turbidite_settings* settings, const char* key);
int turbidite_flag(const turbidite_settings* settings, const char* key);
const char* turbidite_text(const turbidite_settings* settings, const char* key);

/* All keys: 0, 1, 2, ...; a null pointer past the end. */
const char* turbidite_key(const turbidite_settings* settings, size_t index);

/* Of turbidite_grain.shape. */
turbidite_shape turbidite_shape_at(const turbidite_settings* settings, size_t index);

/* Room for the grains of the answer, to be filled in. Once per call of the adapter. */
turbidite_grain* turbidite_grains(turbidite_state* state, size_t count);
turbidite_report* turbidite_report_of(turbidite_state* state);

/* The same for single contacts, with the state of windows with output. Without this call none are
 * sent; a count of 0 says that nothing touches. */
turbidite_contact* turbidite_contacts(turbidite_state* state, size_t count);

/* Room for a saved state, to be filled in. Once per call of `save`. */
void* turbidite_room(turbidite_bytes* state, size_t size);

#define TURBIDITE_BOTH_DIMENSIONS 23

/* The functions return 0, or another number after turbidite_fail: the run then ends for all
 * participants, with exit code 4 and the text. */
typedef struct {
    void* self;
    const char *name, *version, *host_code;
    const char* const* shapes; /* ends with a null pointer; null: discs */
    int32_t native_substeps;
    int32_t effective_inertia; /* advance uses the responses of `joint` */

    int (*initialise)(void* self, const turbidite_settings* settings, const turbidite_grain* grains,
                      size_t count, turbidite_state* answer);
    int (*advance)(void* self, const turbidite_window* window, const turbidite_response* responses,
                   size_t count, turbidite_state* answer);
    int (*apply_kick)(void* self, const turbidite_window* window, const turbidite_kick* kicks,
                      size_t count, turbidite_state* answer);

    /* Both or none; with them the run has checkpoints. `save` writes the state, which it gets room
     * for by turbidite_room; `restore` goes on from it, after initialise. */
    int (*save)(void* self, turbidite_bytes* state);
    int (*restore)(void* self, const void* state, size_t size);

    /* New members come here, each as long as a pointer; a program that was built before has them
     * not, which stands for zero. */

    /* Of `sub-iterated`: advance goes back to the start of the window when it is called again. */
    int64_t restores_within_window;
    const char* const* contact_laws; /* ends with a null pointer; null: none are named */

    /* Once, before initialise: the Fortran handle of the communicator of the adapter's own ranks,
     * for MPI_Comm_f2c. */
    void (*joined)(void* self, int communicator);

    /* An MPI_Comm that the program has split off MPI_COMM_WORLD with colour 1002 or one of its own;
     * 0: the library makes the split. */
    uintptr_t communicator;

    /* Of space that the program plays in: 2 or 3, TURBIDITE_BOTH_DIMENSIONS; 0: 2. */
    int64_t dimensions;
} turbidite_adapter;

/* The text of the failure of the present call. `unphysical`: exit code 6 instead of 4. */
void turbidite_fail(const char* text, int unphysical);

/* The whole life of the program. MPI_Init and MPI_Finalize are included, unless MPI runs already.
 * Returns its exit code. The size tells the library which members the program knows: all later
 * libraries run it. A library that is older than the program refuses it in words, exit code 3, if
 * it uses a member that the library does not know. */
#define turbidite_run_grains(adapter, argc, argv, run_folder) \
    turbidite_run_grains_sized(adapter, sizeof(turbidite_adapter), argc, argv, run_folder)
int turbidite_run_grains_sized(const turbidite_adapter* adapter, size_t adapter_size, int* argc,
                               char*** argv, const char* run_folder);

/* For programs that call them: just before MPI_Init and MPI_Finalize. A program that hangs there is
 * then named, instead of those that wait for it. */
void turbidite_before_mpi_init(void);
void turbidite_before_mpi_finalize(void);

#ifdef __cplusplus
}
#endif

#endif
