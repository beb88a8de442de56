#pragma once
/// What the two layouts of measured data (HDF5, and CSV with TOML) share: the names of the data, their units, and the
/// shapes that they must have. See FORMAT.md.

#include "ensemble/model/campaign.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

enum class Dimension { time, length, angle, acceleration, mass };

/// What a series may reach [SI]: what is beyond is in another unit.
double largest_of_series(Dimension dimension);

/// What one unit is in SI units, for the usual spellings ("mm", "m/s^2", "m_s2", "g", "deg"); nothing if it is no unit
/// of this dimension.
std::optional<double> unit_in_si(std::string_view spelling, Dimension dimension);
/// The units of a dimension, for messages.
const char* known_units(Dimension dimension);

/// A length for messages: "12 mm", "1.5 m".
std::string length_words(double metres);

/// One of the series of a run.
struct SeriesName {
    const char* path;   ///< of the data set in the group of its run
    const char* column; ///< of the CSV file, without its unit; of one for each block the part before the number
    const char* unit;   ///< as written
    const char* suffix; ///< of the column
    Dimension dimension;
    bool per_block;
    Series& (*of)(MeasuredRun&);

    const Series& in(const MeasuredRun& run) const { return of(const_cast<MeasuredRun&>(run)); }
    /// The key of its noise beside the CSV file: "noise_base_acceleration_m_s2".
    std::string noise_key() const { return std::string("noise_") + column + suffix; }
};
const std::array<SeriesName, 8>& series_names();

/// One of the lists of the specimen, a value for each block.
struct SpecimenList {
    const char* name; ///< of the data set and of the TOML key, unit included
    Dimension dimension;
    std::vector<double> Specimen::*member;
};
const std::array<SpecimenList, 6>& specimen_lists();

/// One of the single numbers of the specimen.
struct SpecimenNumber {
    const char* name;
    double Specimen::*member;
};
const std::array<SpecimenNumber, 4>& specimen_numbers();

/// The number of blocks of the campaign: from the first entry that gives it.
std::size_t block_count(const Campaign& campaign);

/// A whole number that fits. @throws InputError naming the campaign's file and `what`
int whole_number(const Campaign& campaign, const std::string& what, double value);
BaseSource base_source(const Campaign& campaign, const std::string& what, const std::string& text);
const char* to_string(BaseSource source);

/// Refuses what contradicts itself in number: lists of another length than the blocks, series of another length than
/// the clock, joints to blocks that are not there. A run without a clock gets one from its rate.
/// @throws InputError
void check_shapes(Campaign& campaign);

/// Refuses a specimen that cannot be: sizes in another unit, densities that no stone has, blocks that overlap, joints
/// between what does not touch, a block without a joint. @throws InputError
void check_specimen(const Campaign& campaign);

Campaign read_measured_hdf5(const std::filesystem::path& file);
/// Reads a file in this process: where the HDF5 library breaks on it, the program ends.
Campaign read_measured_hdf5_here(const std::filesystem::path& file);
Campaign read_measured_csv(const std::filesystem::path& folder);

} // namespace stylobate
