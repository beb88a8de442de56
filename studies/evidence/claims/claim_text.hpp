#pragma once
/// Events, amounts, numbers and criteria in words: for the page, and (the plain names) for the claim files.

#include "studies/evidence/claims/criterion.hpp"

#include <array>

namespace stylobate::claims {

template <class Enum>
struct Word {
    const char* word; ///< in claim files
    Enum value;
    const char* text; ///< on the page
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
                                        Word<Event>{"upright", Event::upright, "stays upright"},
                                        Word<Event>{"unseated", Event::unseated, "an epistyle loses a seat"}};

inline constexpr std::array amount_words{
    Word<Amount>{"total_sliding_m", Amount::total_sliding_m, "total sliding"},
    Word<Amount>{"residual_sliding_m", Amount::residual_sliding_m, "residual sliding"},
    Word<Amount>{"total_rocking_rad", Amount::total_rocking_rad, "total rocking"},
    Word<Amount>{"rocking_path_rad", Amount::rocking_path_rad, "path of rocking"},
    Word<Amount>{"peak_top_m", Amount::peak_top_m, "largest displacement of the top"},
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
/// "1.82 [1.71, 2.03] m/s²"; "above 12 m/s²" and so on for an onset beyond its axis. Lengths in mm.
std::string number_text(const Measure& measure, const Estimate& e);
/// "the probability that it collapses", "the median total sliding", for sentences.
std::string measure_text(const Measure& measure);
/// "collapses", "total sliding", for the key of a figure.
std::string short_text(const Measure& measure);
/// "at 2.15 m/s2", "from 1 to 8 Hz", "above 4 Hz"; empty for everything.
std::string window_text(const Window& window, const char* unit);
/// The criterion as a sentence, from its parameters alone, so that the text of the page is what is computed.
std::string criterion_text(const ClaimFile& file, const Test& test);
const char* to_string(Finding finding);

} // namespace stylobate::claims
