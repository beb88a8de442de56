#include "io/files/suggest.hpp"
#include "io/keys/kind_keys.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace stylobate {

namespace {

/// @param most realizations of one cell
AdaptiveSpec read_adaptive(const KeyReader& keys, std::uint64_t cells, std::uint64_t most)
{
    using namespace adaptive_keys;
    AdaptiveSpec adaptive;
    adaptive.minimum = std::min(adaptive.minimum, most);
    if (keys.has(minimum))
        adaptive.minimum = keys.read_up_to(minimum, most);
    keys.whole(
        budget.name, adaptive.minimum * cells, budget.high,
        fmt::format("Realizations of the whole surface: {} cells have at least {} each.", cells, adaptive.minimum));
    keys.read_fields(surface_keys::adaptive, adaptive);
    return adaptive;
}

/// Those named, in the order of `perturbed`; without the key all.
std::vector<std::string> read_factors(const KeyReader& keys, const std::vector<std::string>& perturbed)
{
    const TomlValue* list = keys.find(sensitivity_keys::factors.name);
    if (!list)
        return perturbed;
    const std::string known = fmt::format("Perturbed are {}.", fmt::join(perturbed, ", "));
    if (list->type != TomlValue::Type::array || list->entries.empty())
        keys.refuse(sensitivity_keys::factors.name, "is not a list of names",
                    "Give factors = [\"friction\", ...]. " + known);
    std::vector<std::string> named;
    for (const TomlValue& entry : list->entries) {
        if (entry.type != TomlValue::Type::string)
            keys.refuse(sensitivity_keys::factors.name,
                        fmt::format("has {}, which is {}", entry.shown(), entry.type_name()), known);
        if (std::find(perturbed.begin(), perturbed.end(), entry.text) == perturbed.end()) {
            const auto near = nearest_word(entry.text, perturbed);
            keys.refuse(sensitivity_keys::factors.name,
                        fmt::format("names '{}', which [perturbation] does not", entry.text),
                        (near ? fmt::format("Did you mean '{}'? ", *near) : "") + known);
        }
        if (std::find(named.begin(), named.end(), entry.text) != named.end())
            keys.refuse(sensitivity_keys::factors.name, fmt::format("names '{}' twice", entry.text), "Name each once.");
        named.push_back(entry.text);
    }
    std::vector<std::string> factors;
    for (const std::string& name : perturbed)
        if (std::find(named.begin(), named.end(), name) != named.end())
            factors.push_back(name);
    return factors;
}

/// The drum of this number in layout order, and whether it is free.
struct FoundDrum {
    const DrumSpec* drum = nullptr;
    bool fixed = false;
};

FoundDrum find_drum(const StructureSpec& structure, std::size_t number)
{
    for (const ColumnSpec& column : structure.columns) {
        if (number < column.drums.size())
            return {&column.drums[number], number < static_cast<std::size_t>(column.fixed_blocks)};
        number -= column.drums.size();
    }
    return {};
}

int read_block(const KeyReader& keys, const StructureSpec& structure)
{
    const std::size_t topmost = structure.columns[0].drums.size() - 1;
    std::size_t drums = 0;
    for (const ColumnSpec& column : structure.columns)
        drums += column.drums.size();
    const std::uint64_t block = keys.has(twins_keys::block) ? keys.read_up_to(twins_keys::block, drums - 1) : topmost;
    if (find_drum(structure, block).fixed)
        keys.refuse(twins_keys::block.name, "is fixed to the base", "Name a free drum.");
    return static_cast<int>(block);
}

/// Whether single precision runs it too (`check_precision` of study_file.cpp).
bool knows_single(const Study& study)
{
    return study.mechanisms.empty() && study.contact.form == ContactForm::area &&
           study.contact.damping == DampingAt::centroid;
}

/// Rigid blocks have no stiffness that another form could take.
bool is_form_of_replicas(const Study& study, ContactForm form)
{
    return study.contact.form != ContactForm::rigid && form != ContactForm::rigid;
}

} // namespace

Axis read_axis(const KeyReader& table, const AxisKey& key, const Range& range)
{
    if (!table.has(key))
        table.missing(key.name, fmt::format("Give it as {{ from = ..., to = ..., count = ..., spacing = \"linear\" }} "
                                            "with values in {}. {}",
                                            range.text(), range.hint));
    const KeyReader keys = table.table(key);
    for (const NumberKey* end : {&key.from, &key.to}) // may be narrower than the key's range
        keys.read_within(*end, range);
    Axis axis;
    keys.read_fields(key, axis);
    if (axis.spacing == Spacing::log && !(axis.from > 0))
        keys.refuse("spacing", fmt::format("is \"log\", but from = {} is not above 0", axis.from),
                    "Give spacing = \"linear\".");
    if (axis.from > axis.to)
        keys.refuse("from", fmt::format("is above to = {}", axis.to), "Axes run upwards.");
    if (axis.count == 1 && axis.from != axis.to)
        keys.refuse("count", fmt::format("is one value, but from = {} and to = {}", axis.from, axis.to),
                    "Give more values, or the same from and to.");
    if (axis.count > 1 && axis.from == axis.to)
        keys.refuse("count", fmt::format("gives equal values: from = to = {}", axis.from),
                    "Give count = 1, or another from or to.");
    return axis;
}

SurfaceSpec read_surface(const KeyReader& keys, std::uint64_t most)
{
    using namespace surface_keys;
    SurfaceSpec surface;
    if (keys.has(direction))
        surface.direction_deg = read_axis(keys, direction, azimuth_range);
    else
        surface.frequency_hz = read_axis(keys, frequency, frequency_range);
    surface.pga_m_s2 = read_axis(keys, pga, acceleration_range);
    if (keys.has(adaptive))
        surface.adaptive = read_adaptive(keys.table(adaptive), static_cast<std::uint64_t>(surface.cells()), most);
    return surface;
}

