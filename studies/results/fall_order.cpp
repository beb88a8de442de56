#include "studies/results/fall_order.hpp"

#include "studies/experiment/limit_state.hpp"

#include <algorithm>

namespace stylobate {

FallOrder fall_order(const std::vector<std::string>& names, const std::vector<ResultRow>& rows,
                     const MotionGroups& motions)
{
    FallOrder order;
    for (const std::string& name : names)
        order.blocks.push_back({name, 0, {}, 0, 1});
    LimitCounts counts(names.size(), motions);
    order.interval = counts.interval();
    for (const ResultRow& row : rows) {
        counts.add(row);
        if (row.outcome.state == State::invalid)
            continue;
        order.end_time_s = std::max(order.end_time_s, row.outcome.end_time_s);
        for (std::size_t i = 0; i < names.size(); ++i)
            if (row.outcome.fall_time_s[i] >= 0)
                order.blocks[i].fall_time_s.push_back(row.outcome.fall_time_s[i]);
    }
    order.trials = counts.trials();
    order.together = counts.first_together();
    for (std::size_t i = 0; i < names.size(); ++i) {
        FallOrder::Block& block = order.blocks[i];
        std::sort(block.fall_time_s.begin(), block.fall_time_s.end());
        block.first = counts.first()[i];
        const Share share = counts.share_fallen(i);
        block.lower = share.lower;
        block.upper = share.upper;
    }
    return order;
}

} // namespace stylobate
