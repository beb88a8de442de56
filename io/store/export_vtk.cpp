#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/spatial/placed_solid.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <string>
#include <vector>

namespace stylobate {

namespace {

constexpr char head[] = "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\">\n";

void check(const Trajectory& t)
{
    if (t.time_s.empty() || !lists_fit(t))
        throw InputError(
            fmt::format("the trajectory of realization {} has tables of different sizes, or no times: it is "
                        "damaged.\n  Replay the realization into a new file.",
                        t.index));
}

using Point = std::array<double, 3>; // along x, y, z [m]

/// What the polygons of a body have.
struct OfBody {
    std::int64_t id = -1; ///< of the block; -1: the base
    double rotation_rad = 0;
    double tilt_rad = 0; ///< in space alone
    Point velocity = {}; ///< [m/s]
};

/// The text of one time.
class Polygons {
public:
    /// @param with_tilt whether the polygons have a tilt besides their rotation
    explicit Polygons(bool with_tilt) : with_tilt_(with_tilt) {}

    /// @param points counter-clockwise
    void add(std::span<const Point> points, const OfBody& of)
    {
        const auto add_point = [](std::string& to, const Point& p) {
            fmt::format_to(std::back_inserter(to), "{:.10g} {:.10g} {:.10g}\n", p[0], p[1], p[2]);
        };
        for (const Point& point : points) {
            add_point(points_, point);
            fmt::format_to(std::back_inserter(connectivity_), "{} ", all_points_++);
        }
        connectivity_.back() = '\n';
        fmt::format_to(std::back_inserter(offsets_), "{} ", all_points_);
        fmt::format_to(std::back_inserter(ids_), "{} ", of.id);
        fmt::format_to(std::back_inserter(rotations_), "{:.10g} ", of.rotation_rad);
        fmt::format_to(std::back_inserter(tilts_), "{:.10g} ", of.tilt_rad);
        add_point(velocities_, of.velocity);
        ++count_;
    }

    std::string text() const
    {
        const auto array = [](const char* type, const char* name, int components, const std::string& values) {
            return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n"
                               "</DataArray>\n",
                               type, name, components, values);
        };
        return fmt::format(head, "PolyData") +
               fmt::format("<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                           "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n<Points>\n",
                           all_points_, count_) +
               array("Float64", "Points", 3, points_) + "</Points>\n<Polys>\n" +
               array("Int64", "connectivity", 1, connectivity_) + array("Int64", "offsets", 1, offsets_) +
               "</Polys>\n<CellData Scalars=\"block_id\" Vectors=\"velocity\">\n" +
               array("Int64", "block_id", 1, ids_) + array("Float64", "rotation", 1, rotations_) +
               (with_tilt_ ? array("Float64", "tilt", 1, tilts_) : "") + array("Float64", "velocity", 3, velocities_) +
               "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    }

private:
    bool with_tilt_;
    std::string points_, connectivity_, offsets_, ids_, rotations_, tilts_, velocities_;
    std::size_t all_points_ = 0, count_ = 0;
};

/// Between the samples before and after number k.
struct Difference {
    std::size_t before, after;
    double time_s;

    Difference(const std::vector<double>& times_s, std::size_t k)
        : before(k > 0 ? k - 1 : k), after(std::min(k + 1, times_s.size() - 1)),
          time_s(times_s[after] - times_s[before])
    {
    }
    double of(const std::vector<double>& values, std::size_t width, std::size_t i) const
    {
        return time_s > 0 ? (values[after * width + i] - values[before * width + i]) / time_s : 0;
    }
};

// ---- in the plane ---------------------------------------------------------------------------------------------------

class PlanarDrawing {
public:
    /// The slab of the base is as wide as the structure ever lies, and a twentieth more on both sides.
    explicit PlanarDrawing(const Trajectory& t) : t_(t)
    {
        for (std::size_t k = 0; k < t.time_s.size(); ++k)
            for (std::size_t i = 0; i < t.blocks(); ++i) {
                const Rectangle block = rectangle_of(t, k, i);
                left_ = std::min(left_, block.x - block.reach());
                right_ = std::max(right_, block.x + block.reach());
            }
        height_ = 0.05 * (right_ - left_);
        left_ -= height_;
        right_ += height_;
    }

