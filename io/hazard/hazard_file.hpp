#pragma once
/// Hazard curves of others: a power law on the command line, tables (CSV), hazard curves of OpenQuake (CSV, NRML).
///
/// | given | is |
/// |---|---|
/// | `k0=1e-4,k=2.5,measure=pga_g[,sigma_ln=0.5]` | lambda = k0 im^-k, im in the unit of the measure; sigma_ln:
/// standard deviation of ln k0 | | CSV with `MEASURE,annual_frequency[,low,high][,fractile_0.16,...]` | a line for each
/// intensity; `low` and `high` are the fractiles 0.05 and 0.95 | | CSV that begins with a comment with
/// `investigation_time` and `imt` | OpenQuake's: columns lon, lat, poe-IML; poe -> -ln(1 - poe) / investigation time
/// (Poisson) | | XML | NRML 0.4 or 0.5 with `hazardCurves` |
///
/// A MEASURE has its unit in its name: pga_m_s2, pga_cm_s2, pga_g, pgv_m_s, pgv_cm_s, pgd_m, pgd_cm, arias_m_s,
/// cav_m_s, cav_cm_s, cav_g_s, sa_1s_m_s2, sa_1s_cm_s2, sa_1s_g. Of a power law it may be without: then it is in SI.
/// OpenQuake's measures are in its units (`fragility_exchange.hpp`).

#include "ensemble/estimators/risk/hazard_curve.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// @param given   one of the above, or several files of OpenQuake: the mean (or the fractile 0.5) and fractiles
/// @param measure of the fragility, with its SI unit: "pga_m_s2"
/// @param site    of several in a file: "LON,LAT", or a number from 0; nullopt, or an empty text, where there is but
/// one
/// @throws InputError with file, line, value and what to do: a hazard of another measure (both are named), an unknown
///         unit, intensities that do not ascend, frequencies that do not decrease, several sites without a choice
HazardModel read_hazard(const std::vector<std::string>& given, const std::string& measure,
                        const std::optional<std::string>& site = {});

} // namespace stylobate
