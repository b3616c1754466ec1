// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/lammps_md_host.hpp"

#include <fmt/format.h>
#include <lammps/library.h>

#include <algorithm>
#include <cmath>

#include "coupler/protocol/run_values.hpp"
#include "granular_adapter/lammps/state_file.hpp"

namespace turbidite::lammps {
namespace {

// Number of probes for overlaps while two grains collide; the maximum overlap of a damped collision
// is underestimated by 6 % at most.
constexpr double probes_per_contact = 4.0;

// Pairs up to this distance are neighbours, over the smallest radius. LAMMPS searches anew when a
// grain has moved half of it.
constexpr double neighbour_margin = 0.2;

// A grain leaves a window after it has passed a free side by its radius. LAMMPS' box reaches beyond
// by so many of the largest radii, one of them for the way of the window.
constexpr double beyond_free_sides = 2.0;

double smallest_of_all(double mine, MPI_Comm communicator) {
    double all = mine;
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MIN, communicator);
    return all;
}

double largest_of_all(double mine, MPI_Comm communicator) {
    return -smallest_of_all(-mine, communicator);
}

bool any_of_all(bool mine, MPI_Comm communicator) {
    int one = mine, all = 0;
    MPI_Allreduce(&one, &all, 1, MPI_INT, MPI_LOR, communicator);
    return all != 0;
}

}  // namespace

void LammpsMdHost::join(MPI_Comm communicator) {
    ranks_.communicator = communicator;
    MPI_Comm_rank(communicator, &ranks_.own);
    MPI_Comm_size(communicator, &ranks_.size);
    lammps_ = std::make_unique<Library>(communicator);
}

std::string LammpsMdHost::code() const {
    return "LAMMPS " + std::to_string(lammps_->version());
}

void LammpsMdHost::create(const Settings& settings, const ShapeTable&, const nscd::Bodies& bodies) {
    const RunValues run = run_values(settings);
    gravity_ = run.gravity;
    size_ = run.size;
    const nscd::PeriodicBox period{{}, run.period};
    grains_.emplace(*lammps_, run.dimension, period);
    borders_ = lay_borders(settings);
    law_.emplace(settings);
    stride_ = std::max<std::int64_t>(
        1, std::llround(settings.real("contact.md_substeps") / probes_per_contact));
    classes_.emplace(bodies.mass, ranks_.communicator);
    walls_ = wall_fixes(*classes_, borders_);
    // A rank without grains must not decide: the size of the domain is larger than any radius.
    double radius = size_[0], largest = 0.0;
    for (const double r : bodies.radius)
        radius = std::min(radius, r), largest = std::max(largest, r);
    skin_ = neighbour_margin * smallest_of_all(radius, ranks_.communicator);
    declare_box(*lammps_, run.dimension, size_, period, borders_,
                beyond_free_sides * largest_of_all(largest, ranks_.communicator),
                classes_->masses().size());
    declare_properties(*lammps_, run.dimension);
    grains_->create(bodies, *classes_, ranks_.communicator);
    start_engines();
    follow_grains();
}

void LammpsMdHost::start_engines() {
    declare_engines(*lammps_, {*law_, *classes_, borders_, skin_, grains_->in_space()});
    lammps_set_fix_external_callback(lammps_->handle(), loads_fix, on_substep, this);
}

void LammpsMdHost::read(nscd::Bodies& bodies) const {
    grains_->read(bodies);
}

void LammpsMdHost::write(const nscd::Bodies& bodies) {
    grains_->write(bodies);
}

// ---- sub-steps -------------------------------------------------------------------------------

void LammpsMdHost::load_grains(const std::vector<Load>& loads) {
    const Freedom free = grains_->freedom();
    double** own = lammps_->atoms<double**>("d2_own");
    grains_->for_each([&](std::size_t place, int i) {
        free.each_push([&](int axis) {
            own[i][free.load[axis]] = loads[place].force[axis], own[i][free.impulse[axis]] = 0.0;
        });
        free.each_turn([&](int axis) {
            own[i][free.load_turn[axis]] = loads[place].torque[axis];
            own[i][free.impulse_turn[axis]] = 0.0;
        });
    });
}

SubstepReport LammpsMdHost::run(const Substeps& substeps, const std::vector<Load>& loads) {
    load_grains(loads);
    present_ = {lammps_->step(), lammps_->step() + substeps.count, substeps.step,
                substeps.detailed};
    lammps_->command(fmt::format("timestep {:.17g}", substeps.step));
    lammps_->command(fmt::format("run {} post no", substeps.count));
    follow_grains();
    SubstepReport report;
    report.contacts = present_.contacts;
    report.max_penetration = present_.deepest;
    if (!substeps.detailed) return report;
    collect_impulses(report);
    report.touching = std::move(present_.touching);
    return report;
}

void LammpsMdHost::collect_impulses(SubstepReport& report) const {
    const auto count = static_cast<std::size_t>(lammps_->local_count());
    report.impulses.assign(count, Vec3{});
    report.angular_impulses.assign(count, Vec3{});
    double** own = lammps_->atoms<double**>("d2_own");
    const Freedom free = grains_->freedom();
    grains_->for_each([&](std::size_t place, int i) {
        free.each_push(
            [&](int axis) { report.impulses[place][axis] = own[i][free.impulse[axis]]; });
        free.each_turn([&](int axis) {
            report.angular_impulses[place][axis] = own[i][free.impulse_turn[axis]];
        });
    });
}

/// The forces that LAMMPS asks for are added here to its own arrays, with the moments, for which it
/// does not ask.
void LammpsMdHost::on_substep(void* host, std::int64_t substep, int count, int*, double**,
                              double** forces) {
    for (int i = 0; i < count; ++i) std::fill_n(forces[i], 3, 0.0);
    static_cast<LammpsMdHost*>(host)->act(substep);
}

