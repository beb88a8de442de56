#include "studies/app/choose_realization.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/motion_set.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/plot_axis.hpp"
#include "studies/experiment/loaded_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

namespace stylobate {

namespace {

/// A value is within an axis if it is so to the digits that people type.
constexpr double typed = 5e-3;

/// The value of an axis that is nearest on the axis' scale.
/// @param option "--pga"   @throws InputError if the value lies outside the axis
std::size_t nearest_on(const std::vector<double>& axis, double wanted, const char* option, const char* unit,
                       const std::string& results)
{
    if (!(wanted >= axis.front() * (1 - typed) && wanted <= axis.back() * (1 + typed)))
        throw InputError(axis.size() == 1 ? fmt::format("{} {:g}: {} has {:.4g} {} alone", option, wanted, results,
                                                        axis.front(), unit)
                                          : fmt::format("{} {:g}: the axis of {} goes from {:.4g} to {:.4g} {}", option,
                                                        wanted, results, axis.front(), axis.back(), unit));
    const PlotAxis scale = make_plot_axis(axis, option);
    const auto distance = [&](double value) { return std::abs(scale.scaled(value) - scale.scaled(wanted)); };
    return static_cast<std::size_t>(
        std::min_element(axis.begin(), axis.end(), [&](double a, double b) { return distance(a) < distance(b); }) -
        axis.begin());
}

/// @returns the number of a motion by its name, or by the number itself   @throws InputError if there is none
std::size_t motion_of(const std::vector<std::string>& names, const std::string& wanted, const std::string& results)
{
    if (const auto found = std::find(names.begin(), names.end(), wanted); found != names.end())
        return static_cast<std::size_t>(found - names.begin());
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    if (error == std::errc{} && end == wanted.data() + wanted.size() && number < names.size())
        return number;
    const std::string meant = nearest_word(wanted, names);
    throw InputError(fmt::format("--motion {}: {} has {} motions, by name or by number from 0 to {}.\n  {}", wanted,
                                 results, names.size(), names.size() - 1,
                                 meant.empty() ? fmt::format("The first is '{}'.", names.front())
                                               : fmt::format("Did you mean '{}'?", meant)));
}

/// Which cells are meant, and where they are in words.
struct Place {
    std::function<bool(std::uint64_t cell)> has = [](std::uint64_t) { return true; };
    std::string words; ///< "at 3.02 Hz, 9.8 m/s2"; empty: anywhere
};

Place of_surface(const ResultHeader& header, const std::string& results, const RealizationChoice& choice)
{
    std::optional<std::uint64_t> f, p;
    Place place;
    if (choice.frequency_hz) {
        f = nearest_on(header.frequency_hz, *choice.frequency_hz, "--frequency", "Hz", results);
        place.words = fmt::format("at {:.4g} Hz", header.frequency_hz[*f]);
    }
    if (choice.pga_m_s2) {
        p = nearest_on(header.pga_m_s2, *choice.pga_m_s2, "--pga", "m/s2", results);
        place.words += fmt::format("{}{:.4g} m/s2", f ? ", " : "at ", header.pga_m_s2[*p]);
    }
    place.has = [f, p, np = header.pga_m_s2.size()](std::uint64_t cell) {
        return (!f || cell / np == *f) && (!p || cell % np == *p);
    };
    return place;
}

Place of_fragility(const ResultHeader& header, const Study& study, const std::string& results,
                   const RealizationChoice& choice)
{
    const FragilitySpec& spec = *study.fragility;
    std::optional<std::uint64_t> m, s;
    Place place;
    if (!choice.motion.empty()) {
        m = motion_of(header.motions.names, choice.motion, results);
        place.words = fmt::format("under motion '{}'", header.motions.names[*m]);
    }
    if (choice.intensity) {
        if (spec.method == FragilityMethod::cloud)
            throw InputError(fmt::format("--intensity {:g}: {} is a cloud: each motion shakes once, as strong as it "
                                         "is. Choose by --motion.",
                                         *choice.intensity, results));
        std::vector<double> levels;
        for (int i = 0; i < spec.intensity.count; ++i)
            levels.push_back(spec.intensity.value(i));
        const std::string measure = measure_name(spec.measure, spec.period_s);
        s = nearest_on(levels, *choice.intensity, "--intensity", ("of " + measure).c_str(), results);
        place.words += fmt::format("{}at {} = {:.4g}", m ? ", " : "", measure, levels[*s]);
    }
    place.has = [m, s, stripes = static_cast<std::uint64_t>(spec.stripes())](std::uint64_t cell) {
        return (!m || cell / stripes == *m) && (!s || cell % stripes == *s);
    };
    return place;
}

Place place_of(const ResultHeader& header, const Study& study, const std::string& results,
               const RealizationChoice& choice)
{
    const bool surface = !header.frequency_hz.empty(), fragility = header.kind == "fragility";
    const char* needs_surface = choice.frequency_hz ? "--frequency" : choice.pga_m_s2 ? "--pga" : nullptr;
    const char* needs_fragility = !choice.motion.empty() ? "--motion" : choice.intensity ? "--intensity" : nullptr;
    if (needs_surface && !surface)
        throw InputError(fmt::format("{}: {} is a result of kind '{}', which has no axes of frequency and PGA.{}",
                                     needs_surface, results, header.kind,
                                     fragility ? " Choose by --motion and --intensity." : ""));
    if (needs_fragility && !fragility)
        throw InputError(fmt::format("{}: {} is a result of kind '{}', not of a fragility study.{}", needs_fragility,
                                     results, header.kind, surface ? " Choose by --frequency and --pga." : ""));
    return surface     ? of_surface(header, results, choice)
           : fragility ? of_fragility(header, study, results, choice)
                       : Place{};
}

/// What is asked for must be one thing.
void check_asked(const RealizationChoice& choice)
{
    const bool by_property = choice.frequency_hz || choice.pga_m_s2 || !choice.motion.empty() || choice.intensity ||
                             choice.fallen || choice.stood || choice.nth;
    if (choice.index && by_property)
        throw InputError(fmt::format("--realization {}: names one realization; leave out what chooses among them "
                                     "(--frequency, --pga, --motion, --intensity, --fallen, --stood, --nth)",
                                     *choice.index));
    if (!choice.index && !by_property)
        throw InputError("no realization is named.\n  Give its index by --realization I, or choose one: --frequency HZ "
                         "--pga M_S2 of a surface, --motion NAME --intensity X of a fragility study, --fallen or "
                         "--stood, --nth N.");
    if (choice.fallen && choice.stood)
        throw InputError("--fallen --stood: no realization did both; give one of them");
    if (choice.nth && *choice.nth < 1)
        throw InputError(fmt::format("--nth {}: counts from 1", *choice.nth));
}

} // namespace

ChosenRealization choose_realization(const ResultReader& reader, const Study& study, const std::string& results,
                                     const RealizationChoice& choice)
{
    check_asked(choice);
    const ResultHeader& header = reader.header();
    if (choice.index) {
        const std::uint64_t end = realizations_end(header, study);
        const auto index = static_cast<std::uint64_t>(std::max(*choice.index, 0LL));
        if (*choice.index < 0 || index >= end || index < header.first)
            throw InputError(fmt::format("--realization {}: {} has realizations {} to {}", *choice.index, results,
                                         header.first, end - 1));
        return {index, ""};
    }
    const Place place = place_of(header, study, results, choice);
    const bool by_outcome = choice.fallen || choice.stood;
    std::vector<std::uint64_t> found;
    std::uint64_t all = 0;
    const auto consider = [&](std::uint64_t index, std::uint64_t cell, State state) {
        // perturbed replicas are not among the realizations of a cell
        if (!place.has(cell) || (study.twins && header.kind != "replay" && index >= study.originals()))
            return;
        ++all;
        const bool fell = state == State::collapsed, valid = state != State::invalid;
        if (!by_outcome || (choice.fallen ? fell : valid && !fell))
            found.push_back(index);
    };
    if (header.has_rows())
        reader.for_each_row([&](const ResultRow& row) { consider(row.index, row.cell, row.outcome.state); });
    else if (by_outcome)
        throw InputError(fmt::format("--{}: {} keeps no rows (output.realizations = \"none\"), and so not which "
                                     "realization fell. Choose by --frequency, --pga and --nth.",
                                     choice.fallen ? "fallen" : "stood", results));
    else
        for (std::uint64_t i = header.first; i < header.first + header.total; ++i)
            consider(i, study.cell(i), State::stood);
    std::sort(found.begin(), found.end());

    const std::string what = choice.fallen ? "fell" : choice.stood ? "stood" : "there are";
    const std::string where = place.words.empty() ? "" : " " + place.words;
    const std::string among = fmt::format("{} of {}{}{}", found.size(), all, where,
                                          header.has_rows() && !reader.complete() ? ", of those run so far" : "");
    const auto nth = static_cast<std::uint64_t>(choice.nth.value_or(1));
    if (found.empty())
        throw InputError(by_outcome ? fmt::format("{}: no realization {}: {}", results, what, among)
                                    : fmt::format("{}: no realization{} was run", results, where));
    if (nth > found.size())
        throw InputError(fmt::format("--nth {}: only {} {}", nth, among, by_outcome ? what : "are there"));
    return {found[nth - 1],
            by_outcome ? fmt::format("number {} of the {} that {}, of {}{}", nth, found.size(), what, all, where)
                       : fmt::format("number {} of {}{}", nth, all, where)};
}

} // namespace stylobate
