#include "bench/rigid_agreement.hpp"

#include "io/tables/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace stylobate {

namespace {

constexpr double bound = 2; // standard errors, of what is said to agree

struct Probability {
    double value = 0, error = 0;
};

struct Row {
    std::string name;         ///< "0.1", "rigid, e = 0.3, Poisson"
    std::string at;           ///< K_N, or the step of rigid blocks
    bool rigid = false;       ///< rigid blocks
    double damping_ratio = 0; ///< of two corners
    std::vector<std::optional<Probability>> cells;
};

struct Agreement {
    std::vector<std::string> cells; ///< their names
    std::vector<Row> rows;          ///< without that of the limit
    Row limit;                      ///< rigid, e = 0
};

/// Fields of a row of a table, without blanks and bold marks.
std::vector<std::string> fields_of(std::string line)
{
    std::erase(line, '*');
    std::vector<std::string> fields;
    std::istringstream stream(line.substr(1, line.rfind('|') - 1));
    for (std::string field; std::getline(stream, field, '|');) {
        const std::size_t from = field.find_first_not_of(' '), to = field.find_last_not_of(' ');
        fields.push_back(from == std::string::npos ? "" : field.substr(from, to - from + 1));
    }
    return fields;
}

/// "0.960 ± 0.012", "1.000", or nothing.
std::optional<Probability> probability_of(const std::string& field)
{
    if (field.empty())
        return std::nullopt;
    const std::size_t sign = field.find("±");
    return Probability{std::stod(field), sign == std::string::npos ? 0 : std::stod(field.substr(sign + 2))};
}

Agreement read_agreement(const std::string& page)
{
    Agreement found;
    std::istringstream lines(page);
    std::string line;
    while (std::getline(lines, line) && !line.starts_with("| contacts |")) {
    }
    if (!lines)
        throw std::runtime_error("the page has no table that begins with '| contacts |'");
    const std::vector<std::string> head = fields_of(line);
    found.cells.assign(head.begin() + 2, head.end());
    std::getline(lines, line); // the rule
    const std::string corners = "two_corner, damping ratio ";
    while (std::getline(lines, line) && line.starts_with("|")) {
        std::vector<std::string> fields = fields_of(line);
        fields.resize(head.size());
        Row row{fields[0], fields[1], fields[0].starts_with("rigid"), 0, {}};
        if (!row.rigid) {
            if (row.name.starts_with(corners))
                row.name.erase(0, corners.size());
            row.damping_ratio = std::stod(row.name);
        }
        for (std::size_t i = 2; i < fields.size(); ++i)
            row.cells.push_back(probability_of(fields[i]));
        if (row.name == "rigid, e = 0")
            found.limit = row;
        else
            found.rows.push_back(row);
    }
    if (found.limit.cells.empty() || !std::ranges::all_of(found.limit.cells, &std::optional<Probability>::has_value))
        throw std::runtime_error("the table has no complete row 'rigid, e = 0'");
    return found;
}

struct Difference {
    const Row* row = nullptr;
    std::size_t cell = 0;
    double value = 0, error = 0;
    bool agrees() const { return std::fabs(value) <= bound * error; }
};

/// Of the rows that are asked for, in the cells that are asked for.
std::vector<Difference> differences(const Agreement& a, const std::function<bool(const Row&)>& rows,
                                    const std::function<bool(std::size_t)>& cells)
{
    std::vector<Difference> all;
    for (const Row& row : a.rows)
        for (std::size_t i = 0; i < a.cells.size(); ++i)
            if (rows(row) && cells(i) && row.cells[i]) {
                const Probability &p = *row.cells[i], &limit = *a.limit.cells[i];
                all.push_back({&row, i, p.value - limit.value, std::hypot(p.error, limit.error)});
            }
    return all;
}

std::string place(const Agreement& a, const Difference& d)
{
    return fmt::format("{:+.3f} ± {:.3f} ({}{}, {})", d.value, d.error, d.row->rigid ? "" : "ratio ", d.row->name,
                       a.cells[d.cell]);
}

/// "agree in 3 of 12 probabilities and differ by -0.065 ± 0.026 (...) to +0.146 ± 0.008 (...)".
std::string words(const Agreement& a, const std::vector<Difference>& all)
{
    const auto agree = std::ranges::count_if(all, &Difference::agrees);
    const auto [least, most] = std::ranges::minmax_element(all, {}, &Difference::value);
    return fmt::format("{} of {} probabilities agree; the differences are {} to {}", agree, all.size(),
                       place(a, *least), place(a, *most));
}

} // namespace

std::string agreement_text(const std::string& page)
{
    const Agreement a = read_agreement(page);
    const auto low = [](const Row& r) { return !r.rigid && r.damping_ratio < 1; };
    const auto high = [](const Row& r) { return !r.rigid && r.damping_ratio >= 1; };
    const auto rebounding = [](const Row& r) { return r.rigid; };
    const auto one_block = [](std::size_t i) { return i == 0; };
    const auto several = [](std::size_t i) { return i > 0; };
    std::string text =
        fmt::format("Differences from rigid blocks with e = 0. Two probabilities *agree* where they differ "
                    "by at most {:g} standard errors of their difference, as of independent draws.\n\n",
                    bound);
    text += markdown_head("contacts | one block | several blocks");
    for (const auto& [name, rows] : std::vector<std::pair<std::string, std::function<bool(const Row&)>>>{
             {"two corners, damping ratio below 1", low},
             {"two corners, damping ratio of 1 and more", high},
             {"rigid blocks with a restitution above 0", rebounding}})
        text += markdown_row("{} | {} | {}", name, words(a, differences(a, rows, one_block)),
                             words(a, differences(a, rows, several)));
    const auto all_agree = [&](const auto& rows, const auto& cells) {
        return std::ranges::all_of(differences(a, rows, cells), &Difference::agrees);
    };
    const auto sentence = [&](const char* what, const auto& cells) {
        const bool plastic = all_agree(high, cells), any = all_agree(low, cells);
        return fmt::format("**{}.** Rigid blocks with e = 0 are {}. {}\n", what,
                           plastic && any ? "the limit of stiff contacts at every damping ratio of the table"
                           : plastic ? "the limit of contacts with a damping ratio of 1 and more, and not of contacts "
                                       "that rebound"
                                     : "not the limit of all contacts with a damping ratio of 1 and more, and not of "
                                       "contacts that rebound",
                           all_agree(rebounding, cells)
                               ? "A restitution up to that of the table does not change their probabilities."
                               : "A restitution above 0 changes their probabilities.");
    };
    return text + "\n" + sentence("One block", one_block) + "\n" + sentence("Several blocks", several);
}

} // namespace stylobate
