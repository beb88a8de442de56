#include "studies/check/trial_order.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

TrialOrder::TrialOrder(const Study& study, std::uint64_t begin, std::uint64_t end) : begin_(begin), end_(end)
{
    const std::uint64_t total = end - begin;
    if (study.surface)
        counts_ = {static_cast<std::uint64_t>(study.surface->frequency_hz.count),
                   static_cast<std::uint64_t>(study.surface->pga_m_s2.count), 1};
    else if (study.fragility)
        counts_ = {static_cast<std::uint64_t>(study.fragility->motions),
                   static_cast<std::uint64_t>(study.fragility->stripes()), 1};
    const std::uint64_t cells = counts_[0] * counts_[1];
    if (total % cells != 0)
        counts_ = {1, 1, total};
    else
        counts_[2] = total / cells;
    const auto dimensions = std::count_if(counts_.begin(), counts_.end(), [](std::uint64_t n) { return n > 1; });
    double g = 1.5; // a fixed point of g = (1 + g)^(1 / (d + 1))
    for (int i = 0; i < 64; ++i)
        g = std::pow(1 + g, 1 / static_cast<double>(dimensions + 1));
    double power = 1;
    for (std::size_t d = 0; d < counts_.size(); ++d)
        if (counts_[d] > 1)
            step_[d] = power /= g;
}

std::vector<std::uint64_t> TrialOrder::next(std::uint64_t count)
{
    count = std::min(count, total() - taken());
    std::vector<std::uint64_t> indices;
    while (indices.size() < count) {
        std::array<std::uint64_t, 3> at{};
        for (std::size_t d = 0; d < at.size(); ++d) {
            double whole = 0;
            const double part = std::modf(0.5 + static_cast<double>(point_) * step_[d], &whole);
            at[d] = std::min(counts_[d] - 1, static_cast<std::uint64_t>(part * static_cast<double>(counts_[d])));
        }
        ++point_;
        std::uint64_t cell = at[0] * counts_[1] + at[1], k = at[2];
        std::uint64_t tried = 0;
        while (!taken_.insert(cell * counts_[2] + k).second) {
            k = (k + 1) % counts_[2];
            if (++tried % counts_[2] == 0)
                cell = (cell + 1) % (counts_[0] * counts_[1]);
        }
        indices.push_back(begin_ + cell * counts_[2] + k);
    }
    std::sort(indices.begin(), indices.end());
    return indices;
}

} // namespace stylobate
