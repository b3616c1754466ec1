// SPDX-License-Identifier: GPL-3.0-or-later
//
// Python module `turbidite_contact_engine`, the basis of the package `turbidite_contact`.
#include <boost/python.hpp>
#include <string>

#include "coupler/keys/key_check.hpp"
#include "coupler/protocol/files/freed_memory.hpp"
#include "coupler/shapes/polygon_outline.hpp"
#include "granular_adapter/contact_keys/contact_keys.hpp"
#include "granular_adapter/nscd_adapter/contact_settings.hpp"
#include "granular_adapter/yade/contact_host.hpp"

namespace turbidite::yade {
namespace {

namespace python = boost::python;

template <class T>
T field(const python::object& record, const char* name) {
    return python::extract<T>(record[name]);
}

Vec3 triple(const python::object& sequence) {
    return {python::extract<double>(sequence[0]), python::extract<double>(sequence[1]),
            python::extract<double>(sequence[2])};
}

python::tuple tuple_of(const Vec3& v) {
    return python::make_tuple(v[0], v[1], v[2]);
}

template <class T, class Read>
std::vector<T> vector_of(const python::object& list, Read read) {
    std::vector<T> result;
    for (python::ssize_t i = 0; i < python::len(list); ++i) result.push_back(read(list[i]));
    return result;
}

/// contact.* from {"tolerance": "1e-3", ...}, checked like those of a case file, with defaults
/// filled in.
Settings checked_settings(const python::dict& options) {
    CaseEntries entries;
    // Where bodies move is the scene's: keys of space are known, and have no effect in the plane.
    CaseEntry dimension;
    dimension.source = "turbidite_contact";
    dimension.key = "dimension";
    dimension.value = "3";
    entries.entries.push_back(dimension);
    const python::list items = options.items();
    for (python::ssize_t i = 0; i < python::len(items); ++i) {
        CaseEntry entry;
        entry.source = "turbidite_contact";
        entry.key = "contact." + std::string(python::extract<std::string>(items[i][0]));
        entry.value = python::extract<std::string>(items[i][1]);
        entries.entries.push_back(entry);
    }
    auto [settings, problems] = check_keys(contact_key_table(), entries);
    CaseProblems ours;
    for (const CaseProblem& problem : problems)
        if (problem.key.rfind("contact.", 0) == 0) ours.push_back(problem);
    if (!ours.empty()) throw CaseRefused(ours);
    // The units of the keys in SI: m/s, m, N.
    for (const char* unit : {"run.velocity_scale", "run.diameter", "run.grain_weight"})
        settings.set(unit, 1.0);
    return settings;
}

/// `diameter`: of the grains between which the force of bridges and bonds is adhesion_force.
nscd::EngineSettings engine_settings(const python::dict& options, const python::object& gravity,
                                     double diameter) {
    nscd::EngineSettings settings = contact_settings(checked_settings(options));
    settings.gravity = triple(gravity);
    settings.law_settings.reference_diameter = diameter;
    return settings;
}

std::vector<double> numbers(const python::object& list) {
    return vector_of<double>(list,
                             [](const python::object& x) { return python::extract<double>(x)(); });
}

ShapeRecord shape_of(const python::object& record) {
    return {field<std::string>(record, "kind"), numbers(record["vertices"])};
}

/// Position and normal are relative to the body's position, in its axes.
nscd::Wall wall_of(const python::object& record) {
    nscd::Wall wall;
    wall.point = triple(record["point"]);
    wall.normal = triple(record["normal"]);
    wall.material = field<std::int32_t>(record, "material");
    const python::object half_length = record["half_length"];  // None: a half-plane
    if (!half_length.is_none()) wall.half_length = python::extract<double>(half_length);
    wall.key = field<std::int32_t>(record, "key");
    return wall;
}

nscd::Body body_of(const python::object& record) {
    nscd::Body body;
    body.id = field<GrainId>(record, "id");
    body.shape = field<std::int32_t>(record, "shape");
    body.material = field<std::int32_t>(record, "material");
    body.radius = field<double>(record, "radius");
    body.density = field<double>(record, "density");
    body.mass = field<double>(record, "mass");
    body.inertia = field<double>(record, "inertia");
    body.weight_mass = body.mass;
    body.fixed = field<bool>(record, "fixed");
    body.rotation_blocked = field<bool>(record, "rotation_blocked");
    // What nothing depends on may be anything in YADE, zero too.
    if (body.fixed) body.mass = 1.0;
    if (body.fixed || body.rotation_blocked) body.inertia = 1.0;
    return body;
}

/// None for discs, else (w, x, y, z).
Turn turn_of(const python::object& rotation) {
    if (rotation.is_none()) return {};
    return {true,
            {python::extract<double>(rotation[0]), python::extract<double>(rotation[1]),
             python::extract<double>(rotation[2]), python::extract<double>(rotation[3])}};
}

/// Converts the description of YADE's bodies made by turbidite_contact/scene.py.
Layout layout_of(const python::object& scene) {
    Layout layout;
    layout.dimension = field<int>(scene, "dimension");
    layout.shapes = vector_of<ShapeRecord>(scene["shapes"], shape_of);
    layout.frictions = numbers(scene["frictions"]);
    layout.walls = HostedWalls(vector_of<nscd::Wall>(scene["walls"], wall_of),
                               BodyStates(scene["wall_states"]));
    layout.bodies = vector_of<nscd::Body>(scene["bodies"], body_of);
    layout.states = BodyStates(scene["states"]);
    layout.turns = vector_of<Turn>(scene["turns"], turn_of);
    layout.box.length = triple(scene["period"]);
    layout.watch = SceneWatch(field<std::size_t>(scene, "count"), scene["watched"], layout.states);
    return layout;
}

python::dict report_dict(const nscd::StepReport& report) {
    python::dict result;
    result["candidates"] = report.candidates;
    result["contacts"] = report.contacts;
    result["iterations"] = report.iterations;
    result["residual"] = report.residual;
    result["quad"] = report.change.quad;
    result["max"] = report.change.max;
    result["converged"] = report.converged;
    return result;
}

std::vector<Vec3> triples(const python::object& list) {
    return vector_of<Vec3>(list, triple);
}

/// Throws std::invalid_argument naming the invalid vertex.
void check_outline(const python::object& vertices) {
    normalised_outline(numbers(vertices));
}

class ContactEngine {
 public:
    ContactEngine(const python::dict& options, const python::object& gravity, double diameter)
        : host_(engine_settings(options, gravity, diameter)) {}

