// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/engine_memory.hpp"

#include <utility>

namespace turbidite::yade {
namespace {

/// Removes the walls from an engine during its lifetime.
class WithoutWalls {
 public:
    explicit WithoutWalls(nscd::Engine& engine)
        : engine_(engine), walls_(std::exchange(engine.walls(), {})) {}
    ~WithoutWalls() { engine_.walls() = std::move(walls_); }
    WithoutWalls(const WithoutWalls&) = delete;
    WithoutWalls& operator=(const WithoutWalls&) = delete;

 private:
    nscd::Engine& engine_;
    std::vector<nscd::Wall> walls_;
};

}  // namespace

std::vector<char> contact_memory(nscd::Engine& engine, const nscd::KeyNames* names) {
    const WithoutWalls apart(engine);
    return engine.save_memory(names);
}

void restore_contact_memory(nscd::Engine& engine, const std::vector<char>& bytes) {
    const WithoutWalls apart(engine);
    engine.restore_memory(bytes);
}

}  // namespace turbidite::yade
