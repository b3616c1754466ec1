// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The part of an exchange that is repeated in phases (nscd/ranks/rank_exchange.hpp), one class per
// way in which doubles travel.
#pragma once

#include <mpi.h>

#include "granular_adapter/nscd/ranks/rank_exchange.hpp"

namespace turbidite::nscd {

class PhaseTransport {
 public:
    using Traffic = RankExchange::Traffic;

    virtual ~PhaseTransport() = default;
    virtual void prepare(const std::vector<Traffic>& phases) = 0;
    virtual double* outgoing(std::size_t phase, int to) = 0;
    virtual void post(std::size_t phase) = 0;
    virtual void await(std::size_t phase) = 0;
    virtual const double* incoming(std::size_t phase, int from) = 0;
};

}  // namespace turbidite::nscd
