#include "library/result.hpp"

#include "io/store/result_layout.hpp"
#include "io/study/study_file.hpp"
#include "library/tables.hpp"
#include "studies/kinds/adaptive/adaptive_kind.hpp"
#include "studies/workflow/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace stylobate::api {

namespace {

/// The tables of any kind that a complete file has.
std::vector<inner::Table> tables_in(const inner::ResultReader& reader)
{
    std::vector<inner::Table> tables;
    for (const char* name : {"fragility", "rare", "sensitivity", "survival", "twins"})
        if (inner::Table table = reader.table(name); !table.empty())
            tables.push_back(std::move(table));
    return tables;
}

/// @throws InputError for a word that is no limit state
inner::LimitState limit_of(const std::string& word)
{
    const std::vector<std::string>& names = inner::limit_state_names();
    if (std::find(names.begin(), names.end(), word) == names.end())
        throw InputError(fmt::format("\"{}\" is not a limit state; known: {}", word, fmt::join(names, ", ")));
    return inner::limit_state_of(word);
}

} // namespace

const char* to_string(State state)
{
    return inner::to_string(static_cast<inner::State>(state));
}

const char* to_string(InvalidReason reason)
{
    return inner::to_string(static_cast<inner::InvalidReason>(reason));
}

Result::Result(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Result Result::from_file(const std::filesystem::path& file)
{
    return translated([&] {
        const inner::ResultReader reader(file);
        const inner::ResultHeader& header = reader.header();
        Data data(header, inner::parse_study(header.study_toml, file.string() + " (its study)"), file.string());
        data.complete = reader.complete();
        if (!data.complete)
            data.count_the_first([&](std::uint64_t index) { return reader.has(index); });
        reader.for_each_row([&](const inner::ResultRow& row) { data.add(row); });
        if (const inner::Tally* tally = reader.tally())
            data.add(*tally);
        data.done = reader.done();
        if (!data.complete)
            data.finish();
        else
            data.finish(header.cells() == 0 ? std::nullopt : std::optional(reader.surface()), tables_in(reader));
        return Inside::make<Result>(std::move(data));
    });
}

std::string Result::kind() const
{
    return data_->header.kind;
}

std::string Result::study_text() const
{
    return data_->header.study_toml;
}

int Result::dimensions() const
{
    return data_->header.dimensions;
}

std::string Result::code_version() const
{
    return data_->header.code_version;
}

bool Result::complete() const
{
    return data_->complete;
}

std::uint64_t Result::realizations() const
{
    return data_->done;
}

std::uint64_t Result::invalid() const
{
    return data_->invalid;
}

std::optional<std::string> Result::too_many_invalid() const
{
    if (!data_->complete)
        return {};
    return inner::too_many_invalid(data_->study, data_->invalid, data_->done, data_->name);
}

std::vector<std::string> Result::warnings() const
{
    return data_->header.warnings;
}

Share Result::share(const std::string& limit_state) const
{
    const inner::LimitState limit = limit_of(limit_state);
    Share share = share_of(data_->limits.share(limit));
    const bool adaptive = data_->is_adaptive(), rare = data_->study.design().chained();
    if (!adaptive && !rare)
        return share;
    // some cells, or chains, have more realizations than others: the plain share means nothing
    if (limit != inner::LimitState::collapse || !data_->complete)
        throw InputError(
            fmt::format("{}: for {} only the probability of collapse is available, after the run is complete",
                        data_->name, adaptive ? "an adaptive surface" : "a study of rare events"));
    if (rare) {
        share.probability = data_->rare.probability;
        share.lower = data_->rare.lower;
        share.upper = data_->rare.upper;
    } else {
        inner::Progress progress;
        inner::set_share(progress, inner::mean_of(data_->surfaces[static_cast<std::size_t>(limit)]));
        share.probability = progress.share;
        share.lower = progress.share_lower;
        share.upper = progress.share_upper;
    }
    return share;
}

const std::vector<Outcome>& Result::outcomes() const
{
    return data_->outcomes;
}

std::vector<std::string> Result::input_names() const
{
    return data_->header.input_names;
}

std::vector<std::string> Result::input_units() const
{
    std::vector<std::string> units;
    const inner::ResultLayout layout(data_->header);
    for (const std::string& name : data_->header.input_names) {
        const std::string path = "input/" + name.substr(0, name.find('['));
        units.push_back(std::ranges::find(layout.columns(), path, &inner::Column::path)->unit);
    }
    return units;
}

std::vector<std::string> Result::block_names() const
{
    return data_->header.block_names;
}

Surface Result::surface(const std::string& limit_state) const
{
    const inner::LimitState limit = limit_of(limit_state);
    if (data_->surfaces.empty())
        throw InputError(fmt::format("{}: a result of kind '{}' has no surface", data_->name, kind()));
    if (data_->is_adaptive() && (limit != inner::LimitState::collapse || !data_->complete))
        throw InputError(fmt::format(
            "{}: an adaptive surface gives only the probability of collapse, after the run is complete", data_->name));
    return surface_of(data_->surfaces[static_cast<std::size_t>(limit)], limit_state);
}

Fragility Result::fragility() const
{
    if (!data_->study.design().motions || kind() == "replay")
        throw InputError(fmt::format("{}: a result of kind '{}' is not a fragility study", data_->name, kind()));
    if (!data_->complete)
        throw InputError(
            fmt::format("{}: the run is not complete; run the same study again to continue it", data_->name));
    return fragility_of(data_->fragility);
}

const std::vector<Table>& Result::tables() const
{
    return data_->tables;
}

Result::Data::Data(inner::ResultHeader of, inner::Study from, std::string called)
    : header(std::move(of)), study(std::move(from)), name(std::move(called)),
      limits(header.block_names.size(),
             header.kind == "replay" ? inner::MotionGroups{} : inner::motion_groups(study, header.motions)),
      trials_(header.kind == "replay" ? study.total() : study.originals())
{
    if (header.cells() > 0)
        for (std::size_t i = 0; i < inner::limit_state_names().size(); ++i)
            counts_.emplace_back(header, static_cast<inner::LimitState>(i));
}

void Result::Data::count_the_first(const std::function<bool(std::uint64_t)>& has)
{
    if (header.selected || study.design().traced)
        return; // their realizations begin in another order
    order_.emplace(trials_);
    while (places_ < trials_ && has(order_->index(places_)))
        ++places_;
    places_ = order_->fair(places_);
}

bool Result::Data::counts(std::uint64_t index) const
{
    return index < trials_ && (!order_ || order_->place(index) < places_);
}

void Result::Data::add(const inner::ResultRow& row)
{
    ++done;
    invalid += row.outcome.state == inner::State::invalid;
    if (header.has_rows())
        outcomes.push_back(outcome_of(row));
    if (!counts(row.index))
        return;
    limits.add(row);
    for (inner::SurfaceCounts& each : counts_)
        each.add(row);
}

void Result::Data::add(const inner::Tally& tally)
{
    limits = inner::LimitCounts(tally);
    invalid = tally.all_invalid();
    for (std::size_t i = 0; i < counts_.size(); ++i)
        counts_[i] = inner::SurfaceCounts::of(inner::surface_of(header, tally, static_cast<inner::LimitState>(i)));
}

void Result::Data::finish(std::optional<inner::SurfaceTable> surface, const std::vector<inner::Table>& found)
{
    std::sort(outcomes.begin(), outcomes.end(), [](const Outcome& a, const Outcome& b) { return a.index < b.index; });
    for (const inner::SurfaceCounts& each : counts_)
        surfaces.push_back(each.table());
    counts_.clear();
    if (surface && !surfaces.empty())
        surfaces[static_cast<std::size_t>(inner::LimitState::collapse)] = std::move(*surface);
    const auto named = [&](const std::string& wanted) {
        const auto at = std::ranges::find(found, wanted, &inner::Table::name);
        return at == found.end() ? inner::Table(wanted) : *at;
    };
    rare = inner::rare_table(named("rare"));
    fragility = inner::fragility_table(named("fragility"));
    tables = tables_of(found);
}

namespace {

Estimate estimate(const stylobate::IntervalArray& array, std::size_t i)
{
    return {array.value[i], array.lower[i], array.upper[i]};
}

} // namespace

Outcome outcome_of(const stylobate::ResultRow& row)
{
    const stylobate::Outcome& o = row.outcome;
    Outcome out;
    out.index = row.index;
    out.cell = row.cell;
    out.frequency_hz = row.frequency_hz;
    out.pga_m_s2 = row.pga_m_s2;
#define STYLOBATE_OUTCOME(type, name, ...) out.name = static_cast<type>(o.name);
#define STYLOBATE_OUTCOME_AS(public_type, public_name, type, name, ...)                                                \
    out.public_name = static_cast<public_type>(o.name);
#include "stylobate/outcome_fields.inc"
    out.fall_time_s = o.fall_time_s;
    out.inputs = row.inputs;
    return out;
}

Share share_of(const stylobate::Share& share)
{
    return {share.trials, share.count, share.probability, share.lower, share.upper};
}

Surface surface_of(const stylobate::SurfaceTable& table, const std::string& limit_state)
{
    return {limit_state,  table.interval,  table.frequency_hz, table.direction_deg, table.pga_m_s2,
            table.trials, table.collapses, table.probability,  table.lower,         table.upper};
}

Cell Surface::cell(std::size_t row, std::size_t pga) const
{
    if (row >= rows().size() || pga >= pga_m_s2.size())
        throw std::out_of_range("the surface has no such cell");
    const std::size_t i = row * pga_m_s2.size() + pga;
    Cell cell{0, 0, pga_m_s2[pga], trials[i], reached[i], probability[i], lower[i], upper[i]};
    (frequency_hz.empty() ? cell.direction_deg : cell.frequency_hz) = rows()[row];
    return cell;
}

Fragility fragility_of(const stylobate::FragilityTable& table)
{
    Fragility fragility{table.measure, table.grid, table.stripe, {}};
    for (std::size_t s = 0; s < table.states.size(); ++s) {
        FragilityCurve curve;
        curve.limit_state = table.states[s];
        curve.meaning = table.meanings[s];
        curve.trials = table.trials[s];
        curve.reached = table.reached[s];
        curve.median = estimate(table.median, s);
        curve.dispersion = estimate(table.dispersion, s);
        for (std::size_t i = 0; i < table.grid.size(); ++i)
            curve.probability.push_back(estimate(table.curve, s * table.grid.size() + i));
        for (std::size_t i = 0; i < table.stripe.size(); ++i)
            curve.share.push_back(estimate(table.share, s * table.stripe.size() + i));
        fragility.curves.push_back(std::move(curve));
    }
    return fragility;
}

} // namespace stylobate::api
