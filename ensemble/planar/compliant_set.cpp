#include "ensemble/planar/compliant_set.hpp"

#include "ensemble/planar/hand_over.hpp"
#include "ensemble/planar/structure/compliant_form.hpp"

namespace stylobate {

CompliantSet::CompliantSet(const Study& study, const Motion* record, const KernelTable& kernels,
                           const Realization& pattern)
    : pattern_(compliant_form(pattern)), set_(study, record, kernels, pattern_)
{
}

void CompliantSet::fill()
{
    for (int lane = 0; lane < set_.lanes() && !waiting_.empty(); ++lane)
        if (set_.free(lane)) {
            take_over(set_, lane, waiting_.back());
            waiting_.pop_back();
        }
}

} // namespace stylobate
