#include "io/study/study_structure.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/study/study_names.hpp"
#include "io/study/study_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

constexpr std::uint64_t most_blocks = 200; ///< in all: every two of them may meet
constexpr std::uint64_t most_columns = 50;

/// A key of one of several tables: of a drum, or of all drums; of a column, or of all columns.
struct Key {
    const KeyReader* keys;
    std::string name;
    bool given() const { return keys->has(name); }
};

/// The first of the keys that is given; the first one where none is.
const Key& first_given(const std::vector<Key>& keys)
{
    const auto at = std::find_if(keys.begin(), keys.end(), [](const Key& key) { return key.given(); });
    return at == keys.end() ? keys.front() : *at;
}

const Key& need(const std::vector<Key>& keys, const Range& range)
{
    const Key& key = first_given(keys);
    if (!key.given() && keys.size() > 1)
        key.keys->missing(key.name, fmt::format("Give a number in {}, or {} for all. {}", range.text(),
                                                keys.back().name, range.hint));
    return key;
}

double number(const std::vector<Key>& keys, const Range& range)
{
    const Key& key = need(keys, range);
    return key.keys->number(key.name, range);
}

/// Where a mass may stand: itself, or as a density.
struct MassKeys {
    const KeyReader* keys;
    std::string mass; ///< empty: only the density
    std::string density;
    bool given() const { return keys->has(density) || (!mass.empty() && keys->has(mass)); }
};

/// @param size the key that tells the block's width @param volume of the block [m3]
double read_mass(const std::vector<MassKeys>& sources, const Key& size, double volume)
{
    if (!(volume >= std::numeric_limits<double>::min()))
        size.keys->refuse(size.name, "gives a drum of zero volume", length_range.hint);
    const auto at = std::find_if(sources.begin(), sources.end(), [](const MassKeys& source) { return source.given(); });
    if (at == sources.end())
        sources.front().keys->missing(sources.front().mass,
                                      "Give the mass in kilograms, or " + sources.front().density + ".");
    const KeyReader& keys = *at->keys;
    const bool by_mass = !at->mass.empty() && keys.has(at->mass);
    if (by_mass && keys.has(at->density))
        keys.refuse(at->density, "and " + at->mass + " exclude each other", "Give one of the two.");
    if (!by_mass) {
        const double mass = keys.number(at->density, density_range) * volume;
        if (!mass_range.contains(mass))
            keys.refuse(at->density, fmt::format("gives a mass of {} kg, outside {}", mass, mass_range.text()),
                        density_range.hint);
        return mass;
    }
    const double mass = keys.number(at->mass, mass_range);
    // the mass of a density at the end of its range may round to just beyond it
    constexpr double slack = 1 + 1e-12;
    const double density = mass / volume;
    if (!(density > 0 && density <= density_range.high * slack))
        keys.refuse(at->mass, fmt::format("makes a density of {:.6g} kg/m3, outside {}", density, density_range.text()),
                    "Masses are in kilograms and lengths in metres: is one in other units?");
    return mass;
}

BedSpec read_bed(const KeyReader& keys)
{
    return {keys.maybe_number("friction", friction_range),
            keys.maybe_number("normal_stiffness_n_m2", normal_stiffness_range),
            keys.maybe_number("tangential_stiffness_n_m", tangential_stiffness_range)};
}

/// The keys of one column: its own ones, and behind them those of the structure for what it does not say.
class ColumnReader {
public:
    ColumnReader(const KeyReader& own, const KeyReader& all, double depth_m) : own_(own), all_(all), depth_m_(depth_m)
    {
    }

    ColumnSpec read() const
    {
        ColumnSpec column;
        const KeyReader& shape = own_.has("blocks") || own_.has("drums") ? own_ : all_;
        if (shape.has("drums"))
            column.drums = listed_drums(shape);
        else
            column.drums = equal_or_tapering_drums(shape);
        if (const Key capital = first_given(both("capital")); capital.given())
            column.drums.push_back(read_capital(capital.keys->table("capital")));
        if (column.drums.size() > most_blocks)
            shape.refuse(shape.has("drums") ? "drums" : "blocks",
                         fmt::format("makes a column of {} blocks", column.drums.size()),
                         fmt::format("At most {}.", most_blocks));
        const Key fixed = first_given(both("fixed_blocks"));
        column.fixed_blocks = static_cast<int>(fixed.keys->whole_or("fixed_blocks", 0, column.drums.size() - 1, 0,
                                                                    "At least one of the drums must be free."));
        return column;
    }

private:
    std::vector<Key> both(const char* name) const { return {{&own_, name}, {&all_, name}}; }

