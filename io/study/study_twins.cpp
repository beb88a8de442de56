#include "io/study/study_twins.hpp"

#include "io/study/study_names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

/// Far below any difference that a hand or a survey could tell, up to one that both can.
const std::vector<double> usual_moves_m = {1e-12, 1e-9, 1e-6, 1e-3};
constexpr double usual_step_ratio = 0.8;

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
    const std::uint64_t block =
        keys.whole_or("block", 0, drums - 1, topmost, "A free drum, counted from 0, column by column from the bottom.");
    if (find_drum(structure, block).fixed)
        keys.refuse("block", "is fixed to the base", "Name a free drum.");
    return static_cast<int>(block);
}

/// Whether single precision runs it too (`check_precision` of study_file.cpp).
bool knows_single(const Study& study)
{
    return study.mechanisms.empty() && study.contact.form == ContactForm::area &&
           study.contact.damping == DampingAt::centroid;
}

} // namespace

TwinsSpec read_twins(const KeyReader& keys, const Study& study)
{
    keys.allow_only({"moves_m", "block", "step_ratio", "precision", "forms", "followed", "tolerance"});
    if (!study.surface)
        keys.refuse_all(fmt::format("[twins] is not used by study.kind = \"{}\".\n  Remove it, or give study.kind = "
                                    "\"surface\".",
                                    word_for(study_kind_names, study.kind)));
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
    TwinsSpec twins;
    twins.block = read_block(keys, study.structure);
    const double width_m = find_drum(study.structure, static_cast<std::size_t>(twins.block)).drum->width_m;
    const Range move{0, width_m / 4, false, "Lengths are in metres; at most a quarter of the drum's width.", 1e-3};
    const std::vector<double> moves = keys.has("moves_m") ? keys.number_list("moves_m", move) : usual_moves_m;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        if (i > 0 && !(moves[i] > moves[i - 1]))
            keys.refuse("moves_m",
                        fmt::format("is not in ascending order: {:g} comes before {:g}", moves[i - 1], moves[i]),
                        "Give the smallest first, each once.");
        twins.kinds.push_back({TwinBy::move, moves[i], study.contact.form});
    }
    const double ratio = keys.number_or(
        "step_ratio",
        {0.01, 1, false, "A fraction of the realization's own step; 1: no replicas with another step.", 0.01},
        usual_step_ratio);
    if (ratio != 1)
        twins.kinds.push_back({TwinBy::step, ratio, study.contact.form});
    if (keys.boolean_or("precision", knows_single(study))) {
        if (!knows_single(study))
            keys.refuse("precision", "requests replicas in single precision, which supports only the paper's model",
                        "Remove it, or the mechanisms, contact.form and contact.damping.");
        twins.kinds.push_back({TwinBy::precision, 0, study.contact.form});
    }
    if (keys.boolean_or("forms", true))
        for (const auto& name : contact_form_names)
            if (name.value != study.contact.form)
                twins.kinds.push_back({TwinBy::form, 0, name.value});
    twins.followed = keys.whole_or("followed", 0, study.realizations, std::min(twins.followed, study.realizations),
                                   "Realizations of each cell whose displaced replicas are tracked step by step.");
    twins.tolerance = keys.number_or(
        "tolerance",
        {1e-6, 1, false, "The separation limit of replicas: a fraction of the drums' width, and radians.", 0.01},
        twins.tolerance);
    return twins;
}

} // namespace stylobate
