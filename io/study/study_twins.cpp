#include "io/study/study_twins.hpp"

#include "io/keys/kind_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

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
bool is_form_of_twins(const Study& study, ContactForm form)
{
    return study.contact.form != ContactForm::rigid && form != ContactForm::rigid;
}

} // namespace

TwinsSpec read_twins(const KeyReader& keys, const Study& study)
{
    if (study.kind != StudyKind::surface)
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
        twins.kinds.push_back({TwinBy::move, moves[i], study.contact.form});
    }
    const double ratio = keys.read(twins_keys::step_ratio);
    if (ratio != 1)
        twins.kinds.push_back({TwinBy::step, ratio, study.contact.form});
    if (keys.read_or(twins_keys::precision, knows_single(study))) {
        if (!knows_single(study))
            keys.refuse(twins_keys::precision.name,
                        "requests replicas in single precision, which supports only the paper's model",
                        "Remove it, or the mechanisms, contact.form and contact.damping.");
        twins.kinds.push_back({TwinBy::precision, 0, study.contact.form});
    }
    if (keys.read(twins_keys::forms))
        for (const auto& name : contact_form_names)
            if (name.value != study.contact.form && is_form_of_twins(study, name.value))
                twins.kinds.push_back({TwinBy::form, 0, name.value});
    twins.followed = keys.has(twins_keys::followed) ? keys.read_up_to(twins_keys::followed, study.realizations)
                                                    : std::min(twins.followed, study.realizations);
    twins.tolerance = keys.read(twins_keys::tolerance);
    return twins;
}

} // namespace stylobate