    /// What all drums of the column have in common.
    MassKeys common_mass() const
    {
        const KeyReader& keys = own_.has("drum_mass_kg") || own_.has("density_kg_m3") ? own_ : all_;
        return {&keys, "drum_mass_kg", "density_kg_m3"};
    }

    std::vector<DrumSpec> equal_or_tapering_drums(const KeyReader& shape) const
    {
        const auto blocks =
            shape.whole("blocks", 1, most_blocks,
                        "Drums of the column, including the fixed ones; or give drums = [ { ... }, ... ].");
        const Key width = first_given(both("drum_width_m"));
        const Key top_width = first_given(both("top_width_m"));
        DrumSpec drum;
        drum.width_m = width.keys->number(width.name, length_range);
        drum.height_m = number(both("drum_height_m"), length_range);
        std::vector<DrumSpec> drums(blocks, drum);
        if (!top_width.given()) {
            drum.mass_kg = read_mass({common_mass()}, width, drum.width_m * drum.height_m * depth_m_);
            drums.assign(blocks, drum);
            return drums;
        }
        const double top = top_width.keys->number(top_width.name, length_range);
        if (blocks == 1)
            top_width.keys->refuse(top_width.name, "tapers a column of one drum", "Give more blocks, or omit it.");
        const MassKeys mass = common_mass();
        if (mass.keys->has("drum_mass_kg"))
            mass.keys->refuse("drum_mass_kg", "is not used with top_width_m",
                              "The drums of a taper differ: give density_kg_m3.");
        for (std::size_t i = 0; i < blocks; ++i) {
            const double part = static_cast<double>(i) / static_cast<double>(blocks - 1);
            drums[i].width_m = drum.width_m + (top - drum.width_m) * part;
            drums[i].mass_kg =
                read_mass({{mass.keys, "", "density_kg_m3"}}, width, drums[i].width_m * drum.height_m * depth_m_);
        }
        return drums;
    }

    std::vector<DrumSpec> listed_drums(const KeyReader& shape) const
    {
        if (shape.has("blocks"))
            shape.refuse("blocks", "and drums exclude each other", "The drums of the list are counted.");
        if (const Key top_width = first_given(both("top_width_m")); top_width.given())
            top_width.keys->refuse(top_width.name, "is not used with drums", "Give each drum of the list its width_m.");
        std::vector<DrumSpec> drums;
        for (const KeyReader& keys : shape.tables("drums")) {
            keys.allow_only({"width_m", "height_m", "mass_kg", "density_kg_m3", "offset_m", "friction",
                             "normal_stiffness_n_m2", "tangential_stiffness_n_m", "count"});
            const DrumSpec drum = read_drum(keys, {&keys, "width_m"}, "drum_width_m", "drum_height_m",
                                            {{&keys, "mass_kg", "density_kg_m3"}, common_mass()});
            drums.insert(drums.end(), keys.whole_or("count", 1, most_blocks, 1, "Equal drums, one on the other."),
                         drum);
        }
        if (drums.empty())
            shape.refuse("drums", "is empty", "Give at least one drum: drums = [ { width_m = ..., height_m = ... } ].");
        return drums;
    }

    DrumSpec read_capital(const KeyReader& keys) const
    {
        keys.allow_only({"width_m", "height_m", "mass_kg", "density_kg_m3", "offset_m", "friction",
                         "normal_stiffness_n_m2", "tangential_stiffness_n_m"});
        DrumSpec capital = read_drum(keys, {&keys, "width_m"}, "", "",
                                     {{&keys, "mass_kg", "density_kg_m3"}, {common_mass().keys, "", "density_kg_m3"}});
        capital.capital = true;
        return capital;
    }

    /// @param width_for_all, height_for_all keys of the column or the structure; empty: there are none
    DrumSpec read_drum(const KeyReader& keys, const Key& own_width, const char* width_for_all,
                       const char* height_for_all, const std::vector<MassKeys>& mass) const
    {
        const auto with = [&](const Key& own, const char* for_all) {
            std::vector<Key> all = {own};
            if (*for_all != '\0')
                for (const Key& key : both(for_all))
                    all.push_back(key);
            return all;
        };
        const Key width = need(with(own_width, width_for_all), length_range);
        DrumSpec drum;
        drum.width_m = width.keys->number(width.name, length_range);
        drum.height_m = number(with({&keys, "height_m"}, height_for_all), length_range);
        drum.mass_kg = read_mass(mass, width, drum.width_m * drum.height_m * depth_m_);
        Range offset = length_range;
        offset.low = -drum.width_m;
        offset.high = drum.width_m;
        offset.open = false;
        drum.offset_m = keys.number_or("offset_m", offset, 0);
        drum.bed = read_bed(keys);
        return drum;
    }

