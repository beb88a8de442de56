#include "studies/measured/loop/loop_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/result_seal.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>

namespace stylobate {

namespace {

constexpr std::string_view tests_head = "# stylobate simulated tests ";
constexpr std::string_view sequence_head = "# stylobate sequence of tests ";
constexpr std::string_view complete = "complete";

std::uint32_t crc_of(const std::vector<double>& values, std::uint32_t before)
{
    return crc32_of(std::as_bytes(std::span(values)), before);
}

std::vector<std::string> lines_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::vector<std::string> out;
    for (std::string line; std::getline(in, line);)
        out.push_back(line);
    return out;
}

std::vector<std::string> parts_of(const std::string& line)
{
    std::vector<std::string> out;
    std::size_t from = 0;
    for (std::size_t to; (to = line.find('\t', from)) != std::string::npos; from = to + 1)
        out.push_back(line.substr(from, to - from));
    out.push_back(line.substr(from));
    return out;
}

/// "nan" too.
std::optional<double> number_in(const std::string& text)
{
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::optional<int> whole_in(const std::string& text)
{
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::optional<RunKind> kind_in(const std::string& text)
{
    for (const RunKind kind : {RunKind::shake, RunKind::pull, RunKind::board, RunKind::tilt, RunKind::push,
                               RunKind::drop, RunKind::slide, RunKind::rest})
        if (text == test_kind_name(kind))
            return kind;
    return std::nullopt;
}

std::string row_line(const Eigen::RowVectorXd& row)
{
    std::string out;
    for (const double value : row)
        out += fmt::format("\t{:.17g}", value);
    return out + "\n";
}

/// Rows of tables, of which all have as many numbers as there are columns.
class TableReader {
public:
    /// False: the line is none of these.
    bool read(const std::vector<std::string>& parts)
    {
        if (parts[0] == "column" && parts.size() == 7)
            return column(parts);
        if (parts[0] == "cause" && parts.size() == 5) {
            const auto size = number_in(parts[3]);
            if (size) {
                tests.causes.push_back({{parts[1], parts[2], *size, parts[4]}, {}, {}});
                rows_.emplace_back();
            }
            return size.has_value();
        }
        if (parts[0] == "healthy")
            return row(parts, 1, healthy_);
        if (parts[0] != "with" || rows_.empty() || parts.size() < 2)
            return false;
        if (const auto pair = whole_in(parts[1]); pair && *pair >= 0)
            tests.causes.back().pairs.push_back(*pair);
        return row(parts, 2, rows_.back());
    }
    /// False: pairs are missing, or have no healthy specimen.
    bool finish()
    {
        tests.healthy = matrix(healthy_);
        for (std::size_t i = 0; i < tests.causes.size(); ++i) {
            CauseSamples& samples = tests.causes[i];
            samples.rows = matrix(rows_[i]);
            if (!samples.pairs.empty() && samples.pairs.size() != rows_[i].size())
                return false;
            for (const int pair : samples.pairs)
                if (pair >= tests.healthy.rows())
                    return false;
        }
        return true;
    }
    SimulatedTests tests;

private:
    bool column(const std::vector<std::string>& parts)
    {
        const auto kind = kind_in(parts[1]);
        const auto joint = whole_in(parts[2]);
        const auto floor = number_in(parts[6]);
        if (!kind || !joint || !floor)
            return false;
        tests.columns.push_back({*kind, *joint, parts[3], parts[4], parts[5], *floor});
        return true;
    }
    bool row(const std::vector<std::string>& parts, std::size_t first, std::vector<std::vector<double>>& to)
    {
        if (parts.size() != first + tests.columns.size())
            return false;
        to.emplace_back();
        for (std::size_t k = first; k < parts.size(); ++k) {
            const auto value = number_in(parts[k]);
            if (!value)
                return false;
            to.back().push_back(*value);
        }
        return true;
    }
    Eigen::MatrixXd matrix(const std::vector<std::vector<double>>& rows) const
    {
        Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(tests.columns.size()));
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < rows[i].size(); ++j)
                out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
        return out;
    }

    std::vector<std::vector<double>> healthy_;
    std::vector<std::vector<std::vector<double>>> rows_; ///< (causes)
};

/// Adds what a line of a sequence has. False: it is none of its lines.
bool read_sequence_line(const std::vector<std::string>& parts, TestSequence& out)
{
    if (parts[0] == "prior" && parts.size() == 4) {
        const auto weight = number_in(parts[3]);
        if (weight)
            out.shares.push_back({parts[1], parts[2].empty() ? std::nullopt : std::optional(parts[2]), *weight});
        return weight.has_value();
    }
    if (parts[0] == "test" && parts.size() == 3) {
        const auto kind = kind_in(parts[1]);
        const auto joint = whole_in(parts[2]);
        if (kind && (joint || parts[2] == "all"))
            out.tests.push_back({*kind, joint, {}});
        return kind && (joint || parts[2] == "all");
    }
    if (parts[0] != "estimate" || parts.size() != 4 || out.tests.empty())
        return false;
    const auto joint = whole_in(parts[2]);
    const auto value = number_in(parts[3]);
    if (joint && value)
        out.tests.back().estimates.push_back({parts[1], *joint, *value});
    return joint && value;
}

} // namespace

