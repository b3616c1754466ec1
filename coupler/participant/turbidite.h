/* SPDX-License-Identifier: LGPL-2.1-or-later */
/** \file
 * The grains side of the participant library in C. It is adapter.hpp with the same meaning of every
 * call (docs/write-an-adapter.md); units are the run's: SI for `scales.kind: physical`, otherwise D
 * = u_c = rho_f = 1. In two dimensions masses, forces and impulses are per unit length, and z
 * components are zero.
 *
 *     int main(int argc, char **argv) {
 *         turbidite_adapter mine = {.self = &code, .name = "my-code", ...};
 *         return turbidite_run_grains(&mine, &argc, &argv, argv[argc - 1]);
 *     }
 *
 * What a call receives is valid until it returns, and so is the room for its answer. Calls never
 * overlap and come from the thread that has called #turbidite_run_grains; the functions below are
 * called from there as well.
 */
#ifndef TURBIDITE_H
#define TURBIDITE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A grain, as a call receives it and as an answer has it. An answer keeps id, shape, material,
 * prescribed, radius and density. */
typedef struct {
    int64_t id;
    int32_t shape;             /**< index into the table of shapes: turbidite_shape_at() */
    int32_t material;          /**< 0: coefficients of `contact`; 1: first of run.materials */
    int32_t prescribed;        /**< not 0: keeps its velocity and spin whatever forces act on it */
    double radius,             /**< circumscribed radius [m] */
        density;               /**< rho_s [kg/m3] */
    double position[3];        /**< of the centre, q [m] */
    double orientation[4];     /**< w, x, y, z; of length 1; body axes to world axes */
    double velocity[3],        /**< U of the centre [m/s] */
        angular_velocity[3];   /**< omega, world axes [rad/s] */
    double contact_impulse[3], /**< sum of the window's contact impulses [N s] */
        contact_angular_impulse[3]; /**< sum of their moments about the centre [N m s] */
    double announced_impulse[3],    /**< of the fluid, already contained in the velocity [N s]; zero
                                       unless the code holds that of the last window during its
                                       sub-steps */
        announced_angular_impulse[3]; /**< its moment about the centre [N m s] */
} turbidite_grain;

/** What the fluid does to a grain over one window. */
typedef struct {
    int64_t id;
    double velocity[3],      /**< U^{n+1}, of the grain at the end of the window [m/s] */
        angular_velocity[3]; /**< omega^{n+1}, of the grain at the end of the window [rad/s] */
    double
        multiplier_impulse[3], /**< dt times the integral of the multiplier over the grain [N s] */
        multiplier_angular_impulse[3]; /**< the same of its moment about the centre [N m s] */
    double force[3],                   /**< of the fluid, without buoyancy; for output [N] */
        torque[3];                     /**< of the fluid about the centre; for output [N m] */
} turbidite_kick;

/** How a grain in the fluid responds to contact impulses J and K of the window: (U, omega) =
 * (velocity, angular_velocity) + inertia^-1 (J, K). Of `sub-iterated` only the velocities count. */
typedef struct {
    int64_t id;
    double velocity[3],      /**< without contact impulses [m/s] */
        angular_velocity[3]; /**< without contact impulses [rad/s] */
    /** A symmetric 6 x 6 matrix, its upper triangle by rows, translation first [kg, kg m, kg m2].
     * All zero for a grain with a given motion, which no impulse changes. */
    double inertia[21];
    double mismatch; /**< between contacts and fluid in the last round [m/s] */
} turbidite_response;

/** One step of the coupling, from t^n to t^n + dt. */
typedef struct {
    int64_t index;        /**< from 0 on; goes on in a resumed run */
    double time,          /**< t^n, at its start [s] */
        step;             /**< dt, its length [s] */
    int32_t write_output; /**< not 0: single contacts are welcome with the state */
} turbidite_window;

/** The report of the contact side. It begins with zeros, converged = 1, and NaN, which stands for
 * none, in residual, quad, max and contact_violation. */
typedef struct {
    int64_t contacts, /**< with an impulse */
        iterations,   /**< sweeps of the contact solver, or sub-steps */
        removed; /**< grains that have left through a free side in this window (apply_kick only) */
    double residual,       /**< scaled natural map */
        max_penetration,   /**< deepest overlap of the window [m] */
        wall_seconds;      /**< of the program's own work [s] */
    int32_t converged;     /**< within the tolerance of the contact solver */
    double quad,           /**< change by one more update of every contact, quadratic mean */
        max,               /**< the largest such change */
        contact_violation; /**< how far the final velocities are from the contact conditions [m/s]
                              (apply_kick only) */
} turbidite_report;

/** Bit of turbidite_contact::status: friction is at its limit. */
#define TURBIDITE_SLIDING 1
/** Bit of turbidite_contact::status: the rolling moment is at its limit. */
#define TURBIDITE_ROLLING 2

