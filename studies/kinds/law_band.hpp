#pragma once
/// The band of the probabilities of a study over contact laws, as plain data, and how it is reported.

#include "ensemble/model/study.hpp"
#include "io/tables/table.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Of stripes, or of one cell, its axes are empty.
struct LawBand : SurfaceAxes {
    std::string file;                  ///< that it is from
    std::vector<std::string> laws;     ///< "as given" (the study), "softer", ...
    std::vector<std::string> words;    ///< (laws) what each is
    std::vector<std::string> left_out; ///< sentences: laws that do not apply
    std::vector<std::string> notes;    ///< sentences: what else a law changes
    std::string measure;               ///< of stripes
    std::vector<double> intensity;     ///< of stripes
    std::vector<std::string> places;   ///< (cells) "2.5 Hz, 4 m/s2", "PGV 0.75 m/s"
    double level = 0.95;               ///< of the intervals of differences
    std::uint64_t pairs = 0;           ///< of realizations, of each law at least

    /// Probabilities of one limit state in one cell or stripe, or in all.
    struct Place {
        std::vector<double> probability; ///< (laws) NaN where no pair is valid
        std::size_t lowest() const;      ///< the law of the least probability; of equal ones the first
        std::size_t highest() const;
        double low() const { return probability[lowest()]; }
        double high() const { return probability[highest()]; }
    };
    struct Limit {
        std::string name, describe;
        std::vector<Place> cells;
        Place overall;
        /// (laws) over all: paired difference from the study with its interval; 0 of the study itself.
        std::vector<double> difference, lower, upper;
        std::optional<std::size_t> widest() const; ///< of several cells the one with the widest band
    };
    std::vector<Limit> limits; ///< the first one is what `check` and `run` report: collapse

    /// Null where there is no such limit state.
    const Limit* limit(const std::string& name) const;
};

/// "contact law: 0.61 to 0.88 (rigid to stiffer)", "contact law: 0.61 under each law"
std::string law_range_words(const LawBand::Place& place, const std::vector<std::string>& laws);
/// Adds the range as members: `lowest`, `lowest_law`, `highest`, `highest_law`.
void add_law_range(Json& json, const LawBand::Place& place, const std::vector<std::string>& laws);
/// "contact law: 0.61 to 0.88 (rigid to stiffer), ..." Lines for a terminal.
std::string law_band_text(const LawBand& band);
/// For pages and pictures: "contact law: 0.61 to 0.88 (rigid to stiffer) over all cells, 0 to 0.97 at 0.61 Hz, 2 m/s2",
/// the second of the cell or stripe with the widest band.
std::string law_band_words(const LawBand::Limit& limit, const LawBand& band);
Json law_band_json(const LawBand& band);
/// A row for each limit state and cell, and for all cells together.
Table law_band_rows(const LawBand& band);
/// A section of a page.
void law_band_section(PageWriter& writer, const LawBand& band);

/// What is reported where there is no band: that the answer depends on the contact law, and which command measures it.
std::string law_advice(const Study& study);

} // namespace stylobate
