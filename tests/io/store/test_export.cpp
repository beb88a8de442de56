/// CSV files read back bit by bit; contours of known functions; refusals.

#include "io/plots/contour.hpp"
#include "io/store/export.hpp"
#include "tests/io/store/export_cases.hpp"

#include <bit>
#include <map>
#include <vector>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

using Export = ExportFolder;

/// A plain reader of CSV: column name -> texts.
std::map<std::string, std::vector<std::string>> read_csv(const fs::path& file)
{
    std::ifstream in(file);
    std::vector<std::vector<std::string>> lines;
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> fields(1);
        bool quoted = false;
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
                fields.back() += line[i++];
            else if (line[i] == '"')
                quoted = !quoted;
            else if (line[i] == ',' && !quoted)
                fields.emplace_back();
            else
                fields.back() += line[i];
        }
        lines.push_back(fields);
    }
    std::map<std::string, std::vector<std::string>> columns;
    for (std::size_t l = 1; l < lines.size(); ++l) {
        EXPECT_EQ(lines[l].size(), lines[0].size()) << "line " << l + 1;
        for (std::size_t c = 0; c < std::min(lines[l].size(), lines[0].size()); ++c)
            columns[lines[0][c]].push_back(lines[l][c]);
    }
    EXPECT_EQ(columns.size(), lines[0].size()) << "two columns of one name";
    return columns;
}

void expect_bits(const std::string& text, double value)
{
    const double back = std::strtod(text.c_str(), nullptr);
    if (std::isnan(value))
        EXPECT_TRUE(std::isnan(back)) << text;
    else
        EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << text;
}