/** One contact point with an impulse. A pair that touches along an edge has several. With several
 * ranks, one of them reports the contact. */
typedef struct {
    int64_t a,         /**< the smaller id; of no meaning at a wall */
        b;             /**< the larger id, or the grain at the wall */
    int32_t wall;      /**< -1: a is a grain; 0 left, 1 right, 2 bottom, 3 top, others follow */
    int32_t feature;   /**< which of the pair's points */
    int32_t status;    /**< bits of TURBIDITE_SLIDING, TURBIDITE_ROLLING */
    double gap,        /**< between the surfaces, negative for an overlap [m] */
        length;        /**< of the face that the point stands for; 0 for points [m] */
    double point[3],   /**< where it is [m] */
        normal[3],     /**< unit vector from a to b, at a wall into the box */
        branch[3];     /**< centre of b minus that of a, at a wall minus `point` [m] */
    double impulse[3], /**< on b over the window [N s] */
        rolling_impulse[3]; /**< moment on b besides that of `impulse` [N m s] */
} turbidite_contact;

/** An entry of the table of shapes. */
typedef struct {
    const char* kind;       /**< disc, triangle, polygon, sphere; null past the end of the table */
    const double* vertices; /**< x, y[, z] of unit circumradius; none for round shapes */
    size_t count;           /**< of numbers in `vertices` */
} turbidite_shape;

/** The resolved case and its shapes. */
typedef struct turbidite_settings turbidite_settings;
/** What a call returns to the coupler. */
typedef struct turbidite_state turbidite_state;
/** A state to be saved. */
typedef struct turbidite_bytes turbidite_bytes;

/** 1 if there is such a key, else 0. Keys are those of the resolved case (`turbidite keys`) and
 * run.* (settings.hpp). A look-up below of a key that is missing or of another type makes the
 * present call fail with a text that names it. */
int turbidite_has(const turbidite_settings* settings, const char* key);
/** A number; 0 where that fails. */
double turbidite_real(const turbidite_settings* settings, const char* key);
/** A whole number; 0 where that fails. */
int64_t turbidite_integer(const turbidite_settings* settings, const char* key);
/** 1 for true, 0 for false, and 0 where that fails. */
int turbidite_flag(const turbidite_settings* settings, const char* key);
/** Any value as a text; an empty one where that fails. */
const char* turbidite_text(const turbidite_settings* settings, const char* key);

/** All keys: 0, 1, 2, ...; a null pointer past the end. */
const char* turbidite_key(const turbidite_settings* settings, size_t index);

/** The shape of a grain, by turbidite_grain::shape; its `kind` is null past the end of the table.
 */
turbidite_shape turbidite_shape_at(const turbidite_settings* settings, size_t index);

/** Room for the grains of the answer, all zero, to be filled in: every grain of this rank, in any
 * order. Once per call of the adapter: a second time discards what the first has given. */
turbidite_grain* turbidite_grains(turbidite_state* state, size_t count);
/** The report of the answer, to be filled in as far as the program has the numbers. */
turbidite_report* turbidite_report_of(turbidite_state* state);

/** As turbidite_grains() for single contacts, with the state (apply_kick) of windows with output.
 * Without this call none are sent; a count of 0 says that nothing touches. Zero in `wall` is the
 * left side: a contact of two grains has -1 there. */
turbidite_contact* turbidite_contacts(turbidite_state* state, size_t count);

/** Room for a saved state, to be filled in. Once per call of `save`. */
void* turbidite_room(turbidite_bytes* state, size_t size);

/** turbidite_adapter::dimensions of a program that plays in the plane and in space. */
#define TURBIDITE_BOTH_DIMENSIONS 23

/** turbidite_adapter::knows: what a program can do beyond free grains of one material that touch
 * without friction and restitution, between walls at rest, on one rank. Added up by `|`;
 * TURBIDITE_KNOWS_NO_MORE alone is nothing beyond. */
#define TURBIDITE_KNOWS_NO_MORE 1        /**< the least */
#define TURBIDITE_KNOWS_RANKS 3          /**< grains.ranks above 1 */
#define TURBIDITE_KNOWS_OPEN_SIDES 5     /**< sides that are free or cyclic */
#define TURBIDITE_KNOWS_INNER_WALLS 9    /**< walls inside the box: run.walls */
#define TURBIDITE_KNOWS_MOVING_WALLS 17  /**< walls that move: run.wall_motions */
#define TURBIDITE_KNOWS_GIVEN_MOTIONS 33 /**< grains that keep their velocity: `prescribed` */
#define TURBIDITE_KNOWS_MATERIALS 65     /**< run.materials and run.side_material */
#define TURBIDITE_KNOWS_FRICTION 129     /**< contact.friction */
#define TURBIDITE_KNOWS_RESTITUTION 257  /**< contact.restitution */
#define TURBIDITE_KNOWS_LAWS 513         /**< adhesion, rolling, torsion, films, contact.law */
#define TURBIDITE_KNOWS_CONTACT_POSITIONS 1025 /**< coupling.positions: contact */

