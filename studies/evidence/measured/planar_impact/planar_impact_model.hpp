#pragma once
/// Parametrized contact laws of an impact, and their fit: the engine's law, and one term more at a time.
///
/// On what do the errors of a law depend? Regressions of residuals on covariates, each against its null.

#include "studies/evidence/measured/planar_impact/planar_impact_law.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace stylobate::measured::impact {

/// What takes the normal energy.
enum class Loss {
    dashpot, ///< C_N, the engine's law
    rate,    ///< C_N = lambda K_N A, Hunt and Crossley's (`rate_damping`)
    recoil   ///< the surface is a free body that recoils, over a constant lambda
};

/// A term that a law can have besides. The first six multiply the loss by exp(polynomial of a covariate).
enum class Term {
    place,            ///< along the surface, quadratic
    speed,            ///< normal, linear
    lever_arm,        ///< r_n, quadratic
    tangential_speed, ///< quadratic
    spin,             ///< quadratic
    order,            ///< in time, quadratic
    orientation,      ///< the orientation is another by a constant angle
    latency,          ///< and by spin x a constant time
    tilt,             ///< of the surface
    stribeck,         ///< friction falls with the speed of sliding
    rolling,          ///< moment against the spin
    inertia           ///< effective moment of inertia
};
inline constexpr int term_count = 12;
const char* to_string(Term term);
const char* to_string(Loss loss);

/// A law with free parameters: logarithms of mu, K_T, C_T and of the loss (of lambda, and of the mass ratio, where the
/// surface recoils), then those of the terms.
struct Model {
    Loss loss = Loss::dashpot;
    std::vector<Term> terms;
    double K_N = 1e8; ///< [N/m2]

    Model with(Term term) const;
    bool has(Term term) const;
    /// Where a fit begins: all terms neutral.
    std::vector<double> start(const Body& body) const;
    ImpactLaw law(const Body& body, const Impact& impact, std::span<const double> parameters) const;
    std::vector<std::string> names() const; ///< of the parameters, with units
};

/// Predicted velocities after the impacts.
std::vector<Velocity> predict(const Body& body, const Model& model, std::span<const double> parameters,
                              const std::vector<Impact>& impacts);

/// Relative errors of predicted velocities; a law that failed has the error 10.
std::vector<double> errors(const Body& body, const std::vector<Velocity>& predicted,
                           const std::vector<Impact>& impacts);

/// What a fit makes least: the mean of the errors, each counted as 0.6 at most, so that impacts that no law explains
/// do not decide.
double misfit(const std::vector<double>& errors);

/// Least value of a function by the simplex of Nelder and Mead (1965) with the coefficients of Gao and Han (2012),
/// begun anew from its end until that gains nothing.
/// @param scale of the first simplex
/// @param evaluations at most, in all
std::vector<double> minimize(const std::function<double(std::span<const double>)>& f, std::vector<double> start,
                             double scale, int evaluations);

/// Parameters that fit impacts best, from `from` (default: the start of the model).
std::vector<double> fit(const Body& body, const Model& model, const std::vector<Impact>& impacts,
                        std::vector<double> from = {}, int evaluations = 1200);

/// mu and e of a rigid impact, the same way.
struct RigidFit {
    double mu = 0;
    double e = 0;
};
/// @param arms of each impact
RigidFit fit_rigid(const Body& body, Restitution rule, const std::vector<Impact>& impacts,
                   const std::vector<Arms>& arms);
std::vector<Velocity> predict_rigid(const Body& body, Restitution rule, const RigidFit& law,
                                    const std::vector<Impact>& impacts, const std::vector<Arms>& arms);

/// What a law leaves of each impact, at the lowest point.
struct Residuals {
    std::vector<double> restitution; ///< (v_n measured - predicted) over the closing speed
    std::vector<double> friction;    ///< P_t / P_n, measured - predicted
    std::vector<double> lever;       ///< line of action from the lowest point [m]; no law enters
};

/// @param turn added to the table's orientation [rad]
Residuals residuals(const Body& body, const std::vector<Impact>& impacts, const std::vector<Velocity>& predicted,
                    double turn);

/// A candidate's columns (n_impact x few): a cubic of one covariate, or a harmonic.
struct Candidate {
    std::string name;
    Eigen::MatrixXd columns;
};
std::vector<Candidate> candidates(const Body& body, const std::vector<Impact>& impacts);

struct Dependence {
    double share = 0;   ///< of the variance of the residual, after what is `given`, that the candidate explains
    double null_99 = 0; ///< what shuffled residuals give in 1 of 100 shufflings
    double p = 1;       ///< of the null: (1 + shufflings that explain as much) / (1 + shufflings)
};

/// Least squares; the null shuffles what is left of the residual after `given` (Freedman and Lane 1983).
/// @param given columns that are taken out of both first (n x any, 0 columns: none); a constant always is
Dependence dependence(const std::vector<double>& residual, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& given,
                      int shufflings, std::uint64_t seed);

/// Correlation of neighbours in the order of the impacts.
double neighbour_correlation(const std::vector<double>& values);

/// Kernel ridge regression (Gaussian, `length` standard deviations of each column) from one set of impacts to another.
/// @param from, to columns (n x d);  @param values (n x 3);  @param weight of each row of `from`
Eigen::MatrixXd smooth_prediction(const Eigen::MatrixXd& from, const Eigen::MatrixXd& values,
                                  const Eigen::VectorXd& weight, const Eigen::MatrixXd& to, double length,
                                  double ridge);

double quantile(std::vector<double> values, double part);

/// A relative gain of the median error, 1 - after / before, with the 95 % interval of resampled impacts.
struct Gain {
    double value = 0;
    double low = 0;
    double high = 0;
};
Gain gain(const std::vector<double>& before, const std::vector<double>& after, std::uint64_t seed);

} // namespace stylobate::measured::impact