std::vector<std::string> perturbed_names(const Study& study)
{
    std::vector<std::string> names;
    for (const Perturbation& p : study.perturbations)
        names.emplace_back(to_string(p.quantity));
    for (const MechanismPerturbation& p : study.mechanism_perturbations)
        names.push_back(input_name(p.mechanism, rule_of(p.mechanism).parameters[p.parameter]));
    return names;
}

FactorDesign read_sensitivity(const KeyReader& keys, const Study& study)
{
    const std::vector<std::string> perturbed = perturbed_names(study);
    if (perturbed.empty())
        keys.refuse_all("study.kind = \"sensitivity\" needs perturbed quantities, and [perturbation] has none.\n  Give "
                        "distributions there, for example friction = { distribution = \"normal\", cov = "
                        "0.1 }.");
    FactorDesign spec;
    spec.method = keys.read(sensitivity_keys::method);
    spec.factors = read_factors(keys, perturbed);
    const bool rest = spec.factors.size() < perturbed.size() || study.excitation.kind == ExcitationKind::noise;
    spec.inner = keys.read_or(sensitivity_keys::inner, rest ? 4 : 1);
    if (rest && spec.inner == 1)
        keys.refuse(sensitivity_keys::inner.name, "cannot separate the factors from the other random quantities",
                    "Give 2 or more (4 is recommended), or name every perturbed quantity in factors.");
    if (!rest && spec.inner > 1)
        keys.refuse(sensitivity_keys::inner.name,
                    "would run the same realizations again: every perturbed quantity is a factor",
                    "Give 1, or omit some quantities from factors.");
    const std::uint64_t of_row = spec.points() * spec.inner;
    spec.samples = keys.whole(
        sensitivity_keys::samples.name, sensitivity_keys::samples.low, most_realizations / of_row,
        fmt::format("Rows of the design, each of {} points with {} realizations.", spec.points(), spec.inner));
    return spec;
}

RareSpec read_rare(const KeyReader& keys, const Study& study)
{
    if (perturbed_names(study).empty())
        keys.refuse_all(
            "study.kind = \"rare\" needs random quantities, and [perturbation] has none.\n  Give distributions there.");
    if (study.excitation.kind == ExcitationKind::noise)
        keys.refuse_all("study.kind = \"rare\" has no chains of synthetic earthquakes: excitation.kind = \"noise\" "
                        "draws thousands of numbers for each.\n  Give another excitation.");
    RareSpec spec;
    keys.read_fields(rare_keys::table, spec);
    return spec;
}

ReplicasSpec read_replicas(const KeyReader& keys, const Study& study)
{
    if (study.surface->adaptive)
        keys.refuse_all(
            "[twins] and surface.adaptive exclude each other: every realization has its perturbed replicas.\n  Remove "
            "one of the two.");
    if (study.kept == KeptRealizations::none)
        keys.refuse_all("[twins] are compared row by row, and output.realizations = \"none\" keeps no rows.\n  Remove "
                        "one of the two.");
    if (study.run.precision == Precision::single)
        keys.refuse_all("[twins] compares double precision with single, and run.precision = \"single\".\n  Give "
                        "run.precision = \"double\".");
    ReplicasSpec twins;
    twins.block = read_block(keys, study.structure);
    const double width_m = find_drum(study.structure, static_cast<std::size_t>(twins.block)).drum->width_m;
    Range move = twins_keys::moves.range;
    move.high = width_m / 4;
    std::vector<double> moves = twins_keys::usual_moves_m;
    if (keys.has(twins_keys::moves))
        moves = keys.number_list(twins_keys::moves.name, move);
    else
        std::erase_if(moves, [&](double m) { return m > move.high; });
    if (moves.empty())
        keys.refuse_all(
            fmt::format("[twins] has no moves_m, and the usual ones are more than a quarter of the width of "
                        "block {}, {:g} m.\n  Give twins.moves_m.",
                        twins.block, width_m));
    for (std::size_t i = 0; i < moves.size(); ++i) {
        if (i > 0 && !(moves[i] > moves[i - 1]))
            keys.refuse(twins_keys::moves.name,
                        fmt::format("is not in ascending order: {:g} comes before {:g}", moves[i - 1], moves[i]),
                        "Give the smallest first, each once.");
        twins.kinds.push_back({ReplicaBy::move, moves[i], study.contact.form});
    }
    const double ratio = keys.read(twins_keys::step_ratio);
    if (ratio != 1)
        twins.kinds.push_back({ReplicaBy::step, ratio, study.contact.form});
    if (keys.read_or(twins_keys::precision, knows_single(study))) {
        if (!knows_single(study))
            keys.refuse(twins_keys::precision.name,
                        "requests replicas in single precision, which supports only the paper's model",
                        "Remove it, or the mechanisms, contact.form and contact.damping.");
        twins.kinds.push_back({ReplicaBy::precision, 0, study.contact.form});
    }
    if (keys.read(twins_keys::forms))
        for (const auto& name : contact_form_names)
            if (name.value != study.contact.form && is_form_of_replicas(study, name.value))
                twins.kinds.push_back({ReplicaBy::form, 0, name.value});
    twins.followed = keys.has(twins_keys::followed) ? keys.read_up_to(twins_keys::followed, study.realizations)
                                                    : std::min(twins.followed, study.realizations);
    twins.tolerance = keys.read(twins_keys::tolerance);
    return twins;
}

} // namespace stylobate
