// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Checks on the numbers of a message before they are used. Whatever is wrong is told with the name
// of the program that sent it: everything it had received itself was checked in the same way.
#pragma once

#include <cstdint>
#include <string>

#include "coupler/hub/participant_link.hpp"
#include "coupler/protocol/records.hpp"

namespace turbidite {

/// A message that all ranks of a participant have delivered.
class Arrival {
 public:
    /// `window` is negative before the first one.
    Arrival(const ParticipantLink& from, Kind kind, std::int64_t window);

    /// Throw PhysicsRefused naming sender, message, window, the first bad grain and its quantity.
    void check(int rank, const Motion& share) const;
    void check(int rank, const Kicks& share) const;
    void check(int rank, const std::vector<FreeResponse>& share) const;
    void check(int rank, const Box& box) const;

    /// "grains rank 0 (my-code, host h, log l): FAULT, in "motion" of window 5. REMEDY"
    [[noreturn]] void refuse(int rank, const std::string& fault, const std::string& remedy) const;
    /// The same where the rank is unknown.
    [[noreturn]] void refuse(const std::string& fault, const std::string& remedy) const;

    Kind kind() const { return kind_; }

 private:
    [[noreturn]] void refuse_from(const std::string& who, const std::string& fault,
                                  const std::string& remedy) const;

    const ParticipantLink& from_;
    Kind kind_;
    std::int64_t window_;
};

}  // namespace turbidite
