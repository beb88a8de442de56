#include "ensemble/engine/handed_over.hpp"

#include "ensemble/statics/compliant_form.hpp"

namespace stylobate {

HandedOver::HandedOver(const Study& study, const Motion* record, const KernelTable& kernels, const Realization& pattern)
    : pattern_(compliant_form(pattern)), set_(study, record, kernels, pattern_)
{
}

void HandedOver::fill()
{
    for (int lane = 0; lane < set_.lanes() && !waiting_.empty(); ++lane)
        if (set_.free(lane)) {
            set_.load(lane, waiting_.back());
            waiting_.pop_back();
        }
}

} // namespace stylobate
