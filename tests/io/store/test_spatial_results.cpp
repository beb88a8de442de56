/// Results of structures in space: their columns and trajectories, and how their files differ from those of the plane.

#include "io/files/hdf5.hpp"
#include "io/store/result_layout.hpp"
#include "io/store/result_seal.hpp"
#include "tests/io/store/result_samples.hpp"

#include <algorithm>
#include <array>
#include <hdf5.h>
#include <set>
#include <string>

namespace stylobate {
namespace {

using SpatialResults = ResultStore;

const std::set<std::string> of_space = {"residual_top_z_m",   "out_of_plane_share", "max_twist_rad",
                                        "residual_twist_rad", "fall_azimuth_rad",   "fallen_column"};
const std::set<std::string> of_plane = {"top_path_m", "sliding_path_m", "rocking_path_rad"};

void write_spatial(const fs::path& file, std::uint64_t total)
{
    const auto writer = ResultWriter::create(file, sample_header(total, 3));
    for (std::uint64_t i = 0; i < total; ++i)
        writer->add(sample_row(i, 3));
    writer->add(sample_spatial_trajectory(3, 4));
    const SurfaceTable table = sample_surface();
    writer->finish(&table);
}

std::uint32_t seal_version(const fs::path& file)
{
    std::uint32_t version = 0;
    std::memcpy(&version, contents(file).data() + 16, sizeof version);
    return version;
}

/// The names of the columns below /realizations/outcome.
std::set<std::string> outcome_columns(const fs::path& file)
{
    const hdf5::Handle opened = hdf5::open_file(file, false);
    const std::vector<std::string> names = hdf5::names_in(hdf5::open_group(opened.id(), "realizations/outcome").id());
    return {names.begin(), names.end()};
}

std::string long_name(const fs::path& file, const std::string& path)
{
    const hdf5::Handle opened = hdf5::open_file(file, false);
    return hdf5::read_text(hdf5::open_object(opened.id(), path).id(), "long_name");
}

void expect_same(const Trajectory& got, const Trajectory& want)
{
    EXPECT_TRUE(is_spatial(got));
    EXPECT_EQ(bits(got.time_s), bits(want.time_s));
    for (const TrajectoryChannel& channel : spatial_channels)
        EXPECT_EQ(bits(got[channel.name]), bits(want[channel.name])) << channel.name;
    EXPECT_EQ(got.role, want.role);
    EXPECT_EQ(got.column, want.column);
    EXPECT_EQ(got.name, want.name);
}

TEST_F(SpatialResults, GiveEveryBitBackCompleteOrNot)
{
    const std::uint64_t total = chunk + 40;
    {
        const auto writer = ResultWriter::create(file, sample_header(total, 3));
        writer->add(sample_spatial_trajectory(8, 5));
        for (std::uint64_t i = 1; i < total; i += 2)
            writer->add(sample_row(i, 3));
    }
    {
        const ResultReader begun(file);
        EXPECT_FALSE(begun.complete());
        EXPECT_EQ(begun.header().dimensions, 3);
        EXPECT_EQ(bits(begun.row(5)), bits(sample_row(5, 3)));
        expect_same(begun.trajectory(8), sample_spatial_trajectory(8, 5));
    }
    const auto writer = ResultWriter::resume(file, sample_header(total, 3));
    for (std::uint64_t i = 0; i < total; i += 2)
        writer->add(sample_row(i, 3));
    const SurfaceTable table = sample_surface();
    writer->finish(&table);
    const ResultReader reader(file);
    EXPECT_TRUE(reader.complete());
    EXPECT_EQ(reader.header().dimensions, 3);
    const auto rows = reader.rows();
    ASSERT_EQ(rows.size(), total);
    for (std::uint64_t i = 0; i < total; ++i)
        ASSERT_EQ(bits(rows[i]), bits(sample_row(i, 3))) << i;
    expect_same(reader.trajectory(8), sample_spatial_trajectory(8, 5));
}

TEST_F(SpatialResults, HaveTheColumnsOfTheirModelAlone)
{
    write_spatial(file, 6);
    const fs::path planar = folder / "planar.h5";
    write_complete(planar, 6);
    const std::set<std::string> in_space = outcome_columns(file), in_plane = outcome_columns(planar);
    std::set<std::string> added, left_out;
    std::ranges::set_difference(in_space, in_plane, std::inserter(added, added.end()));
    std::ranges::set_difference(in_plane, in_space, std::inserter(left_out, left_out.end()));
    EXPECT_EQ(added, of_space);
    EXPECT_EQ(left_out, of_plane);
    EXPECT_EQ(long_name(file, "realizations/outcome/max_twist_rad"), "largest twist of a joint");
    EXPECT_EQ(long_name(file, "trajectories/3/x_m"), spatial_channels[0].meaning);
    EXPECT_EQ(long_name(planar, "trajectories/3/x_m"), planar_channels[0].meaning);
    EXPECT_EQ(long_name(file, "trajectories/3/q_w"), spatial_channels[3].meaning);
}

TEST_F(SpatialResults, SayTheirVersionSoThatOlderProgramsRefuseThem)
{
    write_spatial(file, 6);
    const fs::path planar = folder / "planar.h5";
    write_complete(planar, 6);
    EXPECT_EQ(seal_version(file), 6U);
    EXPECT_EQ(seal_version(planar), 5U);
    {
        const hdf5::Handle opened = hdf5::open_file(file, false), other = hdf5::open_file(planar, false);
        EXPECT_EQ(hdf5::read_number(opened.id(), "format_version"), 6U);
        EXPECT_EQ(hdf5::read_number(opened.id(), "dimensions"), 3U);
        EXPECT_EQ(hdf5::read_number(other.id(), "format_version"), 5U);
        EXPECT_FALSE(hdf5::has_attribute(other.id(), "dimensions"));
    }
    EXPECT_EQ(ResultReader(planar).header().dimensions, 2);
    // begun ones too
    ResultWriter::create(folder / "begun.h5", sample_header(9, 3));
    EXPECT_EQ(seal_version(folder / "begun.h5"), 6U);
    ResultHeader counted = sample_header(9, 3);
    counted.limit_states = {"collapse", "moving"};
    TallyWriter::create(folder / "counted.h5", counted);
    EXPECT_EQ(seal_version(folder / "counted.h5"), 6U);
    EXPECT_EQ(ResultReader(folder / "counted.h5").header().dimensions, 3);
}

TEST_F(SpatialResults, WithAVersionThatIsNotTheirsAreDamaged)
{
    write_spatial(file, 6);
    const auto sealed_again = [&](const char* name, const std::function<void(hid_t)>& change, std::uint64_t version) {
        const fs::path copy = folder / name;
        fs::copy_file(file, copy);
        FileHandle handle = FileHandle::open(copy, true);
        const Seal seal = check_seal(handle, copy.string());
        std::uint32_t block = 0;
        std::memcpy(&block, contents(copy).data() + 20, sizeof block);
        hdf5::Handle opened = hdf5::open_file(copy, true);
        change(opened.id());
        opened.close();
        write_seal(handle, block, seal.extents, version);
        return refusal([&] { ResultReader reader(copy); });
    };
    expect_part(sealed_again(
                    "five.h5", [](hid_t) {}, 5),
                "its two format versions differ");
    expect_part(sealed_again(
                    "plane.h5", [](hid_t id) { H5Adelete(id, "dimensions"); }, 6),
                "its structure has other dimensions than its format version says");
}

TEST_F(SpatialResults, TakeTrajectoriesOfTheirModelAlone)
{
    const auto in_space = ResultWriter::create(file, sample_header(5, 3));
    EXPECT_THROW(in_space->add(sample_trajectory(1, 4)), std::invalid_argument);
    Trajectory cut = sample_spatial_trajectory(1, 4);
    cut["q_y"].pop_back();
    EXPECT_THROW(in_space->add(cut), std::invalid_argument);
    in_space->add(sample_spatial_trajectory(1, 4));
    const auto in_plane = ResultWriter::create(folder / "planar.h5", sample_header(5));
    EXPECT_THROW(in_plane->add(sample_spatial_trajectory(1, 4)), std::invalid_argument);
    in_plane->add(sample_trajectory(1, 4));
    EXPECT_THROW(ResultWriter::create(folder / "four.h5", sample_header(5, 4)), std::invalid_argument);
}

TEST_F(SpatialResults, AreNotContinuedByAStudyInThePlane)
{
    ResultWriter::create(file, sample_header(5, 3));
    expect_part(refusal([&] { ResultWriter::resume(file, sample_header(5)); }),
                "its structure has 3 dimensions instead of 2");
}

TEST(OutcomesOfModels, WhatTheOtherModelHasIsNotANumber)
{
    for (const int dimensions : {2, 3}) {
        Outcome o;
        o.peak_top_displacement_m = 0.25;
        o.top_path_m = o.max_twist_rad = 0.5;
        o.fallen_column = 2;
        leave_out_other_models(o, dimensions);
        EXPECT_EQ(o.peak_top_displacement_m, 0.25);
        EXPECT_EQ(std::isnan(o.top_path_m), dimensions == 3);
        EXPECT_EQ(std::isnan(o.max_twist_rad), dimensions == 2);
        EXPECT_EQ(o.fallen_column, dimensions == 3 ? 2 : -1);
    }
}

} // namespace
} // namespace stylobate