    void lay_out(const python::object& scene) { host_.lay_out(layout_of(scene)); }

    bool outdated(std::size_t count) const { return host_.outdated(count); }

    python::dict step(double dt, const python::object& forces, const python::object& torques) {
        return report_dict(host_.step(dt, {triples(forces), triples(torques)}));
    }

    /// (first, second, depth, depth over the smaller radius, whether first is a wall), or None.
    python::object overlap() const {
        const auto pair = host_.overlap();
        if (!pair) return {};
        return python::make_tuple(pair->first, pair->second, pair->depth, pair->share, pair->wall);
    }

    double max_penetration() { return host_.max_penetration(); }

    python::object memory() const {
        const std::vector<char> bytes = host_.memory();
        return python::object(python::handle<>(
            PyBytes_FromStringAndSize(bytes.data(), static_cast<Py_ssize_t>(bytes.size()))));
    }

    void restore_memory(const python::object& bytes) {
        char* data = nullptr;
        Py_ssize_t size = 0;
        if (PyBytes_AsStringAndSize(bytes.ptr(), &data, &size) != 0)
            python::throw_error_already_set();
        host_.restore_memory({data, data + size});
    }

    python::list contacts() const {
        python::list result;
        for (const ContactForce& contact : host_.contacts())
            result.append(python::make_tuple(contact.first, contact.second, tuple_of(contact.point),
                                             tuple_of(contact.normal), contact.gap,
                                             contact.normal_force, tuple_of(contact.shear_force),
                                             contact.rolling_moment, contact.wall));
        return result;
    }

    /// (id, impulse, angular impulse) of every body in the last step.
    python::list impulses() const {
        const nscd::Bodies& bodies = host_.engine().bodies();
        python::list result;
        for (std::size_t i = 0; i < bodies.size(); ++i)
            result.append(python::make_tuple(bodies.id[i], tuple_of(bodies.contact_impulse[i]),
                                             tuple_of(bodies.contact_angular_impulse[i])));
        return result;
    }

 private:
    ContactHost host_;
};

}  // namespace
}  // namespace turbidite::yade

BOOST_PYTHON_MODULE(turbidite_contact_engine) {
    using turbidite::yade::check_outline;
    using turbidite::yade::ContactEngine;
    namespace python = boost::python;
    turbidite::keep_freed_memory();
    python::def("check_outline", check_outline,
                "check_outline([x, y, ...]): ValueError unless it is a convex polygon.");
    python::class_<ContactEngine, boost::noncopyable>(
        "ContactEngine",
        "The contact engine over bodies of YADE.\n\n"
        "ContactEngine(options, gravity, diameter): options are keys of the group contact as "
        "texts.",
        python::init<python::dict, python::object, double>())
        .def("lay_out", &ContactEngine::lay_out,
             "Sets the scene; impulses of known pairs are kept.")
        .def("outdated", &ContactEngine::outdated,
             "outdated(len(O.bodies)): whether the scene is no longer the one laid out.")
        .def("step", &ContactEngine::step,
             "step(dt, forces, torques): one step; returns the results of the solver.")
        .def("overlap", &ContactEngine::overlap,
             "(first, second, depth, share of the smaller radius, wall?) of the worst pair, or "
             "None.")
        .def("max_penetration", &ContactEngine::max_penetration, "Deepest overlap [m].")
        .def("memory", &ContactEngine::memory, "Contact impulses and states as bytes.")
        .def("restore_memory", &ContactEngine::restore_memory, "The inverse of memory().")
        .def("contacts", &ContactEngine::contacts,
             "(first, second, point, normal, gap, normal force, shear force, rolling moment, "
             "wall?) of every contact of the last step with a force.")
        .def("impulses", &ContactEngine::impulses,
             "(id, impulse, angular impulse) of every body in the last step.");
}
