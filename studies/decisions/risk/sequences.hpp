#pragma once
/// Simulated years of earthquakes at a site: does a structure fall more easily with the damage of earlier ones?
///
/// Earthquakes above a threshold come by Poisson's process, their intensities from the hazard's best estimate, their
/// motions from those of the fragility study, each scaled to its intensity (multiple sequential earthquakes:
/// Papaloizou, Polycarpou, Komodromos, Hatzigeorgiou & Beskos, "Two-dimensional numerical investigation of the effects
/// of multiple sequential earthquake excitations on ancient multi-drum columns", Earthquakes and Structures 10 (2016)
/// 495). A history is run twice with the same draws: once as one motion with rest between its earthquakes, so that the
/// structure keeps what has been displaced, and once with each earthquake by itself on the same structure as new. A
/// history of one earthquake is run once: it cannot differ.

#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/results/results.hpp"

#include <cstdint>
#include <optional>

namespace stylobate {

struct Risk;

struct SequenceOptions {
    std::uint64_t histories = 1000;
    double years = 100;
    double level = 0.9;
    std::optional<double> threshold; ///< none: `harmless_intensity`
    /// Rest between two earthquakes [s]; none: 10 times `tail_after_shaking` of the structure, and at least the study's
    /// `pause_s`. A stack rocks on for long: after a short pause the next earthquake meets it in motion, which topples
    /// it more easily than damage does (docs/risk.md has the effect as measured).
    std::optional<double> pause_s;
    std::uint64_t seed = 1;
    std::uint64_t checked = 100; ///< so many of the histories once more with earthquakes down to half the threshold
};

/// @throws InputError if the results are of sequences already, or if their motions cannot be scaled
void check_sequences(const Results& results);

/// @param risk of the same results: its hazard, and the frequency of the collapse that the histories are compared with
/// @return nothing if the observer asked to stop
/// @throws InputError if a history would have too many earthquakes
std::optional<SequenceRisk> simulate_sequences(const Results& results, const Risk& risk, const SequenceOptions& options,
                                               const RunOptions& run, Observer& observer);

} // namespace stylobate
