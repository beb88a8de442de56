#include "io/store/export.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "io/files/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
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

/// The slab that is drawn for the base, in its own frame.
struct Slab {
    double left = 0, right = 0, height = 0;
};

/// As wide as the structure ever lies, and a twentieth more on both sides.
Slab slab_of(const Trajectory& t)
{
    Slab slab;
    for (std::size_t k = 0; k < t.time_s.size(); ++k)
        for (std::size_t i = 0; i < t.blocks(); ++i) {
            const Rectangle block = rectangle_of(t, k, i);
            slab.left = std::min(slab.left, block.x - block.reach());
            slab.right = std::max(slab.right, block.x + block.reach());
        }
    slab.height = 0.05 * (slab.right - slab.left);
    slab.left -= slab.height;
    slab.right += slab.height;
    return slab;
}

/// The text of one time.
class Polygons {
public:
    void add(const std::array<Rectangle::Corner, 4>& corners, std::int64_t id, double rotation, double vx, double vy)
    {
        for (const auto& [x, y] : corners)
            fmt::format_to(std::back_inserter(points_), "{:.10g} {:.10g} 0\n", x, y);
        fmt::format_to(std::back_inserter(ids_), "{} ", id);
        fmt::format_to(std::back_inserter(rotations_), "{:.10g} ", rotation);
        fmt::format_to(std::back_inserter(velocities_), "{:.10g} {:.10g} 0\n", vx, vy);
        ++count_;
    }

    std::string text() const
    {
        const auto array = [](const char* type, const char* name, int components, const std::string& values) {
            return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n"
                               "</DataArray>\n",
                               type, name, components, values);
        };
        std::string connectivity, offsets;
        for (std::size_t i = 0; i < count_; ++i) {
            fmt::format_to(std::back_inserter(connectivity), "{} {} {} {}\n", 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3);
            fmt::format_to(std::back_inserter(offsets), "{} ", 4 * i + 4);
        }
        return fmt::format(head, "PolyData") +
               fmt::format("<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                           "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n<Points>\n",
                           4 * count_, count_) +
               array("Float64", "Points", 3, points_) + "</Points>\n<Polys>\n" +
               array("Int64", "connectivity", 1, connectivity) + array("Int64", "offsets", 1, offsets) +
               "</Polys>\n<CellData Scalars=\"block_id\" Vectors=\"velocity\">\n" +
               array("Int64", "block_id", 1, ids_) + array("Float64", "rotation", 1, rotations_) +
               array("Float64", "velocity", 3, velocities_) + "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    }

private:
    std::string points_, ids_, rotations_, velocities_;
    std::size_t count_ = 0;
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

std::string polygons_at(const Trajectory& t, std::size_t k, const Slab& slab)
{
    Polygons polygons;
    const std::size_t n = t.blocks();
    const Difference rate(t.time_s, k);
    const double base = t["base_x_m"][k], base_velocity = rate.of(t["base_x_m"], 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        Rectangle block = rectangle_of(t, k, i);
        block.x = base + block.x;
        polygons.add(block.corners(), static_cast<std::int64_t>(i), block.turned_rad,
                     base_velocity + rate.of(t["x_m"], n, i), rate.of(t["y_m"], n, i));
    }
    const double left = base + slab.left, right = base + slab.right;
    polygons.add({{{left, -slab.height}, {right, -slab.height}, {right, 0}, {left, 0}}}, -1, 0, base_velocity, 0);
    return polygons.text();
}

} // namespace

void write_vtk(const std::filesystem::path& folder, const std::string& name, const Trajectory& trajectory)
{
    check(trajectory);
    const Slab slab = slab_of(trajectory);
    AtomicFolder out(folder);
    std::string list = fmt::format(head, "Collection") + "<Collection>\n";
    for (std::size_t k = 0; k < trajectory.time_s.size(); ++k) {
        const std::string file = fmt::format("{}_{:05}.vtp", name, k);
        out.write(file, polygons_at(trajectory, k, slab));
        fmt::format_to(std::back_inserter(list), "<DataSet timestep=\"{:.10g}\" part=\"0\" file=\"{}\"/>\n",
                       trajectory.time_s[k], file);
    }
    out.write(name + ".pvd", list + "</Collection>\n</VTKFile>\n");
    out.commit();
}

} // namespace stylobate
