// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/yade_md_host.hpp"

#include <algorithm>
#include <boost/python.hpp>
#include <cmath>
#include <utility>

#include "coupler/protocol/scene/sides.hpp"
#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/byte_stream.hpp"
#include "granular_adapter/yade/bodies/yade_forces.hpp"
#include "granular_adapter/yade/yade_grains.hpp"

namespace turbidite::yade {

namespace python = boost::python;

namespace {

// Number of probes for overlaps while two grains collide; the maximum overlap of a damped collision
// is underestimated by 6 % at most.
constexpr double probes_per_contact = 4.0;

python::list list_of(const std::vector<int>& ids) {
    python::list list;
    for (const int id : ids) list.append(id);
    return list;
}

std::vector<int> ids_of(const python::object& list) {
    std::vector<int> ids;
    for (python::ssize_t i = 0; i < python::len(list); ++i)
        ids.push_back(python::extract<int>(list[i]));
    return ids;
}

bool is_zero(const Load& load) {
    return load.force == Vec3{} && load.torque == Vec3{};
}

}  // namespace

YadeMdHost::YadeMdHost(python::object scene, std::string yade_version)
    : scene_(std::move(scene)), version_(std::move(yade_version)) {}

void YadeMdHost::create(const Settings& settings, const ShapeTable&, const nscd::Bodies& bodies) {
    ids_ = ids_of(scene_.attr("create")(settings_dict(settings), grain_list(bodies)));
    fetch_bodies(bodies.size());
    exchange_.write(bodies);  // their orientations too, which the scene does not set
    radii_ = bodies.radius;
    borders_ = lay_borders(settings);
    in_space_ = dimension_of(settings) == 3;
    stride_ = std::max<std::int64_t>(
        1, std::llround(settings.real("contact.md_substeps") / probes_per_contact));
    scene_.attr("complete")();
}

void YadeMdHost::fetch_bodies(std::size_t grains) {
    exchange_ = BodyExchange(scene_.attr("states")(list_of(ids_)), {}, grains);
}

void YadeMdHost::read(nscd::Bodies& bodies) const {
    exchange_.read(bodies);
}

void YadeMdHost::write(const nscd::Bodies& bodies) {
    exchange_.write(bodies);
}

/// YADE keeps loads until they are set again.
void YadeMdHost::set_loads(const std::vector<Load>& loads) {
    // Loads of zero are set once, to replace those of an earlier window, and then left alone.
    const bool any = !std::all_of(loads.begin(), loads.end(), is_zero);
    if (!any && !loaded_) return;
    const Forces forces(scene_.attr("forces")());
    for (std::size_t i = 0; i < loads.size(); ++i)
        forces.load(ids_[i], loads[i].force, loads[i].torque);
    loaded_ = any;
}

void YadeMdHost::add_forces(SubstepReport& report, double step) const {
    const Forces forces(scene_.attr("forces")());
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        report.impulses[i] = report.impulses[i] + step * forces.force(ids_[i]);
        report.angular_impulses[i] = report.angular_impulses[i] + step * forces.torque(ids_[i]);
    }
}

double YadeMdHost::deepest_overlap(double known) const {
    double deepest = python::extract<double>(scene_.attr("deepest_overlap")(known));
    if (deepest <= known) deepest = 0.0;  // it may be a bound then
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        const Vec3 place = exchange_.position(i);
        for (const Border& border : borders_)
            if (border.side == BorderKind::wall)
                // scene.deepest_overlap() knows pairs of grains only.
                deepest = std::max(deepest, radii_[i] - signed_distance(border.plane, place));
    }
    return deepest;
}

SubstepReport YadeMdHost::run(const Substeps& substeps, const std::vector<Load>& loads) {
    SubstepReport report;
    if (substeps.detailed) {
        report.impulses.assign(ids_.size(), Vec3{});
        report.angular_impulses.assign(ids_.size(), Vec3{});
    }
    scene_.attr("begin_window")();
    set_loads(loads);
    const python::object step = scene_.attr("step");
    for (std::int64_t i = 1; i <= substeps.count; ++i) {
        step();
        if (substeps.detailed) add_forces(report, substeps.step);
        // Looking at all overlaps takes time: some times per contact time, and at the end.
        if (i % stride_ == 0 || i == substeps.count)
            report.max_penetration =
                std::max(report.max_penetration, deepest_overlap(report.max_penetration));
    }
    report.contacts = python::extract<long>(scene_.attr("contacts")());
    if (substeps.detailed)
        report.touching = touching(substeps.step * static_cast<double>(substeps.count));
    return report;
}

/// Entries of scene.touching() (md_scene.py): side of the domain or -1, a, b, sliding, overlap,
/// then three numbers each: point, normal, force on b, branch.
std::vector<ContactRecord> YadeMdHost::touching(double window) const {
    const python::object list = scene_.attr("touching")();
    std::vector<ContactRecord> records;
    for (python::ssize_t i = 0; i < python::len(list); ++i) {
        const python::object contact = list[i];
        const auto number = [&](int k) -> double { return python::extract<double>(contact[k]); };
        ContactRecord record;
        record.wall = python::extract<int>(contact[0]);
        record.a = python::extract<GrainId>(contact[1]);
        record.b = python::extract<GrainId>(contact[2]);
        record.status = python::extract<bool>(contact[3]) ? ContactStatus::sliding : 0;
        record.gap = -number(4);
        const auto vector = [&](int k) -> Vec3 {
            return {number(k), number(k + 1), in_space_ ? number(k + 2) : 0.0};
        };
        record.point = vector(5);
        record.normal = vector(8);
        record.impulse = window * vector(11);
        record.branch = vector(14);
        records.push_back(record);
    }
    std::sort(records.begin(), records.end(), contact_before);
    return records;
}

void YadeMdHost::keep(const std::vector<std::uint8_t>& mask) {
    std::vector<int> kept, gone;
    std::vector<double> radii;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        (mask[i] ? kept : gone).push_back(ids_[i]);
        if (mask[i]) radii.push_back(radii_[i]);
    }
    scene_.attr("erase")(list_of(gone));
    ids_ = std::move(kept);
    radii_ = std::move(radii);
    exchange_.keep(mask);
}

SavedState YadeMdHost::save() const {
    const python::object bytes = scene_.attr("save")();
    char* first = nullptr;
    Py_ssize_t size = 0;
    if (PyBytes_AsStringAndSize(bytes.ptr(), &first, &size) != 0) python::throw_error_already_set();
    nscd::ByteWriter writer;
    writer.array(ids_);
    writer.array(radii_);
    writer.value(loaded_);
    writer.array(std::vector<char>(first, first + size));
    return writer.take();
}

void YadeMdHost::restore(const SavedState& state) {
    nscd::ByteReader reader(state);
    ids_ = reader.array<int>();
    radii_ = reader.array<double>();
    loaded_ = reader.value<bool>();
    const std::vector<char> bytes = reader.array<char>();
    const python::object copy(
        python::handle<>(PyBytes_FromStringAndSize(bytes.data(), Py_ssize_t(bytes.size()))));
    scene_.attr("restore")(copy);
    fetch_bodies(ids_.size());
}

}  // namespace turbidite::yade
