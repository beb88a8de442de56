#pragma once
/// The results on the page of planar impacts: laws fitted on one half of the impacts and tested on the other,
/// what the errors depend on, and how well the measurement lets one know.

#include "studies/evidence/measured/planar_impact/planar_impact_model.hpp"

#include <functional>
#include <string>
#include <vector>

namespace stylobate::measured::impact {

/// The halves: blocks of 50 consecutive numbers of the published order, by turns. Neighbours in time, which could share
/// a drift, then mostly fall into the same half.
inline constexpr long split_block = 50;

/// A law fitted on the training half.
struct JudgedLaw {
    std::string name;               ///< in the table
    std::string word;               ///< in files
    std::vector<double> parameters; ///< of the fit
    std::vector<Velocity> after;    ///< predicted, of all impacts in their order
    std::vector<double> error;      ///< of the other half
};

/// A term added to a law.
struct AddedTerm {
    Term term = Term::place;
    double training_gain = 0; ///< of the misfit, relative
    Gain gain;                ///< of the other half's median error
    std::vector<double> parameters;
};

/// A candidate against the residuals of the constant law, training half.
struct CandidateLine {
    std::string name;
    Dependence restitution;             ///< alone
    Dependence restitution_given_place; ///< besides the place
    Dependence place_given_it;          ///< and the place besides it
    Dependence restitution_extended;    ///< what the extended law leaves of it
    Dependence friction;                ///< of the friction ratio
    Dependence lever;                   ///< of the line of action; no law enters
};

struct ImpactStudy {
    Body body;
    std::vector<Impact> impacts;
    std::vector<std::size_t> training, other; ///< indices into `impacts`

    // laws, in this order
    enum : std::size_t {
        newton,
        routh_newton,
        routh_poisson,
        constant,
        constant_rate,
        place_dashpot,
        place_rate,
        place_recoil,
        extended,
        law_count
    };
    std::vector<JudgedLaw> laws;
    std::vector<Model> models; ///< of the laws from `constant` on

    // the constant pair of the literature on all impacts given, as it is usually reported
    RigidFit pair_on_all;
    std::vector<double> pair_on_all_error;

    std::vector<AddedTerm> to_constant; ///< every term, to the constant law
    std::vector<AddedTerm> to_extended; ///< and to the extended one
    std::vector<double> shuffled_place; ///< training gains of the term `place` where the places are shuffled
    double true_place = 0;              ///< and the true ones'

    std::vector<CandidateLine> lines;
    double orientation = 0;                 ///< [rad], of the extended law
    double orientation_by_moments = 0;      ///< that takes most out of the moment balance, no law entering
    Gain orientation_interval;              ///< its interval (value, low, high) [rad]
    double rate_place_against_recoil_p = 1; ///< of a sign-flip test of their errors
    double rate_against_dashpot_p = 1;

    std::vector<double> point_floor;     ///< errors of the best impulse in the lowest point, other half
    std::vector<double> isotropic_floor; ///< that scaled from one to three directions
    std::vector<double> smooth;          ///< extended law and a smooth regression of what it leaves, other half
    double residual_neighbours = 0;      ///< correlation of neighbouring restitution residuals, extended law

    struct StiffnessLine {
        double K_N;
        double duration_s;
        std::vector<double> error;
    };
    std::vector<StiffnessLine> stiffness; ///< the extended law fitted at other K_N
    Gain swapped;                         ///< gain of extended over constant with the halves exchanged
    double step_error = 0;                ///< mean change of the extended law's velocities at a tenth of the step
};

/// @param progress is called with a description of each stage
ImpactStudy study_impacts(std::vector<Impact> impacts, const std::function<void(const std::string&)>& progress);

/// p of the null that two laws err alike: mean difference of paired errors (each counted as 0.6 at most) against random
/// signs.
double sign_flip_p(const std::vector<double>& a, const std::vector<double>& b, int flips, std::uint64_t seed);

/// What the length of a vector of independent standard normal components stays below with probability `part` (the root
/// of the quantile of chi2).
/// @param directions 1 or 3 components   @param part in (0, 1)
double length_quantile(int directions, double part);

/// The orientation by which the moment balance holds best: least sum of |residual lever|; golden section within
/// +-0.15 rad.
double orientation_by_moments(const Body& body, const std::vector<Impact>& impacts);

} // namespace stylobate::measured::impact
