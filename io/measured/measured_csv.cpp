#include "ensemble/model/input_error.hpp"
#include "io/files/csv_fields.hpp"
#include "io/files/key_reader.hpp"
#include "io/measured/measured_columns.hpp"
#include "io/measured/measured_layout.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <system_error>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

constexpr const char* toml_name = "campaign.toml";
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

void read_specimen(const KeyReader& table, int version, Campaign& campaign)
{
    Specimen& specimen = campaign.specimen;
    std::vector<std::string> known = {"friction_nominal", "base_block_half_width_m", "joints"};
    for (const SpecimenList& list : specimen_lists())
        if (list.since() <= version)
            known.emplace_back(list.name);
    for (const SpecimenNumber& number : specimen_numbers())
        known.emplace_back(number.name);
    table.allow_only(known);
    for (const SpecimenList& list : specimen_lists())
        for (const TomlValue& value : entries(table, list.name)) {
            if (!is_number(value) && !(list.measured && std::isnan(value.number)))
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

class RunTable {
public:
    RunTable(const fs::path& path, Campaign& campaign, ColumnMap& map, MeasuredRun& run)
        : text_(csv_content(path, std::uint64_t{1} << 32)), file_(path.string()), campaign_(campaign), map_(map),
          run_(run)
    {
    }

    void read()
    {
        for_each_csv_line(text_, [&](const CsvLine& line) {
            if (columns_.empty())
                read_header(line);
            else
                read_row(line);
        });
        if (columns_.empty())
            throw InputError(file_, 0, "has no line of column names.\n  io/FORMAT.md has the layout.");
    }

private:
    void read_header(const CsvLine& line)
    {
        for (const std::string_view name : line.fields) {
            const MeasuredColumn column = map_.find(name, file_, line.number, run_.forces);
            for (std::size_t c = 0; c < columns_.size(); ++c)
                if (columns_[c].same_place(column))
                    throw InputError(file_, line.number,
                                     names_[c] == name
                                         ? fmt::format("the column \"{}\" occurs twice.", name)
                                         : fmt::format("the columns \"{}\" and \"{}\" are the same series.\n  Remove "
                                                       "one, or (in version 2) map it to \"ignore\" in [columns].",
                                                       names_[c], name));
            if (column.factor != 1)
                campaign_.findings.push_back({Severity::note, fmt::format("run {}, {}", run_.name, name),
                                              fmt::format("was converted from {} to SI.", column.unit)});
            columns_.push_back(column);
            names_.emplace_back(name);
        }
        std::size_t blocks = block_count(campaign_);
        const auto of_block = [](const MeasuredColumn& column) { return column.series && column.series->per_block; };
        if (blocks == 0)
            for (const MeasuredColumn& column : columns_)
                if (of_block(column))
                    blocks = std::max(blocks, column.block + 1);
        for (std::size_t c = 0; c < columns_.size(); ++c)
            if (of_block(columns_[c]) && columns_[c].block >= blocks)
                throw InputError(
                    file_, line.number,
                    fmt::format("the column \"{}\" refers to a block that does not exist: the blocks are 0 to {}.",
                                names_[c], static_cast<long>(blocks) - 1));
        blocks_ = blocks;
    }

    void read_row(const CsvLine& line)
    {
        const auto& parts = line.fields;
        if (parts.size() != columns_.size())
            throw InputError(file_, line.number,
                             fmt::format("has {} fields where there are {} columns: the file is damaged or truncated.",
                                         parts.size(), columns_.size()));
        std::vector<std::pair<Series*, std::size_t>> rows; // of the blocks, where this time begins
        for (std::size_t c = 0; c < parts.size(); ++c) {
            const MeasuredColumn& column = columns_[c];
            if (column.left)
                continue;
            const double value = csv_number(file_, line, c, names_[c]) * column.factor;
            if (!column.series) {
                (column.gauge.empty() ? run_.time_s : gauge(column.gauge).value_n.values).push_back(value);
                continue;
            }
            Series& series = column.series->of(run_);
            if (!column.series->per_block) {
                series.values.push_back(value);
                continue;
            }
            auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.first == &series; });
            if (row == rows.end()) {
                row = rows.insert(rows.end(), {&series, series.values.size()});
                series.values.resize(series.values.size() + blocks_, std::numeric_limits<double>::quiet_NaN());
            }
            series.values[row->second + column.block] = value;
        }
    }

    /// @pre the run has it (`ColumnMap::find`)
    ForceGauge& gauge(const std::string& name)
    {
        return *std::ranges::find_if(run_.forces, [&](const ForceGauge& g) { return lower_case(g.name) == name; });
    }

    std::string text_, file_;
    Campaign& campaign_;
    ColumnMap& map_;
    MeasuredRun& run_;
    std::vector<MeasuredColumn> columns_;
    std::vector<std::string> names_; ///< of the columns
    std::size_t blocks_ = 0;
};

