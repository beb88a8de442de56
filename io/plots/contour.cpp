#include "io/plots/contour.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <map>

namespace stylobate {
namespace {

/// The edge of the grid that a line crosses: twice the index of its lower left node, plus 1 if it runs along y.
using Edge = std::size_t;

class Grid {
public:
    Grid(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z, double level)
        : x_(x), y_(y), z_(z), level_(level)
    {
        for (std::size_t i = 0; i + 1 < x.size(); ++i)
            for (std::size_t j = 0; j + 1 < y.size(); ++j)
                add_square(i, j);
    }

    /// Strings the segments together: open lines from their ends first, what is left are rings.
    std::vector<ContourLine> lines()
    {
        std::vector<ContourLine> found;
        std::vector<Edge> starts;
        for (const auto& [edge, next] : neighbours_)
            if (next.size() == 1)
                starts.push_back(edge);
        for (const auto& [edge, next] : neighbours_)
            if (next.size() == 2)
                starts.push_back(edge);
        for (const Edge start : starts)
            if (!neighbours_[start].empty())
                found.push_back(follow(start));
        return found;
    }

private:
    double value(std::size_t i, std::size_t j) const { return z_[i * y_.size() + j]; }

    void add_square(std::size_t i, std::size_t j)
    {
        // Corners and edges counter-clockwise from the lower left; edge k runs from corner k to the next one.
        const std::array<double, 4> corner{value(i, j), value(i + 1, j), value(i + 1, j + 1), value(i, j + 1)};
        if (!std::all_of(corner.begin(), corner.end(), [](double v) { return std::isfinite(v); }))
            return;
        const std::size_t node = i * y_.size() + j;
        const std::array<Edge, 4> edge{2 * node, 2 * (node + y_.size()) + 1, 2 * (node + 1), 2 * node + 1};
        std::array<Edge, 4> crossed{};
        std::size_t count = 0;
        for (std::size_t k = 0; k < 4; ++k)
            if ((corner[k] >= level_) != (corner[(k + 1) % 4] >= level_))
                crossed[count++] = edge[k];
        if (count == 2) {
            join(crossed[0], crossed[1]);
        } else if (count == 4) {
            // The lines cut off the two corners that differ from the middle: 0 and 2, or 1 and 3.
            const bool middle = (corner[0] + corner[1] + corner[2] + corner[3]) / 4 >= level_;
            const bool cut_first = (corner[0] >= level_) != middle;
            join(edge[cut_first ? 3 : 0], edge[cut_first ? 0 : 1]);
            join(edge[cut_first ? 1 : 2], edge[cut_first ? 2 : 3]);
        }
    }

    void join(Edge a, Edge b)
    {
        neighbours_[a].push_back(b);
        neighbours_[b].push_back(a);
    }

    /// Walks from edge to edge, and takes the segments away that it has passed.
    ContourLine follow(Edge edge)
    {
        ContourLine line{point(edge)};
        while (!neighbours_[edge].empty()) {
            const Edge next = neighbours_[edge].back();
            neighbours_[edge].pop_back();
            std::vector<Edge>& back = neighbours_[next];
            back.erase(std::find(back.begin(), back.end(), edge));
            line.push_back(point(next));
            edge = next;
        }
        return line;
    }

    ContourPoint point(Edge edge) const
    {
        const std::size_t i = edge / 2 / y_.size();
        const std::size_t j = edge / 2 % y_.size();
        const bool along_y = edge % 2 == 1;
        const double from = value(i, j);
        const double to = along_y ? value(i, j + 1) : value(i + 1, j);
        const double t = (level_ - from) / (to - from);
        return along_y ? ContourPoint{x_[i], y_[j] + t * (y_[j + 1] - y_[j])}
                       : ContourPoint{x_[i] + t * (x_[i + 1] - x_[i]), y_[j]};
    }

    const std::vector<double>& x_;
    const std::vector<double>& y_;
    const std::vector<double>& z_;
    double level_;
    std::map<Edge, std::vector<Edge>> neighbours_; ///< segments, from both of their ends
};

} // namespace

std::vector<ContourLine> contour_lines(const std::vector<double>& x, const std::vector<double>& y,
                                       const std::vector<double>& z, double level)
{
    assert(z.size() == x.size() * y.size() && "one value for each node of the grid");
    return Grid(x, y, z, level).lines();
}

} // namespace stylobate