TEST_F(Export, RealizationsReadBackBitByBit)
{
    ResultHeader header;
    header.input_names = {"friction[0]", "normal_stiffness[1]", "drum_offset[2]", "odd, \"name\""};
    header.block_names = {"drum 0 of column 0", "odd, \"block\""};
    std::vector<ResultRow> rows(3);
    std::uint64_t bits = 0x3fb999999999999aULL;
    const auto next = [&bits] { // doubles with full mantissas, of either sign
        bits = bits * 6364136223846793005ULL + 1442695040888963407ULL;
        return std::bit_cast<double>((bits & 0x800fffffffffffffULL) | 0x3fe0000000000000ULL) * std::exp2(bits >> 58);
    };
    for (std::size_t r = 0; r < rows.size(); ++r) {
        ResultRow& row = rows[r];
        row.index = std::numeric_limits<std::uint64_t>::max() - r;
        row.cell = 255 + r;
        row.frequency_hz = next();
        row.pga_m_s2 = next();
        row.inputs = {next(), next(), next(), next()};
        Outcome& o = row.outcome;
        for (double* field : {&o.collapse_time_s,
                              &o.peak_top_displacement_m,
                              &o.residual_top_displacement_m,
                              &o.total_sliding_m,
                              &o.total_rocking_rad,
                              &o.sliding_path_m,
                              &o.max_relative_rotation_rad,
                              &o.energy_kinetic_j,
                              &o.energy_potential_j,
                              &o.energy_spring_j,
                              &o.energy_friction_j,
                              &o.energy_damping_j,
                              &o.energy_base_work_j,
                              &o.energy_residual,
                              &o.end_time_s,
                              &o.step_s,
                              &o.unseating_time_s,
                              &o.total_collapse_time_s,
                              &o.top_path_m,
                              &o.residual_sliding_m,
                              &o.residual_dislocation,
                              &o.rocking_path_rad})
            *field = next();
        o.fall_time_s = {next(), -1};
        o.fallen_blocks = static_cast<std::int32_t>(r) + 5;
        o.unseated_block = 1 - static_cast<std::int32_t>(r);
        o.first_collapse_block = static_cast<std::int32_t>(r) - 1;
        o.steps = 1234567890123ULL + r;
    }
    rows[0].outcome.state = State::collapsed;
    rows[1].outcome.state = State::invalid;
    rows[1].outcome.invalid_reason = InvalidReason::energy;
    rows[1].outcome.energy_residual = no_number;
    rows[2].outcome.energy_residual = std::numeric_limits<double>::infinity();
    rows[2].outcome.total_sliding_m = std::numeric_limits<double>::denorm_min();
    rows[2].outcome.energy_kinetic_j = -0.0;

    write_csv(folder / "out put", header, rows, SurfaceTable{});
    EXPECT_FALSE(fs::exists(folder / "out put" / "surface.csv"));
    auto table = read_csv(folder / "out put" / "realizations.csv");
    ASSERT_EQ(table.size(), 4 + 4 + 29 + 2U);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const ResultRow& row = rows[r];
        const Outcome& o = row.outcome;
        EXPECT_EQ(table.at("index").at(r), std::to_string(row.index));
        EXPECT_EQ(table.at("cell").at(r), std::to_string(row.cell));
        EXPECT_EQ(table.at("first_collapse_block").at(r), std::to_string(o.first_collapse_block));
        EXPECT_EQ(table.at("fallen_blocks").at(r), std::to_string(o.fallen_blocks));
        EXPECT_EQ(table.at("at_rest").at(r), std::to_string(o.at_rest));
        EXPECT_EQ(table.at("unseated_block").at(r), std::to_string(o.unseated_block));
        EXPECT_EQ(table.at("steps").at(r), std::to_string(o.steps));
        const std::map<std::string, double> want{{"frequency_hz", row.frequency_hz},
                                                 {"pga_m_s2", row.pga_m_s2},
                                                 {"input_friction[0]", row.inputs[0]},
                                                 {"input_normal_stiffness_n_m2[1]", row.inputs[1]},
                                                 {"input_drum_offset_m[2]", row.inputs[2]},
                                                 {"input_odd, \"name\"", row.inputs[3]},
                                                 {"collapse_time_s", o.collapse_time_s},
                                                 {"peak_top_displacement_m", o.peak_top_displacement_m},
                                                 {"residual_top_displacement_m", o.residual_top_displacement_m},
                                                 {"total_sliding_m", o.total_sliding_m},
                                                 {"total_rocking_rad", o.total_rocking_rad},
                                                 {"sliding_path_m", o.sliding_path_m},
                                                 {"max_relative_rotation_rad", o.max_relative_rotation_rad},
                                                 {"energy_kinetic_j", o.energy_kinetic_j},
                                                 {"energy_potential_j", o.energy_potential_j},
                                                 {"energy_spring_j", o.energy_spring_j},
                                                 {"energy_friction_j", o.energy_friction_j},
                                                 {"energy_damping_j", o.energy_damping_j},
                                                 {"energy_base_work_j", o.energy_base_work_j},
                                                 {"energy_residual", o.energy_residual},
                                                 {"end_time_s", o.end_time_s},
                                                 {"step_s", o.step_s},
                                                 {"unseating_time_s", o.unseating_time_s},
                                                 {"total_collapse_time_s", o.total_collapse_time_s},
                                                 {"top_path_m", o.top_path_m},
                                                 {"residual_sliding_m", o.residual_sliding_m},
                                                 {"residual_dislocation", o.residual_dislocation},
                                                 {"rocking_path_rad", o.rocking_path_rad},
                                                 {"fall_time_s[0]", o.fall_time_s[0]},
                                                 {"fall_time_s[1]", no_number}}; // never
        for (const auto& [column, value] : want) {
            SCOPED_TRACE(column);
            expect_bits(table.at(column).at(r), value);
        }
    }
    EXPECT_EQ(table.at("state"), (std::vector<std::string>{"collapsed", "invalid", "stood"}));
    EXPECT_EQ(table.at("invalid_reason"), (std::vector<std::string>{"none", "energy", "none"}));
    const auto blocks = read_csv(folder / "out put" / "blocks.csv");
    EXPECT_EQ(blocks.at("block"), (std::vector<std::string>{"0", "1"}));
    EXPECT_EQ(blocks.at("name"), header.block_names);
}

