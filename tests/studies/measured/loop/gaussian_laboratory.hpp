#pragma once
/// A laboratory of Gaussian estimators for the tests of the sequence: its densities are known in closed form, and it
/// shares no code with what is tested.

#include "studies/measured/loop/sequence.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace stylobate::gaussian {

/// Student's density with 8 degrees of freedom, location m and squared scale s2.
inline double student_density(double x, double m, double s2)
{
    const double v = 8;
    return std::tgamma((v + 1) / 2) / std::tgamma(v / 2) / std::sqrt(v * std::numbers::pi * s2) *
           std::pow(1 + (x - m) * (x - m) / (v * s2), -(v + 1) / 2);
}

/// Two estimates with scale matrix (a, c; c, b), at the same distance from their locations in x and y.
inline double student_density(double x, double y, double a, double b, double c)
{
    const double v = 8, det = a * b - c * c, q = (b * x * x - 2 * c * x * y + a * y * y) / det;
    return std::tgamma((v + 2) / 2) / std::tgamma(v / 2) / (v * std::numbers::pi * std::sqrt(det)) *
           std::pow(1 + q / v, -(v + 2) / 2);
}

/// Signatures as given, all columns used; columns of one test and name are alike.
inline Signatures signatures(const std::vector<TestColumn>& columns, const Eigen::VectorXd& mean,
                             const Eigen::MatrixXd& covariance, double floor_sd,
                             const std::vector<CauseSignature>& causes)
{
    Signatures s;
    s.columns = columns;
    s.used.assign(columns.size(), true);
    for (std::size_t j = 0; j < columns.size(); ++j) {
        bool found = false;
        for (auto& group : s.alike)
            if (const TestColumn& first = columns[static_cast<std::size_t>(group[0])];
                first.test == columns[j].test && first.name == columns[j].name) {
                group.push_back(static_cast<Eigen::Index>(j));
                found = true;
            }
        if (!found)
            s.alike.push_back({static_cast<Eigen::Index>(j)});
    }
    s.mean = mean;
    s.covariance = covariance;
    s.floor_variance = Eigen::VectorXd::Constant(mean.size(), floor_sd * floor_sd);
    s.causes = causes;
    return s;
}

/// A cause that shifts some columns.
inline CauseSignature cause(const std::string& mechanism, const std::string& place, double size, Eigen::Index p,
                            const std::vector<std::pair<Eigen::Index, double>>& shifts, double variance = 0)
{
    CauseSignature out{{mechanism, place, size, ""}, Eigen::VectorXd::Zero(p), Eigen::VectorXd::Zero(p)};
    for (const auto& [column, shift] : shifts) {
        out.shift(column) = shift;
        out.variance(column) = variance;
    }
    return out;
}

/// Three joints, four kinds of tests with one estimator each: the values of one kind have a common part of scatter 5
/// (the contact law) and an own one of 0.5 at each joint. Friction shows in `pull` and `slide`, a lost corner in `push`
/// and `tilt`, each at one joint; `drop` shows nothing.
inline constexpr int joints = 3;
inline constexpr double common_sd = 5, own_sd = 0.5, floor_sd = 0.3;

inline std::vector<TestColumn> columns()
{
    std::vector<TestColumn> out;
    for (const auto& [test, name] : std::vector<std::pair<RunKind, std::string>>{{RunKind::pull, "ratio"},
                                                                                 {RunKind::slide, "deceleration"},
                                                                                 {RunKind::push, "plateau"},
                                                                                 {RunKind::tilt, "bearing width"},
                                                                                 {RunKind::drop, "time"}})
        for (int j = 0; j < joints; ++j)
            out.push_back({test, j, name, "", "", floor_sd});
    return out;
}

/// Of the columns above: the law is one number of friction for `pull` and `slide`, one of shape for `push` and `tilt`.
inline Eigen::MatrixXd covariance()
{
    const Eigen::Index p = 5 * joints;
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(p, p);
    for (Eigen::Index i = 0; i < p; ++i)
        for (Eigen::Index j = 0; j < p; ++j)
            out(i, j) = (i / joints / 2 == j / joints / 2 ? common_sd * common_sd : 0) + (i == j ? own_sd * own_sd : 0);
    return out;
}

/// Shifts of a cause at a joint, for size 1 (6) and 2 (12).
inline std::vector<std::pair<Eigen::Index, double>> shifts(int group, int joint, double size)
{
    const Eigen::Index first = 2 * joints * group + joint;
    return {{first, 6 * size}, {first + joints, 6 * size}};
}

inline std::vector<CauseSignature> causes()
{
    std::vector<CauseSignature> out;
    for (int joint = 0; joint < joints; ++joint)
        for (const double size : {1.0, 2.0}) {
            out.push_back(
                cause("joint_friction", "joint " + std::to_string(joint), size, 5 * joints, shifts(0, joint, size)));
            out.push_back(
                cause("corner_loss", "joint " + std::to_string(joint), size, 5 * joints, shifts(1, joint, size)));
        }
    return out;
}

inline Signatures laboratory()
{
    return signatures(columns(), Eigen::VectorXd::Constant(5 * joints, 10), covariance(), floor_sd, causes());
}

/// Draws specimens: normal, or Student with 8 degrees of freedom.
class Specimens {
public:
    Specimens(const Eigen::MatrixXd& covariance, unsigned seed, bool student = false)
        : root_(covariance.llt().matrixL()), random_(seed), student_(student)
    {
    }
    /// Off the mean.
    Eigen::VectorXd draw()
    {
        Eigen::VectorXd z(root_.rows());
        for (double& value : z)
            value = normal_(random_);
        return root_ * z * (student_ ? std::sqrt(8 / radius_(random_)) : 1.0);
    }

private:
    Eigen::MatrixXd root_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::chi_squared_distribution<double> radius_{8};
    bool student_;
};

/// Estimates of a specimen in the columns of a test.
inline std::vector<SeenEstimate> test_of(const Signatures& s, const Eigen::VectorXd& values, RunKind test,
                                         std::optional<int> joint = {})
{
    std::vector<SeenEstimate> out;
    for (std::size_t j = 0; j < s.columns.size(); ++j)
        if (s.columns[j].test == test && (!joint || s.columns[j].joint == *joint))
            out.push_back({static_cast<Eigen::Index>(j), values(static_cast<Eigen::Index>(j))});
    return out;
}

inline void append(std::vector<SeenEstimate>& to, const std::vector<SeenEstimate>& more)
{
    to.insert(to.end(), more.begin(), more.end());
}

} // namespace stylobate::gaussian
