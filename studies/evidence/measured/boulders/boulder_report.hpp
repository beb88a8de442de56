#pragma once
/// The page of the boulders: what was computed, as plain data, and its text and pictures.

#include "studies/evidence/measured/boulders/boulder_model.hpp"
#include "studies/evidence/measured/parts/forecast.hpp"
#include "studies/evidence/measured/parts/page_case.hpp"

#include <array>
#include <string>
#include <vector>

namespace stylobate::measured {

/// Forecasts of the held-out tests: those of the first boulder, then those of the second one.
struct Predictor {
    std::string name;
    std::vector<Forecast> held;
    double log_likelihood = 0; ///< on the fitting half, of what was fitted by likelihood; else 0
};

/// What one variant of the contact does to the impacts, and how likely it makes what was measured.
struct Dissipation {
    BoulderFit best;        ///< over sizes and stiffnesses
    double restitution = 0; ///< of its first boulder
    double housner = 0;     ///< 1 - 1.5 sin2 alpha
};

struct BoulderResults {
    BoulderData data;
    std::vector<bool> fits; ///< (tests) whether it is in the fitting half
    std::size_t fitting_motions = 0, held_motions = 0;
    BoulderFit baseline, scattered, extended, one_sided;
    Predictor by_rate, by_box, by_published, by_intensity, by_baseline, by_scattered, by_extended;
    std::array<std::vector<Predictor>, boulders> published; ///< each numerical model on its boulder's held-out tests
    std::array<Predictor, boulders> extended_of;            ///< the extended model on one boulder's alone
    std::vector<Dissipation> dissipation;
    Estimate swapped_brier, swapped_right; ///< extended - baseline, fitted on the other half and judged on this one
    std::vector<Stance> stances;
    MeshBody body;
    int realizations = 0;
    Ends fitting, judging; ///< of the tables that are fitted with, and of the three judged models' ensembles
};

/// Text of the page. @param images path of the pictures, seen from it
std::string boulder_page(const BoulderResults& results, const std::string& images);
void draw_boulders(const BoulderResults& results, const PagePlace& place);

} // namespace stylobate::measured
