#include "io/plots/structure_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

DrawnStructure::DrawnStructure(const Study& of)
    : study(of), layout(lay_out(of.structure)), columns(of.structure.columns.size())
{
    for (std::size_t i = 0; i < layout.blocks.size(); ++i) {
        const PlacedBlock& b = block(i);
        (b.role == BlockRole::epistyle ? epistyles : columns[static_cast<std::size_t>(b.column)]).push_back(i);
        top_m = std::max(top_m, b.top());
    }
}

std::string DrawnStructure::number(double metres) const
{
    return fmt::format("{:.4g}", in_mm ? 1000 * metres : metres);
}

std::optional<std::string> words_of_bed(const BedSpec& bed)
{
    std::string words;
    const auto add = [&](const char* name, const std::optional<double>& value, const char* unit) {
        if (value)
            words += fmt::format("{}{} {:.3g}{}", words.empty() ? "" : ", ", name, *value, unit);
    };
    add("friction", bed.friction, "");
    add("K_N", bed.normal_stiffness_n_m2, " N/m2");
    add("K_T", bed.tangential_stiffness_n_m, " N/m");
    add("K_N", bed.normal_stiffness_n_m3, " N/m3");
    add("K_T", bed.tangential_stiffness_n_m3, " N/m3");
    add("restitution", bed.restitution, "");
    add("damping", bed.normal_damping_ratio, "");
    add("tangential damping", bed.tangential_damping_ratio, "");
    add("hollow: inner size", bed.inner_ratio > 0 ? std::optional(bed.inner_ratio) : std::nullopt, " of the outer");
    return words.empty() ? std::nullopt : std::optional(words);
}

std::optional<std::string> DrawnStructure::bed_words(std::size_t of) const
{
    for (const PlacedBed& bed : layout.beds)
        if (bed.upper == static_cast<int>(of))
            return words_of_bed(bed.bed);
    return std::nullopt;
}

std::string DrawnStructure::name_of(const std::vector<std::size_t>& run) const
{
    const auto alone = [&](std::size_t i) { return block(i).name.substr(0, block(i).name.find(" of column")); };
    const std::string first = alone(run.front());
    if (run.size() == 1)
        return first;
    const std::size_t blank = first.rfind(' ');
    const std::string last = alone(run.back());
    return fmt::format("{}s {} to {}", first.substr(0, blank), first.substr(blank + 1),
                       last.substr(last.rfind(' ') + 1));
}

std::string DrawnStructure::count_words() const
{
    const std::size_t blocks = layout.blocks.size();
    const auto fixed = std::ranges::count_if(layout.blocks, [](const PlacedBlock& b) { return b.fixed; });
    return fmt::format("{} block{}{}", blocks, blocks == 1 ? "" : "s",
                       fixed > 0 ? fmt::format(", {} fixed", fixed) : "");
}

std::string DrawnStructure::whole_mass() const
{
    double sum = 0;
    for (const PlacedBlock& b : layout.blocks)
        sum += b.mass_kg;
    return mass_text(sum);
}

void draw_heights(const DrawnStructure& drawn, DrawingSheet& sheet, double left, double ground, double per_metre)
{
    std::vector<std::size_t> pile = drawn.columns.front();
    for (const std::size_t e : drawn.epistyles)
        if (drawn.study.structure.epistyles[e - drawn.epistyles.front()].first_column == 0) {
            pile.push_back(e);
            break;
        }
    const auto y = [&](double metres) { return ground - metres * per_metre; };
    const double at = left - 55;
    double top = 0;
    for (const auto& run : runs_of(pile, [&](std::size_t a, std::size_t b) {
             return same(drawn.block(a).height_m, drawn.block(b).height_m) &&
                    drawn.block(a).role == drawn.block(b).role;
         })) {
        const PlacedBlock &low = drawn.block(run.front()), &high = drawn.block(run.back());
        top = high.top();
        sheet.along(at, y(low.bottom()), y(top),
                    run.size() == 1 ? drawn.length(low.height_m)
                                    : fmt::format("{} × {}", run.size(), drawn.length(low.height_m)));
        for (const std::size_t i : run)
            sheet.line(at - 4, y(drawn.block(i).top()), at + 4, y(drawn.block(i).top()), "#27475c", 1.2);
    }
    if (pile.size() > 1 || !same(top, drawn.top_m)) {
        const double outer = at - 190;
        sheet.along(outer, y(0), y(drawn.top_m), drawn.length(drawn.top_m), true);
        for (const double level : {y(0), y(drawn.top_m)})
            sheet.line(outer - 10, level, left - 12, level, "#b0b0b0", 0.8);
    }
}

} // namespace stylobate
