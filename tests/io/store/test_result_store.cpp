/// The result store: every bit back in any order, plain HDF5 for other tools, the same file after an interruption.

#include "tests/io/store/result_samples.hpp"

#include <algorithm>
#include <hdf5.h>
#include <map>
#include <numeric>

namespace stylobate {
namespace {

TEST(OutcomeNames, AreThoseOfTheFileFormat)
{
    EXPECT_STREQ(to_string(State::stood), "stood");
    EXPECT_STREQ(to_string(State::rocked), "rocked");
    EXPECT_STREQ(to_string(State::slid), "slid");
    EXPECT_STREQ(to_string(State::collapsed), "collapsed");
    EXPECT_STREQ(to_string(State::invalid), "invalid");
    EXPECT_STREQ(to_string(InvalidReason::none), "none");
    EXPECT_STREQ(to_string(InvalidReason::not_finite), "not_finite");
    EXPECT_STREQ(to_string(InvalidReason::energy), "energy");
}

TEST_F(ResultStore, GivesEveryBitBackWhateverTheOrder)
{
    const std::uint64_t total = 2 * chunk + 77;
    std::vector<std::uint64_t> order(total);
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937_64(5));

    auto writer = ResultWriter::create(file, sample_header(total));
    for (const std::uint64_t i : order) {
        EXPECT_EQ(writer->state(i), std::nullopt);
        writer->add(sample_row(i));
        EXPECT_EQ(writer->state(i), sample_row(i).outcome.state);
    }
    EXPECT_EQ(writer->rows(), total);
    writer->add(sample_trajectory(12, 5));
    writer->add(sample_trajectory(3, 0));
    const SurfaceTable table = sample_surface();
    writer->finish(&table);
    EXPECT_THROW(writer->add(sample_row(0)), std::logic_error);
    writer.reset();

    const ResultReader reader(file);
    EXPECT_TRUE(reader.complete());
    const ResultHeader& got = reader.header();
    const ResultHeader want = sample_header(total);
    EXPECT_EQ(got.kind, want.kind);
    EXPECT_EQ(got.study_toml, want.study_toml);
    EXPECT_EQ(got.seed, want.seed);
    EXPECT_EQ(got.code_version, want.code_version);
    EXPECT_EQ(got.total, want.total);
    EXPECT_EQ(got.input_names, want.input_names);
    EXPECT_EQ(got.block_names, want.block_names);
    EXPECT_EQ(got.frequency_hz, want.frequency_hz);
    EXPECT_EQ(got.pga_m_s2, want.pga_m_s2);
    const auto rows = reader.rows();
    ASSERT_EQ(rows.size(), total);
    for (std::uint64_t i = 0; i < total; ++i)
        ASSERT_EQ(bits(rows[i]), bits(sample_row(i))) << i;
    EXPECT_EQ(bits(reader.row(chunk + 5)), bits(sample_row(chunk + 5)));
    EXPECT_EQ(bits(reader.row(1)), bits(sample_row(1)));
    expect_part(refusal([&] { reader.row(total); }), "has no realization 589; it has those from 0 to 588");

    const SurfaceTable surface = reader.surface();
    EXPECT_EQ(surface.trials, table.trials);
    EXPECT_EQ(surface.collapses, table.collapses);
    EXPECT_EQ(bits(surface.probability), bits(table.probability));
    EXPECT_EQ(bits(surface.lower), bits(table.lower));
    EXPECT_EQ(bits(surface.upper), bits(table.upper));
    EXPECT_EQ(surface.interval, table.interval);

