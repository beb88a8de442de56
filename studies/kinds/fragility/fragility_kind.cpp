#include "studies/kinds/fragility/fragility_kind.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/motion_set.hpp"
#include "io/files/suggest.hpp"
#include "io/tables/table.hpp"
#include "studies/kinds/fragility/exchange.hpp"
#include "studies/kinds/fragility/fragility_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace stylobate {

namespace {

/// @returns the number of a motion by its name, or by the number itself   @throws InputError if there is none
std::size_t motion_of(const std::vector<std::string>& names, const std::string& wanted, const std::string& results)
{
    if (const auto found = std::find(names.begin(), names.end(), wanted); found != names.end())
        return static_cast<std::size_t>(found - names.begin());
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    if (error == std::errc{} && end == wanted.data() + wanted.size() && number < names.size())
        return number;
    const auto meant = nearest_word(wanted, names);
    throw InputError(fmt::format("--motion {}: {} has {} motions, by name or by number from 0 to {}.\n  {}", wanted,
                                 results, names.size(), names.size() - 1,
                                 meant ? fmt::format("Did you mean '{}'?", *meant)
                                       : fmt::format("The first is '{}'.", names.front())));
}

} // namespace

std::string FragilityKind::text() const
{
    return Kind::text() + fragility_text(fragility_);
}

void FragilityKind::add_to(Json& json) const
{
    json.member("fragility", fragility_json(fragility_));
}

ChosenCells FragilityKind::choose(const CellChoice& choice, const std::string& results) const
{
    if (choice.frequency_hz || choice.pga_m_s2)
        return Kind::choose(choice, results);
    const FragilitySpec& spec = *study_.fragility;
    std::optional<std::uint64_t> m, s;
    ChosenCells cells;
    if (choice.motion) {
        m = motion_of(header_.motions.names, *choice.motion, results);
        cells.words = fmt::format("under motion '{}'", header_.motions.names[*m]);
    }
    if (choice.intensity) {
        if (spec.method == FragilityMethod::cloud)
            throw InputError(fmt::format(
                "--intensity {:g}: {} is a cloud: each motion is applied once, unscaled. Select by --motion.",
                *choice.intensity, results));
        std::vector<double> levels;
        for (int i = 0; i < spec.intensity.count; ++i)
            levels.push_back(spec.intensity.value(i));
        const std::string measure = measure_name(spec.measure, spec.period_s);
        s = nearest_on_axis(levels, *choice.intensity, "--intensity", "of " + measure, results);
        cells.words = fmt::format("{}at {} = {:.4g}", m ? *cells.words + ", " : "", measure, levels[*s]);
    }
    cells.has = [m, s, stripes = static_cast<std::uint64_t>(spec.stripes())](std::uint64_t cell) {
        return (!m || cell / stripes == *m) && (!s || cell % stripes == *s);
    };
    return cells;
}

Picture FragilityKind::picture(const ResultReader& reader, const std::string& results,
                               const PictureRequest& request) const
{
    check_complete(reader, results);
    std::vector<std::string> limits;
    if (request.limit)
        limits.push_back(*request.limit);
    return {request.limit ? "fragility_" + *request.limit : "fragility", "Fragility", "",
            [this, limits](const std::string& title, const std::filesystem::path& file) {
                plot_fragility(fragility_, limits, title, file);
            }};
}

Table FragilityKind::columns(const std::vector<ResultRow>& rows) const
{
    Table table("realizations");
    if (fragility_.motion.empty()) // the run is not complete
        return table;
    std::vector<std::string> names;
    for (const std::int32_t motion : fragility_.motion)
        names.push_back(header_.motions.names.at(static_cast<std::size_t>(motion)));
    table.add("motion", fragility_.motion, {rows.size()});
    table.add("motion_name", std::move(names), {rows.size()});
    table.add("intensity_" + fragility_.measure, fragility_.intensity, {rows.size()});
    return table;
}

std::vector<std::pair<std::string, std::string>> FragilityKind::files(const std::string& format,
                                                                      const std::string& name) const
{
    std::vector<std::pair<std::string, std::string>> files;
    if (format == "csv")
        files.emplace_back("motions.csv", csv_text(motions_list(header_.motions)));
    const std::vector<FragilityModel> models = fragility_models(fragility_, name);
    if (models.empty() && format != "csv")
        throw InputError(name + ": no limit state has a curve or shares by stripe to export" +
                         (fragility_.says.empty() ? "" : ":\n  " + fragility_.says.front()) +
                         "\n  The motions and all realizations: --to csv.");
    for (auto& file : model_files(models, format))
        files.push_back(std::move(file));
    return files;
}

std::optional<Answer> FragilityKind::answer() const
{
    return fragility_answer(fragility_);
}

void FragilityKind::sections(PageWriter& writer) const
{
    fragility_section(fragility_, writer.page);
}

} // namespace stylobate
