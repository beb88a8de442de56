#pragma once
/// The general overlap in double precision, whatever the precision of the step.
///
/// It is a sum of areas as large as the blocks in which everything but the contact cancels: in single precision a
/// grazing corner would be lost in rounding, and a centroid, a moment divided by an area, would be arbitrary. It is
/// rare (for beds), so its numbers are widened, processed one half of the register after the other, and rounded.

#include "kernels/planar/overlap.hpp"

#include <type_traits>

namespace stylobate {

template <class Real>
STYLOBATE_INLINE Overlap<Real> full_general_overlap(const Placement<Real>& place, const PairSizes<Real>& sizes)
{
    if constexpr (std::is_same_v<NumberOf<Real>, double>) {
        return general_overlap(place, sizes);
    } else {
        using L = Lanes<Real>;
        using Full = typename L::Full;
        using F = Lanes<Full>;
        constexpr int inputs = 8, outputs = 6;
        alignas(64) float numbers[inputs][L::count], found[outputs][L::count];
        alignas(64) double wide[inputs][F::count];
        const Real given[inputs] = {place.x,
                                    place.depth,
                                    place.sine,
                                    place.cosine,
                                    sizes.lower_half_width,
                                    sizes.lower_half_height,
                                    sizes.upper_half_width,
                                    sizes.upper_half_height};
        for (int i = 0; i < inputs; ++i)
            L::store(numbers[i], given[i]);
        for (int half = 0; half < L::count; half += F::count) {
            for (int i = 0; i < inputs; ++i)
                for (int lane = 0; lane < F::count; ++lane)
                    wide[i][lane] = numbers[i][half + lane];
            const Overlap<Full> o = general_overlap(
                Placement<Full>{F::load(wide[0]), F::load(wide[1]), F::load(wide[2]), F::load(wide[3])},
                PairSizes<Full>{F::load(wide[4]), F::load(wide[5]), F::load(wide[6]), F::load(wide[7])});
            const Full got[outputs] = {o.area, o.moment_x, o.moment_depth, o.normal_x, o.normal_y, o.elastic};
            for (int i = 0; i < outputs; ++i) {
                F::store(wide[i], got[i]);
                for (int lane = 0; lane < F::count; ++lane)
                    found[i][half + lane] = static_cast<float>(wide[i][lane]);
            }
        }
        return {L::load(found[0]), L::load(found[1]), L::load(found[2]),
                L::load(found[3]), L::load(found[4]), L::load(found[5])};
    }
}

} // namespace stylobate