    const KeyReader& own_;
    const KeyReader& all_;
    double depth_m_;
};

std::vector<ColumnSpec> read_columns(const KeyReader& keys, double depth_m)
{
    std::vector<ColumnSpec> columns;
    if (!keys.has("column_list")) {
        const auto count = keys.whole("columns", 2, most_columns, "Or give column_list = [ { x_m = ... }, ... ].");
        const double spacing = keys.number("column_spacing_m", spacing_range);
        columns.assign(count, ColumnReader(keys, keys, depth_m).read());
        for (std::size_t i = 0; i < count; ++i) // about the middle of the shaking table
            columns[i].x_m = (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)) * spacing;
        return columns;
    }
    for (const char* other : {"columns", "column_spacing_m"})
        if (keys.has(other))
            keys.refuse(other, "and column_list exclude each other", "The columns of the list have their own x_m.");
    for (const KeyReader& own : keys.tables("column_list")) {
        own.allow_only({"x_m", "blocks", "fixed_blocks", "drums", "drum_width_m", "drum_height_m", "drum_mass_kg",
                        "density_kg_m3", "top_width_m", "capital"});
        ColumnSpec column = ColumnReader(own, keys, depth_m).read();
        column.x_m = own.number("x_m", position_range);
        columns.push_back(std::move(column));
    }
    if (columns.empty() || columns.size() > most_columns)
        keys.refuse("column_list", fmt::format("has {} columns, outside [1, {}]", columns.size(), most_columns));
    return columns;
}

/// The epistyles that are given one by one.
std::vector<EpistyleSpec> listed_epistyles(const KeyReader& keys, const StructureSpec& structure)
{
    if (keys.has("epistyle_bays"))
        keys.refuse("epistyle_bays", "is not used with epistyles", "Each of the list has its first and last column.");
    const std::uint64_t last_column = structure.columns.size() - 1;
    std::vector<EpistyleSpec> epistyles;
    for (const KeyReader& own : keys.tables("epistyles")) {
        own.allow_only({"first_column", "last_column", "x_m", "length_m", "height_m", "mass_kg", "density_kg_m3",
                        "friction", "normal_stiffness_n_m2", "tangential_stiffness_n_m"});
        const char* counted = "Columns are counted from 0, from the left.";
        const auto first = own.whole("first_column", 0, last_column, counted);
        const auto last = own.whole("last_column", first, last_column, counted);
        const Key length = need({{&own, "length_m"}, {&keys, "epistyle_length_m"}}, length_range);
        EpistyleSpec epistyle;
        epistyle.first_column = static_cast<int>(first);
        epistyle.last_column = static_cast<int>(last);
        epistyle.length_m = length.keys->number(length.name, length_range);
        epistyle.height_m = number({{&own, "height_m"}, {&keys, "epistyle_height_m"}}, length_range);
        epistyle.x_m =
            own.number_or("x_m", position_range, (structure.columns[first].x_m + structure.columns[last].x_m) / 2);
        epistyle.mass_kg = read_mass({{&own, "mass_kg", "density_kg_m3"},
                                      {&keys, "epistyle_mass_kg", "epistyle_density_kg_m3"},
                                      {&keys, "", "density_kg_m3"}},
                                     length, epistyle.length_m * epistyle.height_m * structure.depth_m);
        epistyle.bed = read_bed(own);
        epistyles.push_back(epistyle);
    }
    return epistyles;
}