    EXPECT_EQ(reader.trajectory_indices(), (std::vector<std::uint64_t>{3, 12}));
    EXPECT_EQ(reader.trajectory(3).blocks(), 3U);
    const Trajectory t = reader.trajectory(12);
    const Trajectory want_t = sample_trajectory(12, 5);
    EXPECT_EQ(bits(t.time_s), bits(want_t.time_s));
    EXPECT_EQ(bits(t["x_m"]), bits(want_t["x_m"]));
    EXPECT_EQ(bits(t["y_m"]), bits(want_t["y_m"]));
    EXPECT_EQ(bits(t["theta_rad"]), bits(want_t["theta_rad"]));
    EXPECT_EQ(bits(t["base_x_m"]), bits(want_t["base_x_m"]));
    EXPECT_EQ(bits(t["half_width_m"]), bits(want_t["half_width_m"]));
    EXPECT_EQ(bits(t["half_height_m"]), bits(want_t["half_height_m"]));
    EXPECT_EQ(t.role, want_t.role);
    EXPECT_EQ(t.column, want_t.column);
    EXPECT_EQ(t.name, want_t.name);
    expect_part(refusal([&] { reader.trajectory(4); }), "no trajectory of realization 4");
}

TEST_F(ResultStore, HasNoSurfaceNorInputsWhereTheStudyHasNone)
{
    ResultHeader header = sample_header(2);
    header.kind = "single";
    header.input_names.clear();
    header.frequency_hz.clear();
    header.pga_m_s2.clear();
    const auto writer = ResultWriter::create(file, header);
    for (std::uint64_t i = 0; i < 2; ++i) {
        ResultRow row = sample_row(i);
        EXPECT_THROW(writer->add(row), std::invalid_argument) << "five inputs where there are none";
        row.inputs.clear();
        for (const std::size_t blocks : {0U, 2U, 4U}) {
            ResultRow other = row;
            other.outcome.fall_time_s.resize(blocks);
            EXPECT_THROW(writer->add(other), std::invalid_argument) << blocks << " fall times of three blocks";
        }
        writer->add(row);
    }
    writer->finish(nullptr);
    const ResultReader reader(file);
    EXPECT_EQ(reader.rows().size(), 2U);
    EXPECT_TRUE(reader.surface().frequency_hz.empty());
    EXPECT_TRUE(reader.trajectory_indices().empty());
}

TEST_F(ResultStore, HoldsTheOneRealizationOfAReplay)
{
    ResultHeader header = sample_header(1);
    header.first = 70001; // in no chunk of 256 that begins at 0
    {
        const auto writer = ResultWriter::create(file, header);
        EXPECT_THROW(writer->add(sample_row(70000)), std::invalid_argument);
        EXPECT_THROW(writer->add(sample_row(70002)), std::invalid_argument);
        EXPECT_FALSE(writer->has(70001));
        writer->add(sample_row(70001));
        EXPECT_TRUE(writer->has(70001));
        EXPECT_FALSE(writer->has(0));
        writer->add(sample_trajectory(70001, 2));
        writer->finish(nullptr);
    }
    const ResultReader reader(file);
    EXPECT_EQ(reader.header().first, 70001U);
    EXPECT_EQ(bits(reader.row(70001)), bits(sample_row(70001)));
    ASSERT_EQ(reader.rows().size(), 1U);
    EXPECT_EQ(bits(reader.rows()[0]), bits(sample_row(70001)));
    EXPECT_EQ(reader.trajectory_indices(), std::vector<std::uint64_t>{70001});
    expect_part(refusal([&] { reader.row(0); }), "has no realization 0; it has those from 70001 to 70001");
}

TEST_F(ResultStore, ContinuesFarFromIndexZero)
{
    ResultHeader header = sample_header(chunk + 5);
    header.first = 1000;
    {
        const auto writer = ResultWriter::create(file, header);
        add_rows(*writer, 1000 + chunk, 1000 + chunk + 5);
    }
    const auto writer = ResultWriter::resume(file, header);
    EXPECT_EQ(writer->rows(), 5U);
    for (std::uint64_t i = 900; i < 1400; ++i)
        EXPECT_EQ(writer->has(i), i >= 1000 + chunk && i < 1000 + chunk + 5) << i;
    add_rows(*writer, 1000, 1000 + chunk);
    writer->finish(nullptr);
    const auto rows = ResultReader(file).rows();
    ASSERT_EQ(rows.size(), chunk + 5);
    for (std::uint64_t i = 0; i < rows.size(); ++i)
        ASSERT_EQ(bits(rows[i]), bits(sample_row(1000 + i)));
}

TEST_F(ResultStore, TakesStudyTextsOfAnyLength)
{
    ResultHeader header = sample_header(1);
    header.study_toml.assign(300000, 'x');
    {
        const auto writer = ResultWriter::create(file, header);
        add_rows(*writer, 0, 1);
        writer->finish(nullptr);
    }
    EXPECT_EQ(ResultReader(file).header().study_toml, header.study_toml);
}

/// What the plain HDF5 library finds, without a line of the code under test.
struct Plain {
    explicit Plain(const fs::path& path) : id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
    ~Plain() { H5Fclose(id); }
    Plain(const Plain&) = delete;
    Plain& operator=(const Plain&) = delete;

