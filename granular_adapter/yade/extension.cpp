// SPDX-License-Identifier: GPL-3.0-or-later
//
// Python module `turbidite_yade`: the participant as a YADE script sees it.
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

// Fetches and clears the present Python error; returns its text.
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

// Text of the exception being handled, if it is one of Python and not of C++.
std::string python_text() {
    try {
        throw;
    } catch (const python::error_already_set&) {
        return "in YADE: " + take_python_error();
    } catch (...) {
        return "in YADE: an exception of unknown type";
    }
}

/// The contact engine with YADE's bodies, for Participant.
struct ContactEngine {
    ContactEngine(const std::string& run_folder, python::object scene, const std::string& version)
        : adapter(std::move(scene), version) {
        adapter.set_run_folder(run_folder);
    }
    YadeAdapter adapter;
};

/// YADE's own engines, for Participant.
struct MolecularDynamics {
    MolecularDynamics(const std::string&, python::object scene, const std::string& version)
        : host(std::move(scene), version), adapter("yade-md", host) {}
    YadeMdHost host;
    MdAdapter adapter;
};

/// One YADE process of the job; `Code` contains the adapter.
template <class Code>
class Participant {
 public:
    /// `communicator`: handle of mpy's communicator. From here on, output goes to
    /// RUN/logs/grains.log.
    Participant(const std::string& run_folder, std::uintptr_t communicator, python::object scene,
                const std::string& yade_version)
        : code_(run_folder, std::move(scene), yade_version),
          membership_(Role::grains, {nullptr, nullptr, run_folder, communicator}),
          session_(make_session(code_.adapter, membership_.channel(), membership_.identity())) {
        session_->explain_other_exceptions(python_text);
    }

    bool start() {
        return answered([this] { return session_->start(); });
    }
    bool step() {
        return answered([this] { return session_->step(); });
    }
    int leave() { return membership_.leave(session_->outcome()); }

    /// The contact memory as bytes.
    python::object contacts() {
        const std::vector<char> bytes = code_.adapter.contacts();
        return python::object(python::handle<>(
            PyBytes_FromStringAndSize(bytes.data(), static_cast<Py_ssize_t>(bytes.size()))));
    }

 private:
    // Errors of a session are not passed to Python, whose exit would hang: they end the job.
    template <class Action>
    bool answered(Action action) {
        try {
            return action();
        } catch (const std::exception& error) {
            membership_.abort(error);
        }
    }

    Code code_;
    Membership membership_;
    std::unique_ptr<Session> session_;
};

template <class Code>
python::class_<Participant<Code>, boost::noncopyable> export_participant(
    const char* name, const char* documentation) {
    using Kind = Participant<Code>;
    return python::class_<Kind, boost::noncopyable>(
               name, documentation,
               python::init<std::string, std::uintptr_t, python::object, std::string>())
        .def("start", &Kind::start, "Handshake and initial state; False when the run is over.")
        .def("step", &Kind::step, "One window; False when the run is over.")
        .def("leave", &Kind::leave, "The exit code of the run, after the last window.");
}

}  // namespace
}  // namespace turbidite::yade

BOOST_PYTHON_MODULE(turbidite_yade) {
    using namespace turbidite::yade;
    export_participant<ContactEngine>(
        "Participant",
        "One YADE process in a coupled job, with the contact engine.\n\nParticipant(run_folder, "
        "communicator, scene, yade_version): the functions that scene must have are listed\nin "
        "granular_adapter/yade/yade_adapter.hpp.")
        .def("contacts", &Participant<ContactEngine>::contacts, "The contact memory as bytes.");
    export_participant<MolecularDynamics>(
        "MdParticipant",
        "One YADE process in a coupled job, with YADE's own engines.\n\nMdParticipant(run_folder, "
        "communicator, scene, yade_version): the functions that scene must have are listed\nin "
        "granular_adapter/yade/yade_md_host.hpp.");
}
