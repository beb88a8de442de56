#include "studies/decisions/search/search.hpp"

#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/paired/paired_difference.hpp"
#include "ensemble/estimators/search/search_answer.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/files/toml_document.hpp"
#include "io/study/study_file.hpp"
#include "studies/decisions/compare/compare_studies.hpp"
#include "studies/decisions/compare/pairing.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/decisions/search/search_objective.hpp"
#include "studies/results/study_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <set>

namespace stylobate {

namespace {

constexpr std::size_t most_points = 60;
/// Of the mean over the points that have been run: less is expected of a further point.
constexpr double least_improvement = 1e-3;

struct RunPoint {
    SearchPlace place;
    std::vector<double> value;
    std::unique_ptr<StudyRun> run;
    std::unique_ptr<StudySide> side;
};

OptimiseSpec spec_of(const SearchFiles& files)
{
    const std::optional<OptimiseSpec> spec = read_optimisation(files.study, files.settings);
    if (!spec)
        throw InputError(files.study, 0,
                         "has no [optimise].\n  Give [optimise] with a line \"KEY\" = { from = ..., to = ... } and "
                         "budget.");
    return *spec;
}

/// The study with these values; its file is named by its text, so that no two studies have one.
std::unique_ptr<StudyRun> run_at(const SearchFiles& files, const OptimiseSpec& spec, const std::vector<double>& value)
{
    std::vector<std::string> settings = files.settings;
    for (std::size_t k = 0; k < value.size(); ++k)
        settings.push_back(spec.keys[k].key + "=" + toml_number(value[k]));
    LoadedStudy loaded = [&] {
        try {
            return LoadedStudy::from_file(files.study, settings);
        } catch (const InputError& error) { // of a setting that the user did not give
            const std::string text = error.what(), setting = "--set ";
            if (value.empty() || !text.starts_with(setting))
                throw;
            throw InputError(files.study, 0, "[optimise] with " + text.substr(setting.size()));
        }
    }();
    const std::string stem = std::filesystem::path(files.study).stem().string();
    const std::string name =
        value.empty() ? stem : fmt::format("{}_search_{:08x}", stem, study_crc32_of(loaded.result_header()));
    return std::make_unique<StudyRun>(std::move(loaded), files.study,
                                      (std::filesystem::path(files.folder) / (name + ".h5")).string());
}

std::vector<double> values_at(const OptimiseSpec& spec, const SearchPlace& place)
{
    std::vector<double> value;
    for (std::size_t k = 0; k < place.size(); ++k)
        value.push_back(spec.keys[k].value(place[k]));
    return value;
}

std::unique_ptr<StudySide> side_of(const StudyRun& run)
{
    auto side = std::make_unique<StudySide>(run.study(), run.header());
    run.for_each_row([&](const ResultRow& row) { side->add(row); });
    return side;
}

SearchedRun validity_of(const StudyRun& run)
{
    return {run.results(), run.invalid(), run.done()};
}

std::size_t limit_number(const StudySide& side, const std::string& name, const std::string& study)
{
    const auto found = std::ranges::find(side.limits(), name, &LimitDefinition::name);
    if (found != side.limits().end())
        return static_cast<std::size_t>(found - side.limits().begin());
    std::string names;
    for (const LimitDefinition& limit : side.limits())
        names += (names.empty() ? "" : ", ") + limit.name;
    throw InputError(
        study, 0, fmt::format("optimise.minimise = \"{}\" is no limit state of the study.\n  It has {}.", name, names));
}

/// The improvement that is not worth a further point; half a count where no point has reached the state.
double enough(const PairedNoise& noise)
{
    double mean = 0;
    for (const double share : noise.share)
        mean += share / static_cast<double>(noise.share.size());
    return mean > 0 ? least_improvement * mean : std::sqrt(noise.half);
}

class Search {
public:
    Search(const SearchFiles& files, double level, const RunOptions& options, Observer& observer)
        : files_(files), options_(options), observer_(observer), spec_(spec_of(files))
    {
        result_.asked = spec_;
        result_.level = level;
    }

