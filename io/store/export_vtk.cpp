#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/spatial/spatial_poses.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
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

/// Half sizes of a face along x and z [m].
struct HalfSizes {
    double x = 0, z = 0;
};

/// Sides of the prism that is drawn for a drum: its corners lie on the circles of the faces.
constexpr int drum_sides = 24;

/// Corners of a level face, counter-clockwise as seen from above.
std::vector<Point> ring(const HalfSizes& half, double y, bool round)
{
    if (!round)
        return {{half.x, y, half.z}, {half.x, y, -half.z}, {-half.x, y, -half.z}, {-half.x, y, half.z}};
    std::vector<Point> points;
    for (int i = 0; i < drum_sides; ++i) {
        const double a = 2 * std::numbers::pi * i / drum_sides;
        points.push_back({half.x * std::cos(a), y, -half.z * std::sin(a)});
    }
    return points;
}

/// The faces of a body, each counter-clockwise as seen from outside.
void add_solid(Polygons& to, const std::vector<Point>& bottom, const std::vector<Point>& top, const OfBody& of)
{
    to.add(std::vector<Point>(bottom.rbegin(), bottom.rend()), of);
    to.add(top, of);
    for (std::size_t i = 0; i < bottom.size(); ++i) {
        const std::size_t next = (i + 1) % bottom.size();
        to.add(std::array{bottom[i], bottom[next], top[next], top[i]}, of);
    }
}

/// A turn from upright. The samples of a trajectory lie between two steps, so that its numbers are not quite of
/// length 1.
class Attitude {
public:
    explicit Attitude(const std::array<double, 4>& q) : q_(q)
    {
        const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
        for (double& part : q_)
            part /= length;
    }

    Point turned(const Point& p) const
    {
        const auto [w, x, y, z] = q_;
        // p + 2 v x (v x p + w p), v the vector of the quaternion
        const Point a = {y * p[2] - z * p[1] + w * p[0], z * p[0] - x * p[2] + w * p[1],
                         x * p[1] - y * p[0] + w * p[2]};
        return {p[0] + 2 * (y * a[2] - z * a[1]), p[1] + 2 * (z * a[0] - x * a[2]), p[2] + 2 * (x * a[1] - y * a[0])};
    }
    double angle_rad() const { return 2 * std::atan2(std::hypot(q_[1], q_[2], q_[3]), std::fabs(q_[0])); }
    /// Of the axis from the vertical.
    double tilt_rad() const { return 2 * std::atan2(std::hypot(q_[1], q_[3]), std::hypot(q_[0], q_[2])); }

private:
    std::array<double, 4> q_; ///< w, x, y, z
};

class SpatialDrawing {
public:
    /// The slab of the base is as large as the structure ever lies, and a twentieth of its length more on all sides.
    explicit SpatialDrawing(const Trajectory& t) : t_(t)
    {
        for (std::size_t i = 0; i < t.blocks(); ++i) {
            const bool is_round = t["round"][i] != 0;
            const HalfSizes bottom = {t["bottom_half_x_m"][i], t["bottom_half_z_m"][i]};
            const HalfSizes top = {t["top_half_x_m"][i], t["top_half_z_m"][i]};
            const double half_height = t["half_height_m"][i];
            bottom_.push_back(ring(bottom, -half_height, is_round));
            top_.push_back(ring(top, half_height, is_round));
            const double reach = std::hypot(half_height, std::max(bottom.x, top.x), std::max(bottom.z, top.z));
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
            const auto pose = [&](const char* channel) { return t_[channel][k * n + i]; };
            const Attitude attitude({pose("q_w"), pose("q_x"), pose("q_y"), pose("q_z")});
            const Point middle = sum(base, {pose("x_m"), pose("y_m"), pose("z_m")});
            const auto placed = [&](std::vector<Point> points) {
                for (Point& point : points)
                    point = sum(middle, attitude.turned(point));
                return points;
            };
            const Point velocity =
                sum(base_velocity, {rate.of(t_["x_m"], n, i), rate.of(t_["y_m"], n, i), rate.of(t_["z_m"], n, i)});
            add_solid(polygons, placed(bottom_[i]), placed(top_[i]),
                      {static_cast<std::int64_t>(i), attitude.angle_rad(), attitude.tilt_rad(), velocity});
        }
        const HalfSizes half = {(to_.x - from_.x) / 2, (to_.z - from_.z) / 2};
        const Point middle = sum(base, {(from_.x + to_.x) / 2, 0, (from_.z + to_.z) / 2});
        std::vector<Point> bottom = ring(half, -height_, false), top = ring(half, 0, false);
        for (std::vector<Point>* face : {&bottom, &top})
            for (Point& point : *face)
                point = sum(middle, point);
        add_solid(polygons, bottom, top, {.velocity = base_velocity});
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
    std::vector<std::vector<Point>> bottom_, top_; ///< (blocks) corners of the upright body about its middle
    HalfSizes from_, to_;                          ///< ends of the slab, in its own frame
    double height_ = 0;                            ///< of the slab
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
