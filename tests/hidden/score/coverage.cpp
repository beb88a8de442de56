#include "tests/hidden/score/coverage.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "tests/program/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace stylobate::hidden {

namespace {

/// "column of 4 small blocks" and "column of 5 small blocks" are of one kind.
std::string kind_of(std::string specimen)
{
    std::replace_if(
        specimen.begin(), specimen.end(), [](unsigned char c) { return std::isdigit(c) != 0; }, 'n');
    return specimen;
}

CoverageRow& row_of(std::vector<CoverageRow>& rows, const std::string& of)
{
    for (CoverageRow& row : rows)
        if (row.of == of)
            return row;
    rows.push_back({of, 0, {}, {}, {}});
    return rows.back();
}

double rms(const std::vector<double>& values)
{
    double square = 0;
    for (const double v : values)
        square += v * v;
    return std::sqrt(square / static_cast<double>(values.size()));
}

} // namespace

SaidFriction parse_calibration(std::string_view text, const std::string& name)
{
    const auto fail = [&](const std::string& what) {
        throw InputError(name, 0, what + "\n  Give what 'stylobate calibrate --json' prints.");
    };
    JsonValue root;
    try {
        root = JsonParser::parse(text);
    } catch (const std::runtime_error& error) {
        fail(error.what());
    }
    if (!root.has("forms") || !root.has("best_form"))
        fail("it has no 'forms' and 'best_form'.");
    for (const JsonValue& form : root["forms"].items) {
        if (form["form"].text != root["best_form"].text)
            continue;
        for (const JsonValue& p : form["parameters"].items)
            if (p["key"].text == "contact.friction")
                return {p["determined"].boolean, p["value"].number, p["low"].number, p["high"].number};
    }
    fail("its best form has no contact.friction.");
    return {};
}

SaidFriction read_calibration(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw InputError(file.string(), 0, "cannot be read.");
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    return parse_calibration(text, file.string());
}

std::vector<CoverageRow> coverage(const std::vector<Answer>& answers,
                                  const std::vector<std::optional<SaidFriction>>& said)
{
    std::vector<CoverageRow> rows;
    const auto count = [&](const std::string& of, const Answer& answer, const SaidFriction& friction) {
        CoverageRow& row = row_of(rows, of);
        ++row.campaigns;
        if (!friction.determined)
            return;
        ++row.held.of;
        row.held.count += friction.low <= answer.friction && answer.friction <= friction.high;
        row.relative_half.push_back((friction.high - friction.low) / 2 / friction.value);
        row.error.push_back(std::log(friction.value / answer.friction));
    };
    const auto count_all = [&](auto&& name) {
        for (std::size_t k = 0; k < answers.size(); ++k)
            if (said[k])
                count(name(answers[k]), answers[k], *said[k]);
    };
    count_all([](const Answer&) { return std::string("all"); });
    count_all([](const Answer& a) { return "law " + a.law; });
    count_all([](const Answer& a) { return kind_of(a.specimen); });
    return rows;
}

std::string markdown(const std::vector<CoverageRow>& rows)
{
    std::string text =
        "| campaigns | | friction determined | intervals that hold it | half width, median | error, root "
        "mean square |\n|---|---:|---:|---|---:|---:|\n";
    for (const CoverageRow& row : rows) {
        text += fmt::format("| {} | {} | {} ({:.0f} %) |", row.of, row.campaigns, row.held.of,
                            100.0 * row.held.of / std::max(row.campaigns, 1));
        if (row.held.of == 0) {
            text += " | | |\n";
            continue;
        }
        const BinomialInterval interval = row.held.interval();
        text += fmt::format(" {}, {:.1f} % ({:.1f} to {:.1f} %) | {:.1f} % | {:.1f} % |\n", row.held.count,
                            100 * row.held.value(), 100 * interval.lower, 100 * interval.upper,
                            100 * upper_median(row.relative_half), 100 * rms(row.error));
    }
    return text;
}

} // namespace stylobate::hidden
