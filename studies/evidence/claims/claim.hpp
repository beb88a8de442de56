#pragma once
/// The content of a claim file, as plain data: the claims of a paper about one structure, each with the criterion that
/// decides it, over variants of one ordinary study. It is read from the [claim] section of a study file, whose words
/// `README.md` describes; the rest of the file is an ordinary study.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::claims {

/// What may have happened to a realization.
enum class Event {
    rocked,          ///< the largest relative rotation is above outcome.rocking_threshold_rad, or it collapsed
    slid,            ///< the total sliding is above outcome.sliding_threshold widths
    collapsed,       ///< see `ensemble/engine/README.md`
    stood,           ///< none of the three: it moved as one with the base
    rocked_only,     ///< rocked, did not slide
    slid_only,       ///< slid, did not rock
    rocked_and_slid, ///< both
    rocked_or_slid,  ///< at least one of them
    collapsed_early, ///< within `Measure::within_cycles` of the start of the strong shaking
    upright          ///< not collapsed
};

/// What is measured of a realization.
enum class Amount {
    total_sliding_m,
    total_rocking_rad,
    top_path_ratio,  ///< path of the top against the base, over the path of the base
    face_path_ratio, ///< path of the faces in contact against each other, of a column, over the path of the base
    friction_share,  ///< of the energy that was dissipated, the part that friction took
    collapse_cycles, ///< collapse time x frequency, for those that collapsed
};
inline constexpr std::size_t amount_count = 6;

/// A number estimated from the realizations of a cell (or of a row of cells), with an interval.
struct Measure {
    enum class Kind {
        probability, ///< of an event in a cell
        minority,    ///< share of the rarer of an event and its contrary in a cell: how open the outcome is
        median,      ///< of an amount in a cell
        onset        ///< the lowest PGA at which the probability of an event crosses 1/2, at one frequency
    };
    Kind kind = Kind::probability;
    Event event = Event::collapsed;
    Amount amount = Amount::total_sliding_m;
    std::optional<Event> given; ///< only realizations to which this happened count
    double within_cycles = 0;   ///< of `Event::collapsed_early`
    bool between_steps = false; ///< onset: the interval is interpolated too, where the curve is resolved
};

/// Part of an axis of a surface, ends included; or some values of it.
struct Window {
    double from = 0;
    double to = std::numeric_limits<double>::infinity();
    std::vector<double> values = {}; ///< these alone, to 1 %; empty: all from `from` to `to`
    bool over_f1 = false;            ///< in units of the first natural frequency of the nominal structure

    bool holds(double value) const
    {
        const auto near = [&](double one) { return std::abs(value - one) <= 0.01 * one; };
        return values.empty() ? value >= from * (1 - 1e-6) && value <= to * (1 + 1e-6)
                              : std::any_of(values.begin(), values.end(), near);
    }
};

/// What must be so for a claim to hold. Everything is decided by intervals: what they leave open is undecided.
struct Criterion {
    enum class Kind {
        bound, ///< the measure is at least a number, at most one, or both: in all cells of the window or in any
        trend, ///< it rises or falls along the frequency: from end to end, and in no cell in the opposite direction
        order, ///< it rises or falls from level to level of an axis: in all cells of the window; or it differs: in any
        /// A probability rises or falls from the first to the last level of an axis, by pairs: realizations of equal
        /// number have the same draws at all levels.
        paired,
        same ///< the most frequent of rocked, slid, both is the same at all levels of an axis, where something moves
    };
    enum class Way { falls, rises, either };
    Kind kind = Kind::bound;
    Measure measure;
    Window pga;
    std::optional<double> at_least;   ///< bound
    std::optional<double> at_most;    ///< bound
    bool any = false;                 ///< bound, order: one cell is enough
    Way way = Way::falls;             ///< trend, order, paired
    std::optional<std::string> along; ///< order, paired, same: name of the axis
};

/// Every criterion is judged at these margins. A difference counts where it certainly exceeds the margin: a part of the
/// smaller number (paired: of the larger probability). A number clears a bound where it does so by the margin: a part
/// of the bound (a probability: of what lies between the bound and 0 or 1). Two bounds are a margin of their own.
inline constexpr std::array margins{0.0, 0.05, 0.20};

/// Settings of a level that hold only together with levels of other axes.
struct Together {
    std::vector<std::string> only; ///< "AXIS=LEVEL"
    std::vector<std::string> set;  ///< "KEY=VALUE", as on the command line
};

/// Settings that one variant differs by.
struct Level {
    std::string name;
    std::vector<std::string> set;  ///< "KEY=VALUE", as on the command line
    std::vector<std::string> only; ///< "AXIS=LEVEL": it is combined with these levels alone
    std::vector<Together> also = {};
    std::optional<std::string> law = {}; ///< "rigid", "ends" ...: the study under this contact law (contact_laws.hpp)
};

/// One way in which the variants differ.
struct VariantAxis {
    std::string name;
    std::string label; ///< in words
    std::vector<Level> levels;
};

/// Part of the frequencies that a claim is judged on by itself.
struct Range {
    std::string name;
    Window frequency;
};

/// Words for the page, chosen by the verdict; `claim_page.hpp` lists their fields in braces.
struct Reasons {
    std::optional<std::string> confirmed, refuted, depends, untestable;
};

