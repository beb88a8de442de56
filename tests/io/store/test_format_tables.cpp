/// The tables of io/FORMAT.md that are made from lists of fields. STYLOBATE_UPDATE_TABLES=1 writes them anew.

#include "io/store/result_layout.hpp"
#include "io/store/result_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>

namespace stylobate {

namespace {

/// The text between two lines of FORMAT.md is this one.
void expect_table(const std::string& name, const std::string& want)
{
    const std::string path = STYLOBATE_SOURCE_DIR "/io/FORMAT.md";
    std::ifstream in(path);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string before = fmt::format("<!-- made from the list of fields: {} -->\n\n", name);
    const std::string after = "\n<!-- end -->\n";
    const auto begin = text.find(before);
    ASSERT_NE(begin, std::string::npos) << "io/FORMAT.md lacks the line '" << before << "'";
    const auto from = begin + before.size(), to = text.find(after, from);
    ASSERT_NE(to, std::string::npos) << "the table of " << name << " has no end";
    if (std::getenv("STYLOBATE_UPDATE_TABLES") != nullptr) {
        text.replace(from, to - from, want);
        std::ofstream(path) << text;
    } else {
        EXPECT_EQ(text.substr(from, to - from), want) << "STYLOBATE_UPDATE_TABLES=1 writes the table anew";
    }
}

template <class T>
std::string type_in_file()
{
    if constexpr (std::is_enum_v<T>)
        return "enumeration of uint8";
    else if constexpr (std::is_same_v<T, double>)
        return "float64";
    else
        return std::is_same_v<T, std::uint64_t> ? "uint64" : "int32";
}

std::string in_cell(std::string_view unit)
{
    return unit.empty() ? "" : ' ' + std::string(unit);
}

std::string meaning(const FieldFacts& facts)
{
    std::string text = facts.says;
    if (facts.none)
        text += "; " + std::string(*facts.none);
    if (facts.more)
        text += ". " + std::string(*facts.more);
    return text;
}

constexpr char head[] = "| data set | type | shape | unit | meaning |\n|---|---|---|---|---|\n";

std::string line(const char* name, const std::string& type, const char* shape, const FieldFacts& facts)
{
    const std::string alone = facts.models == Models::plane ? ". In the plane alone." : "";
    std::string text = meaning(facts);
    if (!alone.empty())
        text += text.ends_with('.') ? alone.substr(1) : alone;
    return fmt::format("| `{}` | {} | {} |{} | {} |\n", name, type, shape, in_cell(unit_of(name)), text);
}

/// The numbers that have one of these models, in their order.
std::string numbers_of(std::initializer_list<Models> models)
{
    std::string table;
    visit_fields(std::type_identity<Outcome>(), [&](const char* name, auto field, const FieldFacts& facts) {
        if (std::ranges::find(models, facts.models) != models.end())
            table += line(name, type_in_file<std::remove_cvref_t<decltype(Outcome().*field)>>(), "n", facts);
    });
    return table;
}

TEST(FormatTables, OfOutcomesAreMadeFromTheirList)
{
    std::string table = head + numbers_of({Models::all, Models::plane});
    visit_lists(std::type_identity<Outcome>(),
                [&](const char* name, auto, std::string_view of, const FieldFacts& facts) {
                    table += line(name, "float64", of == "bed" ? "n x joints" : "n x nb", facts);
                });
    expect_table("outcomes", table);
    expect_table("outcomes in space", head + numbers_of({Models::space}));
}

TEST(FormatTables, OfTrajectoriesAreMadeFromTheirList)
{
    for (const int dimensions : {2, 3}) {
        std::string table = head;
        const Trajectory of_model(trajectory_channels(dimensions));
        visit_lists(of_model, [&](const TrajectoryChannel& channel, const auto&) {
            const char* shape = channel.of == ListOf::times ? "nt" : channel.of == ListOf::blocks ? "nb" : "nt x nb";
            table += fmt::format("| `{}` | float64 | {} |{} | {} |\n", channel.name, shape,
                                 in_cell(unit_of(channel.name)), channel.meaning);
        });
        table += "| `role` | enumeration of uint8 | nb | | drum = 0, epistyle = 1, ground = 2 |\n"
                 "| `column` | int32 | nb | | for a drum: its column, from the left, from 0; -1 for all others |\n";
        expect_table(dimensions == 3 ? "trajectories in space" : "trajectories", table);
    }
}

} // namespace

} // namespace stylobate
