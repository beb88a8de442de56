#include "ensemble/model/input_error.hpp"
#include "io/files/csv_fields.hpp"
#include "io/files/key_reader.hpp"
#include "io/files/suggest.hpp"
#include "io/measured/measured_layout.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

constexpr const char* toml_name = "campaign.toml";
constexpr const char* format_name = "stylobate-measured";
constexpr int most = std::numeric_limits<int>::max();
/// Any number: whether it makes sense is asked where all layouts are checked.
const Range any = {-1e300, 1e300, false};

int whole(const KeyReader& table, const char* key, int absent)
{
    const auto value = table.maybe_number(key, {-static_cast<double>(most), static_cast<double>(most), false});
    if (value && *value != std::floor(*value))
        table.refuse(key, "is not a whole number");
    return value ? static_cast<int>(*value) : absent;
}

/// The entries of an array, which is empty where the key is absent.
const std::vector<TomlValue>& entries(const KeyReader& table, const char* key)
{
    static const std::vector<TomlValue> none;
    const TomlValue* list = table.find(key);
    if (!list)
        return none;
    if (list->type != TomlValue::Type::array)
        table.refuse(key, "is " + list->type_name() + ", not a list");
    return list->entries;
}

bool is_number(const TomlValue& value)
{
    return (value.type == TomlValue::Type::number || value.type == TomlValue::Type::integer) &&
           std::isfinite(value.number);
}

void read_specimen(const KeyReader& table, Campaign& campaign)
{
    Specimen& specimen = campaign.specimen;
    std::vector<std::string> known = {"friction_nominal", "base_block_half_width_m", "joints"};
    for (const SpecimenList& list : specimen_lists())
        known.emplace_back(list.name);
    for (const SpecimenNumber& number : specimen_numbers())
        known.emplace_back(number.name);
    table.allow_only(known);
    for (const SpecimenList& list : specimen_lists())
        for (const TomlValue& value : entries(table, list.name)) {
            if (!is_number(value))
                table.refuse(list.name, fmt::format("has the entry {}, which is not a number", value.shown()));
            (specimen.*list.member).push_back(value.number);
        }
    for (const SpecimenNumber& number : specimen_numbers())
        specimen.*number.member = table.number_or(number.name, any, specimen.*number.member);
    specimen.friction_nominal = table.maybe_number("friction_nominal", any);
    specimen.base_block_half_width_m = table.maybe_number("base_block_half_width_m", any);
    for (const TomlValue& pair : entries(table, "joints")) {
        if (pair.type != TomlValue::Type::array || pair.entries.size() != 2 || !is_number(pair.entries[0]) ||
            !is_number(pair.entries[1]))
            table.refuse("joints", "should be pairs [lower block, upper block], -1 being the base");
        specimen.joints.emplace_back(whole_number(campaign, "specimen.joints", pair.entries[0].number),
                                     whole_number(campaign, "specimen.joints", pair.entries[1].number));
    }
}

/// Where a column of a CSV file goes.
struct Target {
    const SeriesName* series = nullptr; ///< null: the clock
    std::size_t block = 0;
    double factor = 1; ///< to SI
    std::string unit;  ///< from the name
};

/// @param spelled "x3_mm", "base_acceleration_g", "time_s", in capitals or not
std::optional<Target> target_of(std::string_view spelled)
{
    const std::string lower = lower_case(spelled);
    const std::string_view name = lower;
    const auto with_unit = [&](std::string_view unit, Dimension dimension,
                               const SeriesName* series) -> std::optional<Target> {
        const auto si = unit_in_si(unit, dimension);
        return si ? std::optional(Target{series, 0, *si, std::string(unit)}) : std::nullopt;
    };
    if (name.starts_with("time_"))
        return with_unit(name.substr(5), Dimension::time, nullptr);
    for (const SeriesName& series : series_names()) {
        if (!name.starts_with(series.column))
            continue;
        std::string_view rest = name.substr(std::string_view(series.column).size());
        std::size_t block = 0;
        if (series.per_block) {
            constexpr std::size_t most_digits = 5;
            const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
            if (digits == 0 || digits > most_digits)
                continue;
            std::from_chars(rest.data(), rest.data() + digits, block);
            rest.remove_prefix(digits);
        }
        if (!rest.starts_with('_'))
            continue;
        if (auto target = with_unit(rest.substr(1), series.dimension, &series)) {
            target->block = block;
            return target;
        }
    }
    return std::nullopt;
}