    std::optional<SearchResult> run()
    {
        base_ = run_at(files_, spec_, {});
        result_.dimensions = base_->study().structure.dimensions;
        layout_ = pair_layout(base_->study(), base_->header().motions, result_.level);
        if (layout_.motions.cells > 0 && layout_.groups < least_records)
            throw InputError(files_.study, 0,
                             fmt::format("[optimise]: a search needs at least {} different motions, and the study has "
                                         "{}.\n  Its points are compared by the scatter over motions: give more.",
                                         least_records, layout_.groups));
        if (!base_->run(options_, observer_).complete)
            return std::nullopt;
        base_side_ = side_of(*base_);
        limit_ = limit_number(*base_side_, spec_.minimise, files_.study);
        objective_.emplace(spec_, files_.study, base_->study(), result_.level);
        check_determined();
        const std::uint64_t each = base_->header().total;
        result_.realizations = each;
        for (const SearchPlace& place : first_places(spec_.keys.size()))
            if (!add(place))
                return std::nullopt;
        const std::vector<SearchPlace> candidates = candidate_places(spec_.keys.size());
        while (points_.size() < most_points) {
            if (observer_.stop_requested()) // while points that are there already are taken again
                return std::nullopt;
            const ResponseSurface surface(places(), noise());
            const NextPlace next = next_place(surface, candidates);
            if (next.improvement < enough(surface.noise()))
                break;
            result_.at_the_end = result_.realizations + each > spec_.budget;
            if (result_.at_the_end)
                break;
            if (!add(next.place))
                return std::nullopt;
        }
        conclude(candidates);
        return std::move(result_);
    }

private:
    std::vector<SearchPlace> places() const
    {
        std::vector<SearchPlace> all;
        for (const RunPoint& point : points_)
            all.push_back(point.place);
        return all;
    }

    PairedNoise noise() const
    {
        std::vector<const StudySide*> sides;
        for (const RunPoint& point : points_)
            sides.push_back(point.side.get());
        return objective_->noise(sides, limit_, layout_);
    }

    /// As `stylobate risk` refuses it.
    void check_determined()
    {
        if (!objective_->is_frequency())
            return;
        const FrequencyEstimate base = objective_->frequency(*base_side_, limit_, layout_);
        if (const std::optional<std::string> why = why_undetermined(base, RiskOptions{}.most_outside))
            throw InputError(files_.study, 0,
                             fmt::format("optimise.hazard: {} of the study as it stands: {}", spec_.minimise, *why));
        result_.base_frequency = base.frequency;
    }

    /// Runs a point. @returns whether it is complete
    bool add(const SearchPlace& place)
    {
        RunPoint point{place, values_at(spec_, place), nullptr, nullptr};
        point.run = run_at(files_, spec_, point.value);
        if (!point.run->run(options_, observer_).complete)
            return false;
        point.side = side_of(*point.run);
        result_.realizations += point.run->header().total;
        points_.push_back(std::move(point));
        return true;
    }

    void conclude(const std::vector<SearchPlace>& candidates)
    {
        const ResponseSurface surface(places(), noise());
        const SearchAnswer answer = search_answer(surface, candidates, result_.level);
        result_.best = values_at(spec_, answer.best);
        result_.value = answer.value;
        result_.lower = answer.lower;
        result_.upper = answer.upper;
        result_.flat_from = values_at(spec_, answer.from);
        result_.flat_to = values_at(spec_, answer.to);
        if (spec_.keys.size() == 2)
            result_.map = map_of(surface, answer);
        else
            for (std::size_t k = 0; k < spec_.keys.size(); ++k)
                result_.slices.push_back(slice(surface, answer, k));
        result_.runs.push_back(validity_of(*base_));
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < points_.size(); ++i) {
            result_.runs.push_back(validity_of(*points_[i].run));
            const PlaceComparison change = change_of(points_[i]);
            result_.points.push_back({points_[i].value,
                                      change.variant,
                                      {},
                                      std::filesystem::path(points_[i].run->results()).filename().string()});
            std::optional<std::string> outside;
            double unseen = 0;
            if (objective_->is_frequency()) {
                const FrequencyEstimate own = objective_->frequency(*points_[i].side, limit_, layout_);
                result_.points.back().frequency = own.frequency;
                outside = why_undetermined(own, RiskOptions{}.most_outside);
                unseen = own.unseen;
            }
            if (const double mean = surface.at(points_[i].place).mean; mean < least) {
                least = mean;
                result_.best_point = i;
                result_.change = change;
                result_.outside = outside;
                result_.unseen = unseen;
                result_.base = change.base;
            }
        }
        if (objective_->is_frequency())
            result_.frequency_change =
                objective_->change(*base_side_, *points_[result_.best_point].side, limit_, layout_);
    }

