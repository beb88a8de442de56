#include "ensemble/model/input_error.hpp"
#include "io/keys/study_keys.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace stylobate {

namespace {

/// A number that may stand in one of several tables: of a drum, or of all drums; of a column, or of all columns.
struct Source {
    const KeyReader* keys;
    const NumberKey* key;
    bool given() const { return keys->has(*key); }
    double read() const { return keys->read(*key); }
    const std::string& name() const { return key->name; }
};

/// The first of the sources that is given; the first one where none is.
const Source& first_given(const std::vector<Source>& sources)
{
    const auto at = std::find_if(sources.begin(), sources.end(), [](const Source& source) { return source.given(); });
    return at == sources.end() ? sources.front() : *at;
}

const Source& need(const std::vector<Source>& sources)
{
    const Source& source = first_given(sources);
    if (!source.given() && sources.size() > 1)
        source.keys->missing(source.name(),
                             fmt::format("Give a number in {}, or {} for all. {}", source.key->range.text(),
                                         sources.back().name(), source.key->range.hint));
    return source;
}

/// Where a mass may stand: itself, or as a density.
struct MassSource {
    const KeyReader* keys;
    const NumberKey* mass; ///< null: only the density
    const NumberKey* density;
    bool given() const { return keys->has(*density) || (mass && keys->has(*mass)); }
};

/// @param size the key of the block's width @param volume of the block [m3]
double read_mass(const std::vector<MassSource>& sources, const Source& size, double volume)
{
    if (!(volume >= std::numeric_limits<double>::min()))
        size.keys->refuse(size.name(), "gives a drum of zero volume", length_range.hint);
    const auto at =
        std::find_if(sources.begin(), sources.end(), [](const MassSource& source) { return source.given(); });
    if (at == sources.end()) {
        const MassSource& first = sources.front();
        if (first.mass == nullptr)
            first.keys->missing(first.density->name, density_range.hint);
        first.keys->missing(first.mass->name, "Give the mass in kilograms, or " + first.density->name + ".");
    }
    const KeyReader& keys = *at->keys;
    const bool by_mass = at->mass && keys.has(*at->mass);
    if (by_mass && keys.has(*at->density))
        keys.refuse(at->density->name, "and " + at->mass->name + " exclude each other", "Give one of the two.");
    if (!by_mass) {
        const double mass = keys.read(*at->density) * volume;
        if (!mass_range.contains(mass))
            keys.refuse(at->density->name, fmt::format("gives a mass of {} kg, outside {}", mass, mass_range.text()),
                        density_range.hint);
        return mass;
    }
    const double mass = keys.read(*at->mass);
    // the mass of a density at the end of its range may round to just beyond it
    constexpr double slack = 1 + 1e-12;
    const double density = mass / volume;
    if (!(density > 0 && density <= density_range.high * slack))
        keys.refuse(at->mass->name,
                    fmt::format("makes a density of {:.6g} kg/m3, outside {}", density, density_range.text()),
                    "Masses are in kilograms and lengths in metres: is one in other units?");
    return mass;
}

double volume_of(const DrumSpec& drum)
{
    return Frustum{drum.shape,
                   drum.width_m,
                   drum.depth_m,
                   drum.height_m,
                   drum.top_width_m / drum.width_m,
                   drum.echinus_height_m / drum.height_m,
                   drum.echinus_width_m / drum.width_m}
        .volume_m3();
}

/// The keys of one column: its own ones, and behind them those of the structure for the keys that it omits.
class ColumnReader {
public:
    ColumnReader(const KeyReader& own, const KeyReader& all, const StructureSpec& structure)
        : own_(own), all_(all), depth_m_(structure.depth_m), spatial_(structure.spatial())
    {
    }

