#include "studies/kinds/sensitivity/sensitivity.hpp"

#include "ensemble/estimators/designs/sobol_indices.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/model/structure.hpp"
#include "io/keys/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace stylobate {

namespace {

void append(IntervalArray& array, const Estimate& estimate)
{
    array.add(estimate.value, estimate.lower, estimate.upper);
}

void append(SensitivityTable& table, const SobolIndices& found, bool rest)
{
    const auto array = [&](std::size_t i) -> IntervalArray& { return table.indices[i].of; };
    append(table.mean, found.mean);
    append(table.explained, found.explained);
    for (const FactorIndices& factor : found.of_mean) {
        append(array(0), factor.first);
        append(array(1), factor.total);
    }
    if (rest) // it has no part in the mean over it
        for (const std::size_t i : {0, 1})
            append(array(i), Estimate::undetermined());
    for (const FactorIndices& factor : found.of_value) {
        append(array(2), factor.first);
        append(array(3), factor.total);
    }
}

void append(SensitivityTable& table, const std::vector<ElementaryEffects>& found)
{
    for (const ElementaryEffects& effect : found) {
        append(table.indices[0].of, effect.mu_star);
        append(table.indices[1].of, effect.rms);
        append(table.indices[2].of, effect.mu);
        append(table.indices[3].of, effect.sigma);
    }
}

/// An outcome that too few rows of the design have. @pre the table has its factors
void append_undetermined(SensitivityTable& table)
{
    append(table.mean, Estimate::undetermined());
    if (table.method == word_for(sensitivity_method_names, SensitivityMethod::sobol))
        append(table.explained, Estimate::undetermined());
    for (std::size_t k = 0; k < table.factors.size(); ++k)
        for (SensitivityTable::Index& index : table.indices)
            append(index.of, Estimate::undetermined());
}

} // namespace

SensitivityOutcomes::SensitivityOutcomes(const Study& study, const std::vector<std::string>& inputs)
    : spec_(*study.sensitivity), seed_(study.seed), width_m_(0), kept_(study.total()),
      drawn_(spec_.samples * spec_.points() * spec_.factors.size())
{
    for (const PlacedBlock& block : lay_out(study.structure).blocks)
        if (block.role == BlockRole::drum)
            width_m_ = std::max(width_m_, block.width_m);
    for (const std::string& factor : spec_.factors) {
        const auto found = std::find(inputs.begin(), inputs.end(), factor);
        input_.push_back(found == inputs.end() ? none : static_cast<std::size_t>(found - inputs.begin()));
    }
}

void SensitivityOutcomes::add(const ResultRow& row)
{
    const Outcome& o = row.outcome;
    kept_.at(row.index) = {o.state, o.collapse_time_s, o.end_time_s, o.peak_top_displacement_m,
                           std::abs(o.residual_top_displacement_m)};
    const FactorDesign::Place place = spec_.place(row.index);
    for (std::size_t k = 0; k < input_.size(); ++k)
        drawn_[(place.row * spec_.points() + place.point) * input_.size() + k] =
            input_[k] == none ? std::nan("") : row.inputs.at(input_[k]);
}

/// Rows all of whose realizations have a value of the outcome: they are valid, and of the residual displacement at rest
/// or fallen.
std::vector<std::size_t> SensitivityOutcomes::usable(std::size_t outcome) const
{
    const std::size_t of_row = spec_.points() * spec_.inner;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < spec_.samples; ++row) {
        const std::span<const Kept> all = std::span(kept_).subspan(row * of_row, of_row);
        if (std::ranges::none_of(all, [&](const Kept& kept) {
                return kept.state == State::invalid ||
                       (outcome == residual && kept.state != State::collapsed && std::isnan(kept.residual_m));
            }))
            rows.push_back(row);
    }
    return rows;
}

/// Which way each factor moves from A, in these rows: 1, -1, or NaN where it has several values.
std::vector<double> SensitivityOutcomes::directions(const std::vector<std::size_t>& rows) const
{
    std::vector<double> directions;
    const std::size_t factors = input_.size();
    for (const std::size_t row : rows)
        for (std::size_t k = 0; k < factors; ++k) {
            const double* a = &drawn_[row * spec_.points() * factors];
            const double change = a[(spec_.first_changed() + k) * factors + k] - a[k];
            directions.push_back(std::isnan(change) ? change : change > 0 ? 1 : -1);
        }
    return directions;
}

