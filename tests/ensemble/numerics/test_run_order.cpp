/// The order in which realizations are run: each once, and any first part spread over all.

#include "ensemble/numerics/run_order.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <optional>
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
    for (const std::uint64_t total :
         {std::uint64_t{65536}, std::uint64_t{30030}, std::uint64_t{1} << 40, ~std::uint64_t{0} / 2}) {
        const RunOrder order(total);
        std::mt19937_64 random(total);
        for (int i = 0; i < 1000; ++i) {
            const std::uint64_t place = random() % total;
            ASSERT_EQ(order.place(order.index(place)), place);
        }
    }
}

/// Counted cell by cell: what is run first has nearly equally many realizations of each cell, and of each PGA, which
/// comes again and again with the frequencies.
TEST(RunOrder, WhatIsRunFirstIsSpreadOverAllCells)
{
    struct Surface {
        int frequencies, pgas, per_cell;
    };
    for (const Surface& s : {Surface{16, 16, 256},
                             {16, 16, 16},
                             {4, 4, 320},
                             {4, 15, 100},
                             {7, 1, 1001},
                             {14, 15, 11},
                             {61, 1, 61},
                             {67, 61, 4},
                             {1, 1, 4096},
                             {3, 3, 7}}) {
        const auto total = static_cast<std::uint64_t>(s.frequencies * s.pgas * s.per_cell);
        const RunOrder order(total);
        std::vector<double> cells(static_cast<std::size_t>(s.frequencies * s.pgas)),
            pgas(static_cast<std::size_t>(s.pgas));
        int samples = 0;
        for (std::uint64_t place = 0; place < total; ++place) {
            const std::size_t cell = order.index(place) / static_cast<std::uint64_t>(s.per_cell);
            ++cells[cell];
            ++pgas[cell % pgas.size()];
            ASSERT_EQ(order.block_begin(place) <= place && place < order.block_end(place), true);
            if (order.fair(place + 1) != place + 1)
                continue;
            ++samples;
            const auto spread = [](const std::vector<double>& n) {
                const auto [least, most] = std::minmax_element(n.begin(), n.end());
                return *most - *least;
            };
            // a random order has a spread of some 5 sqrt(places / cells); this one does not grow
            ASSERT_LE(spread(cells), 5.0)
                << s.frequencies << " x " << s.pgas << " x " << s.per_cell << ", place " << place;
            ASSERT_LE(spread(pgas), 25.0)
                << s.frequencies << " x " << s.pgas << " x " << s.per_cell << ", place " << place;
        }
        EXPECT_GE(samples, 61);
        EXPECT_EQ(order.fair(total), total);
        EXPECT_EQ(order.fair(0), 0U);
    }
}

/// Lanes that step alike realizations take the same branches: within a block indices only grow.
TEST(RunOrder, NeighboursStayNeighbours)
{
    const RunOrder order(65536);
    std::uint64_t blocks = 0;
    for (std::uint64_t begin = 0; begin < 65536; begin = order.block_end(begin), ++blocks)
        for (std::uint64_t place = begin + 1; place < order.block_end(begin); ++place)
            ASSERT_EQ(order.index(place) - order.index(place - 1), order.index(1) - order.index(0));
    EXPECT_GE(blocks, 61U);
    EXPECT_LE(blocks, 80U);
}

TEST(DoneSet, CountsWhatItHolds)
{
    const RunOrder order(500);
    std::mt19937_64 random(1);
    std::vector<std::uint64_t> places(500);
    for (std::uint64_t i = 0; i < places.size(); ++i)
        places[i] = i;
    std::shuffle(places.begin(), places.end(), random);
    const auto collapsed = [](std::uint64_t place) { return place % 3 == 0; };
    const auto invalid = [](std::uint64_t place) { return place % 7 == 1 && place % 3 != 0; };
    DoneSet done(order);
    std::set<std::uint64_t> reference;
    const auto counts_of = [&](std::uint64_t begin, std::uint64_t end) {
        DoneSet::Part part{end, 0, 0};
        for (std::uint64_t place = begin; place < end; ++place) {
            part.collapsed += collapsed(place);
            part.invalid += invalid(place);
        }
        return part;
    };
    for (const std::uint64_t place : places) {
        EXPECT_FALSE(done.has(place));
        done.add(place, collapsed(place), invalid(place));
        reference.insert(place);
        std::uint64_t first = 0;
        while (reference.contains(first))
            ++first;
        EXPECT_EQ(done.sample(), counts_of(0, order.fair(first)));
        EXPECT_EQ(done.all().end, reference.size());
        for (const auto& [begin, part] : done.parts())
            EXPECT_EQ(part, counts_of(begin, part.end));
        for (std::uint64_t i = 0; i < places.size(); i += 11)
            EXPECT_EQ(done.has(i), reference.contains(i));
        DoneSet read(order); // as a file gives it
        for (const auto& [begin, part] : done.parts())
            EXPECT_TRUE(read.append(begin, part));
        EXPECT_EQ(read.parts(), done.parts());
    }
    EXPECT_EQ(done.parts().size(), 1U);
}