/// Equal pieces over all columns. Where their length is not given they meet over the axes of the columns, and the
/// outermost ones end flush with the outer faces of their seats.
std::vector<EpistyleSpec> epistyles_by_bays(const KeyReader& keys, const StructureSpec& structure)
{
    const std::vector<ColumnSpec>& columns = structure.columns;
    const std::size_t bays = columns.size() - 1;
    if (bays == 0)
        keys.refuse("column_list", "has one column and no bay", "Give epistyles = [].");
    std::size_t span = 1;
    if (const TomlValue* value = keys.find("epistyle_bays"); value != nullptr) {
        if (value->type == TomlValue::Type::string) {
            keys.word_index("epistyle_bays", {"all"});
            span = bays;
        } else {
            span = keys.whole("epistyle_bays", 1, bays, "Bays that one piece spans, or \"all\".");
        }
        if (bays % span != 0)
            keys.refuse("epistyle_bays", fmt::format("does not divide the {} bays of the colonnade", bays),
                        "Give another number, \"all\", or each piece in epistyles = [ { ... }, ... ].");
    }
    const double height = keys.number("epistyle_height_m", length_range);
    const std::optional<double> length = keys.maybe_number("epistyle_length_m", length_range);

    std::vector<EpistyleSpec> epistyles;
    for (std::size_t first = 0; first < bays; first += span) {
        const std::size_t last = first + span;
        double left = columns[first].x_m;
        double right = columns[last].x_m;
        if (length) {
            const double middle = (left + right) / 2;
            left = middle - *length / 2;
            right = middle + *length / 2;
        } else {
            const DrumSpec& outer_left = columns[first].drums.back();
            const DrumSpec& outer_right = columns[last].drums.back();
            if (first == 0)
                left += outer_left.offset_m - outer_left.width_m / 2;
            if (last == bays)
                right += outer_right.offset_m + outer_right.width_m / 2;
        }
        EpistyleSpec epistyle;
        epistyle.first_column = static_cast<int>(first);
        epistyle.last_column = static_cast<int>(last);
        epistyle.x_m = (left + right) / 2;
        epistyle.length_m = length.value_or(right - left);
        epistyle.height_m = height;
        if (!length_range.contains(epistyle.length_m))
            keys.refuse("epistyle_height_m",
                        fmt::format("belongs to an epistyle of {:.6g} m, longer than {:g} m", epistyle.length_m,
                                    length_range.high),
                        "Give fewer epistyle_bays, or epistyle_length_m.");
        const std::size_t before = epistyles.size();
        if (before > 0 && keys.has("epistyle_mass_kg") &&
            std::abs(epistyle.length_m - epistyles[0].length_m) > 1e-9 * epistyle.length_m)
            keys.refuse("epistyle_mass_kg",
                        fmt::format("is one mass for epistyles of {:.6g} m and of {:.6g} m", epistyles[0].length_m,
                                    epistyle.length_m),
                        "Give epistyle_density_kg_m3, or epistyle_length_m.");
        epistyle.mass_kg =
            read_mass({{&keys, "epistyle_mass_kg", "epistyle_density_kg_m3"}, {&keys, "", "density_kg_m3"}},
                      {&keys, "epistyle_height_m"}, epistyle.length_m * height * structure.depth_m);
        epistyles.push_back(epistyle);
    }
    return epistyles;
}

std::vector<EpistyleSpec> read_epistyles(const KeyReader& keys, const StructureSpec& structure)
{
    if (keys.has("epistyles"))
        return listed_epistyles(keys, structure);
    if (!keys.has("epistyle_height_m"))
        keys.missing("epistyle_height_m", "Give the height of the epistyles in metres; columns that carry none have "
                                          "epistyles = [].");
    return epistyles_by_bays(keys, structure);
}

} // namespace

StructureSpec read_structure(const KeyReader& keys)
{
    const std::vector<std::string> of_both = {"kind",         "blocks",        "fixed_blocks", "drums",
                                              "drum_width_m", "drum_height_m", "top_width_m",  "depth_m",
                                              "drum_mass_kg", "density_kg_m3", "capital",      "gravity_m_s2"};
    std::vector<std::string> known = of_both;
    known.insert(known.end(), {"columns", "column_spacing_m", "column_list", "epistyles", "epistyle_bays",
                               "epistyle_length_m", "epistyle_height_m", "epistyle_mass_kg", "epistyle_density_kg_m3"});
    keys.allow_only(known);

    StructureSpec s;
    s.kind = keys.choice_or("kind", structure_kind_names, s.kind);
    if (s.kind == StructureKind::column)
        keys.refuse_unused(of_both, "structure.kind = \"column\"");
    s.depth_m = keys.number("depth_m", length_range);
    s.gravity_m_s2 = keys.number_or("gravity_m_s2", gravity_range, s.gravity_m_s2);
    if (s.kind == StructureKind::column) {
        s.columns = {ColumnReader(keys, keys, s.depth_m).read()};
    } else {
        s.columns = read_columns(keys, s.depth_m);
        s.epistyles = read_epistyles(keys, s);
    }

    std::size_t blocks = s.epistyles.size();
    for (const ColumnSpec& column : s.columns)
        blocks += column.drums.size();
    if (blocks > most_blocks)
        keys.refuse_all(fmt::format("structure: {} blocks in all. At most {}.", blocks, most_blocks));
    try {
        lay_out(s);
    } catch (const InputError& error) {
        keys.refuse_all(error.what());
    }
    return s;
}

} // namespace stylobate