    ColumnSpec read() const
    {
        using namespace structure_keys;
        ColumnSpec column;
        const KeyReader& shape = which(blocks, &drums);
        if (shape.has(drums))
            column.drums = listed_drums(shape);
        else
            column.drums = equal_or_tapering_drums(shape);
        if (const KeyReader& keys = which(capital); keys.has(capital))
            column.drums.push_back(read_capital(keys.table(capital), column.drums.back()));
        if (column.drums.size() > most_blocks)
            shape.refuse(shape.has(drums) ? drums.name : blocks.name,
                         fmt::format("makes a column of {} blocks", column.drums.size()),
                         fmt::format("At most {}.", most_blocks));
        column.fixed_blocks = static_cast<int>(which(fixed_blocks).read_up_to(fixed_blocks, column.drums.size() - 1));
        return column;
    }

private:
    /// The column's own keys where they have one of these, else those of the structure.
    const KeyReader& which(const TomlKey& key, const TomlKey* other = nullptr) const
    {
        return own_.has(key) || (other && own_.has(*other)) ? own_ : all_;
    }
    std::vector<Source> both(const NumberKey& key) const { return {{&own_, &key}, {&all_, &key}}; }

    /// What all drums of the column have in common.
    MassSource common_mass() const
    {
        using namespace structure_keys;
        return {&which(drum_mass, &density_of_all), &drum_mass, &density_of_all};
    }

    std::vector<DrumSpec> equal_or_tapering_drums(const KeyReader& shape) const
    {
        using namespace structure_keys;
        const std::uint64_t count_of_blocks = shape.read(blocks);
        const Source width_of_all = first_given(both(drum_width));
        const Source top = first_given(both(top_width));
        DrumSpec drum;
        drum.width_m = width_of_all.read();
        drum.height_m = need(both(drum_height)).read();
        if (spatial_)
            return frusta(drum, count_of_blocks, width_of_all, top);
        std::vector<DrumSpec> all(count_of_blocks, drum);
        if (!top.given()) {
            drum.mass_kg = read_mass({common_mass()}, width_of_all, drum.width_m * drum.height_m * depth_m_);
            all.assign(count_of_blocks, drum);
            return all;
        }
        const double top_m = top.read();
        if (count_of_blocks == 1)
            top.keys->refuse(top.name(), "tapers a column of one drum", "Give more blocks, or omit it.");
        const MassSource mass_of_all = common_mass();
        if (mass_of_all.keys->has(drum_mass))
            mass_of_all.keys->refuse(drum_mass.name, "is not used with top_width_m",
                                     "The drums of a taper differ: give density_kg_m3.");
        for (std::size_t i = 0; i < count_of_blocks; ++i) {
            const double part = static_cast<double>(i) / static_cast<double>(count_of_blocks - 1);
            all[i].width_m = drum.width_m + (top_m - drum.width_m) * part;
            all[i].mass_kg = read_mass({{mass_of_all.keys, nullptr, &density_of_all}}, width_of_all,
                                       all[i].width_m * drum.height_m * depth_m_);
        }
        return all;
    }

    /// In space the drums of a taper are frusta: each begins with the width with which the one below it ends.
    std::vector<DrumSpec> frusta(DrumSpec drum, std::uint64_t number, const Source& width_of_all,
                                 const Source& top) const
    {
        using namespace structure_keys;
        drum.bed.inner_ratio = which(inner_ratio).read(inner_ratio);
        drum.shape = which(shape).read(shape);
        drum.depth_m = depth_of(drum, both(drum_depth));
        const MassSource mass_of_all = common_mass();
        if (top.given() && mass_of_all.keys->has(drum_mass))
            mass_of_all.keys->refuse(drum_mass.name, "is not used with top_width_m",
                                     "The drums of a taper differ: give density_kg_m3.");
        const double bottom_m = drum.width_m, top_m = top.given() ? top.read() : bottom_m, depth_m = drum.depth_m;
        const auto width_at = [&](std::uint64_t i) {
            return bottom_m + (top_m - bottom_m) * (static_cast<double>(i) / static_cast<double>(number));
        };
        std::vector<DrumSpec> all(number, drum);
        for (std::uint64_t i = 0; i < number; ++i) {
            DrumSpec& each = all[i];
            each.width_m = width_at(i);
            each.top_width_m = width_at(i + 1);
            each.depth_m = drum.shape == Shape::rectangle ? depth_m * (each.width_m / bottom_m) : each.width_m;
            each.mass_kg = read_mass({mass_of_all}, width_of_all, volume_of(each));
        }
        return all;
    }

