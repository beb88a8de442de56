/// The order in which realizations are run: each once, and any first part spread over all.

#include "ensemble/run_order.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <vector>

namespace stylobate {
namespace {

TEST(RunOrder, HasEveryIndexOnce)
{
    for (std::uint64_t total = 1; total < 400; ++total) {
        const RunOrder order(total);
        std::set<std::uint64_t> seen;
        for (std::uint64_t place = 0; place < total; ++place) {
            const std::uint64_t index = order.index(place);
            ASSERT_LT(index, total);
            ASSERT_EQ(order.place(index), place) << total;
            seen.insert(index);
        }
        ASSERT_EQ(seen.size(), total);
    }
    for (const std::uint64_t total : {std::uint64_t{65536}, std::uint64_t{30030}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
        const RunOrder order(total);
        std::mt19937_64 random(total);
        for (int i = 0; i < 1000; ++i) {
            const std::uint64_t place = random() % total;
            ASSERT_EQ(order.place(order.index(place)), place);
        }
    }
}

/// Counted cell by cell: every first part has nearly equally many realizations of each cell.
TEST(RunOrder, AFirstPartIsSpreadOverAllCells)
{
    for (const auto& [cells, per_cell] : {std::pair{256, 256}, {16, 320}, {60, 100}, {7, 1001}, {210, 11}, {1, 4096}}) {
        const auto total = static_cast<std::uint64_t>(cells * per_cell);
        const RunOrder order(total);
        std::vector<int> n(static_cast<std::size_t>(cells));
        for (std::uint64_t place = 0; place < total; ++place) {
            ++n[order.index(place) / static_cast<std::uint64_t>(per_cell)];
            const auto [least, most] = std::minmax_element(n.begin(), n.end());
            // a random order has a spread of some sqrt(places / cells); this one of some log(places)
            ASSERT_LE(*most - *least, 12) << cells << " cells, place " << place;
        }
    }
}

TEST(DoneSet, CountsWhatItHolds)
{
    std::mt19937_64 random(1);
    std::vector<std::uint64_t> places(500);
    for (std::uint64_t i = 0; i < places.size(); ++i)
        places[i] = i;
    std::shuffle(places.begin(), places.end(), random);
    const auto collapsed = [](std::uint64_t place) { return place % 3 == 0; };
    const auto invalid = [](std::uint64_t place) { return place % 7 == 1 && place % 3 != 0; };
    DoneSet done;
    std::set<std::uint64_t> reference;
    for (const std::uint64_t place : places) {
        EXPECT_FALSE(done.has(place));
        done.add(place, collapsed(place), invalid(place));
        reference.insert(place);
        std::uint64_t first = 0, first_collapsed = 0, first_invalid = 0;
        for (; reference.contains(first); ++first) {
            first_collapsed += collapsed(first);
            first_invalid += invalid(first);
        }
        EXPECT_EQ(done.first(), (DoneSet::Part{first, first_collapsed, first_invalid}));
        EXPECT_EQ(done.all().end, reference.size());
        for (std::uint64_t i = 0; i < places.size(); i += 11)
            EXPECT_EQ(done.has(i), reference.contains(i));
    }
    EXPECT_EQ(done.parts().size(), 1U);
    DoneSet read;
    EXPECT_TRUE(read.append(3, {5, 1, 1}));
    EXPECT_FALSE(read.append(5, {6, 0, 0})) << "it would be one with the first";
    EXPECT_FALSE(read.append(8, {8, 0, 0})) << "empty";
    EXPECT_FALSE(read.append(8, {9, 1, 1})) << "more than there are";
    EXPECT_TRUE(read.append(8, {9, 0, 1}));
}

} // namespace
} // namespace stylobate
