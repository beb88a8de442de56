#pragma once
/// The density of estimates under each hypothesis over that of a healthy specimen: multivariate Student with 8 degrees
/// of freedom, whose scale matrix is the covariance; of more than 8 estimates normal in its middle. All estimates so
/// far have one joint density, so that a test counts given the tests before it, with which it shares friction and
/// widths. Marginals of a multivariate Student density are of the same kind (Kotz & Nadarajah, "Multivariate t
/// distributions and their applications" (2004)); so the ratios are a martingale under the healthy density, in any
/// order of the tests, as far as its middle is Student's too.

#include "studies/measured/loop/signatures.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

constexpr double estimate_freedom = 8;

/// One distribution of the estimates: a part of the sizes of a cause, or something that is not in the list.
struct Hypothesis {
    int cause = -1;                     ///< of `Hypotheses::causes`; -1: not listed
    double size = 0, from = 0, to = 0;  ///< middle and ends of its sizes
    double share = 0;                   ///< of its cause, or of what is not listed; sums to 1
    std::vector<Eigen::Index> unlisted; ///< not listed: the columns that are off, all by the same number
    Eigen::VectorXd shift;              ///< (p) of the mean
    Eigen::MatrixXd spread;             ///< (p x k) scatter beside that of healthy specimens: its covariance is S S'
};

/// Shift and additional variance of a cause at any size of one sign, linear between 0 and the simulated sizes, and in
/// proportion to the strongest one beyond it.
struct ShiftOfSize {
    std::vector<double> sizes; ///< of one sign, ascending in magnitude
    std::vector<const CauseSignature*> at;
    Eigen::VectorXd shift(double size) const;
    Eigen::VectorXd variance(double size) const;
    /// (p x k) All scatter beside that of healthy specimens; its covariance, S S', is linear in the size.
    Eigen::MatrixXd spread(double size) const;
};

struct Hypotheses {
    std::vector<CausePlace> causes;
    std::vector<Hypothesis> each;

    /// Of each cause the simulated sizes and the middles between them, each with the sizes around it: between half of
    /// the weakest and, beyond the strongest, as far as its cell reaches on the other side. The sizes of a cell are
    /// spread evenly. What is not listed: one estimator at one joint, or the same at all joints, has 6 times its
    /// healthy scatter.
    explicit Hypotheses(const Signatures& signatures);
};

/// Sizes of a cause by sign: those above 0, and those below.
std::vector<ShiftOfSize> shifts_of(const Signatures& signatures, const CausePlace& cause);

/// What a squared distance takes off the logarithm of the density: Student's tails, for outliers. Nearer than n less
/// the degrees of freedom it goes on along the tangent, as for normal numbers: many quiet estimates, of a laboratory
/// better than its stated floors, shall not teach that all are quieter than stated. One that is off would count twice.
double surprise(double squares, Eigen::Index estimates);

/// Densities of the estimates in given columns.
class JointDensity {
public:
    /// @param columns in the order in which they are measured; a column that is there twice is a repeat
    JointDensity(const Signatures& signatures, const Hypotheses& hypotheses, const std::vector<Eigen::Index>& columns);

    /// Estimates without scale and correlation, each given those before it, from what healthy specimens give.
    /// @param values (columns)
    Eigen::VectorXd whitened(const Eigen::VectorXd& values) const;
    /// The same of a shift.
    Eigen::VectorXd whitened_shift(const Eigen::VectorXd& shift) const;

    /// (hypotheses) logarithm of the density over the healthy one
    Eigen::VectorXd log_ratios(const Eigen::VectorXd& white) const;
    /// (hypotheses) distance of the shift from healthy specimens, in standard deviations along itself; the spread of
    /// what is not listed
    const Eigen::VectorXd& distances() const { return distances_; }
    bool shows(std::size_t hypothesis) const { return seen_[hypothesis].shows; }

    /// Estimates that follow the first ones, drawn from the density of a hypothesis given those.
    /// @param hypothesis nothing: a healthy specimen   @param first (d) whitened, of the first columns
    /// @param normals (columns - d + at least the ranks of the hypothesis) standard normal numbers
    /// @param u in (0, 1), for the radius of the Student density
    /// @return (columns) whitened, the first ones as given
    Eigen::VectorXd continued(std::optional<std::size_t> hypothesis, const Eigen::VectorXd& first,
                              const Eigen::VectorXd& normals, double u) const;

private:
    struct Seen {
        bool shows = false;
        Eigen::VectorXd shift;    ///< (columns) whitened
        Eigen::MatrixXd spread;   ///< (columns x k) whitened
        Eigen::MatrixXd narrowed; ///< (k x columns) what the spread takes off the squared distance
        double half_log_determinant = 0;
    };
    std::vector<Eigen::Index> columns_;
    Eigen::VectorXd mean_;
    Eigen::LLT<Eigen::MatrixXd> root_;
    std::vector<Seen> seen_;
    Eigen::VectorXd distances_;
};

} // namespace stylobate