/// What to do about a column that is not known. The unit of the file is kept: with another one its values would be
/// others by a factor.
std::string column_remedy(std::string_view name)
{
    std::vector<std::string> known = {"time_s"};
    for (const SeriesName& series : series_names())
        known.push_back(fmt::format("{}{}{}", series.column, series.per_block ? "0" : "", series.suffix));
    const std::string lower = lower_case(name);
    std::vector<std::string> in_its_unit;
    for (const std::string& column : known)
        for (std::size_t line = lower.find('_'); line != std::string::npos; line = lower.find('_', line + 1))
            if (std::string same_unit = std::string(without_unit(column)) + lower.substr(line); target_of(same_unit))
                in_its_unit.push_back(std::move(same_unit));
    if (const auto meant = meant_key(lower, in_its_unit))
        return fmt::format("Did you mean {}? The unit is part of the name.", *meant);
    const auto meant = meant_key(lower, known);
    if (!meant)
        return fmt::format("Columns are {}. The unit is part of the name.", fmt::join(known, ", "));
    const std::optional<Target> target = target_of(*meant);
    const Dimension dimension = target && target->series ? target->series->dimension : Dimension::time;
    return fmt::format(
        "Did you mean {}? The unit is part of the name, and the values must be in it: known units are {}.", *meant,
        known_units(dimension));
}

class RunTable {
public:
    RunTable(const fs::path& path, Campaign& campaign, MeasuredRun& run)
        : text_(csv_content(path, std::uint64_t{1} << 32)), file_(path.string()), campaign_(campaign), run_(run)
    {
    }

    void read()
    {
        for_each_csv_line(text_, [&](const CsvLine& line) {
            if (targets_.empty())
                read_header(line);
            else
                read_row(line);
        });
        if (targets_.empty())
            throw InputError(file_, 0, "has no line of column names.\n  io/FORMAT.md has the layout.");
    }

private:
    void read_header(const CsvLine& line)
    {
        for (const std::string_view name : line.fields) {
            const auto target = target_of(name);
            if (!target)
                throw InputError(file_, line.number,
                                 fmt::format("the column \"{}\" is not known, or its unit is not.\n  {}",
                                             name.substr(0, 60), column_remedy(name)));
            for (const Target& other : targets_)
                if (other.series == target->series && other.block == target->block)
                    throw InputError(file_, line.number, fmt::format("the column \"{}\" occurs twice.", name));
            if (target->factor != 1)
                campaign_.findings.push_back({Severity::note, fmt::format("run {}, {}", run_.name, name),
                                              fmt::format("was converted from {} to SI.", target->unit)});
            targets_.push_back(*target);
            names_.emplace_back(name);
        }
        std::size_t blocks = block_count(campaign_);
        if (blocks == 0)
            for (const Target& target : targets_)
                if (target.series && target.series->per_block)
                    blocks = std::max(blocks, target.block + 1);
        for (std::size_t c = 0; c < targets_.size(); ++c)
            if (targets_[c].series && targets_[c].series->per_block && targets_[c].block >= blocks)
                throw InputError(
                    file_, line.number,
                    fmt::format("the column \"{}\" refers to a block that does not exist: the blocks are 0 to {}.",
                                names_[c], static_cast<long>(blocks) - 1));
        blocks_ = blocks;
    }

    void read_row(const CsvLine& line)
    {
        const auto& parts = line.fields;
        if (parts.size() != targets_.size())
            throw InputError(file_, line.number,
                             fmt::format("has {} fields where there are {} columns: the file is damaged or truncated.",
                                         parts.size(), targets_.size()));
        std::vector<std::pair<Series*, std::size_t>> rows; // of the blocks, where this time begins
        for (std::size_t c = 0; c < parts.size(); ++c) {
            const Target& target = targets_[c];
            const double value = csv_number(file_, line, c, names_[c]) * target.factor;
            if (!target.series) {
                run_.time_s.push_back(value);
                continue;
            }
            Series& series = target.series->of(run_);
            if (!target.series->per_block) {
                series.values.push_back(value);
                continue;
            }
            auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.first == &series; });
            if (row == rows.end()) {
                row = rows.insert(rows.end(), {&series, series.values.size()});
                series.values.resize(series.values.size() + blocks_, std::numeric_limits<double>::quiet_NaN());
            }
            series.values[row->second + target.block] = value;
        }
    }

    std::string text_, file_;
    Campaign& campaign_;
    MeasuredRun& run_;
    std::vector<Target> targets_; ///< of the columns
    std::vector<std::string> names_;
    std::size_t blocks_ = 0;
};

