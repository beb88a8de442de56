#include "io/measured/measured_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/csv_fields.hpp"
#include "io/files/suggest.hpp"
#include "io/measured/measured_check.hpp"
#include "io/measured/measured_layout.hpp"
#include "io/records/record_parser.hpp"
#include "io/store/result_seal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <span>
#include <system_error>
#include <vector>

namespace stylobate {

Campaign read_campaign(const std::filesystem::path& path)
{
    std::error_code ignored;
    Campaign campaign = std::filesystem::is_directory(path, ignored) ? read_measured_csv(path)
                        : path.extension() == ".toml"                ? read_measured_csv(path.parent_path())
                                                                     : read_measured_hdf5(path);
    check_shapes(campaign);
    check_campaign(campaign);
    return campaign;
}

namespace {

/// The first quantity in which two specimens differ by more than a hundredth, in words; empty: none.
std::string first_difference(const Specimen& a, const Specimen& b)
{
    if (a.blocks() != b.blocks() || a.joints != b.joints)
        return fmt::format("{} blocks and {} joints there, {} blocks and {} joints here", b.blocks(), b.joints.size(),
                           a.blocks(), a.joints.size());
    constexpr double alike = 0.01; // both may have been measured
    const auto differ = [&](const char* what, const char* unit, const std::vector<double>& here,
                            const std::vector<double>& there) {
        for (std::size_t i = 0; i < std::min(here.size(), there.size()); ++i)
            if (std::fabs(here[i] - there[i]) > alike * std::fabs(here[i]))
                return fmt::format("{} {:g} {} for block {} there, {:g} {} here", what, there[i], unit, i, here[i],
                                   unit);
        return std::string();
    };
    std::string found = differ("half_width_m", "m", a.half_width_m, b.half_width_m);
    if (found.empty())
        found = differ("half_height_m", "m", a.half_height_m, b.half_height_m);
    return found.empty() ? differ("mass_kg", "kg", a.mass_kg, b.mass_kg) : found;
}

} // namespace

void add_tests_of(const Campaign& more, Campaign& campaign)
{
    if (const std::string what = first_difference(campaign.specimen, more.specimen); !what.empty())
        throw InputError(more.source, 0,
                         fmt::format("is of another specimen than {}: {}.\n  Give the tests of the same specimen.",
                                     campaign.source, what));
    const Specimen& rest = more.specimen;
    if (more.tests.empty() && rest.centre_of_mass_m.empty() && rest.bearing_left_m.empty())
        throw InputError(more.source, 0,
                         "has no test of a single joint.\n  Give a campaign of shake runs as MEASURED.");
    int last = static_cast<int>(campaign.tests.size()) - 1;
    for (const MeasuredRun& run : campaign.tests)
        last = std::max(last, run.run_order.value_or(0));
    for (std::size_t r = 0; r < more.tests.size(); ++r) {
        campaign.tests.push_back(more.tests[r]);
        campaign.tests.back().run_order = last + 1 + more.tests[r].run_order.value_or(static_cast<int>(r));
    }
    const auto take = [](const std::vector<double>& from, std::vector<double>& to) {
        if (!from.empty())
            to = from;
    };
    take(rest.centre_of_mass_m, campaign.specimen.centre_of_mass_m);
    take(rest.bearing_left_m, campaign.specimen.bearing_left_m);
    take(rest.bearing_right_m, campaign.specimen.bearing_right_m);
    campaign.findings.insert(campaign.findings.end(), more.findings.begin(), more.findings.end());
    if (!more.runs.empty())
        campaign.findings.push_back(
            {Severity::note, more.source,
             fmt::format("its {} shake runs are left out: it was given for its tests", more.runs.size())});
}

std::string fingerprint(const std::filesystem::path& path)
{
    std::uint32_t sum = 0;
    const auto add = [&](const std::filesystem::path& file) {
        std::ifstream in(file, std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
        sum = crc32_of(std::as_bytes(std::span(content)), sum);
    };
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path, error))
            if (entry.is_regular_file(error))
                files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const auto& file : files)
            add(file);
    } else {
        add(path);
    }
    return fmt::format("crc32 {:08x}", sum);
}

