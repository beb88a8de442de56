#include "studies/kinds/law_band.hpp"

#include "studies/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

std::string number(double value)
{
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "none";
}

/// "0.61 to 0.88 (rigid to stiffer)"
std::string spread(const LawBand::Place& place, const std::vector<std::string>& laws, std::string (*text)(double))
{
    if (place.low() == place.high())
        return text(place.low()) + " under each law";
    return fmt::format("{} to {} ({} to {})", text(place.low()), text(place.high()), laws[place.lowest()],
                       laws[place.highest()]);
}

Json place_json(const LawBand::Place& place, const LawBand& band)
{
    Json by_law = Json::object();
    for (std::size_t i = 0; i < band.laws.size(); ++i)
        by_law.member(band.laws[i], place.probability[i]);
    Json json = Json::object();
    add_law_range(json, place, band.laws);
    return json.member("probability", by_law);
}

/// Probability under each law over all, with the paired difference.
HtmlTable laws_table(const LawBand& band)
{
    const LawBand::Limit& limit = band.limits.front();
    HtmlTable table{"llrrr",
                    {"law", "", "probability", "difference", fmt::format("{:g} % interval, paired", 100 * band.level)},
                    {},
                    ""};
    for (std::size_t i = 0; i < band.laws.size(); ++i) {
        std::vector<Html> row = {code(band.laws[i]), band.words[i], percent_text(limit.overall.probability[i])};
        if (i == 0)
            row.insert(row.end(), {"", ""});
        else
            row.insert(row.end(), {fmt::format("{:+.1f}", 100 * limit.difference[i]),
                                   fmt::format("{:+.1f} to {:+.1f}", 100 * limit.lower[i], 100 * limit.upper[i])});
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::string range_words(const LawBand::Place& place)
{
    return std::isfinite(place.low()) ? fmt::format("{:.0f} to {:.0f}", 100 * place.low(), 100 * place.high()) : "–";
}

HtmlTable cells_table(const LawBand& band)
{
    const LawBand::Limit& limit = band.limits.front();
    HtmlTable table;
    if (band.cells() == 0) {
        table = {"rrlrl", {band.measure, "lowest", "law", "highest", "law"}, {}, ""};
        for (std::size_t cell = 0; cell < limit.cells.size(); ++cell) {
            const LawBand::Place& place = limit.cells[cell];
            table.rows.push_back({fmt::format("{:.4g}", band.intensity[cell]), percent_text(place.low()),
                                  code(band.laws[place.lowest()]), percent_text(place.high()),
                                  code(band.laws[place.highest()])});
        }
        return table;
    }
    const std::size_t nf = band.rows().size(), np = band.pga_m_s2.size();
    table.caption = fmt::format("Lowest to highest probability of collapse over the laws [%]; columns: {}, rows: PGA "
                                "[m/s²]",
                                band.row_quantity().label);
    table.align = "r" + std::string(nf, 'c');
    table.head = {"PGA"};
    for (const double value : band.rows())
        table.head.emplace_back(fmt::format("{:.3g}", value));
    for (std::size_t p = np; p-- > 0;) {
        std::vector<Html> row = {fmt::format("{:.3g}", band.pga_m_s2[p])};
        for (std::size_t f = 0; f < nf; ++f)
            row.emplace_back(range_words(limit.cells[f * np + p]));
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace

std::size_t LawBand::Place::lowest() const
{
    const auto known = [](double p) { return std::isnan(p) ? 2 : p; };
    return static_cast<std::size_t>(std::ranges::min_element(probability, {}, known) - probability.begin());
}

std::size_t LawBand::Place::highest() const
{
    const auto known = [](double p) { return std::isnan(p) ? -1 : p; };
    return static_cast<std::size_t>(std::ranges::max_element(probability, {}, known) - probability.begin());
}

std::optional<std::size_t> LawBand::Limit::widest() const
{
    const auto width = [](const Place& cell) { return cell.high() - cell.low(); };
    std::optional<std::size_t> widest;
    for (std::size_t cell = 0; cell < cells.size() && cells.size() > 1; ++cell)
        if (width(cells[cell]) > (widest ? width(cells[*widest]) : 0))
            widest = cell;
    return widest;
}

const LawBand::Limit* LawBand::limit(const std::string& name) const
{
    const auto found = std::ranges::find(limits, name, &Limit::name);
    return found == limits.end() ? nullptr : &*found;
}

std::string law_range_words(const LawBand::Place& place, const std::vector<std::string>& laws)
{
    return "contact law: " + spread(place, laws, number);
}

void add_law_range(Json& json, const LawBand::Place& place, const std::vector<std::string>& laws)
{
    json.member("lowest", place.low())
        .member("lowest_law", laws[place.lowest()])
        .member("highest", place.high())
        .member("highest_law", laws[place.highest()]);
}

std::string law_band_words(const LawBand::Limit& limit, const LawBand& band)
{
    const std::string text = law_range_words(limit.overall, band.laws);
    const std::optional<std::size_t> cell = limit.widest(); // laws may move cells with both signs
    if (!cell)
        return text;
    return fmt::format("{} over all cells, {} to {} at {}", text, number(limit.cells[*cell].low()),
                       number(limit.cells[*cell].high()), band.places[*cell]);
}

std::string law_band_text(const LawBand& band)
{
    const LawBand::Limit& limit = band.limits.front();
    std::string text = fmt::format("{}, {} as given; probability of {}{}\n", law_range_words(limit.overall, band.laws),
                                   number(limit.overall.probability.front()), limit.name,
                                   limit.cells.size() > 1 ? " over all cells" : "");
    for (std::size_t i = 1; i < band.laws.size(); ++i)
        text += fmt::format("  {:<8} {:<50} {}, difference {:+.4f} ({:+.4f} to {:+.4f})\n", band.laws[i], band.words[i],
                            number(limit.overall.probability[i]), limit.difference[i], limit.lower[i], limit.upper[i]);
    if (const std::optional<std::size_t> cell = limit.widest())
        text +=
            fmt::format("  widest band at {}: {}, {} as given\n", band.places[*cell],
                        spread(limit.cells[*cell], band.laws, number), number(limit.cells[*cell].probability.front()));
    for (const std::string& note : band.notes)
        text += "  " + note + "\n";
    for (const std::string& law : band.left_out)
        text += "  left out: " + law + "\n";
    return text + fmt::format("  band of each cell and limit state: {}\n", band.file);
}

Json law_band_json(const LawBand& band)
{
    Json laws = Json::list(), limits = Json::object();
    for (std::size_t i = 0; i < band.laws.size(); ++i)
        laws.item(Json::object().member("name", band.laws[i]).member("words", band.words[i]));
    for (const LawBand::Limit& limit : band.limits) {
        Json differences = Json::object(), cells = Json::list();
        for (std::size_t i = 1; i < band.laws.size(); ++i)
            differences.member(band.laws[i], Json::object()
                                                 .member("difference", limit.difference[i])
                                                 .member("lower", limit.lower[i])
                                                 .member("upper", limit.upper[i]));
        for (const LawBand::Place& place : limit.cells)
            cells.item(place_json(place, band));
        limits.member(limit.name,
                      Json::object()
                          .member("overall", place_json(limit.overall, band).member("differences", differences))
                          .member("cells", cells));
    }
    return Json::object()
        .member("file", band.file)
        .member("complete", true)
        .member("pairs", band.pairs)
        .member("level", band.level)
        .member("laws", laws)
        .member("left_out", Json::list(band.left_out))
        .member("notes", Json::list(band.notes))
        .member("limit_states", limits);
}

Table law_band_rows(const LawBand& band)
{
    std::vector<std::string> limits, cells, lowest_law, highest_law;
    std::vector<double> row, pga, intensity, lowest, highest;
    std::vector<std::vector<double>> probability(band.laws.size());
    const auto add = [&](const LawBand::Limit& limit, const LawBand::Place& place, std::size_t cell, bool all) {
        const std::size_t np = std::max<std::size_t>(1, band.pga_m_s2.size());
        limits.push_back(limit.name);
        cells.push_back(all ? "all" : fmt::format("{}", cell));
        row.push_back(all || band.cells() == 0 ? std::nan("") : band.rows()[cell / np]);
        pga.push_back(all || band.pga_m_s2.empty() ? std::nan("") : band.pga_m_s2[cell % np]);
        intensity.push_back(all || band.intensity.empty() ? std::nan("") : band.intensity[cell]);
        lowest.push_back(place.low());
        lowest_law.push_back(band.laws[place.lowest()]);
        highest.push_back(place.high());
        highest_law.push_back(band.laws[place.highest()]);
        for (std::size_t i = 0; i < band.laws.size(); ++i)
            probability[i].push_back(place.probability[i]);
    };
    for (const LawBand::Limit& limit : band.limits) {
        for (std::size_t cell = 0; cell < limit.cells.size(); ++cell)
            add(limit, limit.cells[cell], cell, false);
        add(limit, limit.overall, 0, true);
    }
    const std::size_t n = limits.size();
    Table table("contact_laws");
    table.add("limit_state", std::move(limits));
    table.add("cell", std::move(cells));
    if (band.cells() > 0) {
        table.add(band.row_quantity().key, std::move(row), {n});
        table.add("pga_m_s2", std::move(pga), {n});
    }
    if (!band.intensity.empty())
        table.add(band.measure, std::move(intensity), {n});
    table.add("lowest", std::move(lowest), {n});
    table.add("lowest_law", std::move(lowest_law));
    table.add("highest", std::move(highest), {n});
    table.add("highest_law", std::move(highest_law));
    for (std::size_t i = 0; i < band.laws.size(); ++i)
        table.add(i == 0 ? "probability_as_given" : "probability_" + band.laws[i], std::move(probability[i]), {n});
    return table;
}

void law_band_section(PageWriter& writer, const LawBand& band)
{
    const LawBand::Limit& limit = band.limits.front();
    writer.page.section("Contact law");
    writer.page.paragraph(fmt::format(
        "The contact law of a monument is not known. Over {} laws the probability of collapse{} is {}; with the law of "
        "the study it is {}. All laws have the same structures and the same shaking.",
        band.laws.size(), limit.cells.size() > 1 ? " in all cells together" : "",
        spread(limit.overall, band.laws, percent_text), percent_text(limit.overall.probability.front())));
    writer.page.table(laws_table(band));
    if (const std::optional<std::size_t> cell = limit.widest())
        writer.page.paragraph(fmt::format("The band is widest at {}: {}.", band.places[*cell],
                                          spread(limit.cells[*cell], band.laws, percent_text)));
    if (limit.cells.size() > 1)
        writer.page.table(cells_table(band));
    for (const std::string& note : band.notes)
        writer.page.note(note);
    for (const std::string& law : band.left_out)
        writer.page.note("Left out: " + law);
    writer.page.note(
        "The ends of a band are estimates: the lowest and the highest of several are spread by chance too, "
        "by about the interval of a difference. All limit states: " +
        band.file + " and stylobate export --to csv.");
}

std::string law_advice(const Study& study)
{
    const StudyDesign design = study.design();
    const bool pairs = !design.selected && !design.factors && !design.end_state; // that `compare` takes
    const std::string command = "stylobate run STUDY.toml --laws";
    std::string how = command + " measures by how much.";
    if (study.contact.form == ContactForm::rigid)
        how = "give contact.form = \"two_corner\" and a stiffness, and " + command +
              " measures by how much, rigid contacts among the laws.";
    else if (!pairs)
        how = command + " measures by how much, of the same structure and shaking as a surface.";
    else if (study.kept == KeptRealizations::none)
        how = command + " measures by how much, with output.realizations = \"all\".";
    return "The answer depends on the contact law: " + how;
}

} // namespace stylobate