/// Velocity Verlet: the forces at the beginning and at the end act for half a sub-step.
void LammpsMdHost::act(std::int64_t substep) {
    const bool begins = substep == present_.first, ends = substep == present_.last;
    // count + 1 calls for count sub-steps: the first one is at the start, before anything has
    // moved.
    add_loads((begins || ends ? 0.5 : 1.0) * present_.step, begins);
    if (ends || (!begins && (substep - present_.first) % stride_ == 0)) probe();
    if (ends && present_.detailed) list_contacts();
}

/// Here, since LAMMPS computes the forces between grains again for the list: the velocities of
/// grains and of their copies are those of which it has made the forces, in the middle of the
/// sub-step. After it grains have new velocities, and copies on other ranks and beyond cyclic sides
/// do not.
void LammpsMdHost::list_contacts() {
    const auto window = static_cast<double>(present_.last - present_.first) * present_.step;
    present_.touching = touching(*lammps_, *grains_, walls_, size_, law_->friction, window);
}

void LammpsMdHost::add_loads(double time, bool begins) {
    double** f = lammps_->atoms<double**>("f");
    double** torque = lammps_->atoms<double**>("torque");
    double** omega = lammps_->atoms<double**>("omega");
    double** own = lammps_->atoms<double**>("d2_own");
    const Freedom free = grains_->freedom();
    const double* mass = lammps_->atoms<double*>("rmass");
    for (int i = 0; i < lammps_->local_count(); ++i) {
        double* mine = own[i];
        free.each_push([&](int axis) {
            f[i][axis] += mine[free.load[axis]];
            // All forces but the weight, which is added below.
            mine[free.impulse[axis]] += time * f[i][axis];
        });
        free.each_turn([&](int axis) {
            torque[i][axis] += mine[free.load_turn[axis]];
            mine[free.impulse_turn[axis]] += time * torque[i][axis];
            // LAMMPS divides torques by its own moment c m R^2; with the factor c m R^2/I by I.
            torque[i][axis] *= mine[turn_factor];
        });
        f[i][1] -= mass[i] * gravity_;
        // omega is that of the middle of the sub-step here, as the velocity that has moved the
        // position.
        if (!begins) grains_->turn(mine, omega[i], present_.step);
    }
}

void LammpsMdHost::probe() {
    const Overlaps found = overlaps(*lammps_, walls_);
    present_.contacts = found.contacts;
    present_.deepest = std::max(present_.deepest, found.deepest);
}

// ---- bodies that come and go -----------------------------------------------------------------

void LammpsMdHost::follow_grains() {
    // On one rank grains keep their places, in whatever order LAMMPS has them.
    if (ranks_.size == 1) return;
    order_ = new_order(grains_->origins(), ranks_.own);
    const bool arrived = std::any_of(order_.begin(), order_.end(),
                                     [this](const Origin& o) { return o.rank != ranks_.own; });
    migrated_ = any_of_all(arrived, ranks_.communicator);
    if (migrated_) grains_->number(order_, ranks_.own);
}

std::vector<char> LammpsMdHost::migrate(const std::vector<char>& rows, std::size_t row_size) {
    return fetch_rows(order_, rows, row_size, ranks_.communicator);
}

bool LammpsMdHost::on_all_ranks(bool here) {
    return ranks_.size == 1 ? here : !any_of_all(!here, ranks_.communicator);
}

std::vector<GrainId> LammpsMdHost::from_all_ranks(const std::vector<GrainId>& ids) {
    return gather_all(ids, ranks_.communicator);
}

void LammpsMdHost::keep(const std::vector<std::uint8_t>& mask) {
    std::vector<std::int64_t> mine;
    std::vector<Origin> stays;
    const int* tag = lammps_->atoms<int*>("id");
    grains_->for_each([&](std::size_t place, int i) {
        if (!mask[place]) mine.push_back(tag[i]);
    });
    for (std::size_t place = 0; place < mask.size(); ++place)
        if (mask[place]) stays.push_back({ranks_.own, int(place)});
    // LAMMPS deletes grains in a command of all ranks, which needs the same list everywhere.
    const std::vector<std::int64_t> gone = gather_all(mine, ranks_.communicator);
    if (gone.empty()) return;
    grains_->remove(gone);
    grains_->number(stays, ranks_.own);
}

// ---- state -----------------------------------------------------------------------------------

/// LAMMPS' own restart file, springs included, with the grains of all ranks: the state of the first
/// rank; others have none. Without `noinit` LAMMPS would move grains between ranks.
SavedState LammpsMdHost::save() const {
    const StateFile file(ranks_.communicator);
    lammps_->command("write_restart " + file.name() + " noinit");
    return ranks_.own == 0 ? file.read() : SavedState{};
}

/// A run of no sub-steps: springs that were read belong to the grains until the list of neighbours
/// has them, from which a restart file takes them. Grains may arrive here from other ranks.
void LammpsMdHost::find_neighbours() {
    present_ = {lammps_->step(), lammps_->step()};
    lammps_->command("run 0 post no");
    follow_grains();
}

void LammpsMdHost::restore(const SavedState& state) {
    const StateFile file(ranks_.communicator);
    if (ranks_.own == 0) file.write(state);
    lammps_->command("clear");
    // Neither has it the strips of ranks along x (scene.cpp).
    lammps_->command(strips_along_x);
    lammps_->command("read_restart " + file.name());
    // A restart file has atoms and their values, not the commands of the scene.
    declare_properties(*lammps_, grains_->in_space() ? 3 : 2);
    start_engines();
    find_neighbours();
}

}  // namespace turbidite::lammps