    /// The extent along z of a block in space whose width and shape are read.
    double depth_of(const DrumSpec& drum, const std::vector<Source>& sources) const
    {
        const Source& depth = first_given(sources);
        if (drum.shape == Shape::rectangle)
            return need(sources).read();
        if (depth.given() && depth.keys == &own_)
            depth.keys->refuse(depth.name(),
                               fmt::format("is not used by shape = \"{}\"", word_for(shape_names, drum.shape)),
                               "Remove it: only a rectangle has a depth of its own.");
        return drum.width_m;
    }

    std::vector<DrumSpec> listed_drums(const KeyReader& shape) const
    {
        using namespace structure_keys;
        if (shape.has(blocks))
            shape.refuse(blocks.name, "and drums exclude each other", "The drums of the list are counted.");
        if (const Source top = first_given(both(top_width)); top.given())
            top.keys->refuse(top.name(), "is not used with drums", "Give each drum of the list its width_m.");
        std::vector<DrumSpec> all;
        for (const KeyReader& keys : shape.tables(drums)) {
            const DrumSpec drum =
                read_drum(keys, &drum_width, &drum_height, {{&keys, &mass, &density}, common_mass()}, nullptr);
            all.insert(all.end(), keys.read(count), drum);
        }
        if (all.empty())
            shape.refuse(drums.name, "is empty",
                         "Give at least one drum: drums = [ { width_m = ..., height_m = ... } ].");
        return all;
    }

    DrumSpec read_capital(const KeyReader& keys, const DrumSpec& below) const
    {
        using namespace structure_keys;
        DrumSpec top = read_drum(keys, nullptr, nullptr,
                                 {{&keys, &mass, &density}, {common_mass().keys, nullptr, &density_of_all}}, &below);
        top.capital = true;
        return top;
    }

    /// The lower part of a capital. @param below the drum on which it lies
    static void read_echinus(const KeyReader& keys, const DrumSpec& below, DrumSpec& drum)
    {
        using namespace structure_keys;
        if (!keys.has(echinus_height)) {
            if (keys.has(echinus_width))
                keys.refuse(echinus_width.name, "belongs to an echinus, and there is none", "Give echinus_height_m.");
            return;
        }
        drum.echinus_height_m = keys.read(echinus_height);
        if (!(drum.echinus_height_m < drum.height_m))
            keys.refuse(echinus_height.name, fmt::format("leaves no abacus: the capital is {:g} m high", drum.height_m),
                        "It is a part of height_m: give less.");
        drum.echinus_width_m = keys.read_or(echinus_width, below.top_width_m);
        const double abacus_m = std::min(drum.width_m, drum.depth_m);
        if (keys.has(echinus_width) && drum.echinus_width_m > abacus_m * (1 + 1e-9)) // as `layout_rounding`
            keys.refuse(echinus_width.name, fmt::format("is above the width of the abacus, {:g} m", abacus_m),
                        "An echinus widens from the drum to the abacus.");
    }

    /// Shape, depth, taper, bed and place of a block in space.
    /// @param below of a capital the drum on which it lies; null: it is none   @param drum its sizes must be read
    void read_in_space(const KeyReader& keys, const DrumSpec* below, DrumSpec& drum) const
    {
        using namespace structure_keys;
        const bool is_capital = below != nullptr;
        if (is_capital)
            drum.shape = keys.read(capital_shape);
        else
            drum.shape = keys.has(own_shape) ? keys.read(own_shape) : which(shape).read(shape);
        std::vector<Source> depths = {{&keys, &own_depth}};
        if (!is_capital)
            for (const Source& source : both(drum_depth))
                depths.push_back(source);
        if (keys.has(own_depth) && drum.shape != Shape::rectangle)
            keys.refuse(own_depth.name, fmt::format("is not used by shape = \"{}\"", word_for(shape_names, drum.shape)),
                        "Remove it: only a rectangle has a depth of its own.");
        drum.depth_m = drum.shape == Shape::rectangle ? need(depths).read() : drum.width_m;
        drum.top_width_m = keys.read_or(own_top_width, drum.width_m);
        drum.bed.inner_ratio = is_capital ? 0 : which(inner_ratio).read(inner_ratio);
        if (is_capital)
            read_echinus(keys, *below, drum);
        Range allowed = offset_z.range;
        allowed.low = -drum.depth_m;
        allowed.high = drum.depth_m;
        drum.offset_z_m = keys.read_within(offset_z, allowed);
    }

