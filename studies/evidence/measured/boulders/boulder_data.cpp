#include "studies/evidence/measured/boulders/boulder_data.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/hdf5.hpp"
#include "studies/evidence/measured/parts/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate::measured {

namespace {

constexpr double spacing_s = 0.005;
constexpr double gravity_m_s2 = 9.80665; // the unit "g" of the file
constexpr double stored_unit_g = 1e-4;

const std::array<std::string, boulders> prefixes{"num_sp1_", "num_sp2_"};

std::vector<double> read_acceleration(const hdf5::Handle& file, const std::string& path)
{
    const hdf5::Dims dims = hdf5::dims_of(file.id(), path);
    if (dims.size() != 1)
        throw hdf5::Error("'" + path + "' is no list");
    const hdf5::Handle dataset = hdf5::open_dataset(file.id(), path, H5T_STD_I16LE, dims);
    std::vector<double> values(dims[0]);
    if (H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        throw hdf5::Error("cannot read '" + path + "'");
    for (double& value : values)
        value *= stored_unit_g * gravity_m_s2;
    return values;
}

Motion strong_motion(const std::vector<double>& acceleration, const std::string& source)
{
    const auto [first, last] = strong_part(acceleration, spacing_s, still_below_m_s2);
    if (first == last)
        return {};
    Motion motion = motion_of({acceleration.begin() + static_cast<std::ptrdiff_t>(first),
                               acceleration.begin() + static_cast<std::ptrdiff_t>(last)},
                              spacing_s);
    motion.source = source;
    motion.predominant_frequency_hz = 1; // nothing stretches it
    return motion;
}

} // namespace

std::pair<std::size_t, std::size_t> strong_part(const std::vector<double>& a, double dt_s, double level_m_s2)
{
    const auto strong = [&](double value) { return std::fabs(value) > level_m_s2; };
    const auto first = std::find_if(a.begin(), a.end(), strong);
    if (first == a.end())
        return {0, 0};
    const auto last = std::find_if(a.rbegin(), a.rend(), strong).base();
    const auto margin = static_cast<std::ptrdiff_t>(std::lround(0.5 / dt_s));
    return {static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first - a.begin() - margin)),
            std::min(a.size(), static_cast<std::size_t>(last - a.begin() + margin))};
}

BoulderData read_boulders(const std::filesystem::path& folder)
{
    const std::filesystem::path motions = folder / "table_motion_200Hz.h5";
    const Table table(folder / "tests.csv");
    BoulderData data;
    std::array<std::vector<std::string>, boulders> columns;
    for (const auto& [specimen, names] :
         {std::pair{std::size_t(0), std::vector<std::string>{"KN1_KS1", "KN3_KS1", "KN5_KS1", "KN10_KS1", "KN15_KS1"}},
          std::pair{std::size_t(1), std::vector<std::string>{"KN3_KS1", "KN5_KS1", "KN5_KS2", "KN10_KS1", "KN15_KS1",
                                                             "KN15_KS2", "KN15_p50", "KN20_KS1"}}})
        data.published[specimen] = names;
    try {
        const hdf5::Handle file = hdf5::open_file(motions, false);
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (!table.flag(row, "motion_available")) {
                ++data.without_motion;
                continue;
            }
            BoulderTest test;
            test.number = static_cast<int>(table.number(row, "test"));
            test.ground_motion = table.text(row, "ground_motion");
            test.pga_g = table.number(row, "pga_g_published");
            test.pgv_over_pga_s = table.number(row, "pgv_over_pga_s_published");
            test.fell = {table.flag(row, "overturned_sp1"), table.flag(row, "overturned_sp2")};
            for (std::size_t s = 0; s < boulders; ++s)
                for (const std::string& name : data.published[s])
                    test.predicted[s].push_back(table.flag(row, prefixes[s] + name));
            const std::string path = fmt::format("{:03}/acc", test.number);
            test.motion = strong_motion(read_acceleration(file, path), fmt::format("test {}", test.number));
            data.tests.push_back(std::move(test));
        }
    } catch (const hdf5::Error& error) {
        throw InputError(motions.string(), 0, error.what());
    }
    return data;
}

} // namespace stylobate::measured
