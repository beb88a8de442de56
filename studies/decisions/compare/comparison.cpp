#include "studies/decisions/compare/comparison.hpp"

#include "io/store/result_seal.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace stylobate {

const char* to_string(ChangeVerdict verdict)
{
    constexpr const char* words[] = {"better", "worse", "less", "more", "open"};
    return words[static_cast<std::size_t>(verdict)];
}

const char* to_string(CommonDraws draws)
{
    return FieldWords<CommonDraws>::words[static_cast<std::size_t>(draws)];
}

double PlaceComparison::largest() const
{
    return std::max(std::abs(lower), std::abs(upper));
}

ChangeVerdict LimitComparison::verdict(const PlaceComparison& place) const
{
    if (place.upper < 0)
        return damage ? ChangeVerdict::better : ChangeVerdict::less;
    if (place.lower > 0)
        return damage ? ChangeVerdict::worse : ChangeVerdict::more;
    return ChangeVerdict::open;
}

std::vector<std::size_t> LimitComparison::named(double rate, bool worse) const
{
    std::vector<std::size_t> found;
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
        if (cells[cell].p_adjusted <= rate && (cells[cell].difference > 0) == worse)
            found.push_back(cell);
    std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(cells[a].difference) > std::abs(cells[b].difference);
    });
    return found;
}

std::size_t Comparison::places() const
{
    return cells() > 0 ? cells() : std::max<std::size_t>(1, intensity.size());
}

std::string Comparison::place(std::size_t cell) const
{
    if (cells() > 0)
        return fmt::format("{:.3g}{}, {:.3g} m/s2", rows()[cell / pga_m_s2.size()], row_quantity().symbol,
                           pga_m_s2[cell % pga_m_s2.size()]);
    return intensity.empty()
               ? "all"
               : fmt::format("{} {:.3g} {}", short_measure(measure), intensity[cell], measure_unit(measure));
}

std::vector<CapacityRow> capacity_rows(const Comparison& comparison, const LimitComparison& limit)
{
    if (!limit.damage || comparison.adaptive_budget > 0)
        return {};
    std::vector<CapacityRow> rows;
    if (comparison.intensity.size() > 1 && !limit.by_motion.empty())
        rows.push_back({"all stripes",
                        capacity_ratio(comparison.intensity, limit.by_motion, comparison.motions, comparison.level)});
    const std::size_t n = comparison.pga_m_s2.size();
    if (n < 2)
        return rows;
    for (std::size_t f = 0; f < comparison.rows().size(); ++f) {
        std::vector<PairedCounts> counts;
        for (const PlaceComparison& place : std::span(limit.cells).subspan(f * n, n))
            counts.push_back(place.counts);
        rows.push_back({fmt::format("{:.3g}{}", comparison.rows()[f], comparison.row_quantity().symbol),
                        capacity_ratio(comparison.pga_m_s2, counts, 0, comparison.level)});
    }
    return rows;
}

std::string capacity_measure(const Comparison& comparison)
{
    return comparison.measure.empty() ? "PGA" : short_measure(comparison.measure);
}