/// A name that is one file in the folder `runs`, nowhere else.
void check_name(const std::string& name, const KeyReader& table, const char* what, const char* todo)
{
    const bool plain =
        !name.empty() && name.size() <= 100 && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
                   c == '.';
        });
    if (!plain)
        table.refuse("name", what, todo);
}

void read_laboratory(const KeyReader& table, Laboratory& laboratory)
{
    std::vector<std::string> known = {"may_dismantle"};
    for (const LaboratoryNumber& number : laboratory_numbers())
        known.emplace_back(number.name);
    for (const RunKind kind : run_kinds)
        known.push_back(cost_key(kind));
    table.allow_only(known);
    for (const LaboratoryNumber& number : laboratory_numbers())
        laboratory.*number.member = table.maybe_number(number.name, any);
    laboratory.may_dismantle = table.boolean_or("may_dismantle", laboratory.may_dismantle);
    for (const RunKind kind : run_kinds)
        if (const auto cost = table.maybe_number(cost_key(kind), any))
            laboratory.cost.emplace_back(kind, *cost);
}

std::vector<int> whole_entries(const KeyReader& table, const char* key, const Campaign& campaign)
{
    std::vector<int> whole;
    for (const TomlValue& value : entries(table, key)) {
        if (!is_number(value))
            table.refuse(key, fmt::format("has the entry {}, which is not a whole number", value.shown()));
        whole.push_back(whole_number(campaign, key, value.number));
    }
    return whole;
}

void read_gauge(const KeyReader& table, const Campaign& campaign, MeasuredRun& run)
{
    std::vector<std::string> known = {"name", "block", "to", "noise_n"};
    for (const GaugeNumber& number : gauge_numbers())
        known.emplace_back(number.name);
    table.allow_only(known);
    ForceGauge gauge;
    gauge.name = table.text("name");
    check_name(gauge.name, table, "is no name of a gauge",
               "Letters, digits, '_', '-' and '.'; its column is "
               "force_NAME_n.");
    for (const ForceGauge& other : run.forces)
        if (lower_case(other.name) == lower_case(gauge.name))
            table.refuse("name", "is also the name of another gauge of the run");
    if (!table.has("block"))
        table.missing("block", "Name the block on which the force acts.");
    gauge.block = whole(table, "block", 0);
    for (const GaugeNumber& number : gauge_numbers()) {
        if (number.needed && !table.has(number.name))
            table.missing(number.name, "Give the height of its point above the block's lower face, in metres.");
        gauge.*number.member = table.number_or(number.name, any, gauge.*number.member);
    }
    gauge.to_laboratory = end_in_laboratory(campaign, fmt::format("run {}: force {}: to", run.name, gauge.name),
                                            table.text_if_given("to"), run.test);
    gauge.value_n.noise_sd = table.maybe_number("noise_n", any);
    run.forces.push_back(std::move(gauge));
}

