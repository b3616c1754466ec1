// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/touching.hpp"

#include <lammps/library.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::lammps {
namespace {

// LAMMPS keeps flags in the two upper bits of its lists of neighbours.
constexpr int neighbour_bits = 0x3FFFFFFF;

void add(Overlaps& all, double overlap) {
    if (overlap <= 0.0) return;
    ++all.contacts;
    all.deepest = std::max(all.deepest, overlap);
}

void add_pairs(const Library& lammps, Overlaps& all) {
    const int list = lammps_find_pair_neighlist(lammps.handle(), "granular", 1, 0, 0);
    double** x = lammps.atoms<double**>("x");
    const double* radius = lammps.atoms<double*>("radius");
    for (int k = 0; k < lammps_neighlist_num_elements(lammps.handle(), list); ++k) {
        int i = 0, count = 0, *neighbours = nullptr;
        lammps_neighlist_element_neighbors(lammps.handle(), list, k, &i, &count, &neighbours);
        for (int n = 0; n < count; ++n) {
            const int j = neighbours[n] & neighbour_bits;
            const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], dz = x[i][2] - x[j][2];
            const double reach = radius[i] + radius[j], square = dx * dx + dy * dy + dz * dz;
            if (square < reach * reach) add(all, reach - std::sqrt(square));
        }
    }
}

/// A row of fix wall/gran with `contacts`: whether there is one, force on the grain, point of the
/// wall, radius.
struct AtWall {
    bool present;
    Vec3 force, point;
    double radius;
};

AtWall at_wall(const double* row) {
    return {row[0] != 0.0, {row[1], row[2], row[3]}, {row[4], row[5], row[6]}, row[7]};
}

Vec3 centre(const Library& lammps, int i) {
    const double* x = lammps.atoms<double**>("x")[i];
    return {x[0], x[1], x[2]};
}

/// Calls visit(grain, contact) for all contacts of this rank's grains with walls.
template <class Visit>
void for_walls(const Library& lammps, const std::vector<std::string>& fixes, Visit visit) {
    for (const std::string& fix : fixes) {
        const auto rows = static_cast<double**>(
            lammps_extract_fix(lammps.handle(), fix.c_str(), LMP_STYLE_ATOM, LMP_TYPE_ARRAY, 0, 0));
        for (int i = 0; i < lammps.local_count(); ++i) {
            const AtWall contact = at_wall(rows[i]);
            if (contact.present) visit(i, contact);
        }
    }
}

/// Force [N] on b with its contact's record, whose other fields except a, b and wall it fills.
void fill(ContactRecord& record, const Vec3& force, double overlap, double friction,
          double window) {
    const double normal = dot(force, record.normal);
    // N = n . F,   |T| = |F - N n|, at the limit if |T| >= mu N
    const double along = norm(force - normal * record.normal);
    record.status = along >= (1.0 - 1e-9) * friction * normal ? ContactStatus::sliding : 0;
    record.gap = -overlap;
    record.impulse = window * force;
}

/// Rows of `compute pairs`: distance, normal force on the first, friction on the first, vector from
/// the second to the first.
struct Pair {
    explicit Pair(const double* row)
        : distance(row[0]),
          force({row[1] + row[4], row[2] + row[5], row[3] + row[6]}),
          apart({row[7], row[8], row[9]}) {}

    double distance;
    Vec3 force, apart;
};

class PairRecords {
 public:
    PairRecords(const Library& lammps, const RoundGrains& grains, double friction, double window)
        : lammps_(lammps), grains_(grains), friction_(friction), window_(window) {
        const int* tag = lammps.atoms<int*>("id");
        for (int i = 0; i < lammps_extract_setting(lammps.handle(), "nall"); ++i)
            index_.emplace(tag[i], i);  // the grain itself comes before its copies
    }

    /// Of two grains with LAMMPS' numbers.
    ContactRecord operator()(int first_tag, int second_tag, const Pair& pair) const {
        const int first = index_.at(first_tag), second = index_.at(second_tag);
        const GrainId ids[] = {grains_.id(first), grains_.id(second)};
        const double* radius = lammps_.atoms<double*>("radius");
        const double overlap = radius[first] + radius[second] - pair.distance;
        // `apart` and `force` are of the first grain. If it is a, both are turned: the normal goes
        // from a to b, and the force is that on b.
        const double sense = ids[0] < ids[1] ? -1.0 : 1.0;  // of b
        ContactRecord record;
        record.a = std::min(ids[0], ids[1]);
        record.b = std::max(ids[0], ids[1]);
        record.normal = (sense / pair.distance) * pair.apart;
        record.branch = sense * pair.apart;
        // The middle of the overlap, beside b where the two meet across a cyclic side.
        const int b = sense > 0.0 ? first : second;
        record.point = grains_.centre(b) - (radius[b] - 0.5 * overlap) * record.normal;
        fill(record, sense * pair.force, overlap, friction_, window_);
        return record;
    }

 private:
    const Library& lammps_;
    const RoundGrains& grains_;
    double friction_, window_;
    std::unordered_map<int, int> index_;  ///< of LAMMPS' number
};

/// The side that a point of a wall belongs to.
std::int32_t side_of(const Vec3& point, const Vec3& grain, const Vec3& size) {
    int axis = 0;
    // The point of a wall differs from the centre along the axis of the wall only.
    while (axis < 2 && point[axis] == grain[axis]) ++axis;
    return 2 * axis + (point[axis] < 0.5 * size[axis] ? 0 : 1);
}

double** rows_of(const Library& lammps, const char* compute, int& count) {
    count = *static_cast<int*>(
        lammps_extract_compute(lammps.handle(), compute, LMP_STYLE_LOCAL, LMP_SIZE_ROWS));
    return static_cast<double**>(
        lammps_extract_compute(lammps.handle(), compute, LMP_STYLE_LOCAL, LMP_TYPE_ARRAY));
}

}  // namespace

Overlaps overlaps(const Library& lammps, const std::vector<std::string>& wall_fixes) {
    Overlaps all;
    add_pairs(lammps, all);
    for_walls(lammps, wall_fixes, [&](int i, const AtWall& contact) {
        add(all, contact.radius - norm(centre(lammps, i) - contact.point));
    });
    return all;
}

std::vector<ContactRecord> touching(const Library& lammps, const RoundGrains& grains,
                                    const std::vector<std::string>& wall_fixes, const Vec3& size,
                                    double friction, double window) {
    std::vector<ContactRecord> records;
    const PairRecords record_of(lammps, grains, friction, window);
    int count = 0;
    double** pairs = rows_of(lammps, "pairs", count);
    double** names = rows_of(lammps, "names", count);
    for (int k = 0; k < count; ++k)
        records.push_back(record_of(int(names[k][0]), int(names[k][1]), Pair(pairs[k])));
    for_walls(lammps, wall_fixes, [&](int i, const AtWall& contact) {
        const Vec3 grain = centre(lammps, i);
        ContactRecord record;
        record.wall = side_of(contact.point, grain, size);
        record.b = grains.id(i);
        record.branch = grain - contact.point;
        // LAMMPS' point belongs to its own centre, which may lie beyond a cyclic side.
        record.point = grains.centre(i) - record.branch;
        record.normal = (1.0 / norm(record.branch)) * record.branch;
        fill(record, contact.force, contact.radius - norm(record.branch), friction, window);
        records.push_back(record);
    });
    std::sort(records.begin(), records.end(), contact_before);
    return records;
}

}  // namespace turbidite::lammps