    SearchSlice slice(const ResponseSurface& surface, const SearchAnswer& answer, std::size_t k) const
    {
        SearchSlice slice;
        std::vector<SearchPlace> places;
        for (const SearchPlace& along : candidate_places(1)) {
            places.push_back(answer.best);
            places.back()[k] = along[0];
            slice.x.push_back(spec_.keys[k].value(along[0]));
        }
        const PairedNoise& found = surface.noise();
        for (const ResponseSurface::Value& value : surface.values(places)) {
            const MeanLimits limits =
                mean_limits(value.mean, value.sd, found.most, answer.freedom, found.groups, result_.level);
            slice.value.push_back(std::clamp(value.mean, 0.0, found.most));
            slice.lower.push_back(limits.lower);
            slice.upper.push_back(limits.upper);
        }
        return slice;
    }

    static SearchMap map_of(const ResponseSurface& surface, const SearchAnswer& answer)
    {
        std::vector<SearchPlace> places = candidate_places(2);
        std::sort(places.begin(), places.end());
        const std::set<SearchPlace> flat(answer.flat.begin(), answer.flat.end());
        const std::vector<ResponseSurface::Value> values = surface.values(places);
        SearchMap map;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (map.place.empty() || places[i][0] > map.place.back()) {
                map.place.push_back(places[i][0]);
                map.value.emplace_back();
                map.flat.emplace_back();
            }
            map.value.back().push_back(std::clamp(values[i].mean, 0.0, surface.noise().most));
            map.flat.back().push_back(flat.contains(places[i]));
        }
        return map;
    }

    PlaceComparison change_of(const RunPoint& point) const
    {
        return compare_overall(count_pairs(*base_side_, *point.side, limit_, limit_, layout_), layout_);
    }

    const SearchFiles& files_;
    const RunOptions& options_;
    Observer& observer_;
    const OptimiseSpec spec_;
    SearchResult result_;
    PairLayout layout_;
    std::optional<SearchObjective> objective_;
    std::size_t limit_ = 0;
    std::unique_ptr<StudyRun> base_;
    std::unique_ptr<StudySide> base_side_;
    std::vector<RunPoint> points_;
};

} // namespace

void check_search(const SearchFiles& files)
{
    const OptimiseSpec spec = spec_of(files);
    const auto base = run_at(files, spec, {});
    check_can_be_compared(base->header(), files.study);
    limit_number(StudySide(base->study(), base->header()), spec.minimise, files.study);
    [[maybe_unused]] const SearchObjective refuses_a_hazard(spec, files.study, base->study(), interval_level);
    const std::uint64_t each = base->header().total, first = first_places(spec.keys.size()).size() + 1;
    if (spec.budget / each < first + 1)
        throw InputError(files.study, 0,
                         fmt::format("optimise.budget = {} holds {} runs of the study, which has {} realizations; the "
                                     "search needs at least {} runs.\n  Give a budget of at least {}, or fewer "
                                     "study.realizations.",
                                     spec.budget, spec.budget / each, each, first + 1, (first + 1) * each));
    base->check_drawn();
    for (const double end : {0.0, 1.0, 0.381966}) { // both ends of all keys, and a place where none is a whole number
        const auto at_end = run_at(files, spec, values_at(spec, SearchPlace(spec.keys.size(), end)));
        check_comparable(base->header(), files.study, at_end->header(), files.study + " (with a value of [optimise])");
        at_end->check_drawn();
    }
}

std::optional<SearchResult> search(const SearchFiles& files, double level, const RunOptions& options,
                                   Observer& observer)
{
    return Search(files, level, options, observer).run();
}

} // namespace stylobate
