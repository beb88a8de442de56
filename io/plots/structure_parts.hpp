#pragma once
/// What the drawings of a structure in the plane and in space have in common.

#include "ensemble/model/study.hpp"
#include "io/plots/sheet.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// The blocks of a structure by columns, and its lengths in words.
struct DrawnStructure {
    const Study& study;
    Layout layout;
    std::vector<std::vector<std::size_t>> columns; ///< blocks of each, from the bottom
    std::vector<std::size_t> epistyles;
    double top_m = 0; ///< of the highest block
    bool in_mm = false;

    explicit DrawnStructure(const Study& of);

    const PlacedBlock& block(std::size_t i) const { return layout.blocks[i]; }
    const char* unit() const { return in_mm ? "mm" : "m"; }
    std::string number(double metres) const;
    std::string length(double metres) const { return number(metres) + " " + unit(); }

    /// What is not that of [contact] in the bed under a block, of an epistyle in that of its first seat; nullopt if
    /// nothing is.
    std::optional<std::string> bed_words(std::size_t block) const;
    /// "drum 3", "capital", "drums 1 to 3": without their column. @param run neighbours of one kind
    std::string name_of(const std::vector<std::size_t>& run) const;
    /// "6 blocks, 1 fixed"
    std::string count_words() const;
    std::string whole_mass() const;
};

/// What of a bed is not that of [contact]; nullopt if nothing is.
std::optional<std::string> words_of_bed(const BedSpec& bed);

/// The chain of heights of the first column, with the epistyle on it, and the whole height, left of an elevation.
/// @param left, ground of the elevation [pixels]
void draw_heights(const DrawnStructure& drawn, DrawingSheet& sheet, double left, double ground, double per_metre);

} // namespace stylobate