    /// "type (shape) unit"
    std::string describe(const std::string& path) const
    {
        const hid_t dataset = H5Dopen2(id, path.c_str(), H5P_DEFAULT);
        if (dataset < 0)
            return "missing";
        const hid_t type = H5Dget_type(dataset);
        const hid_t space = H5Dget_space(dataset);
        const std::map<H5T_class_t, std::string> kinds = {
            {H5T_INTEGER, "int"}, {H5T_FLOAT, "float"}, {H5T_ENUM, "enum"}};
        const bool is_unsigned = H5Tget_class(type) == H5T_INTEGER && H5Tget_sign(type) == H5T_SGN_NONE;
        std::string text =
            (is_unsigned ? "u" : "") + kinds.at(H5Tget_class(type)) + std::to_string(8 * H5Tget_size(type)) + " (";
        hsize_t dims[4] = {};
        const int rank = H5Sget_simple_extent_dims(space, dims, nullptr);
        for (int i = 0; i < rank; ++i)
            text += (i ? " x " : "") + std::to_string(dims[i]);
        text += ")";
        if (H5Aexists(dataset, "unit") > 0)
            text += " " + attribute(path, "unit");
        H5Sclose(space);
        H5Tclose(type);
        H5Dclose(dataset);
        return text;
    }

    std::string attribute(const std::string& object, const char* name) const
    {
        const hid_t a = H5Aopen_by_name(id, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
        const hid_t type = H5Aget_type(a);
        std::string text;
        if (H5Tget_class(type) == H5T_STRING) {
            char* value = nullptr;
            H5Aread(a, type, &value);
            text = value;
            H5free_memory(value);
        } else {
            std::uint64_t value = 0;
            H5Aread(a, H5T_NATIVE_UINT64, &value);
            text = std::to_string(value);
        }
        H5Tclose(type);
        H5Aclose(a);
        return text;
    }

    template <class T>
    std::vector<T> values(const std::string& path, hid_t memory, std::size_t count) const
    {
        std::vector<T> result(count);
        const hid_t dataset = H5Dopen2(id, path.c_str(), H5P_DEFAULT);
        EXPECT_GE(H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data()), 0) << path;
        H5Dclose(dataset);
        return result;
    }

    std::vector<std::uint8_t> states(std::size_t count) const
    {
        const hid_t dataset = H5Dopen2(id, "/realizations/outcome/state", H5P_DEFAULT);
        const hid_t type = H5Dget_type(dataset);
        const auto result = values<std::uint8_t>("/realizations/outcome/state", type, count);
        H5Tclose(type);
        H5Dclose(dataset);
        return result;
    }

