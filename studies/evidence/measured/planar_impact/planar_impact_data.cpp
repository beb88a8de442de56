#include "studies/evidence/measured/planar_impact/planar_impact_data.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/evidence/measured/parts/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace stylobate::measured::impact {

namespace {

/// @param largest of the size of the value
double bounded(const Table& table, const std::string& file, std::size_t row, const char* heading, double largest)
{
    const double value = table.number(row, heading);
    if (!(std::fabs(value) <= largest))
        throw InputError(
            file, static_cast<long>(row) + 2,
            fmt::format("{} = {} is outside [-{}, {}].\n  SI units are expected.", heading, value, largest, largest));
    return value;
}

} // namespace

std::vector<Impact> read_impacts(const std::filesystem::path& file)
{
    const Table table(file);
    const bool measured = table.has("vx_f") && table.has("vy_f") && table.has("w_f");
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Impact> impacts(table.rows());
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const auto value = [&](const char* heading, double largest) {
            return bounded(table, file.string(), row, heading, largest);
        };
        const auto velocity = [&](const char* x, const char* y, const char* spin) {
            return Velocity{-value(x, 100), value(y, 100), value(spin, 1e4)};
        };
        impacts[row] = {std::lround(value("i", 1e9)),
                        value("x_i", 100),
                        value("th_i", 1e4),
                        velocity("vx_i", "vy_i", "w_i"),
                        measured ? velocity("vx_f", "vy_f", "w_f") : Velocity{nan, nan, nan},
                        value("n_th", 1),
                        value("d_th", 1)};
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
    write_whole(file, text);
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
