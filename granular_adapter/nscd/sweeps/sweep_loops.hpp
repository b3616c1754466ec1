// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The loops over packed groups. This file is included behind lane_kernel.hpp and the kernel of a
// kind of contact, which defines
//
//     update<measure>(row, bodies, sums)     the new impulses of a group, and its bodies'
//     velocities needs_update(row, bodies)              whether some contact has an impulse or
//     closes

template <class Rows>
void sweep_plain(Rows* begin, Rows* end, typename Rows::Body* bodies) {
    PassSums<Rows::width> unused;
    for (Rows* row = begin; row != end; ++row) update<false>(*row, bodies, unused);
}

template <class Rows>
void sweep_measured(Rows* begin, Rows* end, typename Rows::Body* bodies,
                    PassSums<Rows::width>& sums) {
    for (Rows* row = begin; row != end; ++row) update<true>(*row, bodies, sums);
}

template <class Rows>
void sweep_asked(Rows* begin, Rows* end, typename Rows::Body* bodies, PassSums<Rows::width>& sums,
                 std::uint8_t* awake) {
    for (Rows* row = begin; row != end; ++row, ++awake) {
        *awake = 0;
        if (!needs_update(*row, bodies)) continue;
        update<true>(*row, bodies, sums);
        *awake = any(load(row->rn)) ? 1 : 0;
    }
}

template <class Rows>
Sweeps<Rows> sweeps() {
    return {sweep_plain<Rows>, sweep_measured<Rows>, sweep_asked<Rows>};
}

#undef TURBIDITE_INLINE