std::array<double, SensitivityOutcomes::outcomes> SensitivityOutcomes::values(const Kept& kept, double longest_s) const
{
    if (kept.state == State::collapsed)
        return {1, kept.collapse_time_s, width_m_, width_m_};
    return {0, longest_s, std::min(kept.peak_m, width_m_), std::min(kept.residual_m, width_m_)};
}

SensitivityTable SensitivityOutcomes::table() const
{
    const bool sobol = spec_.method == SensitivityMethod::sobol;
    const std::size_t of_row = spec_.points() * spec_.inner;
    const std::size_t factors = spec_.factors.size();
    const BootstrapOptions options{.seed = seed_};
    SensitivityTable table;
    table.method = word_for(sensitivity_method_names, spec_.method);
    table.interval = fmt::format("{} {}", sobol ? "resampling" : "bootstrap", options.level);
    table.factors = spec_.factors;
    const bool rest = sobol && spec_.inner > 1;
    if (rest)
        table.factors.emplace_back(rest_name);
    table.inner = spec_.inner;

    double longest_s = 0;
    for (const Kept& kept : kept_)
        if (kept.state != State::invalid)
            longest_s = std::max(longest_s, kept.end_time_s);
    std::array<std::vector<std::size_t>, outcomes> rows;
    for (std::size_t o = 0; o < outcomes; ++o)
        rows[o] = usable(o);
    table.rows = rows[0].size();
    table.invalid_rows = spec_.samples - table.rows;

    table.outcomes = {"collapse", "time_upright", "peak_displacement", "residual_displacement"};
    table.units = {"", "s", "m", "m"};
    const std::string most = fmt::format("limited to a drum's width of {:g} m, the value of a collapse", width_m_);
    table.meanings = {"1 if a block has fallen, else 0",
                      fmt::format("until the first fall; {:.4g} s, the longest end of any, where it stood", longest_s),
                      "largest of the top, " + most, "of the top at rest, its size, " + most};
    if (rows[residual].size() < table.rows)
        table.meanings[residual] +=
            fmt::format("; of {} rows of the design only: in the other {} a structure still moved at the end",
                        rows[residual].size(), table.rows - rows[residual].size());
    for (const char* name : sobol ? std::array{"first", "total", "value_first", "value_total"}
                                  : std::array{"mu_star", "rms", "mu", "sigma"})
        table.indices.push_back({name, {}});
    if (table.rows < 2)
        throw InputError(fmt::format("of the {} rows of the design {} have an invalid realization: too few rows are "
                                     "left for an estimate. A smaller run.step_fraction may help.",
                                     spec_.samples, table.invalid_rows));
    std::vector<std::uint64_t> acts(factors, 0);
    for (std::size_t o = 0; o < outcomes; ++o) {
        if (rows[o].size() < 2) {
            append_undetermined(table);
            continue;
        }
        DesignValues design{rows[o].size(), factors, spec_.inner, {}};
        for (const std::size_t row : rows[o])
            for (std::size_t i = row * of_row; i < (row + 1) * of_row; ++i)
                design.value.push_back(values(kept_[i], longest_s)[o]);
        std::vector<bool> here(factors);
        if (sobol) {
            const SobolIndices found = possible_shares(sobol_indices(design, options));
            append(table, found, rest);
            here = found.acts;
        } else {
            const std::size_t points = spec_.points();
            std::vector<double> mean(design.rows);
            for (std::size_t r = 0; r < design.rows; ++r)
                for (std::size_t i = 0; i < spec_.inner; ++i)
                    mean[r] += design.at(r, 0, i, points) / static_cast<double>(spec_.inner);
            const auto same = [](std::span<const double> means, std::span<double> out) { out[0] = means[0]; };
            append(table.mean, bootstrap_rows(mean, 1, 1, same, options)[0]);
            const std::vector<ElementaryEffects> found = elementary_effects(design, directions(rows[o]), options);
            append(table, found);
            for (std::size_t k = 0; k < factors; ++k)
                here[k] = found[k].acts;
        }
        for (std::size_t k = 0; k < factors; ++k)
            acts[k] |= here[k];
    }
    table.acts = acts;
    if (rest)
        table.acts.push_back(1);
    return table;
}

} // namespace stylobate