TEST(DoneSet, JoinsParts)
{
    const RunOrder order(3000);
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<std::uint64_t> places(3000);
        std::iota(places.begin(), places.end(), 0);
        if (trial % 2 == 0)
            std::shuffle(places.begin(), places.end(), random);
        DoneSet parts[3] = {DoneSet(order), DoneSet(order), DoneSet(order)}, all(order), joined(order);
        for (std::size_t k = 0; k < places.size(); ++k) {
            if (k % 17 == 0 && trial % 4 < 2)
                continue; // done by no process
            const bool collapsed = places[k] % 3 == 0, invalid = places[k] % 5 == 1 && !collapsed;
            parts[trial % 2 == 0 ? k % 3 : k / 1000].add(places[k], collapsed, invalid);
            all.add(places[k], collapsed, invalid);
        }
        for (const DoneSet& part : parts) {
            EXPECT_FALSE(joined.common(part));
            joined.add(part);
            const std::optional<std::uint64_t> twice = joined.common(part);
            ASSERT_TRUE(twice);
            EXPECT_TRUE(joined.has(*twice) && part.has(*twice));
        }
        EXPECT_EQ(joined.parts(), all.parts());
    }
}

TEST(RunOrder, ShardsAreAllPlacesOnce)
{
    for (const std::uint64_t total : {1, 7, 60, 244, 1000, 65536, 1000003})
        for (const std::uint64_t of : {1, 2, 3, 4, 37, 1000}) {
            const RunOrder order(total);
            std::uint64_t next = 0, least = total, most = 0;
            for (Shard shard{1, of}; shard.number <= of; ++shard.number) {
                const RunOrder::Places places = order.places(shard);
                EXPECT_EQ(places.begin, next);
                next = places.end;
                least = std::min(least, places.size());
                most = std::max(most, places.size());
            }
            EXPECT_EQ(next, total);
            EXPECT_LE(most, least + std::max<std::uint64_t>(1, total / of / 8)) << total << " of " << of;
        }
    // of many blocks a shard has whole ones, and so is a fair sample
    const RunOrder order(65536);
    const RunOrder::Places third = order.places({3, 4});
    EXPECT_EQ(order.block_begin(third.begin), third.begin);
    DoneSet done(order);
    for (std::uint64_t place = third.begin; place < third.end; ++place)
        done.add(place, place % 2 == 0, false);
    EXPECT_EQ(done.sample(third.begin).done(third.begin), third.size());
    EXPECT_EQ(done.sample().end, 0U);
    EXPECT_EQ(done.sample(third.begin + 1).end, 0U) << "no block begins there";
}

TEST(Shard, ReadsItsText)
{
    EXPECT_EQ(Shard::from_text("3/8"), (Shard{3, 8}));
    EXPECT_EQ(Shard::from_text("1/1"), Shard{});
    for (const char* text : {"", "3", "3/", "/8", "0/8", "9/8", "3/8/2", "3/8 ", " 3/8", "-1/8", "3/0", "1/1000001",
                             "99999999999999999999/8", "1.5/8"})
        EXPECT_FALSE(Shard::from_text(text)) << text;
}

TEST(DoneSet, RefusesWhatItIsNot)
{
    const RunOrder order(500); // blocks of 8 or 9
    const std::uint64_t block = order.block_end(0);
    DoneSet read(order);
    EXPECT_TRUE(read.append(1, {3, 1, 1}));
    EXPECT_FALSE(read.append(3, {5, 0, 0})) << "it would be one with the first";
    EXPECT_FALSE(read.append(2, {5, 0, 0})) << "it begins within the first";
    EXPECT_FALSE(DoneSet(order).append(6, {6, 0, 0})) << "empty";
    EXPECT_FALSE(DoneSet(order).append(6, {7, 1, 1})) << "more than there are";
    DoneSet blocks(order);
    EXPECT_TRUE(blocks.append(0, {block, 0, 1}));
    EXPECT_TRUE(blocks.append(block, {block + 2, 0, 1})) << "of a block that is not whole";
    DoneSet whole(order);
    EXPECT_TRUE(whole.append(0, {block, 0, 1}));
    EXPECT_FALSE(whole.append(block, {order.block_end(block), 0, 1})) << "whole blocks are one part";
}

} // namespace
} // namespace stylobate