    hid_t id;
};

TEST_F(ResultStore, IsPlainHdf5WithTheNamesOfTheContract)
{
    write_complete(file, 300);
    const Plain plain(file);
    ASSERT_GE(plain.id, 0);
    EXPECT_EQ(plain.attribute("/", "format"), "stylobate");
    EXPECT_EQ(plain.attribute("/", "format_version"), "5");
    EXPECT_EQ(plain.attribute("/", "kind"), "surface");
    EXPECT_EQ(plain.attribute("/", "study_toml"), sample_header(1).study_toml);
    EXPECT_EQ(plain.attribute("/", "seed"), "18364758544493064720");
    EXPECT_EQ(plain.attribute("/", "code_version"), "0.1.0+abc");
    EXPECT_EQ(plain.attribute("/", "complete"), "1");
    EXPECT_EQ(plain.attribute("/", "realizations"), "300");
    EXPECT_EQ(plain.attribute("/", "first_realization"), "0");
    EXPECT_EQ(plain.attribute("/surface", "interval"), "wilson 0.95");
    EXPECT_EQ(plain.attribute("/realizations/outcome", "blocks"),
              "drum 0 of column 0\ndrum 1 of column 0\nepistyle \xc3\xa9, 0");
    EXPECT_EQ(plain.attribute("/trajectories/3", "blocks"), "drum 0\nthe second, \"epistyle\"\n3");

    const std::map<std::string, std::string> want = {
        {"index", "uint64 (300)"},
        {"cell", "int64 (300)"},
        {"frequency_hz", "float64 (300) Hz"},
        {"pga_m_s2", "float64 (300) m/s2"},
        {"input/phase", "float64 (300) rad"},
        {"input/friction", "float64 (300 x 3)"},
        {"input/normal_stiffness", "float64 (300 x 1) N/m2"},
        {"outcome/state", "enum8 (300)"},
        {"outcome/invalid_reason", "enum8 (300)"},
        {"outcome/collapse_time_s", "float64 (300) s"},
        {"outcome/first_collapse_block", "int32 (300)"},
        {"outcome/fallen_blocks", "int32 (300)"},
        {"outcome/at_rest", "int32 (300)"},
        {"outcome/unseated_block", "int32 (300)"},
        {"outcome/unseating_time_s", "float64 (300) s"},
        {"outcome/total_collapse_time_s", "float64 (300) s"},
        {"outcome/fall_time_s", "float64 (300 x 3) s"},
        {"outcome/top_path_m", "float64 (300) m"},
        {"outcome/residual_sliding_m", "float64 (300) m"},
        {"outcome/residual_dislocation", "float64 (300)"},
        {"outcome/rocking_path_rad", "float64 (300) rad"},
        {"outcome/peak_top_displacement_m", "float64 (300) m"},
        {"outcome/residual_top_displacement_m", "float64 (300) m"},
        {"outcome/total_sliding_m", "float64 (300) m"},
        {"outcome/total_rocking_rad", "float64 (300) rad"},
        {"outcome/sliding_path_m", "float64 (300) m"},
        {"outcome/max_relative_rotation_rad", "float64 (300) rad"},
        {"outcome/energy_kinetic_j", "float64 (300) J"},
        {"outcome/energy_potential_j", "float64 (300) J"},
        {"outcome/energy_spring_j", "float64 (300) J"},
        {"outcome/energy_friction_j", "float64 (300) J"},
        {"outcome/energy_damping_j", "float64 (300) J"},
        {"outcome/energy_base_work_j", "float64 (300) J"},
        {"outcome/energy_residual", "float64 (300)"},
        {"outcome/end_time_s", "float64 (300) s"},
        {"outcome/step_s", "float64 (300) s"},
        {"outcome/steps", "uint64 (300)"},
        {"chunk_checksum", "uint64 (2)"},
    };
    for (const auto& [name, description] : want)
        EXPECT_EQ(plain.describe("/realizations/" + name), description) << name;
    for (const char* time : {"collapse_time_s", "unseating_time_s", "total_collapse_time_s", "fall_time_s"})
        EXPECT_EQ(plain.attribute(std::string("/realizations/outcome/") + time, "none"), "NaN: it did not happen");
    for (const char* number : {"first_collapse_block", "unseated_block"})
        EXPECT_EQ(plain.attribute(std::string("/realizations/outcome/") + number, "none"),
                  "-1: no block; -2: several blocks, together");
    EXPECT_EQ(plain.describe("/surface/frequency_hz"), "float64 (3) Hz");
    EXPECT_EQ(plain.describe("/surface/pga_m_s2"), "float64 (2) m/s2");
    EXPECT_EQ(plain.describe("/surface/trials"), "uint64 (3 x 2)");
    EXPECT_EQ(plain.describe("/surface/collapses"), "uint64 (3 x 2)");
    for (const char* name : {"probability", "lower", "upper"})
        EXPECT_EQ(plain.describe(std::string("/surface/") + name), "float64 (3 x 2)");
    EXPECT_EQ(plain.describe("/trajectories/3/time_s"), "float64 (4) s");
    EXPECT_EQ(plain.describe("/trajectories/3/x_m"), "float64 (4 x 3) m");
    EXPECT_EQ(plain.describe("/trajectories/3/y_m"), "float64 (4 x 3) m");
    EXPECT_EQ(plain.describe("/trajectories/3/theta_rad"), "float64 (4 x 3) rad");
    EXPECT_EQ(plain.describe("/trajectories/3/base_x_m"), "float64 (4) m");
    EXPECT_EQ(plain.describe("/trajectories/3/rest_x_m"), "float64 (3) m");
    EXPECT_EQ(plain.describe("/trajectories/3/rest_y_m"), "float64 (3) m");
    EXPECT_EQ(plain.describe("/trajectories/3/half_width_m"), "float64 (3) m");
    EXPECT_EQ(plain.describe("/trajectories/3/half_height_m"), "float64 (3) m");
    EXPECT_EQ(plain.describe("/trajectories/3/role"), "enum8 (3)");
    EXPECT_EQ(plain.describe("/trajectories/3/column"), "int32 (3)");

    // values through the library, which finds them by the structure and not by the writer's offsets
    const auto index = plain.values<std::uint64_t>("/realizations/index", H5T_NATIVE_UINT64, 300);
    const auto steps = plain.values<std::uint64_t>("/realizations/outcome/steps", H5T_NATIVE_UINT64, 300);
    const auto friction = plain.values<double>("/realizations/input/friction", H5T_NATIVE_DOUBLE, 900);
    const auto falls = plain.values<double>("/realizations/outcome/fall_time_s", H5T_NATIVE_DOUBLE, 900);
    const auto block = plain.values<std::int32_t>("/realizations/outcome/first_collapse_block", H5T_NATIVE_INT32, 300);
    const hid_t dataset = H5Dopen2(plain.id, "/realizations/outcome/state", H5P_DEFAULT);
    const hid_t names = H5Dget_type(dataset);
    std::vector<std::uint8_t> state = plain.states(300);
    for (std::uint64_t i = 0; i < 300; ++i) {
        const ResultRow row = sample_row(i);
        EXPECT_EQ(index[i], i);
        EXPECT_EQ(steps[i], row.outcome.steps);
        EXPECT_EQ(block[i], row.outcome.first_collapse_block);
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(std::bit_cast<std::uint64_t>(friction[3 * i + k]),
                      std::bit_cast<std::uint64_t>(row.inputs[1 + k]));
        EXPECT_EQ(
            bits({falls.begin() + static_cast<std::ptrdiff_t>(3 * i),
                  falls.begin() + static_cast<std::ptrdiff_t>(3 * i + 3)}),
            bits(std::vector<double>{time_in_file(row.outcome.fall_time_s[0]), time_in_file(row.outcome.fall_time_s[1]),
                                     time_in_file(row.outcome.fall_time_s[2])}));
        char name[32] = {};
        H5Tenum_nameof(names, &state[i], name, sizeof name);
        EXPECT_STREQ(name, to_string(row.outcome.state));
    }
    H5Tclose(names);
    H5Dclose(dataset);
}

/// CRC-32 bit by bit (reflected, polynomial 0xEDB88320), against the library's table.
std::uint32_t crc32_slow(const std::vector<std::uint8_t>& bytes)
{
    std::uint32_t crc = ~0U;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1U) ? (crc >> 1U) ^ 0xEDB88320U : crc >> 1U;
    }
    return ~crc;
}