TEST_F(Export, SurfaceReadsBackBitByBit)
{
    SurfaceTable surface = some_surface(3, 4);
    surface.trials[5] = 0;
    surface.probability[5] = surface.lower[5] = surface.upper[5] = no_number;
    write_csv(folder, ResultHeader{}, {}, surface);
    const auto table = read_csv(folder / "surface.csv");
    ASSERT_EQ(table.at("cell").size(), 12U);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            const std::size_t cell = 4 * i + j;
            EXPECT_EQ(table.at("cell")[cell], std::to_string(cell));
            expect_bits(table.at("frequency_hz")[cell], surface.frequency_hz[i]);
            expect_bits(table.at("pga_m_s2")[cell], surface.pga_m_s2[j]);
            EXPECT_EQ(table.at("trials")[cell], std::to_string(surface.trials[cell]));
            EXPECT_EQ(table.at("collapses")[cell], std::to_string(surface.collapses[cell]));
            expect_bits(table.at("probability")[cell], surface.probability[cell]);
            expect_bits(table.at("lower")[cell], surface.lower[cell]);
            expect_bits(table.at("upper")[cell], surface.upper[cell]);
            EXPECT_EQ(table.at("interval")[cell], "wilson 0.95");
        }
    EXPECT_EQ(entries(), 3U) << "something else was left in the folder";
}

TEST_F(Export, TrajectoryReadsBackBitByBit)
{
    const Trajectory t = some_trajectory(3, 0.048, 0.029, 20);
    write_trajectory_csv(folder / "one.csv", t);
    const auto table = read_csv(folder / "one.csv");
    ASSERT_EQ(table.at("time_s").size(), 20U);
    for (std::size_t s = 0; s < 20; ++s) {
        expect_bits(table.at("time_s")[s], t.time_s[s]);
        expect_bits(table.at("base_x_m")[s], t["base_x_m"][s]);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string n = "[" + std::to_string(i) + "]";
            expect_bits(table.at("x_m" + n)[s], t["x_m"][3 * s + i]);
            expect_bits(table.at("y_m" + n)[s], t["y_m"][3 * s + i]);
            expect_bits(table.at("theta_rad" + n)[s], t["theta_rad"][3 * s + i]);
            expect_bits(table.at("rest_x_m" + n)[s], t["rest_x_m"][i]);
            expect_bits(table.at("rest_y_m" + n)[s], t["rest_y_m"][i]);
            expect_bits(table.at("half_width_m" + n)[s], t["half_width_m"][i]);
            expect_bits(table.at("half_height_m" + n)[s], t["half_height_m"][i]);
        }
    }
}

TEST_F(Export, RefusedCsvChangesNothing)
{
    std::ofstream(folder / "file") << "kept";
    EXPECT_NE(message_of([&] { write_csv(folder / "file", {}, {}, {}); }).find("file"), std::string::npos);
    EXPECT_NE(message_of([&] { write_csv(folder / "missing" / "deeper", {}, {}, {}); }).find("missing"),
              std::string::npos);
    EXPECT_NE(message_of([&] {
                  write_trajectory_csv(folder / "missing" / "t.csv", some_trajectory(1, 1, 1));
              }).find("nothing was written"),
              std::string::npos);
    message_of([&] { write_trajectory_csv(folder, some_trajectory(1, 1, 1)); });
    EXPECT_EQ(read_file(folder / "file"), "kept");

    // The second file cannot be written: the first is not either, and an earlier one stays.
    fs::create_directories(folder / "both" / "surface.csv");
    std::ofstream(folder / "both" / "realizations.csv") << "earlier";
    message_of([&] { write_csv(folder / "both", {}, {}, some_surface(2, 2)); });
    EXPECT_EQ(read_file(folder / "both" / "realizations.csv"), "earlier");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "both"), fs::directory_iterator()), 2);

    ResultHeader header;
    header.input_names = {"friction"};
    EXPECT_NE(message_of([&] { write_csv(folder / "new", header, std::vector<ResultRow>(1), {}); }).find("damaged"),
              std::string::npos);
    SurfaceTable damaged = some_surface(3, 3);
    damaged.lower.pop_back();
    message_of([&] { write_csv(folder / "new", {}, {}, damaged); });
    ResultHeader blocks;
    blocks.block_names = {"drum 0"};
    EXPECT_NE(
        message_of([&] { write_csv(folder / "new", blocks, std::vector<ResultRow>(1), {}); }).find("fall times of 0"),
        std::string::npos);
    Trajectory short_one = some_trajectory(2, 1, 1);
    short_one["y_m"].pop_back();
    message_of([&] { write_trajectory_csv(folder / "t.csv", short_one); });
    EXPECT_EQ(entries(), 2U);
}

