/// Figures as SVG, and the tables of results.

#include "stylobate/stylobate.hpp"
#include "tests/library/inputs.hpp"

#include "io/store/result_store.hpp"

#include <gtest/gtest.h>

#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <type_traits>
#include <variant>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

std::size_t count(const std::string& text, const std::string& pattern)
{
    const std::regex wanted(pattern);
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), wanted), std::sregex_iterator()));
}

/// Needs nothing from a page: no style, no script, no colour by name.
void expect_alone(const std::string& svg)
{
    EXPECT_TRUE(svg.starts_with("<svg ")) << svg.substr(0, 80);
    EXPECT_EQ(count(svg, "<script|<style|var\\(|class=\"(axis|grid|on-colour|empty-cell)\"|href"), 0U);
}

const std::vector<std::string> small_surface = {"study.realizations=3", "surface.frequency_hz.count=3",
                                                "surface.pga_m_s2.count=2"};

TEST(LibraryFigure, StandsAlone)
{
    const api::Figure figure{.title = "<b>",
                             .x_label = "time [s]",
                             .y_label = "</svg><script>",
                             .series = {{"drum & capital", api::SeriesKind::line, {0, 1, 2}, {0, 1, NAN}, {}, {}},
                                        {"", api::SeriesKind::points, {1}, {0.5}, {0.2}, {0.9}, "one"}}};
    const std::string svg = api::svg(figure);
    expect_alone(svg);
    EXPECT_NE(svg.find("drum &amp; capital"), std::string::npos);
    EXPECT_NE(svg.find("&lt;/svg&gt;&lt;script&gt;"), std::string::npos);
    EXPECT_EQ(count(svg, "<g data-series=\"[01]\">"), 2U);
    EXPECT_EQ(count(svg, "Z\" style=\"fill:#d55e00"), 1U) << "one point";
    EXPECT_NE(svg.find("#1f5673"), std::string::npos) << "the first colour of pages, on paper";
}

TEST(LibraryFigure, RefusesListsThatDoNotFit)
{
    api::Figure figure{.series = {{"drums", api::SeriesKind::line, {0, 1}, {0}, {}, {}}}};
    EXPECT_THROW(api::svg(figure), api::InputError);
    figure.series = {{"drums", api::SeriesKind::line, {0}, {0}, {0}, {}}};
    EXPECT_THROW(api::svg(figure), api::InputError);
}

TEST(LibraryFigure, AMapHasACellForEachOfTheSurface)
{
    const api::Study study = api::Study::from_file(inputs + "small_scale_column.toml", small_surface);
    api::Surface surface = api::run(api::Experiment(study)).surface("rocked");
    const std::string svg = api::svg(surface);
    expect_alone(svg);
    EXPECT_EQ(count(svg, "data-cell=\"[0-5]\""), 6U);
    EXPECT_NE(svg.find("probability of rocked"), std::string::npos);
    surface.probability[4] = NAN;
    EXPECT_EQ(count(api::svg(surface), "data-cell=\"4\"[^/]*fill=\"#b8b8b8\""), 1U) << "nothing is known there";
    surface.lower.pop_back();
    EXPECT_THROW(api::svg(surface), api::InputError);
}

TEST(LibraryFigure, AStructureIsWhatTheFileHas)
{
    api::Study study = api::Study::from_file(inputs + "small_scale_column.toml", small_surface);
    const api::Trajectory trajectory = api::replay(api::Experiment(study), 1);
    const fs::path file = fs::path(testing::TempDir()) / "library_figure.svg";
    api::write_svg(trajectory, 0.5, file);
    std::ifstream in(file);
    EXPECT_EQ(api::svg(trajectory, 0.5), std::string(std::istreambuf_iterator<char>(in), {}));
    study.set("study.title=\"<script> & column\"");
    const auto check = api::check(study, {.trial_seconds = 0});
    ASSERT_TRUE(check);
    check->draw(file);
    std::ifstream of_check(file);
    const std::string drawn{std::istreambuf_iterator<char>(of_check), {}};
    EXPECT_EQ(api::svg(study), drawn.substr(drawn.find('\n') + 1));
    EXPECT_EQ(api::svg(*check), api::svg(study));
    EXPECT_NE(api::svg(study).find("&lt;script&gt; &amp; column"), std::string::npos);
    expect_alone(api::svg(study));
    fs::remove(file);
}

TEST(LibraryFigure, TablesOfAResultAreThoseOfItsFile)
{
    const api::Study study =
        api::Study::from_file(inputs + "sensitivity_column.toml", {"sensitivity.samples=16", "sensitivity.inner=2"});
    const fs::path file = fs::path(testing::TempDir()) / "library_tables.h5";
    fs::remove(file);
    const api::Result written = api::run_to_file(api::Experiment(study), file);
    const api::Result kept = api::run(api::Experiment(study));
    ASSERT_EQ(written.tables().size(), 1U);
    ASSERT_EQ(kept.tables().size(), 1U);
    const Table stored = ResultReader(file).table("sensitivity");
    for (const api::Result& result : {written, kept}) {
        const api::Table& table = result.tables().front();
        EXPECT_EQ(table.name, "sensitivity");
        ASSERT_EQ(table.columns.size(), stored.columns().size());
        for (const Table::Column& want : stored.columns()) {
            const api::Column& column = table.column(want.name);
            EXPECT_EQ(fmt::format("{}", column.shape), fmt::format("{}", want.shape)) << want.name;
            std::visit( // as text, because NaN does not equal itself
                [&](const auto& values) {
                    using Values = std::remove_cvref_t<decltype(values)>;
                    EXPECT_EQ(fmt::format("{}", values), fmt::format("{}", std::get<Values>(want.values))) << want.name;
                },
                column.values);
        }
    }
    fs::remove(file);
}

} // namespace
} // namespace stylobate