struct Test {
    std::string id;                           ///< "P11", "P14a"
    std::string says;                         ///< the statement in our words
    std::string section;                      ///< of the paper, or its figure or table
    bool inference = false;                   ///< it follows from the paper, which does not say it
    std::optional<std::string> stand_ins;     ///< what of the paper's inputs is missing and replaced
    std::optional<std::string> after_trials;  ///< what of the criterion was chosen after trial runs
    std::optional<std::string> contradiction; ///< the inconsistency within the paper
    Criterion criterion;
    std::vector<Range> ranges;     ///< at least one
    std::vector<std::string> only; ///< "AXIS=LEVEL": the variants that are judged; several of one axis: any of them
    std::optional<std::string> untestable; ///< why no verdict can be given, whatever the numbers are
    std::optional<std::string>
        impossible; ///< why it cannot hold in all variants: a verdict "confirmed" is then withheld
    Reasons reasons;
    std::vector<std::string> figures; ///< names of figures, of any claim file
};

struct Figure {
    std::string name; ///< of the file, without .png
    std::string title;
    std::string caption; ///< under the picture on the page
    std::string x;       ///< "frequency", "pga" or the name of an axis
    std::string y_label;
    bool log_y = false;
    std::vector<Measure> measures; ///< one curve each and for each variant
    Window frequency, pga;
    std::vector<std::string> only; ///< as in `Test`
    std::optional<double> line;    ///< a horizontal line, with its label
    std::string line_label;
};

struct ClaimFile {
    std::string file; ///< the study
    std::string name; ///< its name without folder and ending
    std::string what; ///< the structure in words
    std::vector<VariantAxis> axes;
    std::vector<Test> tests;
    std::vector<Figure> figures;
};

/// One combination of levels: the index of the level of each axis, in the order of the axes.
using Levels = std::vector<std::size_t>;

/// The place of an axis; the number of axes where none has the name.
std::size_t axis_index(const std::vector<VariantAxis>& axes, const std::string& name);

/// All combinations that the levels' `only` allow, the last axis running fastest.
std::vector<Levels> variants(const std::vector<VariantAxis>& axes);

/// Whether a combination is among those that "AXIS=LEVEL" words pick: for each axis that they name, one of its levels.
bool picked(const std::vector<VariantAxis>& axes, const Levels& levels, const std::vector<std::string>& only);

/// All settings of a combination, axis by axis.
std::vector<std::string> settings_of(const std::vector<VariantAxis>& axes, const Levels& levels);

/// The contact law that a level names; nullopt where the study has its own.
std::optional<std::string> law_of(const std::vector<VariantAxis>& axes, const Levels& levels);

/// "K_N 1e8, smooth start": the levels in words; an axis with one level is left out.
std::string variant_text(const std::vector<VariantAxis>& axes, const Levels& levels);

/// "AXIS=LEVEL AXIS=LEVEL", for fields in braces and file names.
std::string variant_key(const std::vector<VariantAxis>& axes, const Levels& levels);

template <class Enum>
struct Word {
    const char* word; ///< in claim files
    Enum value;
    const char* text = ""; ///< on the page
};

inline constexpr std::array event_words{Word<Event>{"rocked", Event::rocked, "rocks"},
                                        Word<Event>{"slid", Event::slid, "slides"},
                                        Word<Event>{"collapsed", Event::collapsed, "collapses"},
                                        Word<Event>{"stood", Event::stood, "moves as one with the base"},
                                        Word<Event>{"rocked_only", Event::rocked_only, "rocks without sliding"},
                                        Word<Event>{"slid_only", Event::slid_only, "slides without rocking"},
                                        Word<Event>{"rocked_and_slid", Event::rocked_and_slid, "rocks and slides"},
                                        Word<Event>{"rocked_or_slid", Event::rocked_or_slid, "rocks or slides"},
                                        Word<Event>{"collapsed_early", Event::collapsed_early, "collapses early"},
                                        Word<Event>{"upright", Event::upright, "stays upright"}};

inline constexpr std::array amount_words{
    Word<Amount>{"total_sliding_m", Amount::total_sliding_m, "total sliding"},
    Word<Amount>{"total_rocking_rad", Amount::total_rocking_rad, "total rocking"},
    Word<Amount>{"top_path_ratio", Amount::top_path_ratio, "path of the top over that of the base"},
    Word<Amount>{"face_path_ratio", Amount::face_path_ratio, "path of the faces in contact over that of the base"},
    Word<Amount>{"friction_share", Amount::friction_share, "share of friction in the dissipated energy"},
    Word<Amount>{"collapse_cycles", Amount::collapse_cycles, "cycles until collapse"}};

template <class List, class Enum>
const Word<Enum>& word_of(const List& words, Enum value)
{
    for (const auto& word : words)
        if (word.value == value)
            return word;
    return words.front();
}

/// "rocks and slides"
std::string event_text(Event event);
/// "m/s²", "mm", "rad" or nothing.
std::string unit_text(const Measure& measure);
/// Whether it is a length, whose texts are in mm.
bool is_length(const Measure& measure);
/// "collapses", "total sliding", for the key of a figure.
std::string short_text(const Measure& measure);
/// The criterion as a sentence, from its parameters alone, so that the text of the page is what is computed.
std::string criterion_text(const ClaimFile& file, const Test& test);

/// @throws InputError with file, line and key: misspelt or missing keys, unknown words, axes and levels, a criterion
///         without what its kind needs
ClaimFile read_claims(const std::filesystem::path& file);

/// Reads the text of a claim file. @param name stands for the file in messages
ClaimFile parse_claims(const std::string& text, const std::string& name);

} // namespace stylobate::claims
