#include "io/store/result_layout.hpp"

#include "ensemble/model/mechanism_spec.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/spatial/spatial_poses.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace stylobate {
namespace {

constexpr std::uint64_t bytes_of(Stored stored)
{
    switch (stored) {
    case Stored::state:
    case Stored::invalid_reason:
        return 1;
    case Stored::i32:
        return 4;
    case Stored::i64:
    case Stored::u64:
    case Stored::f64:
        return 8;
    }
    return 0;
}

std::string unit_of_input(const std::string& name)
{
    for (const MechanismRule& rule : mechanism_rules())
        for (const MechanismParameter& parameter : rule.parameters)
            if (input_name(rule.mechanism, parameter) == name)
                return parameter.unit;
    return std::string(unit_of(unit_ending_of_input(name)));
}

struct InputName {
    std::string base;
    bool indexed = false;
    std::uint64_t index = 0;
};

/// "friction" or "friction[3]".
InputName parse_input_name(const std::string& name)
{
    const auto fail = [&] { throw std::invalid_argument("'" + name + "' cannot be the name of an input"); };
    InputName result;
    const auto bracket = name.find('[');
    result.base = name.substr(0, bracket);
    const std::string letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    if (result.base.empty() || result.base.find_first_not_of(letters) != std::string::npos)
        fail();
    if (bracket == std::string::npos)
        return result;
    const std::string digits = name.substr(bracket + 1, name.size() - bracket - 2);
    if (name.back() != ']' || digits.empty() || digits.size() > 6 ||
        digits.find_first_not_of("0123456789") != std::string::npos)
        fail();
    result.indexed = true;
    result.index = std::stoull(digits);
    return result;
}

} // namespace

std::string_view unit_ending_of_input(std::string_view name)
{
    constexpr std::pair<std::string_view, std::string_view> endings[] = {{"normal_stiffness", "_n_m2"},
                                                                         {"tangential_stiffness", "_n_m"},
                                                                         {"drum_width", "_m"},
                                                                         {"drum_height", "_m"},
                                                                         {"bed_normal_stiffness", "_n_m3"},
                                                                         {"bed_tangential_stiffness", "_n_m3"},
                                                                         {"drum_offset", "_m"},
                                                                         {"drum_offset_z", "_m"},
                                                                         {"density", "_kg_m3"},
                                                                         {"tilt", "_rad"},
                                                                         {"tilt_x", "_rad"},
                                                                         {"direction", "_deg"},
                                                                         {"phase", "_rad"},
                                                                         {"pulse_frequency", "_hz"}};
    for (const auto& [known, ending] : endings)
        if (known == name)
            return ending;
    return {};
}

std::string joined_names(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) {
        if (name.empty() || name.find('\n') != std::string::npos || name.find('\0') != std::string::npos)
            throw std::invalid_argument("'" + name + "' cannot be the name of a block");
        text += (text.empty() ? "" : "\n") + name;
    }
    return text;
}

std::vector<std::string> split_names(const std::string& text)
{
    std::vector<std::string> names;
    std::istringstream lines(text);
    for (std::string name; std::getline(lines, name);)
        names.push_back(name);
    return names;
}

std::span<const TrajectoryChannel> trajectory_channels(int dimensions)
{
    if (dimensions == 3)
        return spatial_channels;
    return planar_channels;
}

ResultLayout::ResultLayout(const ResultHeader& header)
    : first_index_(header.first), selected_(header.selected), dimensions_(header.dimensions), rows_(header.total)
{
    if (dimensions_ != 2 && dimensions_ != 3)
        throw std::invalid_argument("a structure has 2 or 3 dimensions");
    if (rows_ == 0)
        throw std::invalid_argument("a results file has at least one row");
    if (first_index_ + rows_ < rows_)
        throw std::invalid_argument("the indices of the rows are too large");
    const auto add_column = [&](const std::string& group, const char* name, const FieldFacts& facts,
                                const auto& value) {
        const Stored stored =
            std::string_view(name) == "cell" ? Stored::i64 : stored_as<std::remove_cvref_t<decltype(value)>>();
        columns_.push_back({group + name, std::string(unit_of(name)), facts.none, stored, false, 1, 0});
    };
    visit_numbers(dimensions_, add_column, ResultRow{});
    if (header.block_names.empty())
        throw std::invalid_argument("a results file has at least one block");
    joined_names(header.block_names); // for its refusals
    joined_names(header.bed_names);
    visit_lists(header, [&](const char* name, auto field, std::size_t width, const FieldFacts& facts) {
        lists_.push_back({field, columns_.size(), facts});
        columns_.push_back(
            {std::string("outcome/") + name, std::string(unit_of(name)), facts.none, Stored::f64, true, width, 0});
    });

    std::map<std::string, std::size_t> column_of;
    std::set<std::pair<std::size_t, std::uint64_t>> taken;
    for (const std::string& name : header.input_names) {
        const InputName input = parse_input_name(name);
        const auto [at, is_new] = column_of.try_emplace(input.base, columns_.size());
        if (is_new)
            columns_.push_back(
                {"input/" + input.base, unit_of_input(input.base), std::nullopt, Stored::f64, input.indexed, 1, 0});
        Column& column = columns_[at->second];
        if (column.matrix != input.indexed || !taken.emplace(at->second, input.index).second)
            throw std::invalid_argument("the input '" + name + "' comes twice");
        column.width = std::max(column.width, input.index + 1);
        inputs_.push_back({at->second, input.index});
    }
    for (const auto& [base, column] : column_of)
        for (std::uint64_t i = 0; i < columns_[column].width; ++i)
            if (!taken.contains({column, i}))
                throw std::invalid_argument("the input '" + base + "[" + std::to_string(i) + "]' is missing");

    for (Column& column : columns_) {
        column.bytes = column.width * bytes_of(column.stored);
        before_.push_back(row_bytes_);
        row_bytes_ += column.bytes;
    }
}