TEST_F(ResultStore, ChecksumIsTheDocumentedOne)
{
    write_complete(file, chunk + 3);
    std::vector<std::uint8_t> bytes;
    const auto append = [&](const auto& value) {
        const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
        bytes.insert(bytes.end(), begin, begin + sizeof value);
    };
    const auto column = [&](const std::function<void(const ResultRow&)>& f) {
        for (std::uint64_t i = chunk; i < chunk + 3; ++i)
            f(sample_row(i));
    };
    column([&](const ResultRow& r) { append(r.index); });
    column([&](const ResultRow& r) { append(r.cell); });
    column([&](const ResultRow& r) { append(r.frequency_hz); });
    column([&](const ResultRow& r) { append(r.pga_m_s2); });
    column([&](const ResultRow& r) { append(r.outcome.state); });
    column([&](const ResultRow& r) { append(r.outcome.invalid_reason); });
    column([&](const ResultRow& r) { append(time_in_file(r.outcome.collapse_time_s)); });
    column([&](const ResultRow& r) { append(r.outcome.first_collapse_block); });
    column([&](const ResultRow& r) { append(r.outcome.fallen_blocks); });
    column([&](const ResultRow& r) { append(r.outcome.at_rest); });
    column([&](const ResultRow& r) { append(r.outcome.unseated_block); });
    column([&](const ResultRow& r) { append(time_in_file(r.outcome.unseating_time_s)); });
    column([&](const ResultRow& r) { append(time_in_file(r.outcome.total_collapse_time_s)); });
    for (double Outcome::*field :
         {&Outcome::peak_top_displacement_m, &Outcome::residual_top_displacement_m, &Outcome::top_path_m,
          &Outcome::total_sliding_m, &Outcome::sliding_path_m, &Outcome::residual_sliding_m,
          &Outcome::residual_dislocation, &Outcome::total_rocking_rad, &Outcome::rocking_path_rad,
          &Outcome::max_relative_rotation_rad, &Outcome::energy_kinetic_j, &Outcome::energy_potential_j,
          &Outcome::energy_spring_j, &Outcome::energy_friction_j, &Outcome::energy_damping_j,
          &Outcome::energy_base_work_j, &Outcome::energy_residual, &Outcome::end_time_s, &Outcome::step_s})
        column([&](const ResultRow& r) { append(r.outcome.*field); });
    column([&](const ResultRow& r) { append(r.outcome.steps); });
    column([&](const ResultRow& r) {
        for (const double time : r.outcome.fall_time_s)
            append(time_in_file(time));
    });
    column([&](const ResultRow& r) { append(r.inputs[0]); });
    column([&](const ResultRow& r) {
        for (std::size_t k = 1; k < 4; ++k)
            append(r.inputs[k]);
    });
    column([&](const ResultRow& r) { append(r.inputs[4]); });
    const Plain plain(file);
    const auto checksums = plain.values<std::uint64_t>("/realizations/chunk_checksum", H5T_NATIVE_UINT64, 2);
    EXPECT_EQ(checksums[1], (std::uint64_t{1} << 32) + crc32_slow(bytes));
}

