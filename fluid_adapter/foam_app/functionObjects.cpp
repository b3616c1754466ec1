// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/functionObjects.hpp"

#include <OSspecific.H>
#include <timeControlFunctionObject.H>

#include "fluid_adapter/foam_app/foamErrors.hpp"

namespace turbidite {
namespace {

const Foam::dictionary* functions_of(const Foam::Time& time) {
    return time.controlDict().findDict("functions", Foam::keyType::LITERAL);
}

/// A dictionary that is not switched off.
bool is_wanted(const Foam::entry& entry) {
    return entry.isDict() && entry.dict().getOrDefault("enabled", true);
}

bool has_any(const Foam::Time& time) {
    const Foam::dictionary* functions = functions_of(time);
    if (functions)
        for (const Foam::entry& entry : *functions)
            if (is_wanted(entry)) return true;
    return false;
}

/// OpenFOAM would go on with a warning.
void open_libraries(Foam::Time& time, const Foam::dictionary& entries, const Foam::word& object) {
    Foam::fileNameList names;
    for (const char* key : {"libs", "functionObjectLibs"})
        if (names.empty()) entries.readIfPresent(key, names);
    for (const Foam::fileName& name : names) {
        std::string why;
        if (Foam::dlOpen(Foam::fileName(name).expand(), why) != nullptr)
            time.libs().open(name, false);
        else
            throw Failure(ExitCode::participant_failed, "fluid.functions: the library " + name +
                                                            " of " + object +
                                                            " cannot be loaded: " + why);
    }
}

}  // namespace

FunctionObjects::FunctionObjects(Foam::Time& time) : time_(time), any_(has_any(time)) {
    // Dictionaries may name files by $FOAM_CASE or <case>.
    Foam::setEnv("FOAM_CASE", time.rootPath() / time.globalCaseName(), true);
    Foam::setEnv("FOAM_CASENAME", time.globalCaseName(), true);
}

void FunctionObjects::begin() {
    if (made_ || !any_) return;
    made_ = true;
    time_.functionObjects().start();  // reads what objects of an earlier part remember
    const Foam::dictionary& functions = *functions_of(time_);
    open_libraries(time_, functions, "functions");
    for (const Foam::entry& entry : functions)
        if (is_wanted(entry)) make(entry.keyword(), entry.dict());
}

void FunctionObjects::make(const Foam::word& name, const Foam::dictionary& entries) {
    using Timed = Foam::functionObjects::timeControl;
    open_libraries(time_, entries, name);
    try {
        if (Timed::entriesPresent(entries))
            objects_.push_back(std::make_unique<Timed>(name, time_, entries));
        else
            objects_.emplace_back(Foam::functionObject::New(name, time_, entries).release());
    } catch (const Foam::error& error) {
        throw Failure(ExitCode::participant_failed,
                      "fluid.functions: OpenFOAM cannot make " + name + ": " + text_of(error));
    }
}

void FunctionObjects::execute() {
    for (const auto& object : objects_)
        with_foam_errors("function object " + object->name(), [&] {
            object->execute();
            object->write();
        });
    // Of OpenFOAM's own list, which is empty: writes at output times what objects remember.
    time_.functionObjects().execute();
}

void FunctionObjects::end() {
    for (const auto& object : objects_)
        with_foam_errors("function object " + object->name(), [&] { object->end(); });
}

}  // namespace turbidite
