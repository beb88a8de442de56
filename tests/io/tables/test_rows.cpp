/// Structures as tables, by the lists of their fields: names, types, units and shapes by hand; what is written is read;
/// what stands for nothing is refused.

#include "ensemble/model/input_error.hpp"
#include "io/tables/rows.hpp"
#include "studies/report/json.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stylobate {
namespace {

enum class Colour { red, green };
const char* to_string(Colour colour)
{
    return colour == Colour::red ? "red" : "green";
}

struct Span {
    double value = 0, lower = 0, upper = 0, part = 0;
};
struct Leaf {
    std::string name;
    bool fallen = false;
    Colour colour = Colour::red;
};
struct Tree {
    std::uint64_t number = 0;
    std::optional<double> height_m;
    Span mass;
    bool old = false;
    std::vector<double> rings;
    std::vector<Leaf> leaves;
    std::optional<Leaf> blossom;
    int since = 0;
};

template <class F>
void visit_fields(std::type_identity<Span>, F&& f)
{
    f("value", &Span::value);
    f("lower", &Span::lower);
    f("upper", &Span::upper);
    f("part", &Span::part, {.unit = "1"});
}
template <class F>
void visit_fields(std::type_identity<Leaf>, F&& f)
{
    f("name", &Leaf::name);
    f("fallen", &Leaf::fallen);
    f("colour", &Leaf::colour);
}

/// A row: values alone.
struct Row : Tree {};
template <class F>
void visit_fields(std::type_identity<Row>, F&& f)
{
    f("number", &Row::number);
    f("height_m", &Row::height_m);
    f("mass", &Row::mass, {.unit = "t"});
    f("old", &Row::old);
    f("twice", [](const Row& row) { return 2.0 * static_cast<double>(row.number); });
}

struct Record : Tree {};
template <class F>
void visit_fields(std::type_identity<Record>, F&& f)
{
    f("number", &Record::number);
    f("old", &Record::old);
    f("mass", &Record::mass);
    f("rings", &Record::rings, {.none = "it is too young"});
}

template <class F>
void visit_fields(std::type_identity<Tree>, F&& f)
{
    f("number", &Tree::number);
    f(
        "mass_value", [](auto& t) -> auto& { return t.mass.value; });
    f("rings", &Tree::rings);
    f("leaves", &Tree::leaves);
    f("blossom", &Tree::blossom);
    f("since", &Tree::since, {.since = 2});
}

} // namespace

template <>
struct FieldWords<Colour> {
    static constexpr const char* words[] = {"red", "green"};
};

namespace {

std::string refusal(const std::function<void()>& act)
{
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::vector<Row> two_rows()
{
    std::vector<Row> rows(2);
    rows[0].number = 7;
    rows[0].height_m = 12.5;
    rows[0].mass = {3, 2, 5, 0.5};
    rows[1].number = 8;
    rows[1].old = true;
    return rows;
}

TEST(Rows, HaveAColumnForEachValue)
{
    Table table("trees", "a.h5");
    add_rows(table, two_rows());
    std::vector<std::string> names, units;
    for (const Table::Column& column : table.columns()) {
        names.push_back(column.name);
        units.push_back(column.unit);
        EXPECT_EQ(column.shape, Table::Shape{2}) << column.name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"number", "height_m", "mass", "mass_lower", "mass_upper", "mass_part",
                                               "old", "twice"}));
    EXPECT_EQ(units, (std::vector<std::string>{"", "m", "t", "t", "t", "", "", ""}));
    EXPECT_EQ(table.counts("number", {2}), (std::vector<std::uint64_t>{7, 8}));
    EXPECT_EQ(table.numbers("mass_upper", {2}), (std::vector<double>{5, 0}));
    EXPECT_EQ(table.integers("old", {2}), (std::vector<std::int32_t>{0, 1}));
    EXPECT_EQ(table.numbers("twice", {2}), (std::vector<double>{14, 16}));
    EXPECT_TRUE(std::isnan(table.numbers("height_m", {2})[1]));

    const std::vector<Row> read = rows_of<Row>(table, "number");
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].number, 7U);
    EXPECT_EQ(read[0].height_m, 12.5);
    EXPECT_EQ(read[0].mass.lower, 2);
    EXPECT_FALSE(read[1].height_m);
    EXPECT_TRUE(read[1].old);

    std::vector<Row> three(3);
    EXPECT_NE(refusal([&] { read_rows(table, pointers_to(three)); }).find("a.h5: is damaged"), std::string::npos);
}