std::vector<double> even(double from, double to, std::size_t count)
{
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
    return values;
}

TEST(Contour, PlaneIsOneStraightLine)
{
    const std::vector<double> x{0, 0.3, 1, 1.7, 2};
    const std::vector<double> y{-1, 0, 0.5, 3};
    std::vector<double> z;
    for (const double a : x)
        for (const double b : y)
            z.push_back(2 * a + 3 * b);
    const auto lines = contour_lines(x, y, z, 2.5);
    ASSERT_EQ(lines.size(), 1U);
    for (const ContourPoint& p : lines[0])
        EXPECT_NEAR(2 * p.x + 3 * p.y, 2.5, 1e-14); // linear interpolation is exact on a plane
    // From edge to edge: y = 2.5 / 3 at x = 0, y = -0.5 at x = 2.
    EXPECT_DOUBLE_EQ(std::min(lines[0].front().x, lines[0].back().x), 0);
    EXPECT_DOUBLE_EQ(std::max(lines[0].front().x, lines[0].back().x), 2);
}

TEST(Contour, CircleIsOneRingOfItsLength)
{
    const std::vector<double> axis = even(-1.5, 1.5, 101);
    std::vector<double> z;
    for (const double a : axis)
        for (const double b : axis)
            z.push_back(a * a + b * b);
    const auto lines = contour_lines(axis, axis, z, 1);
    ASSERT_EQ(lines.size(), 1U);
    const ContourLine& ring = lines[0];
    EXPECT_EQ(ring.front().x, ring.back().x);
    EXPECT_EQ(ring.front().y, ring.back().y);
    double length = 0;
    double area = 0;
    for (std::size_t i = 1; i < ring.size(); ++i) {
        EXPECT_NEAR(std::hypot(ring[i].x, ring[i].y), 1, 2e-4); // h^2 / 8 times the curvature of z
        length += std::hypot(ring[i].x - ring[i - 1].x, ring[i].y - ring[i - 1].y);
        area += (ring[i - 1].x * ring[i].y - ring[i].x * ring[i - 1].y) / 2;
    }
    EXPECT_NEAR(length, 2 * std::acos(-1.0), 2e-3);
    EXPECT_NEAR(std::abs(area), std::acos(-1.0), 2e-3);
}

TEST(Contour, SaddleHolesAndPlateaus)
{
    const std::vector<double> unit{0, 1};
    // Corners (0,0) and (1,1) high: the mean decides whether they are joined.
    for (const double mean : {0.4, 0.6}) {
        const std::vector<double> z{2 * mean, 0, 0, 2 * mean};
        const auto lines = contour_lines(unit, unit, z, 0.5);
        ASSERT_EQ(lines.size(), 2U);
        for (const ContourLine& line : lines) {
            ASSERT_EQ(line.size(), 2U);
            // The mid-point of each line is nearer to the corner that it cuts off: on the diagonal x = y when the high
            // corners are cut off, on the other one when they are joined.
            const double mx = (line[0].x + line[1].x) / 2;
            const double my = (line[0].y + line[1].y) / 2;
            EXPECT_NEAR(2 * mean > 1 ? mx + my : mx - my + 1, 1, 1e-14);
            EXPECT_GT(std::abs(mx - 0.5), 0.05);
        }
    }
    // A hole breaks a line in two.
    const std::vector<double> x = even(0, 4, 5);
    const std::vector<double> y = even(0, 2, 3);
    std::vector<double> z;
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            z.push_back(i == 2 && j == 0 ? no_number : static_cast<double>(j));
    EXPECT_EQ(contour_lines(x, y, z, 1.5).size(), 1U);
    EXPECT_EQ(contour_lines(x, y, z, 0.5).size(), 2U);
    EXPECT_TRUE(contour_lines(x, y, z, 2.5).empty());
    // A plateau at the level itself.
    EXPECT_TRUE(contour_lines(unit, unit, {0.5, 0.5, 0.5, 0.5}, 0.5).empty());
}

} // namespace
} // namespace stylobate