    std::string at(std::size_t k) const
    {
        Polygons polygons(false);
        const std::size_t n = t_.blocks();
        const Difference rate(t_.time_s, k);
        const double base = t_["base_x_m"][k], base_velocity = rate.of(t_["base_x_m"], 1, 0);
        const auto add = [&](const std::array<Rectangle::Corner, 4>& corners, const OfBody& of) {
            std::array<Point, 4> points;
            std::ranges::transform(corners, points.begin(), [](const auto& c) { return Point{c.x, c.y, 0}; });
            polygons.add(points, of);
        };
        for (std::size_t i = 0; i < n; ++i) {
            Rectangle block = rectangle_of(t_, k, i);
            block.x = base + block.x;
            add(block.corners(), {.id = static_cast<std::int64_t>(i),
                                  .rotation_rad = block.turned_rad,
                                  .velocity = {base_velocity + rate.of(t_["x_m"], n, i), rate.of(t_["y_m"], n, i), 0}});
        }
        const double left = base + left_, right = base + right_;
        add({{{left, -height_}, {right, -height_}, {right, 0}, {left, 0}}}, {.velocity = {base_velocity, 0, 0}});
        return polygons.text();
    }

private:
    const Trajectory& t_;
    double left_ = 0, right_ = 0, height_ = 0; ///< of the slab, in its own frame
};

// ---- in space -------------------------------------------------------------------------------------------------------

void add_solid(Polygons& to, const PlacedSolid& solid, const OfBody& of)
{
    const std::vector<SpacePoint> corners = solid.corners();
    for (const std::vector<std::size_t>& face : solid.faces()) {
        std::vector<Point> points;
        for (const std::size_t corner : face)
            points.push_back(corners[corner]);
        to.add(points, of);
    }
}

class SpatialDrawing {
public:
    /// The slab of the base is as large as the structure ever lies, and a twentieth of its length more on all sides.
    explicit SpatialDrawing(const Trajectory& t) : t_(t)
    {
        for (std::size_t i = 0; i < t.blocks(); ++i) {
            const double reach = shape_of(t, i).half_diagonal();
            for (std::size_t at = i; at < t["x_m"].size(); at += t.blocks()) {
                from_ = {std::min(from_.x, t["x_m"][at] - reach), std::min(from_.z, t["z_m"][at] - reach)};
                to_ = {std::max(to_.x, t["x_m"][at] + reach), std::max(to_.z, t["z_m"][at] + reach)};
            }
        }
        height_ = 0.05 * std::max(to_.x - from_.x, to_.z - from_.z);
        from_ = {from_.x - height_, from_.z - height_};
        to_ = {to_.x + height_, to_.z + height_};
    }

    std::string at(std::size_t k) const
    {
        Polygons polygons(true);
        const std::size_t n = t_.blocks();
        const Difference rate(t_.time_s, k);
        const Point base = base_of([&](const std::vector<double>& list) { return list[k]; });
        const Point base_velocity = base_of([&](const std::vector<double>& list) { return rate.of(list, 1, 0); });
        for (std::size_t i = 0; i < n; ++i) {
            PlacedSolid solid = solid_of(t_, k, i);
            solid.middle = sum(base, solid.middle);
            const Point velocity =
                sum(base_velocity, {rate.of(t_["x_m"], n, i), rate.of(t_["y_m"], n, i), rate.of(t_["z_m"], n, i)});
            add_solid(polygons, solid,
                      {static_cast<std::int64_t>(i), solid.attitude.angle_rad(), solid.attitude.tilt_rad(), velocity});
        }
        const HalfSizes half = {(to_.x - from_.x) / 2, (to_.z - from_.z) / 2};
        const Point middle = sum(base, {(from_.x + to_.x) / 2, -height_ / 2, (from_.z + to_.z) / 2});
        add_solid(polygons, {{height_ / 2, half, half, false}, middle, Attitude()}, {.velocity = base_velocity});
        return polygons.text();
    }

private:
    static Point sum(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
    template <class F>
    Point base_of(const F& value) const
    {
        return {value(t_["base_x_m"]), value(t_["base_y_m"]), value(t_["base_z_m"])};
    }

    const Trajectory& t_;
    HalfSizes from_, to_; ///< ends of the slab, in its own frame
    double height_ = 0;   ///< of the slab
};

template <class Drawing>
void write_drawn(const std::filesystem::path& folder, const std::string& name, const Trajectory& trajectory)
{
    const Drawing drawing(trajectory);
    AtomicFolder out(folder);
    std::string list = fmt::format(head, "Collection") + "<Collection>\n";
    for (std::size_t k = 0; k < trajectory.time_s.size(); ++k) {
        const std::string file = fmt::format("{}_{:05}.vtp", name, k);
        out.write(file, drawing.at(k));
        fmt::format_to(std::back_inserter(list), "<DataSet timestep=\"{:.10g}\" part=\"0\" file=\"{}\"/>\n",
                       trajectory.time_s[k], file);
    }
    out.write(name + ".pvd", list + "</Collection>\n</VTKFile>\n");
    out.commit();
}

} // namespace

void write_vtk(const std::filesystem::path& folder, const std::string& name, const Trajectory& trajectory)
{
    check(trajectory);
    if (is_spatial(trajectory))
        write_drawn<SpatialDrawing>(folder, name, trajectory);
    else
        write_drawn<PlanarDrawing>(folder, name, trajectory);
}

} // namespace stylobate
