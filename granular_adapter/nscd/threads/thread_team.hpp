// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A few threads that repeatedly run the same function in parallel.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace turbidite::nscd {

class ThreadTeam {
 public:
    /// The calling thread is one of them; `size` >= 1.
    explicit ThreadTeam(int size);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    int size() const { return static_cast<int>(threads_.size()) + 1; }

    /// Where the part of a thread begins when `count` pieces are shared; it ends where the next
    /// begins.
    std::size_t part_begin(std::size_t count, int thread) const {
        return count * static_cast<std::size_t>(thread) / static_cast<std::size_t>(size());
    }

    /// Calls work(0) … work(size - 1), each in its own thread, and returns when all are done.
    /// Throws what the first of them has thrown.
    void run(const std::function<void(int)>& work);

    /// Waits for another thread, first spinning, then yielding the processor.
    class Patience {
     public:
        void wait();

     private:
        int turns_ = 0;
    };

    /// Where all threads of a team wait for each other, any number of times.
    class Meeting {
     public:
        explicit Meeting(int threads) : threads_(threads) {}
        void wait();

     private:
        std::int64_t threads_;
        std::atomic<std::int64_t> arrivals_{0};
    };

 private:
    void serve(int number);
    void work_as(int number);

    std::vector<std::thread> threads_;
    const std::function<void(int)>* work_ = nullptr;
    std::atomic<std::int64_t> order_{0};  ///< number of runs started; -1: exit
    std::atomic<int> busy_{0};
    std::mutex failing_;
    std::exception_ptr failure_;  ///< the first of the present run
};

}  // namespace turbidite::nscd
