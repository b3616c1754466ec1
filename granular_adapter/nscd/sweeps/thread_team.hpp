// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A few threads that do the same piece of work side by side, again and again.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace turbidite::nscd {

class ThreadTeam {
 public:
    /// The caller is one of them; `size` >= 1.
    explicit ThreadTeam(int size);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    int size() const { return static_cast<int>(threads_.size()) + 1; }

    /// Calls work(0) … work(size - 1), each in its thread, and returns when all are done. The work
    /// must not throw.
    void run(const std::function<void(int)>& work);

    /// Waits for somebody else, first hot, then giving the processor away.
    class Patience {
     public:
        void wait();

     private:
        int turns_ = 0;
    };

 private:
    void serve(int number);

    std::vector<std::thread> threads_;
    const std::function<void(int)>* work_ = nullptr;
    std::atomic<std::int64_t> order_{0};  ///< counts runs; -1: go home
    std::atomic<int> busy_{0};
};

}  // namespace turbidite::nscd