TEST_F(ResultStore, ContinuesToTheSameFile)
{
    const std::uint64_t total = 3 * chunk + 10;
    const fs::path whole = folder / "whole.h5";
    const SurfaceTable table = sample_surface();
    {
        const auto writer = ResultWriter::create(whole, sample_header(total));
        writer->add(sample_trajectory(chunk, 7));
        add_rows(*writer, 0, total);
        writer->finish(&table);
    }
    {
        const auto writer = ResultWriter::create(file, sample_header(total));
        add_rows(*writer, chunk, 2 * chunk + 9);
        EXPECT_TRUE(writer->has(chunk));
        EXPECT_TRUE(writer->has(2 * chunk + 8));
        writer->add(sample_trajectory(chunk, 7));
        writer->flush();
        EXPECT_THROW(writer->finish(&table), std::logic_error);
    }
    {
        const ResultReader reader(file);
        EXPECT_FALSE(reader.complete());
        EXPECT_EQ(reader.rows().size(), chunk + 9);
        EXPECT_EQ(bits(reader.row(chunk + 1)), bits(sample_row(chunk + 1)));
        EXPECT_EQ(reader.trajectory_indices(), std::vector<std::uint64_t>{chunk});
        EXPECT_EQ(bits(reader.trajectory(chunk)["x_m"]), bits(sample_trajectory(chunk, 7)["x_m"]));
        EXPECT_TRUE(reader.surface().trials.empty());
        expect_part(refusal([&] { reader.row(0); }), "does not hold realization 0 yet");
    }
    {
        const Plain plain(file);
        EXPECT_EQ(plain.attribute("/", "complete"), "0");
        EXPECT_EQ(plain.attribute("/realizations/outcome", "blocks").substr(0, 6), "drum 0");
    }
    {
        const auto writer = ResultWriter::resume(file, sample_header(total));
        EXPECT_EQ(writer->rows(), chunk + 9);
        for (std::uint64_t i = 0; i < total; ++i)
            EXPECT_EQ(writer->has(i), i >= chunk && i < 2 * chunk + 9);
        EXPECT_FALSE(writer->has(total));
        for (std::uint64_t i = total; i-- > 0;)
            writer->add(sample_row(i)); // those that are there already change nothing
        EXPECT_EQ(writer->rows(), total);
        writer->finish(&table);
    }
    EXPECT_TRUE(contents(file) == contents(whole)) << "equal results are equal files";
    std::vector<fs::path> left(fs::directory_iterator(folder), {});
    EXPECT_EQ(left.size(), 2U) << "no other file remains";
}

