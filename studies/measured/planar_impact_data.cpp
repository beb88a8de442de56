#include "studies/measured/planar_impact_data.hpp"

#include "ensemble/input_error.hpp"
#include "io/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>

namespace stylobate::measured::impact {

namespace {

/// A column that may be absent, or where it lies.
constexpr std::size_t absent = static_cast<std::size_t>(-1);

std::vector<std::string_view> cells_of(std::string_view line)
{
    if (line.ends_with('\r'))
        line.remove_suffix(1);
    std::vector<std::string_view> cells;
    for (std::size_t at = 0; at <= line.size();) {
        const std::size_t end = std::min(line.find(',', at), line.size());
        cells.push_back(line.substr(at, end - at));
        at = end + 1;
    }
    return cells;
}

/// Rows of numbers under named columns.
class Table {
public:
    explicit Table(const std::filesystem::path& file) : name_(file.string()), in_(file)
    {
        if (!in_)
            throw InputError(fmt::format("{} cannot be read.\n  Give the path of a table of impacts.", name_));
        std::getline(in_, header_);
        columns_ = cells_of(header_);
    }

    std::size_t column(std::string_view name) const
    {
        const auto at = std::find(columns_.begin(), columns_.end(), name);
        return at == columns_.end() ? absent : static_cast<std::size_t>(at - columns_.begin());
    }

    std::size_t needed(std::string_view name) const
    {
        const std::size_t at = column(name);
        if (at == absent)
            throw InputError(name_, 1,
                             fmt::format("there is no column '{}'.\n  The first line names the columns; i, x_i, th_i, "
                                         "vx_i, vy_i, w_i, n_th and d_th are needed.",
                                         name));
        return at;
    }

    bool next()
    {
        do {
            ++line_;
            if (!std::getline(in_, text_))
                return false;
        } while (text_.empty() || text_ == "\r");
        cells_ = cells_of(text_);
        if (cells_.size() != columns_.size())
            throw InputError(
                name_, line_,
                fmt::format("{} values where the first line names {} columns.", cells_.size(), columns_.size()));
        return true;
    }

    /// @param largest of the size of the value
    double value(std::size_t at, double largest) const
    {
        const std::string_view cell = cells_[at];
        double number = 0;
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
        if (error != std::errc{} || end != cell.data() + cell.size() || !(std::fabs(number) <= largest))
            throw InputError(name_, line_,
                             fmt::format("{} = '{}' is no number in [-{}, {}].\n  SI units are expected.", columns_[at],
                                         cell, largest, largest));
        return number;
    }

private:
    std::string name_, header_, text_;
    std::ifstream in_;
    long line_ = 1;
    std::vector<std::string_view> columns_, cells_;
};

} // namespace

std::vector<Impact> read_impacts(const std::filesystem::path& file)
{
    Table table(file);
    const std::size_t index = table.needed("i"), x = table.needed("x_i"), theta = table.needed("th_i"),
                      vx = table.needed("vx_i"), vy = table.needed("vy_i"), spin = table.needed("w_i"),
                      arm_n = table.needed("n_th"), arm_t = table.needed("d_th");
    const std::size_t after[] = {table.column("vx_f"), table.column("vy_f"), table.column("w_f")};
    const bool measured = std::find(std::begin(after), std::end(after), absent) == std::end(after);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Impact> impacts;
    while (table.next()) {
        Impact one;
        one.index = std::lround(table.value(index, 1e9));
        one.x = table.value(x, 100);
        one.theta = table.value(theta, 1e4);
        one.before = {-table.value(vx, 100), table.value(vy, 100), table.value(spin, 1e4)};
        one.arm_n = table.value(arm_n, 1);
        one.arm_t = table.value(arm_t, 1);
        one.after = measured
                        ? Velocity{-table.value(after[0], 100), table.value(after[1], 100), table.value(after[2], 1e4)}
                        : Velocity{nan, nan, nan};
        impacts.push_back(one);
    }
    if (impacts.empty())
        throw InputError(file.string(), 1, "there is no impact in this table.");
    return impacts;
}

void write_predictions(const std::filesystem::path& file, const std::vector<Impact>& impacts,
                       const std::vector<Prediction>& predictions)
{
    std::string text = "i";
    for (const Prediction& p : predictions)
        text += fmt::format(",{0}_vx_f,{0}_vy_f,{0}_w_f", p.law);
    text += '\n';
    for (std::size_t k = 0; k < impacts.size(); ++k) {
        text += fmt::format("{}", impacts[k].index);
        for (const Prediction& p : predictions)
            text += fmt::format(",{:.7g},{:.7g},{:.7g}", -p.after[k].x, p.after[k].y, p.after[k].spin);
        text += '\n';
    }
    AtomicFile out(file);
    out.write(text);
    out.commit();
}

double kinetic_energy(const Body& body, const Velocity& v)
{
    return 0.5 * (body.mass * (v.x * v.x + v.y * v.y) + body.inertia() * v.spin * v.spin);
}

double relative_error(const Body& body, const Velocity& predicted, const Velocity& measured)
{
    return std::sqrt(kinetic_energy(body, predicted - measured) / kinetic_energy(body, measured));
}

} // namespace stylobate::measured::impact
