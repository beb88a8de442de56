#include "studies/measured/diagnosis/campaigns/conformal.hpp"

#include <algorithm>

namespace stylobate {

double conformal_p_value(const std::vector<double>& nulls, double score, const std::vector<double>& weights)
{
    double as_large = 1, all = 1;
    for (std::size_t i = 0; i < nulls.size(); ++i) {
        const double weight = weights.empty() ? 1 : weights[i];
        all += weight;
        as_large += nulls[i] >= score ? weight : 0;
    }
    return as_large / all;
}

CalibratedProbability::CalibratedProbability(std::vector<Case> cases)
{
    std::stable_sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.score < b.score; });
    for (const Case& each : cases) {
        blocks_.push_back({each.score, each.right ? 1.0 : 0.0, each.weight});
        while (blocks_.size() > 1 && blocks_[blocks_.size() - 2].right >= blocks_.back().right) {
            const Block last = blocks_.back();
            blocks_.pop_back();
            Block& merged = blocks_.back();
            const double weight = merged.weight + last.weight;
            merged.score = (merged.score * merged.weight + last.score * last.weight) / weight;
            merged.right = (merged.right * merged.weight + last.right * last.weight) / weight;
            merged.weight = weight;
        }
    }
    for (Block& block : blocks_) // never 0 or 1: half a case of either kind (Jeffreys)
        block.right = (block.right * block.weight + 0.5) / (block.weight + 1);
}

double CalibratedProbability::operator()(double score) const
{
    if (blocks_.empty())
        return 0.5;
    if (score <= blocks_.front().score)
        return blocks_.front().right;
    for (std::size_t i = 1; i < blocks_.size(); ++i)
        if (score <= blocks_[i].score) {
            const Block &a = blocks_[i - 1], &b = blocks_[i];
            return a.right + (b.right - a.right) * (score - a.score) / (b.score - a.score);
        }
    return blocks_.back().right;
}

} // namespace stylobate
