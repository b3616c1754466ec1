// SPDX-License-Identifier: GPL-3.0-or-later
//
// Python module `turbidite_yade`: what a YADE script sees of the participant.
#include <boost/python.hpp>
#include <memory>
#include <string>

#include "coupler/participant/participant.hpp"
#include "granular_adapter/md/md_adapter.hpp"
#include "granular_adapter/yade/yade_adapter.hpp"
#include "granular_adapter/yade/yade_md_host.hpp"

namespace turbidite::yade {
namespace {

namespace python = boost::python;

// The text of the Python exception that is set, which thereby is handled.
std::string take_python_error() {
    PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
    PyErr_Fetch(&type, &value, &trace);
    PyErr_NormalizeException(&type, &value, &trace);
    const python::object traceback = python::import("traceback");
    const auto object = [](PyObject* p) {
        return p ? python::object(python::handle<>(p)) : python::object();
    };
    const python::object lines =
        traceback.attr("format_exception")(object(type), object(value), object(trace));
    return python::extract<std::string>(python::str("").join(lines));
}

// Python exceptions of the scene's functions travel on as ordinary ones.
template <class Action>
auto guarded(Action action) {
    try {
        return action();
    } catch (const python::error_already_set&) {
        throw Failure(ExitCode::participant_failed, "in YADE: " + take_python_error());
    }
}

class GuardedAdapter final : public GrainsAdapter {
 public:
    explicit GuardedAdapter(std::unique_ptr<GrainsAdapter> inner) : inner_(std::move(inner)) {}

    Hello describe() const override { return inner_->describe(); }
    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override {
        return guarded([&] { return inner_->initialise(settings, shapes, grains); });
    }
    Motion advance(const Window& window, const std::vector<FreeResponse>& responses) override {
        return guarded([&] { return inner_->advance(window, responses); });
    }
    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override {
        return guarded([&] { return inner_->apply_kick(window, kicks); });
    }
    SavedState save() const override {
        return guarded([&] { return inner_->save(); });
    }
    void restore(const SavedState& state) override {
        guarded([&] { return inner_->restore(state), 0; });
    }

 private:
    std::unique_ptr<GrainsAdapter> inner_;
};

/// One YADE process in the job.
class Participant {
 public:
    /// `communicator`: handle of mpy's communicator. Output goes to RUN/logs/grains.log from here
    /// on.
    Participant(std::unique_ptr<GrainsAdapter> adapter, const std::string& run_folder,
                std::uintptr_t communicator)
        : adapter_(std::move(adapter)) {
        Launch launch;
        launch.run_folder = run_folder;
        launch.communicator = communicator;
        membership_ = std::make_unique<Membership>(Role::grains, launch);
        session_ = make_session(adapter_, membership_->channel(), membership_->identity());
    }

    bool start() {
        return answered([this] { return session_->start(); });
    }
    bool step() {
        return answered([this] { return session_->step(); });
    }
    int leave() { return membership_->leave(session_->outcome()); }

 private:
    // What a session throws is no matter for Python, whose exit would hang: it ends the job.
    template <class Action>
    bool answered(Action action) {
        try {
            return action();
        } catch (const std::exception& error) {
            membership_->abort(error);
        }
    }

    GuardedAdapter adapter_;
    std::unique_ptr<Membership> membership_;
    std::unique_ptr<Session> session_;
};

std::unique_ptr<YadeAdapter> nscd_adapter(const std::string& run_folder, python::object scene,
                                          const std::string& yade_version) {
    auto adapter = std::make_unique<YadeAdapter>(std::move(scene), yade_version);
    adapter->set_run_folder(run_folder);
    return adapter;
}

/// The contact engine with YADE's bodies.
class NscdParticipant final : public Participant {
 public:
    NscdParticipant(const std::string& run_folder, std::uintptr_t communicator,
                    python::object scene, const std::string& yade_version)
        : NscdParticipant(nscd_adapter(run_folder, std::move(scene), yade_version).release(),
                          run_folder, communicator) {}

    /// What contacts remember, as bytes.
    python::object contacts() {
        const std::vector<char> bytes = adapter_.contacts();
        return python::object(python::handle<>(
            PyBytes_FromStringAndSize(bytes.data(), static_cast<Py_ssize_t>(bytes.size()))));
    }

 private:
    NscdParticipant(YadeAdapter* adapter, const std::string& run_folder,
                    std::uintptr_t communicator)
        : Participant(std::unique_ptr<GrainsAdapter>(adapter), run_folder, communicator),
          adapter_(*adapter) {}

    YadeAdapter& adapter_;  ///< owned by the base
};

/// A host and the adapter that drives it.
class YadeMdAdapter final : public GrainsAdapter {
 public:
    YadeMdAdapter(python::object scene, const std::string& yade_version)
        : host_(std::move(scene), yade_version), adapter_("yade-md", host_) {}

    Hello describe() const override { return adapter_.describe(); }
    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override {
        return adapter_.initialise(settings, shapes, grains);
    }
    Motion advance(const Window& window, const std::vector<FreeResponse>& responses) override {
        return adapter_.advance(window, responses);
    }
    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override {
        return adapter_.apply_kick(window, kicks);
    }
    SavedState save() const override { return adapter_.save(); }
    void restore(const SavedState& state) override { adapter_.restore(state); }

 private:
    YadeMdHost host_;
    MdAdapter adapter_;
};

/// YADE's own engines.
class MdParticipant final : public Participant {
 public:
    MdParticipant(const std::string& run_folder, std::uintptr_t communicator, python::object scene,
                  const std::string& yade_version)
        : Participant(std::make_unique<YadeMdAdapter>(scene, yade_version), run_folder,
                      communicator) {}
};

template <class Kind>
python::class_<Kind, boost::noncopyable> export_participant(const char* name,
                                                            const char* documentation) {
    return python::class_<Kind, boost::noncopyable>(
               name, documentation,
               python::init<std::string, std::uintptr_t, python::object, std::string>())
        .def("start", &Participant::start,
             "Handshake and initial state; False when the run is over.")
        .def("step", &Participant::step, "One window; False when the run is over.")
        .def("leave", &Participant::leave, "The exit code of the run, after the last window.");
}

}  // namespace
}  // namespace turbidite::yade

BOOST_PYTHON_MODULE(turbidite_yade) {
    using namespace turbidite::yade;
    export_participant<NscdParticipant>(
        "Participant",
        "One YADE process in a coupled job, with the contact engine.\n\n"
        "Participant(run_folder, communicator, scene, yade_version): scene has create(settings, "
        "grains),\n"
        "which returns the states of the bodies it built and how YADE turned their axes\n"
        "((w, x, y, z), None for discs), and erase(ids).")
        .def("contacts", &NscdParticipant::contacts, "What contacts remember, as bytes.");
    export_participant<MdParticipant>(
        "MdParticipant",
        "One YADE process in a coupled job, with YADE's own engines.\n\n"
        "MdParticipant(run_folder, communicator, scene, yade_version): what scene must have stands "
        "in\n"
        "granular_adapter/yade/yade_md_host.hpp.");
}