namespace {

constexpr SealedFormat format{"stylobate-comparison", "comparison", 2, 1, "compare again"};
constexpr char variant_table[] = "variant_";   ///< and its number
constexpr char motion[] = "motion";            ///< before the names of the pairs of each motion
constexpr char motion_shape[] = "motion_both"; ///< files of version 1 are without it
constexpr char depends_prefix[] = "depends", depends_difference[] = "depends_difference";

/// The limit state over all cells, as a list of one.
constexpr auto overall = [](auto& limit) { return std::span(&limit.overall, 1); };
constexpr auto thirds = [](auto& input) -> auto&
{
    return input.found.thirds;
};

Table general_table(const Comparison& c)
{
    Table table("comparison");
    add_record(table, c);
    std::vector<std::string> names;
    for (const VariantComparison& variant : c.variants)
        names.push_back(variant.name);
    table.add("variants", names);
    return table;
}

/// Places are (limit states x cells), those over all cells (limit states), and the pairs of motions, from which the
/// change of a frequency is computed, (limit states x stripes x motions).
Table table_of(const VariantComparison& v, std::size_t number, std::size_t cells)
{
    Table table(variant_table + std::to_string(number));
    const std::size_t limits = v.limits.size();
    add_record(table, v);
    add_rows(table, v.limits);
    add_rows(table, pointers_to(v.limits, &LimitComparison::cells), "", Table::Shape{limits, cells});
    add_rows(table, pointers_to(v.limits, overall), "overall");
    if (limits > 0 && !v.limits.front().by_motion.empty())
        add_rows(table, pointers_to(v.limits, &LimitComparison::by_motion), motion,
                 Table::Shape{limits, cells, v.limits.front().by_motion.size() / cells});
    add_rows(table, v.inputs);
    add_rows(table, v.depends, depends_prefix);
    std::vector<double> between;
    for (const InputDependence& input : v.depends)
        between.insert(between.end(), input.found.between.begin(), input.found.between.end());
    table.add("depends_between", std::move(between), {v.depends.size(), 2});
    add_rows(table, pointers_to(v.depends, thirds), depends_difference, Table::Shape{v.depends.size(), 3});
    return table;
}

void read_places(const Table& table, const std::vector<PlaceComparison*>& places, const std::string& before,
                 const Table::Shape& shape)
{
    read_rows(table, places, before, shape);
    for (PlaceComparison* place : places) {
        place->base.trials = place->variant.trials = place->counts.pairs();
        place->base.count = place->counts.base();
        place->variant.count = place->counts.variant();
    }
}

VariantComparison variant_of(const Table& table, std::size_t cells)
{
    VariantComparison v;
    read_record(table, v);
    v.limits = rows_of<LimitComparison>(table, "limit_states");
    const std::size_t limits = v.limits.size();
    if (limits == 0)
        table.refuse("it has no limit state");
    table.counts("both", {limits, cells}); // as many places as there are numbers
    for (LimitComparison& limit : v.limits)
        limit.cells.resize(cells);
    read_places(table, pointers_to(v.limits, &LimitComparison::cells), "", {limits, cells});
    read_places(table, pointers_to(v.limits, overall), "overall", {limits});
    if (table.has(motion_shape)) {
        const Table::Shape shape = table.shape(motion_shape);
        if (shape.size() != 3 || shape[0] != limits || shape[1] != cells || shape[2] == 0)
            table.refuse("its pairs of motions have another shape");
        for (LimitComparison& limit : v.limits)
            limit.by_motion.resize(cells * shape[2]);
        read_rows(table, pointers_to(v.limits, &LimitComparison::by_motion), motion, shape);
    }
    v.inputs = rows_of<CommonInput>(table, "inputs");
    v.depends = rows_of<InputDependence>(table, "depends_on", depends_prefix);
    const std::size_t inputs = v.depends.size();
    const std::vector<double>& between = table.numbers("depends_between", {inputs, 2});
    for (std::size_t i = 0; i < inputs; ++i)
        v.depends[i].found.between = {between[2 * i], between[2 * i + 1]};
    read_rows(table, pointers_to(v.depends, thirds), depends_difference, Table::Shape{inputs, 3});
    return v;
}

} // namespace

std::vector<Table> tables_of(const Comparison& comparison)
{
    std::vector<Table> tables = {general_table(comparison)};
    for (std::size_t i = 0; i < comparison.variants.size(); ++i)
        tables.push_back(table_of(comparison.variants[i], i, comparison.places()));
    return tables;
}

Comparison comparison_from(const std::vector<Table>& tables, const std::string& file)
{
    const Table& general = table_named(tables, "comparison", file);
    Comparison c;
    read_record(general, c);
    if (c.rows().empty() != c.pga_m_s2.empty())
        general.refuse("one axis of its surface is missing");
    const std::size_t variants = general.texts("variants").size();
    if (variants == 0)
        general.refuse("it has no variant");
    for (std::size_t i = 0; i < variants; ++i)
        c.variants.push_back(variant_of(table_named(tables, variant_table + std::to_string(i), file), c.places()));
    return c;
}

void write_comparison(const Comparison& comparison, const std::filesystem::path& file)
{
    write_sealed_file(file, format, comparison.code_version, Table(format.kind, tables_of(comparison)));
}

Comparison read_comparison(const std::filesystem::path& file)
{
    return comparison_from(read_sealed_file(file, format).content.tables(), file.string());
}

} // namespace stylobate