namespace {

enum class Column { ignored, fell, motion_file, amplitude, frequency, pga, pgv, pgv_over_pga, motion_id, repeat };

struct Known {
    const char* name;
    Column column;
    double factor = 1;
};
const Known known_columns[] = {
    {"fell", Column::fell},
    {"collapsed", Column::fell},
    {"overturned", Column::fell},
    {"toppled", Column::fell},
    {"motion_file", Column::motion_file},
    {"amplitude_m", Column::amplitude},
    {"amplitude_cm", Column::amplitude, 0.01},
    {"amplitude_mm", Column::amplitude, 0.001},
    {"frequency_hz", Column::frequency},
    {"pga_m_s2", Column::pga},
    {"pga_cm_s2", Column::pga, 0.01},
    {"pga_g", Column::pga, 9.80665},
    {"pgv_m_s", Column::pgv},
    {"pgv_cm_s", Column::pgv, 0.01},
    {"pgv_over_pga_s", Column::pgv_over_pga},
    {"motion_id", Column::motion_id},
    {"repeat", Column::repeat},
};

constexpr double largest_ratio_s = 20; ///< of PGV and PGA

std::optional<bool> fell_of(std::string_view word)
{
    const std::string lower = lower_case(word);
    for (const char* yes : {"1", "y", "yes", "true", "fell", "collapsed", "overturned", "toppled"})
        if (lower == yes)
            return true;
    for (const char* no : {"0", "n", "no", "false", "stood"})
        if (lower == no)
            return false;
    return std::nullopt;
}

class Reader {
public:
    explicit Reader(OutcomeTable& table) : table_(table) {}

    void header(const CsvLine& line)
    {
        std::vector<std::string> names;
        for (const Known& known : known_columns)
            names.emplace_back(known.name);
        for (const std::string_view name : line.fields) {
            const auto known = std::find_if(std::begin(known_columns), std::end(known_columns),
                                            [&](const Known& k) { return k.name == name; });
            names_.emplace_back(name);
            columns_.push_back(known == std::end(known_columns) ? Known{"", Column::ignored} : *known);
            if (known == std::end(known_columns)) {
                const auto meant = meant_key(name, names);
                table_.findings.push_back({Severity::note, fmt::format("column \"{}\"", name.substr(0, 60)),
                                           "is unknown and ignored." + (meant ? " Did you mean " + *meant + "?" : "")});
            } else if (std::count_if(columns_.begin(), columns_.end(),
                                     [&](const Known& k) { return k.column == known->column; }) > 1) {
                throw InputError(table_.source, line.number,
                                 fmt::format("the column \"{}\" duplicates another one.\n  Keep one of them.", name));
            }
        }
        if (!has(Column::fell))
            throw InputError(table_.source, line.number,
                             "no column gives the outcome.\n  Name it fell, collapsed, overturned or "
                             "toppled; io/FORMAT.md has the layout.");
        if (!has(Column::motion_file) && !has(Column::pga) && !(has(Column::amplitude) && has(Column::frequency)))
            throw InputError(table_.source, line.number,
                             "no column gives the motion.\n  Give motion_file, or amplitude_m and "
                             "frequency_hz, or pga_m_s2 and pgv_over_pga_s.");
    }

    void row(const CsvLine& line)
    {
        if (line.fields.size() != columns_.size())
            throw InputError(table_.source, line.number,
                             fmt::format("has {} fields where there are {} columns: the file is damaged or truncated.",
                                         line.fields.size(), columns_.size()));
        MeasuredOutcome outcome;
        outcome.line = line.number;
        std::optional<double> pgv;
        bool known_outcome = true;
        has_id_ = has(Column::motion_id);
        has_repeat_ = has(Column::repeat);
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const std::string_view field = line.fields[c];
            switch (columns_[c].column) {
            case Column::ignored:
                break;
            case Column::fell:
                known_outcome = !field.empty();
                if (const auto fell = fell_of(field))
                    outcome.fell = *fell;
                else if (known_outcome)
                    throw InputError(table_.source, line.number,
                                     fmt::format("{} = \"{}\" is neither a fall nor a stand.\n  Write 1 or "
                                                 "0, yes or no, fell or stood; leave it empty where it is not known.",
                                                 names_[c], field.substr(0, 40)));
                break;
            case Column::motion_file:
                if (!field.empty())
                    outcome.motion_file = field;
                break;
            case Column::amplitude:
                outcome.amplitude_m = number(line, c, 10);
                break;
            case Column::frequency:
                outcome.frequency_hz = number(line, c, 1000);
                break;
            case Column::pga:
                outcome.pga_m_s2 = number(line, c, 100);
                break;
            case Column::pgv:
                pgv = number(line, c, 20);
                break;
            case Column::pgv_over_pga:
                outcome.pgv_over_pga_s = number(line, c, largest_ratio_s);
                break;
            case Column::motion_id:
                outcome.motion_id = whole(line, c);
                break;
            case Column::repeat:
                outcome.repeat = whole(line, c);
                break;
            }
        }
        const std::string place = fmt::format("line {}", line.number);
        if (!known_outcome) {
            table_.findings.push_back({Severity::warning, place, "has no outcome and is omitted."});
            return;
        }
        if (!outcome.motion_file && !outcome.pga_m_s2 && !(outcome.amplitude_m && outcome.frequency_hz)) {
            table_.findings.push_back({Severity::warning, place, "has no motion and is omitted."});
            return;
        }
        if (pgv && outcome.pga_m_s2 && !outcome.pgv_over_pga_s)
            outcome.pgv_over_pga_s = ratio_of(line, *pgv, *outcome.pga_m_s2);
        check_harmonic(outcome, place);
        table_.rows.push_back(std::move(outcome));
    }

