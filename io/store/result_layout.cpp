#include "io/store/result_layout.hpp"

#include "ensemble/model/mechanism_spec.hpp"

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

/// Units of the inputs that studies name; of others none is known.
std::string unit_of_input(const std::string& name)
{
    static const std::map<std::string, std::string> units = {{"normal_stiffness", "N/m2"},
                                                             {"tangential_stiffness", "N/m"},
                                                             {"drum_width", "m"},
                                                             {"drum_height", "m"},
                                                             {"drum_offset", "m"},
                                                             {"density", "kg/m3"},
                                                             {"tilt", "rad"},
                                                             {"phase", "rad"},
                                                             {"pulse_frequency", "Hz"}};
    for (const MechanismRule& rule : mechanism_rules())
        for (const MechanismParameter& parameter : rule.parameters)
            if (input_name(rule.mechanism, parameter) == name)
                return parameter.unit;
    const auto found = units.find(name);
    return found == units.end() ? std::string() : found->second;
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

ResultLayout::ResultLayout(const ResultHeader& header)
    : first_index_(header.first), selected_(header.selected), rows_(header.total)
{
    if (rows_ == 0)
        throw std::invalid_argument("a results file has at least one row");
    if (first_index_ + rows_ < rows_)
        throw std::invalid_argument("the indices of the rows are too large");
    ResultRow row;
    visit_fields(row, [&](const char* path, const char* unit, auto& field) {
        const Stored stored =
            std::string_view(path) == "cell" ? Stored::i64 : stored_as<std::remove_cvref_t<decltype(field)>>();
        columns_.push_back({path, unit, std::string(meaning_of_none(path)), stored, false, 1, 0});
    });
    if (header.block_names.empty())
        throw std::invalid_argument("a results file has at least one block");
    joined_names(header.block_names); // for its refusals
    fall_time_ = columns_.size();
    columns_.push_back({result_names::fall_time, "s", std::string(meaning_of_none(result_names::fall_time)),
                        Stored::f64, true, header.block_names.size(), 0});

    if (!header.bed_names.empty()) {
        joined_names(header.bed_names);
        beds_ = header.bed_names.size();
        columns_.push_back({result_names::bed_offset, "m", "", Stored::f64, true, beds_, 0});
        columns_.push_back({result_names::rotation, "rad", "", Stored::f64, true, header.block_names.size(), 0});
    }

    std::map<std::string, std::size_t> column_of;
    std::set<std::pair<std::size_t, std::uint64_t>> taken;
    for (const std::string& name : header.input_names) {
        const InputName input = parse_input_name(name);
        const auto [at, is_new] = column_of.try_emplace(input.base, columns_.size());
        if (is_new)
            columns_.push_back(
                {"input/" + input.base, unit_of_input(input.base), "", Stored::f64, input.indexed, 1, 0});
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
    const Outcome& o = row.outcome;
    return row.inputs.size() == inputs() && o.fall_time_s.size() == blocks() &&
           (beds_ == 0 || (o.bed_offset_m.size() == beds() && o.rotation_rad.size() == blocks()));
}

void ResultLayout::encode(std::uint64_t k, const ResultRow& row, std::span<std::byte> bytes) const
{
    const std::uint64_t rows = bytes.size() / row_bytes_;
    const auto put = [&](std::size_t column, std::size_t within, const void* from, std::size_t size) {
        std::memcpy(bytes.subspan(before_[column] * rows + k * columns_[column].bytes + within, size).data(), from,
                    size);
    };
    std::size_t column = 0;
    visit_fields(row, [&](const char* path, const char*, const auto& field) {
        const auto value = without_none(path, field);
        put(column++, 0, &value, sizeof value);
    });
    std::vector<double> fall_times = row.outcome.fall_time_s;
    for (double& time : fall_times)
        time = without_none(result_names::fall_time, time);
    put(fall_time_, 0, fall_times.data(), fall_times.size() * sizeof(double));
    if (beds_ > 0) {
        put(fall_time_ + 1, 0, row.outcome.bed_offset_m.data(), beds() * sizeof(double));
        put(fall_time_ + 2, 0, row.outcome.rotation_rad.data(), blocks() * sizeof(double));
    }
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        put(inputs_[i].column, inputs_[i].component * sizeof(double), &row.inputs[i], sizeof(double));
}

ResultRow ResultLayout::decode(std::uint64_t k, std::span<const std::byte> bytes) const
{
    const std::uint64_t rows = bytes.size() / row_bytes_;
    const auto take = [&](std::size_t column, std::size_t within, void* to, std::size_t size) {
        std::memcpy(to, bytes.subspan(before_[column] * rows + k * columns_[column].bytes + within, size).data(), size);
    };
    ResultRow row;
    std::size_t column = 0;
    const auto none = [](std::string_view path, auto& value) { // NaN is -1 again
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>)
            if (std::isnan(value) && is_event_time(path))
                value = -1;
    };
    visit_fields(row, [&](const char* path, const char*, auto& field) {
        take(column++, 0, &field, sizeof field);
        none(path, field);
    });
    row.outcome.fall_time_s.resize(blocks());
    take(fall_time_, 0, row.outcome.fall_time_s.data(), blocks() * sizeof(double));
    for (double& time : row.outcome.fall_time_s)
        none(result_names::fall_time, time);
    if (beds_ > 0) {
        row.outcome.bed_offset_m.resize(beds());
        take(fall_time_ + 1, 0, row.outcome.bed_offset_m.data(), beds() * sizeof(double));
        row.outcome.rotation_rad.resize(blocks());
        take(fall_time_ + 2, 0, row.outcome.rotation_rad.data(), blocks() * sizeof(double));
    }
    row.inputs.resize(inputs_.size());
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        take(inputs_[i].column, inputs_[i].component * sizeof(double), &row.inputs[i], sizeof(double));
    const bool here = selected_ || (row.index >= first_index_ && row.index - first_index_ < rows_);
    if (!here || row.outcome.state > State::invalid || row.outcome.invalid_reason > InvalidReason::energy)
        throw std::invalid_argument("a row of realization " + std::to_string(row.index) +
                                    " contains values that no run writes");
    return row;
}

bool same_bits(const ResultRow& a, const ResultRow& b)
{
    const auto bytes = [](const ResultRow& row) {
        std::vector<unsigned char> all;
        const auto append = [&](const auto& value) {
            const auto* first = reinterpret_cast<const unsigned char*>(&value);
            all.insert(all.end(), first, first + sizeof value);
        };
        visit_fields(row, [&](const char*, const char*, const auto& value) { append(value); });
        for (const auto* list :
             {&row.outcome.fall_time_s, &row.outcome.bed_offset_m, &row.outcome.rotation_rad, &row.inputs}) {
            append(list->size());
            for (const double value : *list)
                append(value);
        }
        return all;
    };
    return bytes(a) == bytes(b);
}

} // namespace stylobate
