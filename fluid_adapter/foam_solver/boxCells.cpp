// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/boxCells.hpp"

#include <cyclicLduInterface.H>
#include <processorCyclicFvPatch.H>
#include <processorLduInterface.H>

#include <cstdlib>
#include <utility>

namespace turbidite {
namespace {

bool joins_ranks(const Foam::lduInterface& interface) {
    return Foam::isA<Foam::processorLduInterface>(interface);
}

/// Cyclic patches, including those split by a decomposition.
bool closes_box(const Foam::lduInterface& interface) {
    return Foam::isA<Foam::cyclicLduInterface>(interface) ||
           Foam::isA<Foam::processorCyclicFvPatch>(interface);
}

/// By patch and face: the value of the cell on the far side, given one value per cell.
std::vector<std::vector<int>> beyond_patches(const Foam::lduMesh& mesh,
                                             const Foam::labelList& values) {
    constexpr auto way = Foam::Pstream::commsTypes::nonBlocking;
    const Foam::lduInterfacePtrsList interfaces = mesh.interfaces();
    const auto known = [&](Foam::label patch) {
        return interfaces.set(patch) &&
               (joins_ranks(interfaces[patch]) || closes_box(interfaces[patch]));
    };
    // Only requests made from here on are waited for.
    const Foam::label first_request = Foam::UPstream::nRequests();
    forAll(interfaces, patch) if (known(patch)) interfaces[patch].initInternalFieldTransfer(way,
                                                                                            values);
    Foam::UPstream::waitRequests(first_request);
    std::vector<std::vector<int>> beyond(interfaces.size());
    forAll(interfaces, patch) {
        if (!known(patch)) continue;
        const Foam::tmp<Foam::labelField> far =
            interfaces[patch].internalFieldTransfer(way, values);
        beyond[patch].assign(far().begin(), far().end());
    }
    return beyond;
}

/// Consecutive numbers for this rank's cells, after those of the ranks before it.
Foam::labelList numbers_over_ranks(const Foam::lduMesh& mesh, const RankGroup& ranks) {
    const std::vector<int> counts = ranks.everywhere(mesh.lduAddr().size());
    int first = 0;
    for (int rank = 0; rank < ranks.rank(); ++rank) first += counts[rank];
    Foam::labelList numbers(mesh.lduAddr().size());
    forAll(numbers, c) numbers[c] = first + c;
    return numbers;
}

/// Both cells of every face between two cells of this rank, and of the faces shared with another
/// rank if this rank's cell has the smaller number.
std::vector<int> face_pairs(const Foam::lduMesh& mesh, const Foam::labelList& numbers) {
    std::vector<int> pairs;
    const Foam::labelUList& lower = mesh.lduAddr().lowerAddr();
    const Foam::labelUList& upper = mesh.lduAddr().upperAddr();
    forAll(lower, face) pairs.insert(pairs.end(), {numbers[lower[face]], numbers[upper[face]]});
    const std::vector<std::vector<int>> beyond = beyond_patches(mesh, numbers);
    const Foam::lduInterfacePtrsList interfaces = mesh.interfaces();
    forAll(interfaces, patch) {
        if (!interfaces.set(patch) || closes_box(interfaces[patch])) continue;
        const Foam::labelUList& cells = interfaces[patch].faceCells();
        for (std::size_t face = 0; face < beyond[patch].size(); ++face)
            // So that each such face is told once, by one of its two ranks
            if (numbers[cells[face]] < beyond[patch][face])
                pairs.insert(pairs.end(), {numbers[cells[face]], beyond[patch][face]});
    }
    return pairs;
}

/// Numbers the box from the faces of all ranks. Sends each rank the columns, the rows and the
/// places of its cells; or a zero and the text of what does not fit.
ByRank<int> numbered(const ByRank<int>& pairs_of_rank, const std::vector<int>& counts) {
    ByRank<int> answers(counts.size());
    try {
        CellFaces faces;
        for (const int count : counts) faces.count += count;
        for (const std::vector<int>& pairs : pairs_of_rank)
            for (std::size_t f = 0; f < pairs.size(); f += 2) {
                faces.low.push_back(pairs[f]);
                faces.high.push_back(pairs[f + 1]);
            }
        const BoxNumbering box = number_box(faces);
        auto next = box.place.begin();
        for (std::size_t rank = 0; rank < counts.size(); next += counts[rank++]) {
            answers[rank] = {box.cells[0], box.cells[1]};
            answers[rank].insert(answers[rank].end(), next, next + counts[rank]);
        }
    } catch (const DoesNotFit& why) {
        const std::string text = why.what();
        for (std::vector<int>& answer : answers) {
            answer.assign(1, 0);
            answer.insert(answer.end(), text.begin(), text.end());
        }
    }
    return answers;
}

}  // namespace

/// For OpenFOAM the world is MPI_COMM_WORLD as seen through the names MPI_*, which may stand for
/// another communicator (coupler/transport/world_isolation.hpp); a RankGroup calls PMPI_*.
RankGroup openfoam_ranks() {
    if (!Foam::Pstream::parRun()) return {};
    MPI_Group everyone = MPI_GROUP_NULL;
    MPI_Comm world = MPI_COMM_NULL;
    MPI_Comm_group(MPI_COMM_WORLD, &everyone);
    MPI_Comm_create(MPI_COMM_WORLD, everyone, &world);
    RankGroup ranks(world);
    PMPI_Comm_free(&world);
    PMPI_Group_free(&everyone);
    return ranks;
}

BoxCells number_cells(const Foam::lduMesh& mesh, const RankGroup& ranks) {
    const std::vector<int> counts = ranks.everywhere(mesh.lduAddr().size());
    ByRank<int> to_first(ranks.size());
    // Rank 0 numbers the box: following rows needs the faces of all ranks.
    to_first[0] = face_pairs(mesh, numbers_over_ranks(mesh, ranks));
    const ByRank<int> pairs = all_to_all(ranks, to_first);
    const ByRank<int> answers =
        ranks.rank() == 0 ? numbered(pairs, counts) : ByRank<int>(ranks.size());
    const std::vector<int> answer = all_to_all(ranks, answers)[0];
    // Every rank gets the same text and throws.
    if (answer[0] == 0) throw DoesNotFit(std::string(answer.begin() + 1, answer.end()));
    return box_cells(mesh, ranks, {answer[0], answer[1]}, {answer.begin() + 2, answer.end()});
}

BoxCells box_cells(const Foam::lduMesh& mesh, const RankGroup& ranks,
                   const std::array<int, 2>& cells, const std::vector<int>& place) {
    BoxCells box{ranks, cells, place, {}, {}};
    const Foam::labelUList& lower = mesh.lduAddr().lowerAddr();
    const Foam::labelUList& upper = mesh.lduAddr().upperAddr();
    box.axis.resize(lower.size());
    // Two cells of a row are coupled along x.
    forAll(lower, face) box.axis[face] =
        box.row(place[lower[face]]) == box.row(place[upper[face]]) ? 0 : 1;
    Foam::labelList places(static_cast<Foam::label>(place.size()));
    forAll(places, c) places[c] = place[c];
    box.beyond = beyond_patches(mesh, places);
    return box;
}

void demand(const RankGroup& ranks, const std::string& fault) {
    if (ranks.all(fault.empty())) return;
    ByRank<int> letters(ranks.size());
    for (std::vector<int>& list : letters) list.assign(fault.begin(), fault.end());
    for (const std::vector<int>& text : all_to_all(ranks, letters))
        // From the lowest rank that has found a fault
        if (!text.empty()) throw DoesNotFit(std::string(text.begin(), text.end()));
}

}  // namespace turbidite
