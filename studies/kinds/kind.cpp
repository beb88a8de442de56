#include "studies/kinds/kind.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/store/surface_axis.hpp"
#include "studies/kinds/limit_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace stylobate {

std::size_t nearest_on_axis(const std::vector<double>& axis, double wanted, const char* option, const std::string& unit,
                            const std::string& results)
{
    constexpr double typed = 5e-3; // a value is within an axis if it is so to the digits that people type
    const double first = axis.front(), last = axis.back(); // of directions also below zero
    if (!(wanted >= first - typed * std::abs(first) && wanted <= last + typed * std::abs(last)))
        throw InputError(axis.size() == 1 ? fmt::format("{} {:g}: {} has only {:.4g} {}", option, wanted, results,
                                                        axis.front(), unit)
                                          : fmt::format("{} {:g}: the axis of {} goes from {:.4g} to {:.4g} {}", option,
                                                        wanted, results, axis.front(), axis.back(), unit));
    return make_cell_axis(axis, option).nearest(wanted);
}

void check_complete(const ResultReader& reader, const std::string& results)
{
    if (!reader.complete())
        throw InputError(fmt::format("{}: the run is not complete: it has {} of {} realizations.\n  Run the same study "
                                     "again to continue it.",
                                     results, reader.done(), reader.header().total));
}

Kind::Kind(const Study& study, const ResultHeader& header)
    : study_(study), header_(header), counts_(header.block_names.size(), motion_groups(study, header.motions))
{
}

void Kind::add(const ResultRow& row)
{
    if (is_trial(row.index))
        counts_.add(row);
    take(row);
}

void Kind::add(const Tally& tally)
{
    counts_ = LimitCounts(tally);
    take(tally);
}

std::optional<std::string> Kind::prepare(const Experiment&, const std::string&)
{
    return std::nullopt;
}

void Kind::share(Progress& progress) const
{
    estimate_share(progress, counts_.trials(), counts_.share(LimitState::collapse).count);
}

std::string Kind::text() const
{
    return counts_.trials() == 0 ? ""
                                 : limits_text(counts_, header_.block_names, study_.outcome.follow == Follow::rest,
                                               counted_words(study_));
}

Json Kind::limits_json() const
{
    return stylobate::limits_json(counts_, header_.block_names, study_.outcome.follow == Follow::rest,
                                  !header_.selected);
}

ChosenCells Kind::choose(const CellChoice& choice, const std::string& results) const
{
    const auto refuse = [&](const char* option, const char* why) {
        const std::optional<std::string> by = chosen_by();
        throw InputError(fmt::format("{}: {} is a result of kind '{}', {}.{}", option, results, kind_name(), why,
                                     by ? " Choose by " + *by + "." : ""));
    };
    if (choice.frequency_hz || choice.pga_m_s2)
        refuse(choice.frequency_hz ? "--frequency" : "--pga", "which has no axes of frequency and PGA");
    if (choice.direction_deg)
        refuse("--direction", "which has no axis of directions");
    if (choice.motion || choice.intensity)
        refuse(choice.motion ? "--motion" : "--intensity", "not of a fragility study");
    return {};
}

Picture Kind::picture(const ResultReader&, const std::string&, const PictureRequest&) const
{
    throw std::logic_error("a kind without pictures is not asked for one");
}

std::vector<std::pair<std::string, std::string>> Kind::files(const std::string& format, const std::string& name) const
{
    if (format != "csv")
        throw InputError(
            fmt::format("--to {}: {} is a result of kind '{}', which has no fragility functions; a study of "
                        "study.kind = \"fragility\" has",
                        format, name, kind_name()));
    return {};
}

} // namespace stylobate
