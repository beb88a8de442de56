#include "io/files/atomic_file.hpp"
#include "library/inside.hpp"
#include "library/tables.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/workflow/compare.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"
#include "studies/workflow/past.hpp"
#include "studies/workflow/report.hpp"
#include "studies/workflow/risk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace stylobate::api {

struct Answer::Data {
    std::string text, json;
    Table rows;
    std::vector<Table> tables;
    std::function<void(const std::filesystem::path& file)> write;
    std::function<void(const std::filesystem::path& picture, const std::optional<std::string>& limit_state)> draw;
};

namespace {

/// Finds by name. @param what for the message
template <class List>
const auto& named(const List& list, const std::string& name, const char* what)
{
    for (const auto& each : list)
        if (each.name == name)
            return each;
    throw std::out_of_range(fmt::format("there is no {} \"{}\"", what, name));
}

std::vector<std::string> texts_of(const std::vector<std::filesystem::path>& files)
{
    if (files.empty())
        throw inner::InputError("no file is given");
    std::vector<std::string> texts;
    for (const std::filesystem::path& file : files)
        texts.push_back(file.string());
    return texts;
}

template <class Made>
Made made_of(inner::Comparison comparison)
{
    const auto held = std::make_shared<const inner::Comparison>(std::move(comparison));
    return Inside::make<Made>({inner::comparison_text(*held), inner::comparison_json(*held).text(),
                               table_of(inner::comparison_rows(*held)), tables_of(inner::tables_of(*held)),
                               [held](const auto& file) { inner::write_comparison(*held, file); },
                               [held](const auto& picture, const std::optional<std::string>& limit) {
                                   inner::check_drawing(picture);
                                   inner::comparison_picture(*held, limit, std::nullopt, picture);
                               }});
}

template <class Made>
Made made_of(inner::AnyRisk risk)
{
    const auto held = std::make_shared<const inner::AnyRisk>(std::move(risk));
    return Inside::make<Made>({inner::risk_text(*held), inner::risk_json(*held).text(),
                               table_of(inner::risk_rows(*held)), tables_of(inner::tables_of(*held)),
                               [held](const auto& file) { inner::write_risk(*held, file); },
                               [held](const auto& picture, const std::optional<std::string>& limit) {
                                   inner::check_drawing(picture);
                                   inner::plot_risk(*held, limit, std::nullopt, picture);
                               }});
}

} // namespace

const Column& Table::column(const std::string& wanted) const
{
    return named(columns, wanted, "column");
}

std::vector<double> Table::numbers(const std::string& wanted) const
{
    return std::visit(
        [&](const auto& values) -> std::vector<double> {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(values)>, std::vector<std::string>>)
                throw std::out_of_range(fmt::format("the column \"{}\" contains texts", wanted));
            else
                return {values.begin(), values.end()};
        },
        column(wanted).values);
}

const std::vector<std::string>& Table::texts(const std::string& wanted) const
{
    const auto* const texts = std::get_if<std::vector<std::string>>(&column(wanted).values);
    if (!texts)
        throw std::out_of_range(fmt::format("the column \"{}\" contains numbers", wanted));
    return *texts;
}

Answer::Answer(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

std::string Answer::text() const
{
    return data_->text;
}

std::string Answer::json() const
{
    return data_->json;
}

const Table& Answer::rows() const
{
    return data_->rows;
}

const std::vector<Table>& Answer::tables() const
{
    return data_->tables;
}

const Table& Answer::table(const std::string& name) const
{
    return named(data_->tables, name, "table");
}

void Answer::write(const std::filesystem::path& file) const
{
    if (!data_->write)
        throw InputError("a past has no file: its results have");
    translated([&] { data_->write(file); });
}

void Answer::draw(const std::filesystem::path& picture, const std::optional<std::string>& limit_state) const
{
    translated([&] { data_->draw(picture, limit_state); });
}

Comparison Comparison::from_file(const std::filesystem::path& file)
{
    return translated([&] { return made_of<Comparison>(inner::read_comparison(file)); });
}

std::optional<Comparison> compare(const std::vector<std::filesystem::path>& files, const CompareOptions& options)
{
    return translated([&]() -> std::optional<Comparison> {
        Teller teller(options);
        inner::ComparisonEnd end = inner::compare_files({.files = texts_of(files),
                                                         .settings = options.settings,
                                                         .folder = options.folder.string(),
                                                         .level = options.level,
                                                         .adaptive = options.adaptive,
                                                         .margin = options.margin},
                                                        machine_of(options), teller);
        if (!end.comparison)
            return {};
        return made_of<Comparison>(std::move(*end.comparison));
    });
}

Risk Risk::from_file(const std::filesystem::path& file)
{
    return translated([&] { return made_of<Risk>(inner::read_any_risk(file)); });
}

std::optional<Risk> risk(const std::filesystem::path& file, const std::vector<std::string>& hazard,
                         const RiskOptions& options)
{
    return translated([&]() -> std::optional<Risk> {
        Teller teller(options);
        std::optional<inner::AnyRisk> found = inner::estimate_risk({.file = file.string(),
                                                                    .hazard = hazard,
                                                                    .site = options.site,
                                                                    .settings = options.settings,
                                                                    .state = options.limit_state,
                                                                    .years = options.years,
                                                                    .level = options.level,
                                                                    .most_outside = options.most_outside,
                                                                    .sequences = options.sequences,
                                                                    .threshold = options.threshold,
                                                                    .pause_s = options.pause_s,
                                                                    .seed = options.seed},
                                                                   machine_of(options), teller);
        if (!found)
            return {};
        return made_of<Risk>(std::move(*found));
    });
}

Past past(const std::vector<std::filesystem::path>& files)
{
    return translated([&] {
        const auto held = std::make_shared<const inner::CombinedPast>(inner::past_of_files(texts_of(files)));
        std::vector<Table> tables = tables_of(inner::tables_of(*held));
        Table rows = tables.front();
        return Inside::make<Past>({inner::combined_text(*held),
                                   inner::combined_json(*held).text(),
                                   std::move(rows),
                                   std::move(tables),
                                   {},
                                   [held](const auto& picture, const auto&) { inner::draw_past(*held, picture); }});
    });
}

void Page::write(const std::filesystem::path& file) const
{
    translated([&] { inner::write_whole(file, html); });
}

std::optional<Page> report(const std::filesystem::path& file, const ReportOptions& options)
{
    return translated([&]() -> std::optional<Page> {
        Teller teller(options);
        std::optional<inner::MadePage> page = inner::make_page({.file = file.string(),
                                                                .title = options.title,
                                                                .settings = options.settings,
                                                                .animate = options.animate,
                                                                .animate_mb = options.animate_mb,
                                                                .animate_seconds = options.animate_seconds},
                                                               machine_of(options), teller);
        if (!page)
            return {};
        return Page{std::move(page->text), std::move(page->warnings)};
    });
}

} // namespace stylobate::api