    /// @param width_of_all, height_of_all keys of the column or the structure; null: there are none
    /// @param below of a capital the drum on which it lies; null: it is none
    DrumSpec read_drum(const KeyReader& keys, const NumberKey* width_of_all, const NumberKey* height_of_all,
                       const std::vector<MassSource>& masses, const DrumSpec* below) const
    {
        using namespace structure_keys;
        const auto with = [&](const NumberKey& own, const NumberKey* of_all) {
            std::vector<Source> all = {{&keys, &own}};
            if (of_all)
                for (const Source& source : both(*of_all))
                    all.push_back(source);
            return all;
        };
        const Source size = need(with(width, width_of_all));
        DrumSpec drum;
        drum.width_m = size.read();
        drum.height_m = need(with(height, height_of_all)).read();
        if (spatial_)
            read_in_space(keys, below, drum);
        drum.mass_kg = read_mass(masses, size, spatial_ ? volume_of(drum) : drum.width_m * drum.height_m * depth_m_);
        Range allowed = offset.range;
        allowed.low = -drum.width_m;
        allowed.high = drum.width_m;
        drum.offset_m = keys.read_within(offset, allowed);
        keys.read_fields(drums, drum.bed);
        return drum;
    }

    const KeyReader& own_;
    const KeyReader& all_;
    double depth_m_;
    bool spatial_;
};

std::vector<ColumnSpec> read_columns(const KeyReader& keys, const StructureSpec& structure)
{
    using namespace structure_keys;
    std::vector<ColumnSpec> all;
    if (!keys.has(column_list)) {
        const std::uint64_t number = keys.read(columns);
        const double spacing = keys.read(column_spacing);
        all.assign(number, ColumnReader(keys, keys, structure).read());
        for (std::size_t i = 0; i < number; ++i) // about the middle of the shaking table
            all[i].x_m = (static_cast<double>(i) - 0.5 * static_cast<double>(number - 1)) * spacing;
        return all;
    }
    for (const TomlKey* other : std::initializer_list<const TomlKey*>{&columns, &column_spacing})
        if (keys.has(*other))
            keys.refuse(other->name, "and column_list exclude each other",
                        "The columns of the list have their own x_m.");
    for (const KeyReader& own : keys.tables(column_list)) {
        ColumnSpec column = ColumnReader(own, keys, structure).read();
        column.x_m = own.read(x);
        column.z_m = own.read_or(z, 0);
        all.push_back(std::move(column));
    }
    if (all.empty() || all.size() > most_columns)
        keys.refuse(column_list.name, fmt::format("has {} columns, outside [1, {}]", all.size(), most_columns));
    return all;
}

/// The axis along which two columns are further apart.
Along usual_along(const ColumnSpec& from, const ColumnSpec& to)
{
    return std::abs(to.z_m - from.z_m) > std::abs(to.x_m - from.x_m) ? Along::z : Along::x;
}

/// The row in which all columns stand, along x or along z.
/// @throws InputError if they do not stand in one row, in their order
Along row_of(const KeyReader& keys, const std::vector<ColumnSpec>& columns)
{
    const Along along = usual_along(columns.front(), columns.back());
    for (std::size_t c = 1; c < columns.size(); ++c) {
        const ColumnSpec &before = columns[c - 1], &column = columns[c];
        const bool in_row = along == Along::z ? column.x_m == before.x_m && column.z_m > before.z_m
                                              : column.z_m == before.z_m && column.x_m > before.x_m;
        if (!in_row)
            keys.refuse(structure_keys::column_list.name,
                        "has columns that do not stand in one row along x or z, in "
                        "their order",
                        "Give each piece: epistyles = [ { first_column = 0, last_column = 1, ... }, ... ], or "
                        "epistyles = [] for none.");
    }
    return along;
}

/// Adds an epistyle, or so many of them side by side about its place. Where it is written out it is one by one.
void add_abreast(const EpistyleSpec& epistyle, std::uint64_t number, std::vector<EpistyleSpec>& all)
{
    for (std::uint64_t i = 0; i < number; ++i) {
        EpistyleSpec piece = epistyle;
        (piece.along == Along::z ? piece.x_m : piece.z_m) +=
            (static_cast<double>(i) - 0.5 * static_cast<double>(number - 1)) * piece.width_m;
        all.push_back(piece);
    }
}

/// The epistyles that are given one by one.
std::vector<EpistyleSpec> listed_epistyles(const KeyReader& keys, const StructureSpec& structure)
{
    using namespace structure_keys;
    if (keys.has(epistyle_bays))
        keys.refuse(epistyle_bays.name, "is not used with epistyles",
                    "Each of the list has its first and last column.");
    const std::uint64_t last_of_all = structure.columns.size() - 1;
    std::vector<EpistyleSpec> all;
    for (const KeyReader& own : keys.tables(epistyles)) {
        const std::uint64_t first = own.read_up_to(first_column, last_of_all);
        const std::uint64_t last = own.whole(last_column.name, first, last_of_all, last_column.hint);
        const Source size = need({{&own, &length}, {&keys, &epistyle_length}});
        EpistyleSpec epistyle;
        epistyle.first_column = static_cast<int>(first);
        epistyle.last_column = static_cast<int>(last);
        epistyle.length_m = size.read();
        epistyle.height_m = need({{&own, &own_epistyle_height}, {&keys, &epistyle_height}}).read();
        const ColumnSpec &from = structure.columns[first], &to = structure.columns[last];
        epistyle.x_m = own.read_or(epistyle_x, (from.x_m + to.x_m) / 2);
        if (structure.spatial()) {
            epistyle.width_m = need({{&own, &own_epistyle_width}, {&keys, &epistyle_width}}).read();
            epistyle.z_m = own.read_or(epistyle_z, (from.z_m + to.z_m) / 2);
            epistyle.along = own.read_or(along, usual_along(from, to));
        }
        const double across = structure.spatial() ? epistyle.width_m : structure.depth_m;
        epistyle.mass_kg = read_mass(
            {{&own, &mass, &density}, {&keys, &epistyle_mass, &epistyle_density}, {&keys, nullptr, &density_of_all}},
            size, epistyle.length_m * epistyle.height_m * across);
        own.read_fields(epistyles, epistyle.bed);
        add_abreast(epistyle, structure.spatial() ? own.read_or(abreast, keys.read(epistyle_abreast)) : 1, all);
    }
    return all;
}

/// Equal pieces over all columns. Where their length is not given they meet over the axes of the columns, and the
/// outermost ones end flush with the outer faces of their seats.
std::vector<EpistyleSpec> epistyles_by_bays(const KeyReader& keys, const StructureSpec& structure)
{
    namespace key = structure_keys;
    const std::vector<ColumnSpec>& columns = structure.columns;
    const std::size_t bays = columns.size() - 1;
    if (bays == 0)
        keys.refuse(key::column_list.name, "has one column and no bay", "Give epistyles = [].");
    std::size_t span = 1;
    const std::string& bays_key = key::epistyle_bays.name;
    if (const TomlValue* value = keys.find(bays_key); value != nullptr) {
        if (value->type == TomlValue::Type::string) {
            keys.word_index(bays_key, key::epistyle_bays.words);
            span = bays;
        } else {
            span = keys.read_up_to(key::epistyle_bays, bays);
        }
        if (bays % span != 0)
            keys.refuse(bays_key, fmt::format("does not divide the {} bays of the colonnade", bays),
                        "Give another number, \"all\", or each piece in epistyles = [ { ... }, ... ].");
    }
    const double height = keys.read(key::epistyle_height);
    const Along along = structure.spatial() ? row_of(keys, columns) : Along::x;
    const bool along_z = along == Along::z;
    const double width = structure.spatial() ? keys.read(key::epistyle_width) : structure.depth_m;
    const auto place = [&](const ColumnSpec& column) { return along_z ? column.z_m : column.x_m; };
    const auto half_seat = [&](const DrumSpec& drum) {
        const double taper = structure.spatial() ? drum.top_width_m / drum.width_m : 1;
        return taper * (along_z ? drum.depth_m : drum.width_m) / 2;
    };
    const std::optional<double> length = keys.maybe(key::epistyle_length);

    std::vector<EpistyleSpec> epistyles;
    for (std::size_t first = 0; first < bays; first += span) {
        const std::size_t last = first + span;
        double left = place(columns[first]);
        double right = place(columns[last]);
        if (length) {
            const double middle = (left + right) / 2;
            left = middle - *length / 2;
            right = middle + *length / 2;
        } else {
            const DrumSpec& outer_left = columns[first].drums.back();
            const DrumSpec& outer_right = columns[last].drums.back();
            if (first == 0)
                left += (along_z ? outer_left.offset_z_m : outer_left.offset_m) - half_seat(outer_left);
            if (last == bays)
                right += (along_z ? outer_right.offset_z_m : outer_right.offset_m) + half_seat(outer_right);
        }
        EpistyleSpec epistyle;
        epistyle.first_column = static_cast<int>(first);
        epistyle.last_column = static_cast<int>(last);
        (along_z ? epistyle.z_m : epistyle.x_m) = (left + right) / 2;
        if (structure.spatial()) {
            (along_z ? epistyle.x_m : epistyle.z_m) = along_z ? columns[first].x_m : columns[first].z_m;
            epistyle.along = along;
            epistyle.width_m = width;
        }
        epistyle.length_m = length.value_or(right - left);
        epistyle.height_m = height;
        if (!length_range.contains(epistyle.length_m))
            keys.refuse(key::epistyle_height.name,
                        fmt::format("belongs to an epistyle of {:.6g} m, longer than {:g} m", epistyle.length_m,
                                    length_range.high),
                        "Give fewer epistyle_bays, or epistyle_length_m.");
        const std::size_t before = epistyles.size();
        if (before > 0 && keys.has(key::epistyle_mass) &&
            std::abs(epistyle.length_m - epistyles[0].length_m) > 1e-9 * epistyle.length_m)
            keys.refuse(key::epistyle_mass.name,
                        fmt::format("is one mass for epistyles of {:.6g} m and of {:.6g} m", epistyles[0].length_m,
                                    epistyle.length_m),
                        "Give epistyle_density_kg_m3, or epistyle_length_m.");
        epistyle.mass_kg =
            read_mass({{&keys, &key::epistyle_mass, &key::epistyle_density}, {&keys, nullptr, &key::density_of_all}},
                      {&keys, &key::epistyle_height}, epistyle.length_m * height * width);
        add_abreast(epistyle, structure.spatial() ? keys.read(key::epistyle_abreast) : 1, epistyles);
    }
    return epistyles;
}

std::vector<EpistyleSpec> read_epistyles(const KeyReader& keys, const StructureSpec& structure)
{
    if (keys.has(structure_keys::epistyles))
        return listed_epistyles(keys, structure);
    if (!keys.has(structure_keys::epistyle_height))
        keys.missing(structure_keys::epistyle_height.name,
                     "Give the height of the epistyles in metres; columns that carry none have "
                     "epistyles = [].");
    return epistyles_by_bays(keys, structure);
}

} // namespace

StructureSpec read_structure(const KeyReader& keys)
{
    StructureSpec s;
    s.kind = keys.read(structure_keys::kind);
    keys.refuse_unused(structure_keys::table, "structure.kind", word_for(structure_kind_names, s.kind));
    keys.read_fields(structure_keys::table, s,
                     KeyUse{{{model_key, keys.read(structure_keys::dimensions) == 3 ? "3" : "2"}}});
    if (s.kind == StructureKind::column) {
        s.columns = {ColumnReader(keys, keys, s).read()};
    } else {
        s.columns = read_columns(keys, s);
        s.epistyles = read_epistyles(keys, s);
    }

    std::size_t blocks = s.epistyles.size();
    for (const ColumnSpec& column : s.columns)
        blocks += column.drums.size();
    if (blocks > structure_keys::most_blocks)
        keys.refuse_all(fmt::format("structure: {} blocks in all. At most {}.", blocks, structure_keys::most_blocks));
    try {
        lay_out(s);
    } catch (const InputError& error) {
        keys.refuse_all(error.what());
    }
    return s;
}

} // namespace stylobate
