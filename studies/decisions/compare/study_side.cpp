#include "studies/decisions/compare/study_side.hpp"

#include "ensemble/model/nominal.hpp"
#include "studies/kinds/fragility/damage.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace stylobate {

namespace {

/// When the shaking of a sequence that a damage state belongs to is over, and the next one begins.
double until_s(const Study& study, const ResultHeader& header, std::uint64_t motion, int shaking)
{
    const auto shakings = static_cast<std::size_t>(study.fragility->shakings);
    if (shaking == 0 || static_cast<std::size_t>(shaking) == shakings)
        return std::numeric_limits<double>::infinity();
    return header.motions.shaking_end_s.at(motion * shakings + static_cast<std::size_t>(shaking) - 1) +
           shaking_pause_s(study);
}

std::vector<LimitDefinition> damage_definitions(const Study& study, const ResultHeader& header)
{
    std::vector<LimitDefinition> all;
    const double width = base_width_m(study.structure);
    const auto stripes = static_cast<std::uint64_t>(study.fragility->stripes());
    for (const DamageState& state : damage_states(study))
        all.push_back(
            {state.name, state.describe, true, [&study, &header, state, width, stripes](const ResultRow& row) {
                 return reached(state, row.outcome, width, until_s(study, header, row.cell / stripes, state.shaking));
             }});
    std::stable_partition(all.begin(), all.end(), [](const LimitDefinition& one) { return one.name == "collapse"; });
    return all;
}

} // namespace

std::vector<LimitDefinition> limit_definitions(const Study& study, const ResultHeader& header)
{
    if (study.fragility)
        return damage_definitions(study, header);
    std::vector<LimitDefinition> all;
    for (std::size_t i = 0; i < limit_state_names().size(); ++i) {
        const auto limit = static_cast<LimitState>(i);
        if ((limit == LimitState::total && study.outcome.follow != Follow::rest) ||
            (limit == LimitState::unseated && study.structure.epistyles.empty()))
            continue;
        all.push_back({limit_state_names()[i], describe(limit),
                       limit != LimitState::rocked && limit != LimitState::slid && limit != LimitState::moving,
                       [limit](const ResultRow& row) { return reached(limit, row.outcome); }});
    }
    return all;
}

StudySide::StudySide(const Study& study, const ResultHeader& header)
    : limits_(limit_definitions(study, header)), state_(study.originals()), per_cell_(study.realizations),
      drawn_per_cell_(std::max<std::uint64_t>(1, most_draws / study.cells()))
{
    assert(limits_.size() <= most_limits && "limit states have a bit each");
}

void StudySide::add(const ResultRow& row)
{
    if (row.index >= state_.size()) // a replica
        return;
    std::uint64_t state = present;
    if (row.outcome.state == State::invalid)
        state |= invalid;
    else
        for (std::size_t i = 0; i < limits_.size(); ++i) {
            const std::optional<bool> reached = limits_[i].reached(row);
            state |= static_cast<std::uint64_t>(reached.value_or(false)) << i;
            state |= static_cast<std::uint64_t>(!reached) << (most_limits + i);
        }
    state_[row.index] = state;
    if (row.index % per_cell_ < drawn_per_cell_)
        draws_.push_back({row.index, row.inputs});
}

std::vector<StudySide::Draws> StudySide::draws() const
{
    std::vector<Draws> sorted = draws_;
    std::sort(sorted.begin(), sorted.end(), [](const Draws& a, const Draws& b) { return a.index < b.index; });
    return sorted;
}

} // namespace stylobate
