#include "library/results.hpp"

#include "io/study/study_file.hpp"
#include "library/outcomes.hpp"
#include "studies/kinds/adaptive/run_adaptive.hpp"
#include "studies/kinds/surface/surface.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate::api {

namespace {

/// @throws InputError for a word that is no limit state
inner::LimitState limit_of(const std::string& word)
{
    const std::vector<std::string>& names = inner::limit_state_names();
    if (std::find(names.begin(), names.end(), word) == names.end())
        throw InputError(fmt::format("\"{}\" is no limit state; there are {}", word, fmt::join(names, ", ")));
    return inner::limit_state_of(word);
}

bool is_adaptive(const inner::Study& study)
{
    return study.surface && study.surface->adaptive;
}

} // namespace

const char* to_string(State state)
{
    return inner::to_string(static_cast<inner::State>(state));
}

Result::Result(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Result Result::from_file(const std::filesystem::path& file)
{
    return translated([&] { return Inside::make<Result>({inner::ResultReader(file), file.string()}); });
}

Result::Data::Data(const inner::ResultReader& reader, const std::string& file)
    : header(reader.header()), study(inner::parse_study(header.study_toml, file + " (its study)")), name(file),
      complete(reader.complete()), done(reader.done()),
      limits(header.block_names.size(), header.kind == "replay" ? 0 : inner::cells_of_motion(study))
{
    std::vector<inner::SurfaceCounts> counts;
    if (!header.frequency_hz.empty())
        for (std::size_t i = 0; i < inner::limit_state_names().size(); ++i)
            counts.emplace_back(header.frequency_hz, header.pga_m_s2, static_cast<inner::LimitState>(i));
    const std::uint64_t originals = header.kind == "replay" ? study.total() : study.originals();
    reader.for_each_row([&](const inner::ResultRow& row) {
        outcomes.push_back(outcome_of(row));
        invalid += row.outcome.state == inner::State::invalid;
        if (row.index >= originals) // perturbed replicas are no further trials
            return;
        limits.add(row);
        for (inner::SurfaceCounts& each : counts)
            each.add(row);
    });
    std::sort(outcomes.begin(), outcomes.end(), [](const Outcome& a, const Outcome& b) { return a.index < b.index; });
    for (const inner::SurfaceCounts& each : counts)
        surfaces.push_back(each.table());
    if (const inner::Tally* tally = reader.tally()) {
        limits = inner::LimitCounts(*tally);
        invalid = tally->all_invalid();
        for (std::size_t i = 0; i < surfaces.size(); ++i)
            surfaces[i] = inner::surface_of(header, *tally, static_cast<inner::LimitState>(i));
    }
    if (complete && is_adaptive(study))
        surfaces[static_cast<std::size_t>(inner::LimitState::collapse)] = reader.surface();
    if (complete && study.rare)
        rare = reader.rare();
    if (complete && study.fragility)
        fragility = reader.fragility();
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

std::vector<std::string> Result::warnings() const
{
    return data_->header.warnings;
}

Share Result::share(const std::string& limit_state) const
{
    const inner::LimitState limit = limit_of(limit_state);
    Share share = share_of(data_->limits.share(limit));
    const bool adaptive = is_adaptive(data_->study), rare = data_->study.rare.has_value();
    if (!adaptive && !rare)
        return share;
    // some cells, or chains, have more realizations than others: the plain share means nothing
    if (limit != inner::LimitState::collapse || !data_->complete)
        throw InputError(fmt::format("{}: of {} only the share of the collapse is known, once it is complete",
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

std::vector<std::string> Result::block_names() const
{
    return data_->header.block_names;
}

Surface Result::surface(const std::string& limit_state) const
{
    const inner::LimitState limit = limit_of(limit_state);
    if (data_->surfaces.empty())
        throw InputError(fmt::format("{}: a result of kind '{}' has no surface", data_->name, kind()));
    if (is_adaptive(data_->study) && (limit != inner::LimitState::collapse || !data_->complete))
        throw InputError(fmt::format("{}: an adaptive surface is that of the collapse, once it is complete; its "
                                     "realizations lie where that one needed them",
                                     data_->name));
    return surface_of(data_->surfaces[static_cast<std::size_t>(limit)], limit_state);
}

Fragility Result::fragility() const
{
    if (!data_->study.fragility || kind() == "replay")
        throw InputError(fmt::format("{}: a result of kind '{}' is no fragility study", data_->name, kind()));
    if (!data_->complete)
        throw InputError(
            fmt::format("{}: the run is not complete; run the same study again to continue it", data_->name));
    return fragility_of(data_->fragility);
}

} // namespace stylobate::api
