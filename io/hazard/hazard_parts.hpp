#pragma once
/// What the readers of hazard curves share.

#include "ensemble/estimators/risk/hazard_curve.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

// Names and units of the intensity measures of hazard curves.

struct HazardMeasure {
    std::string name;    ///< as of a fragility study, with its SI unit: "pga_m_s2"
    double per_unit = 1; ///< SI units in one of the unit that was named
};

/// Of a name with its unit, "pga_g"; nullopt, as below, if the measure is not known.
std::optional<HazardMeasure> measure_of_column(std::string_view name);
/// Of a name without its unit, "pga" or "sa_1s", in SI.
std::optional<HazardMeasure> measure_without_unit(std::string_view name);
/// Of OpenQuake's name, "SA(1.0)", in its unit.
std::optional<HazardMeasure> measure_of_openquake(const std::string& imt);

/// Names with units that are known, for messages.
std::string known_hazard_measures();

/// A hazard as it was read, not yet checked. Frequencies may be 0 or infinite.
struct RawHazard {
    HazardModel hazard;             ///< `frequency` is empty where the file has none but fractiles
    std::vector<long> lines;        ///< (n) of the file; 0: there are none
    std::vector<std::string> names; ///< (n) of the points for messages; empty: by their intensity
};

/// Where a hazard curve lies.
struct HazardSite {
    double lon = 0, lat = 0;
    std::string name() const;
};

/// @param given "LON,LAT" within 0.001 degrees, or a number from 0; nullopt if the file is of one site alone
/// @throws InputError if it is none of the sites, or if there are several and none is given
std::size_t chosen_site(const std::string& file, const std::vector<HazardSite>& sites,
                        const std::optional<std::string>& given);

/// -ln(1 - poe) / years, infinite of 1. @throws InputError with what was read if it is no probability
double annual_frequency(const std::string& file, long line, const std::string& what, double poe, double years);

/// A number, whole. Nothing if it is none, or not finite.
std::optional<double> hazard_number(std::string_view text);

/// @name The formats. @throws InputError
/// @{
RawHazard power_law_hazard(const std::string& given);
RawHazard csv_hazard(const std::string& file, std::string_view text);
RawHazard openquake_hazard(const std::string& file, std::string_view text, const std::optional<std::string>& site);
RawHazard nrml_hazard(const std::string& file, const std::string& text, const std::optional<std::string>& site);
/// Whether a CSV is OpenQuake's, by its first line.
bool is_openquake_hazard(std::string_view text);
/// @}

/// Where a curve increases, with the line of its own file: of several files only the first one's lines are kept.
/// @throws InputError
void check_decrease(const RawHazard& raw);

/// Without points that have no frequency above 0 that is finite, at the ends.
/// @throws InputError for whatever is wrong with its numbers
HazardModel checked_hazard(RawHazard raw);

} // namespace stylobate
