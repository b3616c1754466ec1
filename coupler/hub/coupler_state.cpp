// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/coupler_state.hpp"

#include <string>

#include "coupler/protocol/even_shares.hpp"

namespace turbidite {
namespace {

// The output's state goes in as one text: its own encoding may grow without changing this one.
std::string text_of(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

template <class Record>
Record record_of(Reader& code) {
    std::string text;
    code(text);
    return decode<Record>(Bytes(text.begin(), text.end()));
}

template <class Code, class Ledger>
void visit_ledger(Code& code, Ledger& ledger) {
    code(ledger.divergent_windows), code(ledger.stopped_windows);
    code(ledger.warned_of_grains), code(ledger.warned_of_fluid);
}

}  // namespace

Bytes encode(const CouplerState& state) {
    Bytes out;
    Writer code(out);
    code(state.windows), code(state.wall_seconds);
    visit_ledger(code, state.ledger);
    code(static_cast<std::int64_t>(state.owners.size()));
    for (const std::int64_t owner : state.owners) code(owner);
    code(text_of(encode(state.output)));
    return out;
}

template <>
CouplerState decode(View bytes) {
    CouplerState state;
    Reader code(bytes);
    code(state.windows), code(state.wall_seconds);
    visit_ledger(code, state.ledger);
    state.owners.resize(code.length());
    for (std::int64_t& owner : state.owners) code(owner);
    state.output = record_of<OutputState>(code);
    code.finish();
    // owners[i] is the rank of grains[i]: lists of different length belong to different states.
    if (state.owners.size() != state.output.state.grains.size())
        throw MalformedPayload("owners of " + std::to_string(state.owners.size()) +
                               " grains instead of " +
                               std::to_string(state.output.state.grains.size()));
    return state;
}

void share_out(CouplerState& state, int ranks) {
    // By the rule that the ranks follow themselves in restore_from: both ends find the same owners.
    const std::vector<int> owners = even_shares(state.output.state.grains, ranks);
    state.owners.assign(owners.begin(), owners.end());
}

std::vector<Motion> shares_of(const CouplerState& state, int ranks) {
    std::vector<Motion> shares(static_cast<std::size_t>(ranks));
    for (std::size_t i = 0; i < state.owners.size(); ++i)
        shares.at(static_cast<std::size_t>(state.owners[i]))
            .grains.push_back(state.output.state.grains[i]);
    return shares;
}

}  // namespace turbidite