/// A name that is one file in the folder `runs`, nowhere else.
void check_run_name(const std::string& name, const KeyReader& table)
{
    const bool plain =
        !name.empty() && name.size() <= 100 && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
                   c == '.';
        });
    if (!plain)
        table.refuse("name", "is not a valid file name",
                     "Letters, digits, '_', '-' and '.'; the run is in runs/NAME.csv.");
}

MeasuredRun read_run(const KeyReader& table, const fs::path& folder, Campaign& campaign)
{
    std::vector<std::string> known = {"name",      "motion_id", "repeat",          "kind",        "rate_hz",
                                      "run_order", "collapsed", "collapse_time_s", "base_source", "base_clock"};
    for (const SeriesName& series : series_names())
        known.push_back(series.noise_key());
    table.allow_only(known);
    MeasuredRun run;
    run.name = table.text("name");
    check_run_name(run.name, table);
    run.motion_id = whole(table, "motion_id", 0);
    run.repeat = whole(table, "repeat", 0);
    run.kind = table.text_if_given("kind");
    run.rate_hz = table.number_or("rate_hz", any, 0);
    if (table.has("run_order"))
        run.run_order = whole(table, "run_order", 0);
    if (table.has("collapsed"))
        run.collapsed = table.boolean_or("collapsed", false);
    run.collapse_time_s = table.number_or("collapse_time_s", any, -1);
    if (table.has("base_source"))
        run.base_source =
            base_source(campaign, fmt::format("run {}: base_source", run.name), table.text("base_source"));
    run.base_clock = table.text_if_given("base_clock");
    RunTable(folder / "runs" / (run.name + ".csv"), campaign, run).read();
    for (const SeriesName& series : series_names())
        series.of(run).noise_sd = table.maybe_number(series.noise_key(), any);
    return run;
}

} // namespace

Campaign read_measured_csv(const fs::path& folder)
{
    const fs::path file = folder / toml_name;
    Campaign campaign;
    campaign.source = folder.string();
    std::error_code ignored;
    if (!fs::exists(file, ignored))
        throw InputError(
            folder.string(), 0,
            fmt::format("is a folder without {}.\n  io/FORMAT.md has the layout of measured data.", toml_name));
    const TomlValue root = parse_toml(csv_content(file, std::uint64_t{1} << 26), file.string());
    const KeyReader top(&root, "", {file.string(), 0, false});
    top.allow_only({"campaign", "specimen", "run"});
    const KeyReader head = top.table("campaign");
    head.allow_only({"format", "format_version", "specimen", "gravity_m_s2"});
    if (head.text("format") != format_name)
        head.refuse("format", "is not measured data", fmt::format("It should be \"{}\".", format_name));
    head.whole("format_version", 1, 1);
    campaign.specimen.name = head.text_if_given("specimen").value_or("");
    campaign.specimen.gravity_m_s2 = head.number_or("gravity_m_s2", any, campaign.specimen.gravity_m_s2);
    read_specimen(top.table("specimen"), campaign);
    for (const KeyReader& run : top.tables("run")) {
        campaign.runs.push_back(read_run(run, folder, campaign));
        const std::string& name = campaign.runs.back().name;
        for (std::size_t i = 0; i + 1 < campaign.runs.size(); ++i)
            if (campaign.runs[i].name == name)
                run.refuse("name", "is also the name of another run");
    }
    std::sort(campaign.runs.begin(), campaign.runs.end(),
              [](const MeasuredRun& a, const MeasuredRun& b) { return a.name < b.name; });
    return campaign;
}

} // namespace stylobate
