/// Memory of a bundle by lists of fields: where numbers lie, by hand.

#include "kernels/row_list.hpp"

#include <gtest/gtest.h>

namespace stylobate {

namespace {

struct OfStone {
    enum Field : int { place, turn, count };
};
struct OfWedge {
    enum Field : int { angle, count };
};
struct OfAll {
    enum Field : int { energy, count };
};
struct OfShaking {
    enum Field : int { second, third, fourth, count };
};
struct Heap {
    int stones = 0;
    bool wedges = false;
    constexpr int rows(RowOf of) const { return of == RowOf::block ? stones : of == RowOf::step ? 2 : 1; }
};
struct WithWedges {
    template <class Number>
    static constexpr bool in(const Heap& heap)
    {
        return heap.wedges;
    }
};
using Rows = RowList<double, FieldList<OfStone, RowOf::block>, FieldList<OfWedge, RowOf::block, WithWedges>,
                     FieldList<OfAll, RowOf::realization>, FieldList<OfShaking, RowOf::step>>;

constexpr auto any_rows = [](RowOf) { return true; };

} // namespace

TEST(RowList, KnowsItsListsByTheirFields)
{
    EXPECT_EQ(Rows::list<OfStone::Field>, 0);
    EXPECT_EQ(Rows::list<OfWedge::Field>, 1);
    EXPECT_EQ(Rows::list<OfShaking::Field>, 3);
    EXPECT_EQ(Rows::fields<OfStone::Field>, 2);
    EXPECT_EQ(Rows::fields<OfAll::Field>, 1);
}

TEST(RowList, CountsTheListsThatABundleHas)
{
    EXPECT_EQ(Rows::registers(Heap{5, false}, any_rows), 5U * 2 + 1 + 2 * 3);
    EXPECT_EQ(Rows::registers(Heap{5, true}, any_rows), 5U * 2 + 5 + 1 + 2 * 3);
    EXPECT_EQ(Rows::registers(Heap{5, true}, [](RowOf row) { return row == RowOf::step; }), 2U * 3);
}

TEST(RowList, LaysListsOutOneBehindTheOther)
{
    const Heap heap{3, true};
    double memory[4 * (3 * 2 + 3 + 1 + 2 * 3)] = {};
    Rows rows;
    rows.lanes = 4;
    rows.bind(heap, memory, any_rows);
    EXPECT_EQ(&rows.at(OfStone::turn, 2, 1), memory + (2 * 2 + 1) * 4 + 1);
    EXPECT_EQ(&rows.at(OfWedge::angle, 1, 3), memory + (6 + 1) * 4 + 3);
    EXPECT_EQ(&rows.at(OfAll::energy, 2), memory + (6 + 3) * 4 + 2);
    EXPECT_EQ(&rows.at(OfShaking::fourth, 1, 0), memory + (6 + 3 + 1 + 3 + 2) * 4);
    rows.move_to_lane(2);
    EXPECT_EQ(&rows.at(OfAll::energy, 0), memory + (6 + 3) * 4 + 2);
}

TEST(RowList, WhatABundleDoesNotHaveIsNowhere)
{
    double memory[2 * (1 * 2 + 1 + 2 * 3)] = {};
    Rows rows;
    rows.lanes = 2;
    rows.bind(Heap{1, false}, memory, any_rows);
    EXPECT_EQ(rows.rows<OfWedge::Field>(), nullptr);
    EXPECT_EQ(rows.rows<OfAll::Field>(), memory + 2 * 2);
    rows.move_to_lane(1);
    EXPECT_EQ(rows.rows<OfWedge::Field>(), nullptr);
}

} // namespace stylobate
