// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a participant sends, as lists of numbers with names: for comparisons. Times spent, hosts and
// processes differ from run to run and are left out.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/message.hpp"
#include "coupler/protocol/records.hpp"

namespace turbidite {

/// Records of one type, each with the same numbers.
struct NumberTable {
    std::string what;                ///< "grain 7" begins with it; "report"
    std::vector<std::string> names;  ///< of the numbers of a record
    std::vector<GrainId> ids;        ///< by record; of a single record without an id -1
    std::vector<double> numbers;     ///< record after record
};

/// Of a message from a participant. Throws MalformedPayload if it is not one.
std::vector<NumberTable> numbers_of(const Message& message);

}  // namespace turbidite