/** A granular code: what it is and its functions. A program sets what it has and leaves the rest
 * zero.
 *
 * The functions return 0, or another number after turbidite_fail(): the run then ends for all
 * participants, with exit code 4 and the text. In a window `advance` is called once, or with
 * responses once or more, and then `apply_kick`. */
typedef struct {
    void* self;                /**< passed to every function; the program's own */
    const char *name,          /**< of the program; shown in `run.json`, like the next two */
        *version,              /**< of the program */
        *host_code;            /**< what it runs in, with its version */
    const char* const* shapes; /**< kinds it knows; ends with a null pointer; null: discs */
    int32_t native_substeps;   /**< moves grains in smaller steps of its own */
    int32_t effective_inertia; /**< advance uses the responses of `joint` */

    /** Gets the settings and the grains of this rank at t = 0, and answers with exactly these.
     * Fails, naming the key, if the case asks for what the program cannot do. See
     * turbidite::GrainsAdapter::initialise. */
    int (*initialise)(void* self, const turbidite_settings* settings, const turbidite_grain* grains,
                      size_t count, turbidite_state* answer);
    /** The contacts of the window. The answer has every grain with position and orientation of the
     * start of the window, velocities after the contacts, and contact impulses. `responses`: one
     * per grain, or none. If it is called again before apply_kick, it starts from the same state.
     * See turbidite::GrainsAdapter::advance. */
    int (*advance)(void* self, const turbidite_window* window, const turbidite_response* responses,
                   size_t count, turbidite_state* answer);
    /** Takes the velocities of the kicks (one per grain, by id, in any order; none without a
     * fluid), moves and turns the grains. The answer has every grain at the end of the window,
     * without those that have left. See turbidite::GrainsAdapter::apply_kick. */
    int (*apply_kick)(void* self, const turbidite_window* window, const turbidite_kick* kicks,
                      size_t count, turbidite_state* answer);

    /** Writes the state, which it gets room for by turbidite_room(). With `save` and `restore` the
     * run has checkpoints; a program has both or none. A failure costs this checkpoint, not the
     * run. */
    int (*save)(void* self, turbidite_bytes* state);
    /** Goes on from a state, after initialise with the grains of t = 0. */
    int (*restore)(void* self, const void* state, size_t size);

    /* New members come here, each as long as a pointer; a program that was built before has them
     * not, which stands for zero. */

    /** Of `sub-iterated`: advance goes back to the start of the window when it is called again. */
    int64_t restores_within_window;
    const char* const* contact_laws; /**< ends with a null pointer; null: none are named */

    /** Once, before initialise: the Fortran handle of the communicator of the adapter's own ranks,
     * for MPI_Comm_f2c. */
    void (*joined)(void* self, int communicator);

    /** An MPI_Comm that the program has split off MPI_COMM_WORLD with colour 1002 or one of its
     * own; 0: the library makes the split. */
    uintptr_t communicator;

    /** Of space that the program plays in: 2 or 3, TURBIDITE_BOTH_DIMENSIONS; 0: 2. */
    int64_t dimensions;

    /** What it can do, TURBIDITE_KNOWS_*: every case that asks for more is then refused, naming
     * the key, before `initialise`. 0: `initialise` has to refuse it. */
    uint64_t knows;
} turbidite_adapter;

/** The text of the failure of the present call, which fails whatever it returns. `unphysical`, if
 * not 0: exit code 6 instead of 4. In `joined`, and before turbidite_run_grains(), it ends the run
 * before it begins. */
void turbidite_fail(const char* text, int unphysical);

/** The whole life of the program. MPI_Init and MPI_Finalize are included, unless MPI runs already.
 * Returns its exit code (turbidite::ExitCode). `argc` and `argv` are those of main, or null.
 *
 * The size tells the library which members the program knows: all later
 * libraries run it. A library that is older than the program refuses it in words, exit code 3, if
 * it uses a member that the library does not know. */
#define turbidite_run_grains(adapter, argc, argv, run_folder) \
    turbidite_run_grains_sized(adapter, sizeof(turbidite_adapter), argc, argv, run_folder)
/** #turbidite_run_grains with the size of the program's turbidite_adapter. */
int turbidite_run_grains_sized(const turbidite_adapter* adapter, size_t adapter_size, int* argc,
                               char*** argv, const char* run_folder);

/** For programs that call MPI_Init themselves: just before. A program that hangs there is then
 * named, instead of those that wait for it. */
void turbidite_before_mpi_init(void);
/** The same just before MPI_Finalize. */
void turbidite_before_mpi_finalize(void);

#ifdef __cplusplus
}
#endif

#endif
