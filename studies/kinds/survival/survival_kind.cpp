#include "studies/kinds/survival/survival_kind.hpp"

#include "io/plots/figure_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/kinds/survival/survival_text.hpp"

#include <fmt/format.h>

#include <numeric>

namespace stylobate {

bool SurvivalKind::plan(Rounds& rounds)
{
    rounds.progress.total = size_of(rounds.shard);
    std::vector<std::uint64_t> indices(study_.originals());
    for (int events = 1; events <= study_.events(); ++events) {
        std::iota(indices.begin(), indices.end(), static_cast<std::uint64_t>(events - 1) * study_.originals());
        if (!rounds.run({.indices = indices, .fair = events == 1}))
            return false;
    }
    return true;
}

void SurvivalKind::take(const ResultRow& row)
{
    SurfaceKind::take(row);
    rows_.add(row);
}

std::vector<Table> SurvivalKind::tables() const
{
    if (survival_.axes.intensity.empty())
        return {};
    return {survival_table(survival_)};
}

std::string SurvivalKind::text() const
{
    return SurfaceKind::text() + survival_text(survival_);
}

void SurvivalKind::add_to(Json& json) const
{
    json.member("survival", survival_json(survival_));
}

Picture SurvivalKind::picture(const ResultReader& reader, const std::string& results,
                              const PictureRequest& request) const
{
    if (request.name == "surface" || request.name == "slice")
        return SurfaceKind::picture(reader, results, request);
    check_complete(reader, results);
    if (request.name == "likelihood")
        return {"likelihood", survival_.state_measured ? "Likelihood of the observed state" : "Probability of standing",
                "", [this](const std::string& title, const std::filesystem::path& file) {
                    plot_likelihood(survival_, title, file);
                }};
    if (request.name == "exclusion") {
        if (!survival_.judged())
            throw InputError(fmt::format("--picture exclusion: {}: {}", results, not_judged_words(survival_)));
        return {"exclusion", "Excluded shaking", "",
                [this](const std::string& title, const std::filesystem::path& file) {
                    write_figure(exclusion_figure(survival_), title, "bands: 95 % intervals of the counts", file);
                }};
    }
    if (!survival_.rates)
        throw InputError(fmt::format("--picture rates: {} has no survival.stands_for_years, by which the rates of its "
                                     "hazard curve are updated.",
                                     results));
    return {"rates", "Factor on the rates of the hazard curve", "",
            [this](const std::string& title, const std::filesystem::path& file) {
                write_figure(rates_figure(survival_), title, "bands: 95 % intervals of the counts", file);
            }};
}

std::vector<std::pair<std::string, std::string>> SurvivalKind::files(const std::string& format,
                                                                     const std::string& name) const
{
    auto files = SurfaceKind::files(format, name);
    files.emplace_back("survival.csv", survival_csv(survival_));
    return files;
}

std::optional<Answer> SurvivalKind::answer() const
{
    return survival_answer(survival_);
}

void SurvivalKind::sections(PageWriter& writer) const
{
    survival_section(survival_, writer);
    SurfaceKind::sections(writer);
}

} // namespace stylobate
