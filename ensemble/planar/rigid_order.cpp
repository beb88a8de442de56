#include "ensemble/planar/rigid_order.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace stylobate {

namespace {

struct Edge {
    int block = -1, of_first = 0, of_second = 0; ///< roles in the bed of the smaller and of the larger number
};

using Pair = std::pair<int, int>;

Pair pair_of(int a, int b)
{
    return {std::min(a, b), std::max(a, b)};
}

std::map<Pair, Edge> shared_blocks(const Topology& topology)
{
    std::map<Pair, Edge> edges;
    for (int a = 0; a < topology.beds(); ++a)
        for (int b = a + 1; b < topology.beds(); ++b)
            for (const bool upper_of_a : {true, false})
                for (const bool upper_of_b : {true, false}) {
                    const int block = upper_of_a ? topology.joint[a].upper : topology.joint[a].lower;
                    const int other = upper_of_b ? topology.joint[b].upper : topology.joint[b].lower;
                    if (block == other && block >= topology.fixed)
                        edges[{a, b}] = {block, upper_of_a ? 1 : -1, upper_of_b ? 1 : -1};
                }
    return edges;
}

} // namespace

RigidOrder rigid_order(const Topology& topology)
{
    std::map<Pair, Edge> edges = shared_blocks(topology);
    std::vector<std::set<int>> related(static_cast<std::size_t>(topology.beds()));
    for (const auto& [beds, edge] : edges) {
        related[static_cast<std::size_t>(beds.first)].insert(beds.second);
        related[static_cast<std::size_t>(beds.second)].insert(beds.first);
    }
    const std::vector<std::set<int>>& now = related;
    const auto degree = [&](int bed) { return now[static_cast<std::size_t>(bed)].size(); };

    std::vector<int> order, place(related.size(), -1);
    std::vector<std::vector<int>> later;
    bool from_above = true;
    while (order.size() < related.size()) {
        int pivot = -1;
        for (int bed = 0; bed < topology.beds(); ++bed)
            if (place[static_cast<std::size_t>(bed)] < 0 &&
                (pivot < 0 || degree(bed) < degree(pivot) || (from_above && degree(bed) == degree(pivot))))
                pivot = bed;
        from_above = !from_above;

        const auto p = static_cast<std::size_t>(pivot);
        place[p] = static_cast<int>(order.size());
        order.push_back(pivot);
        later.emplace_back(related[p].begin(), related[p].end());
        for (const int a : later.back()) {
            related[static_cast<std::size_t>(a)].erase(pivot);
            for (const int b : later.back())
                if (a != b) {
                    related[static_cast<std::size_t>(a)].insert(b);
                    edges.try_emplace(pair_of(a, b));
                }
        }
    }

    RigidOrder out;
    std::map<Pair, int> number;
    for (const auto& [beds, edge] : edges) {
        const bool swapped = place[static_cast<std::size_t>(beds.first)] > place[static_cast<std::size_t>(beds.second)];
        number[beds] = out.edges++;
        const std::initializer_list<int> entry = {
            swapped ? beds.second : beds.first, swapped ? beds.first : beds.second, edge.block,
            swapped ? edge.of_second : edge.of_first, swapped ? edge.of_first : edge.of_second};
        out.list.insert(out.list.end(), entry);
    }
    std::vector<int> begins;
    for (std::size_t k = 0; k < order.size(); ++k) {
        begins.push_back(static_cast<int>(out.list.size()));
        out.list.push_back(order[k]);
        out.list.push_back(static_cast<int>(later[k].size()));
        for (const int bed : later[k]) {
            out.list.push_back(bed);
            out.list.push_back(number.at(pair_of(order[k], bed)));
        }
        for (const int row : later[k])
            for (const int column : later[k]) {
                const bool earlier = place[static_cast<std::size_t>(row)] < place[static_cast<std::size_t>(column)];
                out.list.push_back(row == column ? -1 : 2 * number.at(pair_of(row, column)) + (earlier ? 0 : 1));
            }
    }
    out.list.insert(out.list.end(), begins.rbegin(), begins.rend());
    return out;
}

} // namespace stylobate