std::string specimen_fingerprint(const Specimen& s)
{
    std::uint32_t sum = 0;
    for (const auto* values : {&s.half_width_m, &s.half_height_m, &s.depth_m, &s.mass_kg, &s.rest_x_m, &s.rest_y_m}) {
        sum = crc_of({static_cast<double>(values->size())}, sum);
        sum = crc_of(*values, sum);
    }
    for (const auto& [lower, upper] : s.joints)
        sum = crc_of({static_cast<double>(lower), static_cast<double>(upper)}, sum);
    sum = crc_of({s.gravity_m_s2, s.friction_nominal.value_or(-1), s.mass_tolerance, s.width_tolerance,
                  s.placement_tolerance_m, s.base_block_half_width_m.value_or(-1), s.base_block_top_m},
                 sum);
    return fmt::format("{:08x}", sum);
}

std::string tests_fingerprint(const Specimen& specimen, std::string_view procedures)
{
    return fmt::format("{} {} {:08x}", code_version(), specimen_fingerprint(specimen),
                       crc32_of(std::as_bytes(std::span(procedures))));
}

void keep_tests(const std::filesystem::path& file, const std::string& fingerprint, const SimulatedTests& tests)
{
    std::string text = std::string(tests_head) + fingerprint + "\n";
    for (const TestColumn& c : tests.columns)
        text += fmt::format("column\t{}\t{}\t{}\t{}\t{}\t{:.17g}\n", test_kind_name(c.test), c.joint, c.name, c.unit,
                            c.depends_on, c.floor_sd);
    for (const auto& row : tests.healthy.rowwise())
        text += "healthy" + row_line(row);
    for (const CauseSamples& samples : tests.causes) {
        const TestedCause& c = samples.cause;
        text += fmt::format("cause\t{}\t{}\t{:.17g}\t{}\n", c.mechanism, c.place, c.size, c.unit);
        for (Eigen::Index i = 0; i < samples.rows.rows(); ++i)
            text += fmt::format("with\t{}", samples.pairs.empty() ? -1 : samples.pairs[static_cast<std::size_t>(i)]) +
                    row_line(samples.rows.row(i));
    }
    write_whole(file, text + std::string(complete) + "\n");
}

std::optional<SimulatedTests> kept_tests(const std::filesystem::path& file, const std::string& fingerprint)
{
    const std::vector<std::string> lines = lines_of(file);
    if (lines.empty())
        return std::nullopt;
    if (!lines[0].starts_with(tests_head))
        throw InputError(file.string(), 1,
                         "keeps no simulated tests, and nothing was written.\n  Remove it, or name another output.");
    if (lines[0] != std::string(tests_head) + fingerprint || lines.back() != complete)
        return std::nullopt;
    TableReader reader;
    for (std::size_t i = 1; i + 1 < lines.size(); ++i)
        if (!reader.read(parts_of(lines[i])))
            return std::nullopt;
    return reader.finish() ? std::optional(std::move(reader.tests)) : std::nullopt;
}

void keep_sequence(const std::filesystem::path& file, const Specimen& specimen, const TestSequence& sequence)
{
    std::string text = std::string(sequence_head) + specimen_fingerprint(specimen) + "\n";
    for (const PriorShare& share : sequence.shares)
        text += fmt::format("prior\t{}\t{}\t{:.17g}\n", share.of, share.place.value_or(""), share.weight);
    for (const DoneTest& test : sequence.tests) {
        text +=
            fmt::format("test\t{}\t{}\n", test_kind_name(test.test), test.joint ? std::to_string(*test.joint) : "all");
        for (const NamedEstimate& estimate : test.estimates)
            text += fmt::format("estimate\t{}\t{}\t{:.17g}\n", estimate.name, estimate.joint, estimate.value);
    }
    write_whole(file, text);
}

TestSequence kept_sequence(const std::filesystem::path& file, const Specimen& specimen)
{
    TestSequence out;
    const std::vector<std::string> lines = lines_of(file);
    if (lines.empty())
        return out;
    if (!lines[0].starts_with(sequence_head))
        throw InputError(file.string(), 1,
                         "keeps no sequence of tests, and nothing was written.\n  Remove it, or name another file.");
    if (lines[0] != std::string(sequence_head) + specimen_fingerprint(specimen))
        throw InputError(
            file.string(), 1,
            fmt::format("keeps the tests of another specimen than '{}': sizes, masses or joints differ.\n  "
                        "Name another file to begin a sequence for this specimen.",
                        specimen.name));
    for (std::size_t i = 1; i < lines.size(); ++i)
        if (!read_sequence_line(parts_of(lines[i]), out))
            throw InputError(file.string(), static_cast<long>(i) + 1,
                             "is no line of a sequence of tests.\n  Remove the file and diagnose the campaign again.");
    return out;
}

} // namespace stylobate
