// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/call_trace.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <mutex>

namespace turbidite::trace {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> active{false};
std::mutex one_at_a_time;
std::vector<Call> recorded;

template <class Function>
Function* of_libc(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

fs::path path_of(int descriptor) {
    std::error_code gone;
    return fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor), gone);
}

void record(Call call) {
    const std::lock_guard lock(one_at_a_time);
    recorded.push_back(std::move(call));
}

Call rename_call(const fs::path& from, const fs::path& to) {
    Call call{Call::Kind::rename, fs::absolute(from), fs::absolute(to), version_of(from), {}};
    std::error_code no_folder;
    for (const auto& entry : fs::directory_iterator(from, no_folder))
        call.content[entry.path()] = version_of(entry.path());
    return call;
}

}  // namespace

Version version_of(const fs::path& path) {
    struct stat found {};
    if (::stat(path.c_str(), &found) != 0) return {};
    return {static_cast<long>(found.st_size), found.st_mtim};
}

Recorder::Recorder() {
    recorded.clear();
    active = true;
}

Recorder::~Recorder() {
    active = false;
}

std::vector<Call> Recorder::calls() const {
    const std::lock_guard lock(one_at_a_time);
    return recorded;
}

std::map<fs::path, Version> on_disk(const std::vector<Call>& calls) {
    std::map<fs::path, Version> versions;
    for (const Call& call : calls) {
        if (call.kind == Call::Kind::sync) {
            versions[call.path] = call.version;
            continue;
        }
        const auto old = versions.find(call.path);
        if (old == versions.end()) continue;
        versions[call.to] = old->second;
        versions.erase(old);
    }
    return versions;
}

}  // namespace turbidite::trace

namespace trace = turbidite::trace;

extern "C" int fsync(int descriptor) {
    static auto* const original = trace::of_libc<int(int)>("fsync");
    const int result = original(descriptor);
    if (trace::active && result == 0) {
        const auto path = trace::path_of(descriptor);
        trace::record({trace::Call::Kind::sync, path, {}, trace::version_of(path), {}});
    }
    return result;
}

extern "C" int rename(const char* from, const char* to) noexcept {
    static auto* const original = trace::of_libc<int(const char*, const char*)>("rename");
    if (!trace::active) return original(from, to);
    trace::Call call = trace::rename_call(from, to);
    const int result = original(from, to);
    if (result == 0) trace::record(std::move(call));
    return result;
}
