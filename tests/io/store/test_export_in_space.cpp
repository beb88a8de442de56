/// Exports of structures in space: tables with the columns of the model, and solids for ParaView whose faces look
/// outward and enclose the volume of the body.

#include "ensemble/spatial/spatial_poses.hpp"
#include "io/store/export.hpp"
#include "tests/io/store/export_cases.hpp"

#include <array>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>
#include <vector>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

using ExportInSpace = ExportFolder;
using Vector = std::array<double, 3>;

Vector operator+(const Vector& a, const Vector& b)
{
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator-(const Vector& a, const Vector& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector operator*(double s, const Vector& a)
{
    return {s * a[0], s * a[1], s * a[2]};
}
double dot(const Vector& a, const Vector& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Rodrigues' formula. @param axis of length 1
Vector turned(const Vector& p, const Vector& axis, double angle)
{
    return std::cos(angle) * p + std::sin(angle) * cross(axis, p) + (1 - std::cos(angle)) * dot(axis, p) * axis;
}

/// A tapered drum, and a prism that tapers otherwise along x than along z, both turned about an axis of their own.
struct Case {
    Trajectory trajectory{spatial_channels};
    static constexpr std::size_t blocks = 2, samples = 3;
    const std::array<Vector, blocks> axis = {Vector{0.6, 0, 0.8}, Vector{2.0 / 3, 1.0 / 3, -2.0 / 3}};
    const std::array<double, blocks> angle = {0.7, 2.1}; ///< at the last sample
    const std::array<Vector, blocks> velocity = {Vector{1, 0, -2}, Vector{0, -3, 0.5}};
    const Vector base_velocity = {0.1, 0.2, -0.4};

    Case()
    {
        Trajectory& t = trajectory;
        t.index = 12;
        t.role = {BlockRole::drum, BlockRole::epistyle};
        t.column = {0, -1};
        t.name = {"drum 0", "epistyle 0"};
        t["rest_x_m"] = {0, 2};
        t["rest_y_m"] = {0.5, 1.5};
        t["rest_z_m"] = {0, 1};
        t["half_height_m"] = {0.5, 0.4};
        t["bottom_half_x_m"] = {0.6, 1.2};
        t["bottom_half_z_m"] = {0.6, 0.5};
        t["top_half_x_m"] = {0.45, 1.0};
        t["top_half_z_m"] = {0.45, 0.5};
        t["round"] = {1, 0};
        for (std::size_t k = 0; k < samples; ++k) {
            const double time = 0.5 * static_cast<double>(k);
            t.time_s.push_back(time);
            for (const auto& [name, value] :
                 {std::pair("base_x_m", base_velocity[0]), std::pair("base_y_m", base_velocity[1]),
                  std::pair("base_z_m", base_velocity[2])})
                t[name].push_back(time * value);
            for (std::size_t i = 0; i < blocks; ++i) {
                const Vector at = middle(i, time) - time * base_velocity;
                t["x_m"].push_back(at[0]);
                t["y_m"].push_back(at[1]);
                t["z_m"].push_back(at[2]);
                const double half = angle_at(i, k) / 2, longer = 1.01; // as between two steps, and more
                t["q_w"].push_back(longer * std::cos(half));
                t["q_x"].push_back(longer * std::sin(half) * axis[i][0]);
                t["q_y"].push_back(longer * std::sin(half) * axis[i][1]);
                t["q_z"].push_back(longer * std::sin(half) * axis[i][2]);
            }
        }
    }

    double angle_at(std::size_t i, std::size_t k) const { return angle[i] * static_cast<double>(k) / (samples - 1); }
    /// In the laboratory frame.
    Vector middle(std::size_t i, double time) const
    {
        const Vector rest = {trajectory["rest_x_m"][i], trajectory["rest_y_m"][i], trajectory["rest_z_m"][i]};
        return rest + time * (velocity[i] + base_velocity);
    }
};

/// A VTP as it stands in the file.
struct Drawn {
    std::vector<std::vector<Vector>> polygons;
    std::map<std::string, std::vector<double>> data;
};

Drawn read_vtp(const fs::path& file)
{
    pugi::xml_document document;
    EXPECT_TRUE(document.load_file(file.c_str())) << file;
    Drawn drawn;
    for (const pugi::xpath_node& node : document.select_nodes("//DataArray")) {
        std::istringstream words(node.node().text().get());
        std::vector<double>& values = drawn.data[node.node().attribute("Name").value()];
        for (double value = 0; words >> value;)
            values.push_back(value);
    }
    std::size_t begin = 0;
    for (const double offset : drawn.data["offsets"]) {
        std::vector<Vector> polygon;
        for (; begin < static_cast<std::size_t>(offset); ++begin) {
            const auto at = 3 * static_cast<std::size_t>(drawn.data["connectivity"][begin]);
            const std::vector<double>& points = drawn.data["Points"];
            polygon.push_back({points[at], points[at + 1], points[at + 2]});
        }
        drawn.polygons.push_back(polygon);
    }
    return drawn;
}

/// The polygons of a block. @param id -1: the base
std::vector<std::vector<Vector>> faces(const Drawn& drawn, double id)
{
    std::vector<std::vector<Vector>> found;
    for (std::size_t i = 0; i < drawn.polygons.size(); ++i)
        if (drawn.data.at("block_id")[i] == id)
            found.push_back(drawn.polygons[i]);
    return found;
}

Vector mean(const std::vector<Vector>& points)
{
    Vector sum = {};
    for (const Vector& point : points)
        sum = sum + point;
    return 1.0 / static_cast<double>(points.size()) * sum;
}

/// Twice the area, along the normal.
Vector area2(const std::vector<Vector>& polygon)
{
    Vector sum = {};
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum = sum + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return sum;
}

/// By the divergence theorem: positive where the faces look outward.
double volume(const std::vector<std::vector<Vector>>& solid)
{
    double sum = 0;
    for (const std::vector<Vector>& face : solid)
        sum += dot(face[0], area2(face)) / 6;
    return sum;
}

TEST_F(ExportInSpace, SolidsEncloseTheirBodiesAndLookOutward)
{
    const Case c;
    write_vtk(folder / "vtk", "realization_12", c.trajectory);
    const Drawn drawn = read_vtp(folder / "vtk" / "realization_12_00002.vtp");
    constexpr double time = 1, n = 24;
    const auto round_area = [](double r) { return n / 2 * std::sin(2 * std::numbers::pi / n) * r * r; };
    const std::array want = {(round_area(0.6) + round_area(0.45) + 4 * round_area(0.525)) /
                                 6, // Simpson's rule is exact
                             0.8 * (4 * 1.2 * 0.5 + 4 * 1.0 * 0.5 + 4 * 4 * 1.1 * 0.5) / 6};
    const std::array<std::size_t, 2> sides = {24, 4};
    for (std::size_t i = 0; i < Case::blocks; ++i) {
        SCOPED_TRACE(i);
        const auto solid = faces(drawn, static_cast<double>(i));
        ASSERT_EQ(solid.size(), sides[i] + 2);
        EXPECT_NEAR(volume(solid), want[i], 1e-8);
        const Vector middle = c.middle(i, time);
        for (const std::vector<Vector>& face : solid)
            EXPECT_GT(dot(area2(face), mean(face) - middle), 0);
        const Vector up = turned({0, 1, 0}, c.axis[i], c.angle[i]);
        const double half_height = c.trajectory["half_height_m"][i];
        for (const double sign : {-1.0, 1.0}) {
            const std::vector<Vector>& end = solid[sign < 0 ? 0 : 1];
            EXPECT_EQ(end.size(), sides[i]);
            const Vector off = mean(end) - (middle + sign * half_height * up);
            EXPECT_LT(std::sqrt(dot(off, off)), 1e-8);
            // which way its sides lie: a corner of a rectangle, or the point of a disc along x
            const char* half = sign < 0 ? "bottom_half_x_m" : "top_half_x_m";
            const double half_x = c.trajectory[half][i], half_z = i == 0 ? 0 : 0.5;
            const Vector corner = middle + turned({half_x, sign * half_height, half_z}, c.axis[i], c.angle[i]);
            double nearest = 1;
            for (const Vector& point : end) {
                const Vector apart = point - corner;
                nearest = std::min(nearest, std::sqrt(dot(apart, apart)));
            }
            EXPECT_LT(nearest, 1e-8);
        }
    }
    const auto base = faces(drawn, -1);
    ASSERT_EQ(base.size(), 6U);
    EXPECT_GT(volume(base), 0);
    EXPECT_NEAR(mean(base[1])[1], time * c.base_velocity[1], 1e-8) << "its top is the level of the base";
}

TEST_F(ExportInSpace, SolidsHaveTheirRotationTiltAndVelocity)
{
    const Case c;
    write_vtk(folder / "vtk", "t", c.trajectory);
    for (std::size_t k = 0; k < Case::samples; ++k) {
        Drawn drawn = read_vtp(folder / "vtk" / ("t_0000" + std::to_string(k) + ".vtp"));
        for (std::size_t p = 0; p < drawn.polygons.size(); ++p) {
            const double id = drawn.data["block_id"][p];
            Vector velocity = c.base_velocity;
            double rotation = 0, tilt = 0;
            if (id >= 0) {
                const auto i = static_cast<std::size_t>(id);
                velocity = velocity + c.velocity[i];
                rotation = c.angle_at(i, k);
                tilt = std::acos(turned({0, 1, 0}, c.axis[i], rotation)[1]);
            }
            EXPECT_NEAR(drawn.data["rotation"][p], rotation, 1e-7);
            EXPECT_NEAR(drawn.data["tilt"][p], tilt, 1e-7);
            for (std::size_t axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(drawn.data["velocity"][3 * p + axis], velocity[axis], 1e-7);
        }
    }
}

TEST_F(ExportInSpace, TablesHaveTheColumnsOfTheModel)
{
    const auto first_line = [](const fs::path& file) {
        std::ifstream in(file);
        std::string line;
        std::getline(in, line);
        return "," + line + ",";
    };
    const auto expect = [](const std::string& line, const std::string& column, bool has) {
        EXPECT_EQ(line.find("," + column + ",") != std::string::npos, has) << column << " in " << line;
    };
    ResultHeader header;
    for (const int dimensions : {2, 3}) {
        header.dimensions = dimensions;
        const fs::path to = folder / std::to_string(dimensions);
        write_csv(to, header, std::vector<ResultRow>(1), SurfaceTable{});
        const std::string line = first_line(to / "realizations.csv");
        for (const char* column : {"residual_top_z_m", "max_twist_rad", "fall_azimuth_rad", "fallen_column"})
            expect(line, column, dimensions == 3);
        for (const char* column : {"top_path_m", "sliding_path_m", "rocking_path_rad"})
            expect(line, column, dimensions == 2);
        expect(line, "peak_top_displacement_m", true);
    }
    write_trajectory_csv(folder / "t.csv", Case().trajectory);
    const std::string line = first_line(folder / "t.csv");
    EXPECT_TRUE(line.starts_with(",time_s,base_x_m,base_y_m,base_z_m,x_m[0],y_m[0],z_m[0],q_w[0],")) << line;
    for (const char* column : {"q_z[1]", "rest_z_m[1]", "bottom_half_x_m[0]", "top_half_z_m[1]", "round[0]"})
        expect(line, column, true);
}

TEST_F(ExportInSpace, AreRefusedWhereTheyAreDamaged)
{
    Case c;
    c.trajectory["q_x"].pop_back();
    EXPECT_NE(message_of([&] { write_vtk(folder / "vtk", "t", c.trajectory); }).find("damaged"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "vtk"));
}

} // namespace
} // namespace stylobate
