#pragma once
/// What is measured, as tables and as a picture.

#include "ensemble/model/study.hpp"
#include "studies/evidence/picture/picture.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate::work {

// Three answers of the engine, each with what it cost in block-steps: a number that no neighbour on the machine
// changes.

/// What is varied.
struct Setting {
    ContactForm form = ContactForm::area;
    DampingAt damping = DampingAt::centroid;
    StepBasis basis = StepBasis::block;
    double K_n = 1e8;           ///< [N/m2]
    double shear = 1;           ///< K_T / (K_N B)
    double xi = 0.1;            ///< both damping ratios
    double step_fraction = 0.9; ///< of the safe bound
};

/// Block-steps per simulated second of the monolith (48 x 174 mm, one free block): 1 / step.
double monolith_cost(const Setting& setting);

/// (a) Leaned by half its slenderness and let go: time until it is upright [s]; NaN if it takes more than 5 / p.
double quarter_period_s(const Setting& setting);
double exact_quarter_period_s();

/// (b) Least amplitude of half a sine of w = 4 p that overturns it, eta = a / (g tan alpha), to 1e-5; NaN if that is
/// not between 1.5 and 4.5.
double overturning_eta(const Setting& setting);
double exact_overturning_eta();

/// Block-steps per simulated second of the specimen as it is meant: six free drums of 48 x 29 mm.
double specimen_cost(const Setting& setting);

/// (c) The specimen under 10 cycles of 3 Hz, friction and drum widths drawn.
struct Ensemble {
    std::vector<char> collapsed; ///< (realizations) the same draws whatever the setting
    std::uint64_t invalid = 0;
    double cost = 0;           ///< block-steps per simulated second
    double worst_residual = 0; ///< of the energy
    double probability() const;
};
Ensemble collapses(const Setting& setting, double pga_m_s2, std::uint64_t realizations);

/// An amplitude with which about half of them collapse [m/s2]: the best of ten halvings of 1 to 9 m/s2 with 64
/// realizations.
double steep_place(const Setting& setting);

/// Realizations of which one has collapsed and not the other.
std::uint64_t differing(const Ensemble& a, const Ensemble& b);

struct Report {
    std::string text;                                 ///< Markdown
    std::vector<verification::Series> quarter_period; ///< |error| over cost
    std::vector<verification::Series> overturning;    ///< |error| over cost
    std::vector<verification::Series> collapse;       ///< difference of the probability from a fine step over cost
};

/// Errors of the monolith against the rigid block, over K_N, step, form, damping and K_T; and of limits of K_N.
void monolith_tables(Report& report);

/// Probabilities of collapse over the step against a fine one, and what the step bound of the structure saves.
/// @param realizations of each ensemble
void collapse_tables(Report& report, std::uint64_t realizations);

void draw(const Report& report, const std::filesystem::path& png);

/// As it is called in tables.
const char* name(ContactForm form);
const char* name(DampingAt damping);

} // namespace stylobate::work
