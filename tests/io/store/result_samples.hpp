#pragma once
/// What the tests of the result store share: rows of arbitrary bits, and a folder of one's own.

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/spatial/spatial_poses.hpp"
#include "io/store/result_store.hpp"
#include "tests/ensemble/engine/outcome_bits.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <unistd.h>

namespace stylobate {

namespace fs = std::filesystem;
inline constexpr std::uint64_t chunk = ResultWriter::rows_per_chunk;

/// A folder of its own for each test, gone afterwards.
class ResultStore : public testing::Test {
protected:
    void SetUp() override
    {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder =
            fs::temp_directory_path() / ("stylobate_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
        fs::remove_all(folder);
        fs::create_directory(folder);
        file = folder / "results.h5";
    }
    void TearDown() override { fs::remove_all(folder); }

    fs::path folder;
    fs::path file;
};

/// @param dimensions of the structure
inline ResultHeader sample_header(std::uint64_t total, int dimensions = 2)
{
    ResultHeader header;
    header.dimensions = dimensions;
    header.kind = "surface";
    header.study_toml = "[study]\nkind = \"surface\"\nseed = 7\n\n[contact]\nfriction = 0.68 # \xc2\xb5\n";
    header.seed = 0xfedcba9876543210;
    header.code_version = "0.1.0+abc";
    header.total = total;
    header.input_names = {"phase", "friction[0]", "friction[1]", "friction[2]", "normal_stiffness[0]"};
    header.block_names = {"drum 0 of column 0", "drum 1 of column 0", "epistyle \xc3\xa9, 0"};
    header.frequency_hz = {0.5, 2.25, 10.0};
    header.pga_m_s2 = {1.0, 12.0};
    return header;
}

/// Any bits, NaN, infinities, denormals and negative zero among them; a function of the index alone.
/// @param dimensions of the structure
inline ResultRow sample_row(std::uint64_t index, int dimensions = 2)
{
    std::mt19937_64 random(index * 0x9e3779b97f4a7c15 + 1);
    const auto any = [&] {
        switch (random() % 8) {
        case 0:
            return std::numeric_limits<double>::quiet_NaN();
        case 1:
            return -0.0;
        case 2:
            return std::numeric_limits<double>::denorm_min();
        case 3:
            return -std::numeric_limits<double>::infinity();
        default:
            return std::bit_cast<double>(random());
        }
    };
    ResultRow row;
    row.index = index;
    row.cell = random();
    row.frequency_hz = any();
    row.pga_m_s2 = any();
    row.inputs = {any(), any(), any(), any(), any()};
    Outcome& o = row.outcome;
    visit_fields(std::type_identity<Outcome>(), [&](auto, auto field, auto) {
        using Number = std::remove_cvref_t<decltype(o.*field)>;
        if constexpr (std::is_same_v<Number, double>)
            o.*field = any();
        else if constexpr (std::is_same_v<Number, State>)
            o.*field = static_cast<State>(random() % 5);
        else if constexpr (std::is_same_v<Number, InvalidReason>)
            o.*field = static_cast<InvalidReason>(random() % 3);
        else
            o.*field = static_cast<Number>(random());
    });
    leave_out_other_models(o, dimensions);
    o.fall_time_s = {any(), any(), any()};
    // of times that may never come NaN is the file's word for none, which is -1 in memory
    for (double* time : {&o.collapse_time_s, &o.unseating_time_s, &o.total_collapse_time_s, &o.fall_time_s[0],
                         &o.fall_time_s[1], &o.fall_time_s[2]})
        if (std::isnan(*time))
            *time = -1;
    return row;
}

/// A time as it stands in the file.
inline double time_in_file(double time)
{
    return time == -1 ? std::numeric_limits<double>::quiet_NaN() : time;
}

/// Every value of a row as bits.
inline std::vector<std::uint64_t> bits(const ResultRow& row)
{
    std::vector<std::uint64_t> result = outcome_bits(row.outcome);
    result.insert(result.end(), {row.index, row.cell});
    std::vector<double> values = {row.frequency_hz, row.pga_m_s2};
    values.insert(values.end(), row.inputs.begin(), row.inputs.end());
    for (const double value : values)
        result.push_back(std::bit_cast<std::uint64_t>(value));
    return result;
}

inline std::vector<std::uint64_t> bits(const std::vector<double>& values)
{
    std::vector<std::uint64_t> result;
    for (const double value : values)
        result.push_back(std::bit_cast<std::uint64_t>(value));
    return result;
}

inline SurfaceTable sample_surface()
{
    SurfaceTable table;
    table.frequency_hz = sample_header(1).frequency_hz;
    table.pga_m_s2 = sample_header(1).pga_m_s2;
    table.trials = {1, 2, 3, 4, 5, 0};
    table.collapses = {0, 1, 2, 3, 4, 0};
    table.probability = {0, 0.5, 2.0 / 3, 0.75, 0.8, std::nan("")};
    table.lower = {0, 0.1, 0.2, 0.3, 0.4, std::nan("")};
    table.upper = {0.5, 0.6, 0.7, 0.8, 0.9, std::nan("")};
    table.interval = "wilson 0.95";
    return table;
}

inline Trajectory sample_trajectory(std::uint64_t index, std::size_t times)
{
    std::mt19937_64 random(index + 99);
    const auto list = [&](std::size_t n) {
        std::vector<double> values(n);
        for (double& value : values)
            value = std::bit_cast<double>(random());
        return values;
    };
    Trajectory t(planar_channels);
    t.index = index;
    t.time_s = list(times);
    t["x_m"] = list(3 * times);
    t["y_m"] = list(3 * times);
    t["theta_rad"] = list(3 * times);
    t["base_x_m"] = list(times);
    t["rest_x_m"] = list(3);
    t["rest_y_m"] = list(3);
    t["half_width_m"] = list(3);
    t["half_height_m"] = list(3);
    t.role = {BlockRole::drum, BlockRole::epistyle, BlockRole::ground};
    t.column = {-2147483647, 2147483647, static_cast<std::int32_t>(index)};
    t.name = {"drum 0", "the second, \"epistyle\"", std::to_string(index)};
    return t;
}

/// The same of a structure in space.
inline Trajectory sample_spatial_trajectory(std::uint64_t index, std::size_t times)
{
    std::mt19937_64 random(index + 7);
    Trajectory t(spatial_channels);
    t.index = index;
    const Trajectory planar = sample_trajectory(index, times);
    t.role = planar.role;
    t.column = planar.column;
    t.name = planar.name;
    t.time_s = planar.time_s;
    for (std::size_t c = 0; c < t.channels.size(); ++c) {
        const ListOf of = t.channels[c].of;
        t.lists[c].resize((of == ListOf::blocks ? 1 : times) * (of == ListOf::times ? 1 : t.blocks()));
        for (double& value : t.lists[c])
            value = std::bit_cast<double>(random());
    }
    return t;
}

inline void add_rows(ResultWriter& writer, std::uint64_t from, std::uint64_t to)
{
    for (std::uint64_t i = from; i < to; ++i)
        writer.add(sample_row(i));
}

inline void write_complete(const fs::path& file, std::uint64_t total, std::size_t trajectory_times = 4)
{
    const auto writer = ResultWriter::create(file, sample_header(total));
    add_rows(*writer, 0, total);
    writer->add(sample_trajectory(3, trajectory_times));
    const SurfaceTable table = sample_surface();
    writer->finish(&table);
}

inline std::string contents(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void put(const fs::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary) << bytes;
}

/// The message of the InputError that `action` must throw.
inline std::string refusal(const std::function<void()>& action)
{
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "it was not refused";
    return "";
}

inline void expect_part(const std::string& text, const std::string& part)
{
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in:\n" << text;
}

/// All that a reader tells of a file, as text.
inline std::string everything(const ResultReader& reader)
{
    std::string text;
    const auto put_bits = [&](const std::vector<std::uint64_t>& values) {
        text.append(reinterpret_cast<const char*>(values.data()), values.size() * 8);
        text += '|';
    };
    const ResultHeader& h = reader.header();
    text += h.kind + '|' + h.study_toml + '|' + h.code_version + '|';
    for (const auto* list : {&h.input_names, &h.block_names})
        for (const std::string& name : *list)
            text += name + '|';
    put_bits({h.seed, h.total, reader.complete()});
    put_bits(bits(h.frequency_hz));
    put_bits(bits(h.pga_m_s2));
    for (const ResultRow& row : reader.rows())
        put_bits(bits(row));
    const SurfaceTable s = reader.surface();
    put_bits(s.trials);
    put_bits(s.collapses);
    for (const auto* list : {&s.frequency_hz, &s.pga_m_s2, &s.probability, &s.lower, &s.upper})
        put_bits(bits(*list));
    text += s.interval;
    for (const std::uint64_t i : reader.trajectory_indices()) {
        const Trajectory t = reader.trajectory(i);
        put_bits({i, t.index});
        visit_lists(t, [&](const TrajectoryChannel&, const std::vector<double>& list) { put_bits(bits(list)); });
        for (std::size_t k = 0; k < t.blocks(); ++k) {
            text += t.name[k] + '|';
            put_bits({static_cast<std::uint64_t>(t.role[k]), static_cast<std::uint32_t>(t.column[k])});
        }
    }
    return text;
}

} // namespace stylobate
