#include "studies/evidence/measured/boulders/mesh_stance.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

namespace stylobate::measured {

namespace {

std::string whole_file(const std::filesystem::path& file)
{
    const gzFile in = gzopen(file.c_str(), "rb");
    if (in == nullptr)
        throw InputError(file.string(), 0, "cannot be read");
    std::string text;
    std::array<char, 1 << 16> buffer;
    int got = 0;
    while ((got = gzread(in, buffer.data(), static_cast<unsigned>(buffer.size()))) > 0)
        text.append(buffer.data(), static_cast<std::size_t>(got));
    gzclose(in);
    if (got < 0)
        throw InputError(file.string(), 0, "cannot be decompressed");
    return text;
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

} // namespace

Mesh read_obj(const std::filesystem::path& file)
{
    Mesh mesh;
    std::istringstream text(whole_file(file));
    std::string line;
    for (long number = 1; std::getline(text, line); ++number) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        if (key == "v") {
            std::array<double, 3> v{};
            if (!(words >> v[0] >> v[1] >> v[2]))
                throw InputError(file.string(), number, "a vertex needs three numbers");
            mesh.vertices.push_back(v);
        } else if (key == "f") {
            std::array<std::size_t, 3> t{};
            for (std::size_t& corner : t) {
                std::string word;
                long index = 0;
                if (words >> word)
                    index = std::atol(word.c_str()); // "7", "7/1" or "7//2": the vertex comes first
                if (index < 1 || static_cast<std::size_t>(index) > mesh.vertices.size())
                    throw InputError(file.string(), number, "a face needs three of the vertices before it");
                corner = static_cast<std::size_t>(index - 1);
            }
            mesh.triangles.push_back(t);
        }
    }
    if (mesh.triangles.size() < 4)
        throw InputError(file.string(), 0, "has fewer than four faces; a closed surface is needed");
    return mesh;
}

MeshBody body_of(const Mesh& mesh)
{
    MeshBody body;
    double six_volumes = 0;
    std::array<double, 3> moment{};
    for (const auto& t : mesh.triangles) {
        const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        const double v = dot(a, cross(b, c));
        six_volumes += v;
        for (std::size_t k = 0; k < 3; ++k)
            moment[k] += v * (a[k] + b[k] + c[k]) / 4;
    }
    body.volume_m3 = std::fabs(six_volumes) / 6;
    for (std::size_t k = 0; k < 3; ++k) {
        body.centroid_m[k] = moment[k] / six_volumes;
        const auto [low, high] = std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                                     [k](const auto& p, const auto& q) { return p[k] < q[k]; });
        body.extent_m[k] = (*high)[k] - (*low)[k];
    }
    return body;
}

double Stance::effective_slenderness() const
{
    return std::tan(std::acos(1 / (1 + barrier)));
}

std::vector<Stance> stances(const Mesh& mesh, int directions)
{
    constexpr double degree = std::numbers::pi / 180;
    const std::array<double, 3> centre = body_of(mesh).centroid_m;
    std::vector<Stance> all;
    for (int d = 0; d < directions; ++d) {
        Stance s;
        s.azimuth_rad = 2 * std::numbers::pi * d / directions;
        const double ca = std::cos(s.azimuth_rad), sa = std::sin(s.azimuth_rad);
        double rest = 0, highest = 0;
        for (double lean = 0; lean <= 80 * degree; lean += 0.25 * degree) {
            // height of the centre over the lowest point, and how far that lies ahead
            double height = -1e300, ahead = 0;
            for (const auto& v : mesh.vertices) {
                const double u = (v[0] - centre[0]) * ca + (v[1] - centre[1]) * sa, z = v[2] - centre[2];
                const double below = u * std::sin(lean) - z * std::cos(lean);
                if (below > height) {
                    height = below;
                    ahead = u * std::cos(lean) + z * std::sin(lean);
                }
            }
            if (lean == 0)
                rest = highest = height;
            if (std::fabs(lean - degree) < 0.1 * degree)
                s.start_slenderness = ahead / height;
            if (height > highest) {
                highest = height;
                s.balance_rad = lean;
            }
        }
        s.barrier = highest / rest - 1;
        all.push_back(s);
    }
    return all;
}

} // namespace stylobate::measured
