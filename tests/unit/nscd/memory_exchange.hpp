// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Ranks that are threads of one process.
#pragma once

#include <barrier>
#include <thread>

#include "granular_adapter/nscd/ranks/rank_exchange.hpp"

namespace turbidite::nscd {

/// What the ranks share.
struct RankBoard {
    using Bytes = RankExchange::Bytes;

    explicit RankBoard(int ranks)
        : meeting(ranks),
          given(static_cast<std::size_t>(ranks)),
          parts(static_cast<std::size_t>(ranks)),
          posted(static_cast<std::size_t>(ranks)) {}

    std::barrier<> meeting;
    std::vector<Bytes> given;
    std::vector<std::vector<Bytes>> parts;
    /// By rank, phase and receiver.
    std::vector<std::vector<std::vector<std::vector<double>>>> posted;
};

class MemoryExchange final : public RankExchange {
 public:
    MemoryExchange(RankBoard& board, int rank) : board_(board), rank_(rank) {}

    int rank() const override { return rank_; }
    int size() const override { return static_cast<int>(board_.given.size()); }

    std::vector<Bytes> gather(Bytes mine) override {
        board_.given[own()] = std::move(mine);
        board_.meeting.arrive_and_wait();
        std::vector<Bytes> all = board_.given;
        board_.meeting.arrive_and_wait();
        return all;
    }

    std::vector<Bytes> swap(std::vector<Bytes> parts) override {
        board_.parts[own()] = std::move(parts);
        board_.meeting.arrive_and_wait();
        std::vector<Bytes> got;
        for (const std::vector<Bytes>& of_rank : board_.parts) got.push_back(of_rank.at(own()));
        board_.meeting.arrive_and_wait();
        return got;
    }

    void prepare(const std::vector<Traffic>& phases) override {
        received_.assign(phases.size(), {});
        board_.posted[own()].assign(phases.size(), {});
        for (std::size_t phase = 0; phase < phases.size(); ++phase) {
            for (const std::size_t count : phases[phase].sent)
                board_.posted[own()][phase].emplace_back(count);
            for (const std::size_t count : phases[phase].received)
                received_[phase].emplace_back(count);
        }
        board_.meeting.arrive_and_wait();
    }

    double* outgoing(std::size_t phase, int to) override {
        return board_.posted[own()][phase][static_cast<std::size_t>(to)].data();
    }
    void post(std::size_t) override { board_.meeting.arrive_and_wait(); }
    void await(std::size_t phase) override {
        for (std::size_t from = 0; from < board_.posted.size(); ++from) {
            const std::vector<double>& sent = board_.posted[from][phase][own()];
            moved_ += sent.size();
            // The receiver has to know how much comes.
            if (sent.size() != received_[phase][from].size()) std::abort();
            received_[phase][from] = sent;
        }
        board_.meeting.arrive_and_wait();
    }
    const double* incoming(std::size_t phase, int from) override {
        return received_[phase][static_cast<std::size_t>(from)].data();
    }

    /// Doubles received in phases.
    std::size_t moved() const { return moved_; }

 private:
    std::size_t own() const { return static_cast<std::size_t>(rank_); }

    RankBoard& board_;
    int rank_;
    std::size_t moved_ = 0;
    std::vector<std::vector<std::vector<double>>> received_;
};

/// Calls work(exchange) for every rank in a thread of its own.
template <class Work>
void on_ranks(int ranks, const Work& work) {
    RankBoard board(ranks);
    std::vector<std::thread> threads;
    for (int rank = 0; rank < ranks; ++rank)
        threads.emplace_back([&board, &work, rank] {
            MemoryExchange exchange(board, rank);
            work(exchange);
        });
    for (std::thread& thread : threads) thread.join();
}

}  // namespace turbidite::nscd