void read_test(const KeyReader& table, const Campaign& campaign, MeasuredRun& run)
{
    if (table.has("joint"))
        run.joint = whole(table, "joint", 0);
    run.released_s = table.maybe_number("released_s", any);
    run.present = whole_entries(table, "present", campaign);
    run.clamped = whole_entries(table, "clamped", campaign);
    for (const TomlValue& group : entries(table, "taped")) {
        if (group.type != TomlValue::Type::array || !std::ranges::all_of(group.entries, is_number))
            table.refuse("taped", "should be lists of blocks: [[0, 1]]");
        std::vector<int>& blocks = run.taped.emplace_back();
        for (const TomlValue& block : group.entries)
            blocks.push_back(whole_number(campaign, "taped", block.number));
    }
    for (const KeyReader& dummy : table.tables("dummy")) {
        std::vector<std::string> known = {"block"};
        for (const DummyNumber& number : dummy_numbers())
            known.emplace_back(number.name);
        dummy.allow_only(known);
        Dummy& made = run.dummies.emplace_back();
        if (!dummy.has("block"))
            dummy.missing("block", "Name the block on which it is taped.");
        made.block = whole(dummy, "block", 0);
        for (const DummyNumber& number : dummy_numbers())
            made.*number.member = number.needed ? dummy.number(number.name, any) : dummy.number_or(number.name, any, 0);
    }
    for (const KeyReader& force : table.tables("force"))
        read_gauge(force, campaign, run);
    std::ranges::sort(run.forces, {}, &ForceGauge::name);
}

/// Nothing: a run of a kind that is not known.
std::optional<MeasuredRun> read_run(const KeyReader& table, const fs::path& folder, int version, ColumnMap& map,
                                    Campaign& campaign)
{
    MeasuredRun run;
    run.name = table.text("name");
    check_name(run.name, table, "is not a valid file name",
               "Letters, digits, '_', '-' and '.'; the run is in runs/NAME.csv.");
    if (version >= 2) {
        const auto kind = known_run_kind(campaign, run.name, table.text_if_given("kind"));
        if (!kind)
            return std::nullopt;
        run.test = *kind;
    }
    std::vector<std::string> known = {"name",      "motion_id", "repeat",          "kind",        "rate_hz",
                                      "run_order", "collapsed", "collapse_time_s", "base_source", "base_clock"};
    if (version >= 2)
        known.insert(known.end(), {"motion", "joint", "present", "clamped", "taped", "dummy", "force", "released_s"});
    for (const SeriesName& series : series_names())
        if (series.since <= version)
            known.push_back(series.noise_key());
    table.allow_only(known);
    run.motion_id = whole(table, "motion_id", 0);
    run.repeat = whole(table, "repeat", 0);
    run.kind = table.text_if_given(version >= 2 ? "motion" : "kind");
    if (version < 2)
        report_old_kind(campaign, run);
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
    if (version >= 2)
        read_test(table, campaign, run);
    const fs::path rows = folder / "runs" / (run.name + ".csv");
    std::error_code ignored;
    if (run.test != RunKind::rest || fs::exists(rows, ignored)) // nothing moves
        RunTable(rows, campaign, map, run).read();
    for (const SeriesName& series : series_names())
        if (series.since <= version)
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
    const KeyReader head = top.table("campaign");
    head.allow_only({"format", "format_version", "specimen", "gravity_m_s2"});
    if (head.text("format") != measured_format)
        head.refuse("format", "is not measured data", fmt::format("It should be \"{}\".", measured_format));
    const int version = static_cast<int>(head.whole("format_version", 1, measured_version));
    std::vector<std::string> known = {"campaign", "specimen", "run"};
    if (version >= 2)
        known.insert(known.end(), {"laboratory", "columns"});
    top.allow_only(known);
    campaign.specimen.name = head.text_if_given("specimen").value_or("");
    campaign.specimen.gravity_m_s2 = head.number_or("gravity_m_s2", any, campaign.specimen.gravity_m_s2);
    read_specimen(top.table("specimen"), version, campaign);
    read_laboratory(top.table("laboratory"), campaign.laboratory);
    ColumnMap map(top.find("columns"), top.table("columns"), version);
    std::set<std::string> names;
    for (const KeyReader& table : top.tables("run")) {
        auto run = read_run(table, folder, version, map, campaign);
        if (!names.insert(table.text("name")).second)
            table.refuse("name", "is also the name of another run");
        if (run)
            campaign.runs.push_back(std::move(*run));
    }
    for (const std::string& name : map.unused())
        campaign.findings.push_back(
            {Severity::warning, fmt::format("columns, \"{}\"", name), "no table has a column of this name."});
    std::ranges::sort(campaign.runs, {}, &MeasuredRun::name);
    keep_tests_apart(campaign);
    return campaign;
}

} // namespace stylobate