bool ResultLayout::fits(const ResultRow& row) const
{
    return row.inputs.size() == inputs_.size() && std::ranges::all_of(lists_, [&](const List& list) {
               return (row.outcome.*list.field).size() == columns_[list.column].width;
           });
}

void ResultLayout::encode(std::uint64_t k, const ResultRow& row, std::span<std::byte> bytes) const
{
    const std::uint64_t rows = bytes.size() / row_bytes_;
    const auto put = [&](std::size_t column, std::size_t component, const auto& value) {
        std::memcpy(&bytes[before_[column] * rows + k * columns_[column].bytes + component * sizeof value], &value,
                    sizeof value);
    };
    std::size_t column = 0;
    visit_numbers(
        dimensions_,
        [&](auto, auto, const FieldFacts& facts, const auto& value) { put(column++, 0, without_none(facts, value)); },
        row);
    for (const List& list : lists_)
        for (std::size_t i = 0; i < columns_[list.column].width; ++i)
            put(list.column, i, without_none(list.facts, (row.outcome.*list.field)[i]));
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        put(inputs_[i].column, inputs_[i].component, row.inputs[i]);
}

ResultRow ResultLayout::decode(std::uint64_t k, std::span<const std::byte> bytes) const
{
    const std::uint64_t rows = bytes.size() / row_bytes_;
    const auto take = [&](std::size_t column, std::size_t component, auto& value, const FieldFacts& facts = {}) {
        std::memcpy(&value, &bytes[before_[column] * rows + k * columns_[column].bytes + component * sizeof value],
                    sizeof value);
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>)
            if (std::isnan(value) && is_event_time(facts))
                value = -1;
    };
    ResultRow row;
    std::size_t column = 0;
    visit_numbers(
        dimensions_, [&](auto, auto, const FieldFacts& facts, auto& value) { take(column++, 0, value, facts); }, row);
    leave_out_other_models(row.outcome, dimensions_);
    for (const List& list : lists_) {
        (row.outcome.*list.field).resize(columns_[list.column].width);
        for (std::size_t i = 0; i < columns_[list.column].width; ++i)
            take(list.column, i, (row.outcome.*list.field)[i], list.facts);
    }
    row.inputs.resize(inputs_.size());
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        take(inputs_[i].column, inputs_[i].component, row.inputs[i]);
    const bool here = selected_ || (row.index >= first_index_ && row.index - first_index_ < rows_);
    if (!here || row.outcome.state > State::invalid || row.outcome.invalid_reason > InvalidReason::energy)
        throw std::invalid_argument("a row of realization " + std::to_string(row.index) +
                                    " contains values that no run writes");
    return row;
}

bool same_bits(const ResultRow& a, const ResultRow& b)
{
    const auto bits = [](const ResultRow& row) {
        std::vector<std::uint64_t> all;
        const auto add = [&](const auto& value) { std::memcpy(&all.emplace_back(), &value, sizeof value); };
        const auto add_list = [&](const std::vector<double>& list) {
            add(list.size());
            std::ranges::for_each(list, add);
        };
        visit_fields(std::type_identity<ResultRow>(), [&](auto, auto field, auto) { add(row.*field); });
        visit_fields(std::type_identity<Outcome>(), [&](auto, auto field, auto) { add(row.outcome.*field); });
        visit_lists(std::type_identity<Outcome>(), [&](auto, auto field, auto, auto) { add_list(row.outcome.*field); });
        add_list(row.inputs);
        return all;
    };
    return bits(a) == bits(b);
}

} // namespace stylobate