TEST_F(ResultStore, SameBitsSeesEveryFallTime)
{
    const ResultRow row = sample_row(4);
    EXPECT_TRUE(same_bits(row, sample_row(4)));
    for (std::size_t i = 0; i < 3; ++i) {
        ResultRow other = row;
        other.outcome.fall_time_s[i] =
            std::bit_cast<double>(std::bit_cast<std::uint64_t>(row.outcome.fall_time_s[i]) ^ 1U);
        EXPECT_FALSE(same_bits(row, other)) << i;
    }
    // a fall time that became an input would be the same bytes in the same order
    ResultRow moved = row;
    moved.inputs.insert(moved.inputs.begin(), moved.outcome.fall_time_s.back());
    moved.outcome.fall_time_s.pop_back();
    EXPECT_FALSE(same_bits(row, moved));
}

TEST_F(ResultStore, RefusesTrajectoriesWhoseBlocksDoNotFit)
{
    const auto writer = ResultWriter::create(file, sample_header(1));
    const auto bad = [&](const std::function<void(Trajectory&)>& change) {
        Trajectory t = sample_trajectory(0, 4);
        change(t);
        EXPECT_THROW(writer->add(t), std::invalid_argument);
    };
    bad([](Trajectory& t) { t.role.pop_back(); });
    bad([](Trajectory& t) { t.column.push_back(0); });
    bad([](Trajectory& t) { t["rest_x_m"].pop_back(); });
    bad([](Trajectory& t) { t["rest_y_m"].clear(); });
    bad([](Trajectory& t) { t.name.pop_back(); });
    bad([](Trajectory& t) { t.name[0] = ""; });
    bad([](Trajectory& t) { t.name[0] = "a\nb"; });
    writer->add(sample_trajectory(0, 4));
}

TEST_F(ResultStore, RefusesHeadersThatMakeNoSense)
{
    const auto bad = [&](const std::function<void(ResultHeader&)>& change) {
        ResultHeader header = sample_header(5);
        change(header);
        EXPECT_THROW(ResultWriter::create(file, header), std::invalid_argument);
        EXPECT_TRUE(fs::is_empty(folder));
    };
    bad([](ResultHeader& h) { h.total = 0; });
    bad([](ResultHeader& h) { h.first = ~std::uint64_t{0}; });
    bad([](ResultHeader& h) { h.pga_m_s2.clear(); });
    bad([](ResultHeader& h) { h.block_names.clear(); });
    bad([](ResultHeader& h) { h.block_names[1] = ""; });
    bad([](ResultHeader& h) { h.block_names[1] = "two\nlines"; });
    for (const char* name : {"", "a b", "a/b", "a[", "a[]", "a[1", "a[-1]", "a[x]", "[0]", "a[9999999]", "phase",
                             "friction", "friction[4]", "friction[0]", "other[1]"})
        bad([&](ResultHeader& h) { h.input_names.push_back(name); });
}

TEST_F(ResultStore, IsAsLargeAsItsRows)
{
    const std::uint64_t total = 100 * chunk;
    {
        const auto writer = ResultWriter::create(file, sample_header(total));
        add_rows(*writer, 0, total);
        writer->finish(nullptr);
    }
    const std::uint64_t row = 4 * 8 + 5 * 8 + 2 + 4 * 4 + 22 * 8 + 8 + 3 * 8; // 32 + inputs + outcome + fall times
    EXPECT_GE(fs::file_size(file), row * total);
    EXPECT_LE(fs::file_size(file), row * total + 60000); // names, units and scales
}

} // namespace
} // namespace stylobate
