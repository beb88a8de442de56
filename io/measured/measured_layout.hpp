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

inline constexpr const char* measured_format = "stylobate-measured";
/// Version 2 has tests of single joints, and what belongs to them; version 1 has shake runs alone.
inline constexpr int measured_version = 2;

enum class Dimension { time, length, angle, acceleration, mass, force };

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
    int since = 1; ///< version of the format

    const Series& in(const MeasuredRun& run) const { return of(const_cast<MeasuredRun&>(run)); }
    /// The key of its noise beside the CSV file: "noise_base_acceleration_m_s2".
    std::string noise_key() const { return std::string("noise_") + column + suffix; }
};
const std::array<SeriesName, 9>& series_names();

/// One of the lists of the specimen, a value for each block or joint.
struct SpecimenList {
    const char* name; ///< of the data set and of the TOML key, unit included
    Dimension dimension;
    std::vector<double> Specimen::*member;
    bool per_joint = false;
    bool measured = false; ///< NaN where it was not measured; since version 2
    int since() const { return measured ? 2 : 1; }
};
const std::array<SpecimenList, 9>& specimen_lists();

/// One of the single numbers of the specimen.
struct SpecimenNumber {
    const char* name;
    double Specimen::*member;
};
const std::array<SpecimenNumber, 4>& specimen_numbers();

/// One of the limits of the laboratory.
struct LaboratoryNumber {
    const char* name;
    std::optional<double> Laboratory::*member;
    double largest; ///< what is beyond is in another unit
};
const std::array<LaboratoryNumber, 5>& laboratory_numbers();
/// The key of what a test of a kind costs: "cost_pull".
std::string cost_key(RunKind kind);

/// One of the numbers of a dummy.
struct DummyNumber {
    const char* name;
    double Dummy::*member;
    bool needed;
    Dimension dimension() const { return member == &Dummy::mass_kg ? Dimension::mass : Dimension::length; }
};
const std::array<DummyNumber, 5>& dummy_numbers();

/// One of the numbers of a force gauge.
struct GaugeNumber {
    const char* name;
    double ForceGauge::*member;
    bool needed;
    double low, high;
};
const std::array<GaugeNumber, 4>& gauge_numbers();
/// "laboratory" or "table": where the other end of its rod is.
const char* end_word(const ForceGauge& gauge);
/// The end of a word; without one that which a test of this kind has: the table where it pushes, else the laboratory.
/// @param what the key, for messages   @throws InputError
bool end_in_laboratory(const Campaign& campaign, const std::string& what, const std::optional<std::string>& word,
                       RunKind kind);

/// The kind of a run by its word; nullopt where the program does not know it. @throws nothing
std::optional<RunKind> run_kind(std::string_view word);
/// The kind of a run of version 2, `shake` where none is given; nullopt: not known, reported, and to be left out.
std::optional<RunKind> known_run_kind(Campaign& campaign, const std::string& run,
                                      const std::optional<std::string>& word);
/// Reports a run of version 1 whose kind of motion is the word of a test in version 2.
void report_old_kind(Campaign& campaign, const MeasuredRun& run);

/// Moves runs into `tests` that are no shake runs, and those in which the specimen is not whole, free and level, which
/// is reported. @pre all are in `runs`, by name
void keep_tests_apart(Campaign& campaign);

/// All runs, those that are shake runs first.
template <class C>
auto every_run(C& campaign)
{
    std::vector<decltype(campaign.runs.data())> all;
    for (auto* list : {&campaign.runs, &campaign.tests})
        for (auto& run : *list)
            all.push_back(&run);
    return all;
}

/// The number of blocks of the campaign: from the first entry that gives it.
std::size_t block_count(const Campaign& campaign);

/// A whole number that fits. @throws InputError naming the campaign's file and `what`
int whole_number(const Campaign& campaign, const std::string& what, double value);
BaseSource base_source(const Campaign& campaign, const std::string& what, const std::string& text);
const char* to_string(BaseSource source);

/// "a test (pull) on joint 2", for messages
std::string test_words(const MeasuredRun& run);

/// Refuses what contradicts itself in number: lists of another length than the blocks, series of another length than
/// the clock, joints to blocks that are not there. A run without a clock gets one from its rate.
/// @throws InputError
void check_shapes(Campaign& campaign);

/// Refuses tests that cannot be: joints, blocks and groups that are not there or not adjacent, dummies without mass,
/// forces without a gauge or outside the block, tilts in degrees, blocks that are seen but absent. @throws InputError
/// @pre shapes are right
void check_tests(const Campaign& campaign);

/// Refuses limits of a laboratory that are negative or in another unit. @throws InputError
void check_laboratory(const Campaign& campaign);

/// Refuses a specimen that cannot be: sizes in another unit, densities that no stone has, blocks that overlap, joints
/// between what does not touch, a block without a joint. @throws InputError
void check_specimen(const Campaign& campaign);

Campaign read_measured_hdf5(const std::filesystem::path& file);
/// Reads a file in this process: where the HDF5 library breaks on it, the program ends.
Campaign read_measured_hdf5_here(const std::filesystem::path& file);
Campaign read_measured_csv(const std::filesystem::path& folder);

} // namespace stylobate