    /// Equal motions get one number, and their rows count as its repeats in the order of the file.
    void count_motions()
    {
        std::map<decltype(MeasuredOutcome().motion()), int> ids;
        std::map<int, int> repeats;
        for (MeasuredOutcome& row : table_.rows) {
            if (!has_id_)
                row.motion_id = ids.emplace(row.motion(), static_cast<int>(ids.size())).first->second;
            if (!has_repeat_)
                row.repeat = repeats[row.motion_id]++;
        }
    }

private:
    bool has(Column column) const
    {
        return std::any_of(columns_.begin(), columns_.end(), [&](const Known& k) { return k.column == column; });
    }

    /// A number in SI above 0, nothing of an empty field.
    std::optional<double> number(const CsvLine& line, std::size_t c, double largest) const
    {
        const double value = csv_number(table_.source, line, c, names_[c]) * columns_[c].factor;
        if (std::isnan(value))
            return std::nullopt;
        if (!(value > 0 && value <= largest))
            throw InputError(table_.source, line.number,
                             fmt::format("{} = {} is outside (0, {:g}].\n  The unit is part of the name.{}", names_[c],
                                         line.fields[c], largest / columns_[c].factor,
                                         value > 0 ? fmt::format(" Did you mean {:.4g}?", value / 1000) : ""));
        return value;
    }
    /// Each of the two may be what it is, and the other one not.
    double ratio_of(const CsvLine& line, double pgv_m_s, double pga_m_s2) const
    {
        const double ratio_s = pgv_m_s / pga_m_s2;
        if (!(ratio_s > 0 && ratio_s <= largest_ratio_s))
            throw InputError(table_.source, line.number,
                             fmt::format("the peak velocity {:.4g} m/s is {:.4g} s of the peak acceleration {:.4g} "
                                         "m/s2, outside (0, {:g}].\n  The unit is part of the name of each column.",
                                         pgv_m_s, ratio_s, pga_m_s2, largest_ratio_s));
        return ratio_s;
    }
    int whole(const CsvLine& line, std::size_t c) const
    {
        Campaign file;
        file.source = fmt::format("{}:{}", table_.source, line.number);
        return whole_number(file, names_[c], csv_number(table_.source, line, c, names_[c]));
    }

    /// A sine of this amplitude and frequency has this peak acceleration.
    void check_harmonic(const MeasuredOutcome& outcome, const std::string& place)
    {
        if (!outcome.amplitude_m || !outcome.frequency_hz || !outcome.pga_m_s2)
            return;
        const double omega = 2 * std::numbers::pi * *outcome.frequency_hz;
        const double peak = *outcome.amplitude_m * omega * omega;
        constexpr double alike = 1.25;
        if (peak > alike * *outcome.pga_m_s2 || peak < *outcome.pga_m_s2 / alike)
            table_.findings.push_back(
                {Severity::warning, place,
                 fmt::format("amplitude and frequency make {:.3g} m/s2, but the peak acceleration is {:.3g} m/s2.",
                             peak, *outcome.pga_m_s2)});
    }

    OutcomeTable& table_;
    std::vector<std::string> names_;
    std::vector<Known> columns_;
    bool has_id_ = false, has_repeat_ = false;
};

} // namespace

OutcomeTable read_outcomes(const std::filesystem::path& file)
{
    OutcomeTable table;
    table.source = file.string();
    const std::string text = csv_content(file, std::uint64_t{1} << 28);
    Reader reader(table);
    bool first = true;
    for_each_csv_line(text, [&](const CsvLine& line) {
        if (first)
            reader.header(line);
        else
            reader.row(line);
        first = false;
    });
    if (first)
        throw InputError(table.source, 0, "has no line of column names.\n  io/FORMAT.md has the layout.");
    reader.count_motions();
    return table;
}

} // namespace stylobate