TEST(Rows, OfSeveralListsAreOneColumn)
{
    std::vector<Tree> trees(2);
    trees[0].leaves = {{"a", true, Colour::green}};
    trees[1].leaves = {{"b", false, Colour::red}, {"c", false, Colour::red}};
    const Table table = entries_table("leaves", trees, &Tree::leaves);
    EXPECT_EQ(table.integers("row", {3}), (std::vector<std::int32_t>{0, 1, 1}));
    EXPECT_EQ(table.texts("colour"), (std::vector<std::string>{"green", "red", "red"}));
    std::vector<Tree> read(2), one(1);
    read_entries(table, read, &Tree::leaves);
    EXPECT_EQ(read[1].leaves[1].name, "c");
    EXPECT_TRUE(read[0].leaves[0].fallen);
    EXPECT_NE(refusal([&] { read_entries(table, one, &Tree::leaves); }).find("an entry of no row"), std::string::npos);
}

TEST(Rows, ARecordHasAttributesAndLists)
{
    Record record;
    record.number = 3;
    record.old = true;
    record.mass = {1, 2, 3, 4};
    Table young("tree"), aged("tree");
    add_record(young, record);
    EXPECT_TRUE(young.columns().empty());
    record.rings = {0.1, 0.2};
    add_record(aged, record);
    EXPECT_EQ(aged.count("number"), 3U);
    EXPECT_EQ(aged.count("old"), 1U);
    EXPECT_EQ(aged.number("mass_upper"), 3);
    for (const Table* table : {&young, &aged}) {
        Record read;
        read_record(*table, read);
        EXPECT_EQ(read.number, 3U);
        EXPECT_TRUE(read.old);
        EXPECT_EQ(read.mass.part, 4);
        EXPECT_EQ(read.rings, table == &aged ? record.rings : std::vector<double>{});
    }
    EXPECT_NE(refusal([] {
                  Record read;
                  read_record(Table("tree", "a.h5"), read);
              }).find("attribute 'number'"),
              std::string::npos);
}

TEST(Rows, ItemsHaveTablesBelow)
{
    std::vector<Tree> trees(2);
    trees[0].rings = {1, 2};
    trees[1].number = 9;
    trees[1].leaves = {{"a", true, Colour::green}};
    trees[1].blossom = Leaf{"b", false, Colour::red};
    trees[1].since = -4;
    Table table("trees", "a.h5");
    add_items<Tree>(table, {&trees[0], &trees[1]});
    const Table& leaves = table.table("leaves");
    EXPECT_EQ(leaves.counts("row", {1}), (std::vector<std::uint64_t>{1}));
    EXPECT_EQ(leaves.texts("fallen"), (std::vector<std::string>{"yes"}));
    EXPECT_EQ(leaves.columns()[2].words, (std::vector<std::string>{"no", "yes"}));
    EXPECT_EQ(table.table("rings").numbers("value", {2}), (std::vector<double>{1, 2}));

    const std::vector<Tree> read = items_of<Tree>(table, 2, 2);
    EXPECT_EQ(read[0].rings, trees[0].rings);
    EXPECT_EQ(read[1].leaves[0].colour, Colour::green);
    EXPECT_TRUE(read[1].leaves[0].fallen);
    EXPECT_EQ(read[1].blossom->name, "b");
    EXPECT_EQ(read[1].since, -4);
    EXPECT_EQ(items_of<Tree>(table, 2, 1)[1].since, 0) << "a file of version 1 is without it";

    EXPECT_NE(refusal([&] { items_of<Tree>(table, 1, 2); }), "");
    Table strange("leaf", "a.h5");
    strange.add("name", std::vector<std::string>{"a"});
    strange.add("fallen", std::vector<std::string>{"perhaps"});
    strange.add("colour", std::vector<std::string>{"red"});
    EXPECT_NE(refusal([&] { items_of<Leaf>(strange, 1, 2); }).find("stands for nothing"), std::string::npos);
}

TEST(Rows, AreObjectsOfJson)
{
    EXPECT_EQ(json_of(Leaf{"a", true, Colour::green}).text(), R"({"name": "a", "fallen": true, "colour": "green"})");
    EXPECT_EQ(json_of(two_rows()[1], {"height_m", {"weight", "mass"}}).text(),
              R"({"height_m": null, "weight": {"value": 0, "lower": 0, "upper": 0, "part": 0}})");
    EXPECT_EQ(json_of(std::vector<Leaf>{}).text(), "[]");
    EXPECT_EQ(json_of(std::vector<double>{0.1, NAN}).text(), "[0.1, null]");
}

} // namespace
} // namespace stylobate
