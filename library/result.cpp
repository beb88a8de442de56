#include "library/results.hpp"

#include "io/store/result_layout.hpp"
#include "io/study/study_file.hpp"
#include "library/outcomes.hpp"
#include "studies/kinds/adaptive/adaptive_kind.hpp"
#include "studies/workflow/run.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate::api {

namespace {

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
            data.finish(header.frequency_hz.empty() ? std::nullopt : std::optional(reader.surface()),
                        reader.table("rare"), reader.table("fragility"));
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

std::string Result::too_many_invalid() const
{
    if (!data_->complete)
        return {};
    return inner::too_many_invalid(data_->study, data_->invalid, data_->done, data_->name).value_or("");
}

std::vector<std::string> Result::warnings() const
{
    return data_->header.warnings;
}

Share Result::share(const std::string& limit_state) const
{
    const inner::LimitState limit = limit_of(limit_state);
    Share share = share_of(data_->limits.share(limit));
    const bool adaptive = data_->is_adaptive(), rare = data_->study.rare.has_value();
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
    if (!data_->study.fragility || kind() == "replay")
        throw InputError(fmt::format("{}: a result of kind '{}' is not a fragility study", data_->name, kind()));
    if (!data_->complete)
        throw InputError(
            fmt::format("{}: the run is not complete; run the same study again to continue it", data_->name));
    return fragility_of(data_->fragility);
}

} // namespace stylobate::api
