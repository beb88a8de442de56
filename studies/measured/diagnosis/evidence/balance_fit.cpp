#include "studies/measured/diagnosis/evidence/balance_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace stylobate {

namespace {

// What smoothing, finite contacts and small rotations leave out, over the weight: samples of wide windows would else
// count as exact.
constexpr double least_sd = 0.01;
// What the path costs after which wear ends, in nats: half of ln(samples) for some fifty of them.
constexpr double price_of_an_end = 2;
// Friction that differs by less differs between healthy joints.
constexpr double friction_matters = 0.12;
constexpr double stribeck_matters = 0.9;
// A sample shows wear that ends if it has this part of it still before it.
constexpr double worn_enough = 0.75;

double dead_zone(double value, double gap)
{
    return value > gap ? value - gap : value < -gap ? value + gap : 0;
}

bool at_joint(const LawTerm& term, int joint)
{
    return joint < 0 || term.joint == joint;
}

/// Sum over the terms of a law at a joint (-1: any) of weight x `value`.
template <class Value>
double sum_of(const LawSample& sample, Law law, int joint, Value&& value)
{
    double sum = 0;
    for (const LawTerm& term : sample.terms)
        if (term.law == law && at_joint(term, joint))
            sum += term.weight * value(term);
    return sum;
}

/// What a force on a block does to the value of a sample.
double pushed(const LawSample& sample, int block, double force_x, double force_y, double moment)
{
    const double* c = &sample.coefficients[3 * static_cast<std::size_t>(block)];
    return c[0] * force_x + c[1] * force_y + c[2] * moment;
}

template <class Push>
double over_blocks(const LawSample& sample, int block, Push&& push)
{
    double sum = 0;
    const int blocks = static_cast<int>(sample.coefficients.size() / 3);
    for (int b = 0; b < blocks; ++b)
        if (block < 0 || b == block)
            sum += push(b);
    return sum;
}

/// For each metre by which a block's centre of mass lies to the right of its middle.
double off_centre(const Specimen& s, const LawSample& sample, int block)
{
    const auto b = static_cast<std::size_t>(block);
    const double m = s.mass_kg[b], c = std::cos(sample.motion[0][in_theta][b]),
                 n = std::sin(sample.motion[0][in_theta][b]);
    const double turn = sample.motion[1][in_theta][b], spin = sample.motion[2][in_theta][b];
    const double ax = sample.motion[2][in_x][b], ay = sample.motion[2][in_y][b];
    return -pushed(sample, block, -m * (spin * n + turn * turn * c), m * (spin * c - turn * turn * n),
                   m * (c * (ay + s.gravity_m_s2) - n * ax));
}

/// Path by which a joint has worn.
double worn_path(const Cause& cause, const LawTerm& term)
{
    return term.slip_path_m + (cause.persists ? term.slip_before_m : 0);
}

/// Friction of all joints that depends on something.
struct FrictionStructure {
    const char* depends_on;
    const char* text;
    double (*value)(const LawSample&, const LawTerm&);
};

constexpr std::array frictions = {
    FrictionStructure{"direction", "friction that differs between slip to the left and to the right",
                      [](const LawSample&, const LawTerm& t) -> double { return t.sign; }},
    FrictionStructure{"recent slip", "friction that changes with the recent slip of the joint and recovers",
                      [](const LawSample&, const LawTerm& t) { return t.recent_slip_m; }},
    FrictionStructure{"time", "friction that drifts with time",
                      [](const LawSample& s, const LawTerm&) { return s.time_s; }},
    FrictionStructure{"position", "friction that depends on the slip position of the joint",
                      [](const LawSample&, const LawTerm& t) { return t.slip_m; }},
    FrictionStructure{"normal force", "friction that is not in proportion to the normal force",
                      [](const LawSample&, const LawTerm& t) { return t.normal; }},
};

/// A force on a block, over its mass, or a moment over mass and half width, that depends on something.
struct ForceStructure {
    Component to;
    const char* depends_on;
    const char* on;
    double (*value)(const Specimen&, const LawSample&, std::size_t block);
};

template <Component to>
constexpr std::array forces_along = {
    ForceStructure{to, "nothing", "none: it is constant",
                   [](const Specimen&, const LawSample&, std::size_t) { return 1.0; }},
    ForceStructure{to, "time", "time", [](const Specimen&, const LawSample& s, std::size_t) { return s.time_s; }},
    ForceStructure{to, "velocity", "its sideways velocity",
                   [](const Specimen&, const LawSample& s, std::size_t k) { return s.motion[1][in_x][k]; }},
    ForceStructure{to, "vertical velocity", "its vertical velocity",
                   [](const Specimen&, const LawSample& s, std::size_t k) { return s.motion[1][in_y][k]; }},
    ForceStructure{to, "angular velocity", "its angular velocity",
                   [](const Specimen&, const LawSample& s, std::size_t k) { return s.motion[1][in_theta][k]; }},
    ForceStructure{to, "position", "its sideways displacement",
                   [](const Specimen& specimen, const LawSample& s, std::size_t k) {
                       return s.motion[0][in_x][k] - specimen.rest_x_m[k];
                   }},
    ForceStructure{to, "rotation", "its rotation",
                   [](const Specimen&, const LawSample& s, std::size_t k) { return s.motion[0][in_theta][k]; }},
};

const std::vector<ForceStructure> force_structures = [] {
    std::vector<ForceStructure> all(forces_along<in_x>.begin(), forces_along<in_x>.end());
    all.insert(all.end(), forces_along<in_y>.begin(), forces_along<in_y>.end());
    all.push_back({in_theta, "angular velocity", "its angular velocity",
                   [](const Specimen&, const LawSample& s, std::size_t k) { return s.motion[1][in_theta][k]; }});
    all.push_back({in_theta, "rotation", "its rotation",
                   [](const Specimen&, const LawSample& s, std::size_t k) { return s.motion[0][in_theta][k]; }});
    return all;
}();

template <class Value>
Eigen::VectorXd each(const std::vector<LawSample>& samples, Value&& value)
{
    Eigen::VectorXd column(static_cast<Eigen::Index>(samples.size()));
    for (std::size_t i = 0; i < samples.size(); ++i)
        column(static_cast<Eigen::Index>(i)) = value(samples[i]);
    return column;
}

/// By which a column is divided: the regression then knows no units.
double size_of(const Eigen::VectorXd& column)
{
    const double most = column.size() > 0 ? column.cwiseAbs().maxCoeff() : 0;
    return most > 0 ? most : 1;
}

// Its column in the baseline's design, after that of the friction.
constexpr std::size_t common_turning = 1;

} // namespace

bool stands_for_unknown(const Cause& cause)
{
    return cause.mechanism == "tie";
}

bool possible(const CauseFit& fit)
{
    const std::string& m = fit.cause.mechanism;
    if (!std::isfinite(fit.size) || !std::isfinite(fit.sd) || fit.gain <= 0)
        return false;
    if (m == "joint_friction")
        return fit.size > 0.05 && fit.size < 3;
    if (m == "stribeck")
        return fit.size > 0.05 && fit.size < 1;
    if (m == "friction_wear" && fit.size * fit.cause.fixed > 1)
        return false; // no friction is left
    if (m == "drag" || m == "dowel" || m == "corner_loss" || m == "corner_wear" || m == "friction_wear")
        return fit.size > 0;
    return true;
}

bool matters(const CauseFit& fit)
{
    const std::string& m = fit.cause.mechanism;
    if (m == "joint_friction")
        return std::fabs(std::log(fit.size)) > friction_matters;
    if (m == "stribeck")
        return fit.size < stribeck_matters;
    return true;
}

BalanceFit::BalanceFit(const Specimen& specimen, std::vector<LawSample> samples, double friction, int runs,
                       const Scatter& scatter)
    : specimen_(&specimen), samples_(std::move(samples)), friction_(friction), runs_(runs), scatter_(scatter)
{
    if (samples_.empty())
        return;
    add_baseline_columns();
    const RobustFit fit = solve({}, nullptr);
    baseline_ = result_of(fit, {}, nullptr);
    prepare_scores(fit);
}

BalanceFit::Column BalanceFit::column(const Cause& cause) const
{
    const double mu = friction_;
    const auto value = [&](const LawSample& s) -> double {
        if (cause.mechanism == "joint_friction")
            return sum_of(s, Law::sliding, cause.joint, [&](const LawTerm& t) { return mu * t.normal; });
        if (cause.mechanism == "stribeck") // what the dynamic friction lacks; the prior is on the static one
            return sum_of(s, Law::sliding, cause.joint, [&](const LawTerm& t) {
                return mu * t.normal * std::expm1(-std::fabs(t.slip_m_s) / cause.fixed);
            });
        if (cause.mechanism == "friction_wear")
            return sum_of(s, Law::sliding, cause.joint, [&](const LawTerm& t) {
                const double path = worn_path(cause, t);
                return -mu * t.normal * (cause.fixed > 0 ? std::min(path, cause.fixed) : path);
            });
        if (cause.mechanism == "dowel")
            return sum_of(s, Law::sliding, cause.joint, [&](const LawTerm& t) {
                return t.sign * dead_zone(t.slip_m, cause.fixed) / t.rest_weight_n;
            });
        if (cause.mechanism == "corner_loss")
            return sum_of(s, Law::rocking, cause.joint, [&](const LawTerm& t) {
                const bool left = t.sign > 0;
                const bool chipped = !cause.side || (cause.side == "left") == left;
                return chipped ? t.normal / t.half_width_m : 0;
            });
        if (cause.mechanism == "corner_wear")
            return sum_of(s, Law::rocking, cause.joint, [&](const LawTerm& t) {
                return t.normal / t.half_width_m * (t.rotation_path_rad + (cause.persists ? t.rotation_before_rad : 0));
            });
        if (cause.mechanism == "drag")
            return over_blocks(s, cause.block, [&](int b) {
                const auto k = static_cast<std::size_t>(b);
                const double vx = s.motion[1][in_x][k], vy = s.motion[1][in_y][k];
                const double per_speed = cause.parameter == "linear_n_s_m" ? 1 : std::hypot(vx, vy);
                return pushed(s, b, -per_speed * vx, -per_speed * vy, 0);
            });
        if (cause.mechanism == "eccentricity")
            return over_blocks(s, cause.block, [&](int b) { return off_centre(*specimen_, s, b); });
        return 0;
    };
    return each(samples_, value);
}

BalanceFit::Column BalanceFit::column(const Structure& structure) const
{
    if (structure.friction) {
        const auto at = std::find_if(frictions.begin(), frictions.end(),
                                     [&](const FrictionStructure& f) { return structure.depends_on == f.depends_on; });
        assert(at != frictions.end());
        return each(samples_, [&](const LawSample& s) {
            return sum_of(s, Law::sliding, -1, [&](const LawTerm& t) { return t.normal * at->value(s, t); });
        });
    }
    const auto at = std::find_if(force_structures.begin(), force_structures.end(), [&](const ForceStructure& f) {
        return structure.coordinate == component_names[static_cast<std::size_t>(f.to)] &&
               structure.depends_on == f.depends_on;
    });
    assert(at != force_structures.end());
    return each(samples_, [&](const LawSample& s) {
        return over_blocks(s, structure.block, [&](int b) {
            const auto k = static_cast<std::size_t>(b);
            // in proportion to the mass, or to mass x half width
            const double by = specimen_->mass_kg[k] * at->value(*specimen_, s, k) *
                              (at->to == in_theta ? specimen_->half_width_m[k] : 1);
            return pushed(s, b, at->to == in_x ? by : 0, at->to == in_y ? by : 0, at->to == in_theta ? by : 0);
        });
    });
}

void BalanceFit::add_baseline_columns()
{
    std::vector<Column> columns;
    const auto add = [&](Column column, double sd) {
        size_.push_back(size_of(column));
        prior_.push_back(sd);
        columns.push_back(std::move(column));
    };
    const auto normal = [](const LawTerm& t) { return t.normal; };
    const auto slides = [&](int joint) {
        return each(samples_, [&](const LawSample& s) { return friction_ * sum_of(s, Law::sliding, joint, normal); });
    };
    const auto turns = [&](int joint) {
        return each(samples_, [&](const LawSample& s) { return sum_of(s, Law::rocking, joint, normal); });
    };
    add(slides(-1), scatter_.common_friction);
    add(turns(-1), scatter_.common_turning);
    for (int j = 0; j < static_cast<int>(specimen_->joints.size()); ++j) {
        add(slides(j), scatter_.friction);
        add(turns(j), scatter_.turning_point);
    }
    for (int b = 0; b < specimen_->blocks(); ++b)
        add(each(samples_, [&](const LawSample& s) { return off_centre(*specimen_, s, b); }),
            scatter_.mass_centre * specimen_->half_width_m[static_cast<std::size_t>(b)]);
    design_.resize(static_cast<Eigen::Index>(samples_.size()), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k)
        design_.col(static_cast<Eigen::Index>(k)) = columns[k] / size_[k];
}

RobustFit BalanceFit::solve(const std::vector<Column>& given, const Column* tried) const
{
    const Eigen::Index n = design_.rows(), fixed = design_.cols();
    const auto p = fixed + static_cast<Eigen::Index>(given.size()) + (tried != nullptr ? 1 : 0);
    RegressionData data;
    data.columns.resize(n, p);
    data.columns.leftCols(fixed) = design_;
    Eigen::Index next = fixed;
    for (const Column& column : given)
        data.columns.col(next++) = column / size_of(column);
    if (tried != nullptr)
        data.columns.col(next) = *tried / size_of(*tried);
    data.prior_sd = Eigen::VectorXd::Constant(p, std::numeric_limits<double>::infinity());
    for (Eigen::Index k = 0; k < fixed; ++k)
        data.prior_sd(k) = prior_[static_cast<std::size_t>(k)] * size_[static_cast<std::size_t>(k)];
    data.one_sided.assign(static_cast<std::size_t>(p), false);
    data.one_sided[common_turning] = true;
    data.values.resize(n);
    data.sd.resize(n);
    data.groups = 2;
    for (Eigen::Index i = 0; i < n; ++i) {
        const LawSample& s = samples_[static_cast<std::size_t>(i)];
        data.values(i) = s.value;
        data.sd(i) = std::hypot(s.sd, least_sd);
        data.group.push_back(s.terms.front().law == Law::sliding ? 0 : 1);
    }
    return robust_fit(data);
}

BalanceFit::Result BalanceFit::regress(const std::vector<Column>& given, const Column* tried) const
{
    return result_of(solve(given, tried), given, tried);
}

BalanceFit::Result BalanceFit::result_of(const RobustFit& fit, const std::vector<Column>& given,
                                         const Column* tried) const
{
    Result result;
    result.log_posterior = fit.log_posterior;
    result.by_run.assign(static_cast<std::size_t>(runs_), 0);
    for (std::size_t i = 0; i < samples_.size(); ++i)
        result.by_run[static_cast<std::size_t>(samples_[i].run)] += fit.log_density(static_cast<Eigen::Index>(i));
    if (tried != nullptr) {
        const Eigen::Index last = design_.cols() + static_cast<Eigen::Index>(given.size());
        result.size = fit.coefficients(last) / size_of(*tried);
        result.sd = std::sqrt(fit.covariance(last, last)) / size_of(*tried);
    }
    result.friction = fit.coefficients(0) / size_[0];
    result.friction_sd = std::sqrt(fit.covariance(0, 0)) / size_[0];
    result.residuals.assign(fit.residuals.begin(), fit.residuals.end());
    return result;
}

void BalanceFit::prepare_scores(const RobustFit& baseline)
{
    Eigen::MatrixXd free = design_;
    for (Eigen::Index k = 0; k < free.cols(); ++k)
        if (baseline.held[static_cast<std::size_t>(k)])
            free.col(k).setZero();
    weights_ = baseline.weights;
    const Eigen::VectorXd root = weights_.cwiseSqrt();
    weighted_residuals_ = weights_.cwiseProduct(baseline.errors);
    weighted_design_ = weights_.asDiagonal() * free;
    Eigen::MatrixXd normal = free.transpose() * weighted_design_;
    for (Eigen::Index k = 0; k < normal.rows(); ++k) {
        const auto c = static_cast<std::size_t>(k);
        normal(k, k) += 1 / std::pow(prior_[c] * size_[c], 2);
    }
    normal_.compute(normal);
}

double BalanceFit::score_of(const Column& tried) const
{
    constexpr double unseen = 1e-6; // of its information that the baseline leaves
    const double size = size_of(tried);
    const Column c = tried / size;
    const double alone = c.dot(weights_.cwiseProduct(c));
    const Eigen::VectorXd along = weighted_design_.transpose() * c;
    const double information = alone - along.dot(normal_.solve(along));
    if (!(information > unseen * alone) || alone == 0)
        return std::numeric_limits<double>::quiet_NaN();
    return c.dot(weighted_residuals_) / std::sqrt(information);
}

CauseFit BalanceFit::fit(const Cause& cause, const std::vector<Cause>& given) const
{
    CauseFit out;
    out.cause = cause;
    out.gain_by_run.assign(static_cast<std::size_t>(runs_), 0);
    out.size = cause.neutral;
    const Column tried = column(cause);
    if ((tried.array() == 0).all())
        return out; // the joint never slid, or never rocked
    if (cause.mechanism == "friction_wear" && cause.fixed > 0 && !seen_wearing(cause))
        return out; // worn from the first sample on: a joint of less friction
    std::vector<Column> columns;
    for (const Cause& other : given)
        columns.push_back(column(other));
    const Result before = given.empty() ? baseline_ : regress(columns, nullptr);
    const Result after = regress(columns, &tried);
    out.gain = std::max(0.0, after.log_posterior - before.log_posterior);
    for (std::size_t r = 0; r < out.gain_by_run.size(); ++r)
        out.gain_by_run[r] = after.by_run[r] - before.by_run[r];
    out.size = after.size;
    out.sd = after.sd;
    const double mean = 1 + after.friction;
    if (cause.mechanism == "joint_friction") {
        out.size = (mean + after.size) / mean;
        out.sd = after.sd / mean;
    } else if (cause.mechanism == "stribeck") {
        out.size = (mean - after.size) / mean;
        out.sd = after.sd / mean;
    } else if (cause.mechanism == "friction_wear") {
        out.size = after.size / mean;
        out.sd = after.sd / mean;
        // friction that was less all along explains nearly as much with one parameter less
        if (cause.fixed > 0)
            out.gain = std::max(0.0, out.gain - price_of_an_end);
    }
    return out;
}

bool BalanceFit::seen_wearing(const Cause& cause) const
{
    return std::any_of(samples_.begin(), samples_.end(), [&](const LawSample& s) {
        return std::any_of(s.terms.begin(), s.terms.end(), [&](const LawTerm& t) {
            return t.law == Law::sliding && at_joint(t, cause.joint) && worn_path(cause, t) < worn_enough * cause.fixed;
        });
    });
}

int BalanceFit::samples_of(Law law, int joint) const
{
    return static_cast<int>(std::count_if(samples_.begin(), samples_.end(), [&](const LawSample& s) {
        return std::any_of(s.terms.begin(), s.terms.end(),
                           [&](const LawTerm& t) { return t.law == law && at_joint(t, joint); });
    }));
}

std::vector<StructureFit> BalanceFit::describe(const std::vector<Cause>& given) const
{
    std::vector<Column> columns;
    for (const Cause& cause : given)
        columns.push_back(column(cause));
    const Result before = given.empty() ? baseline_ : regress(columns, nullptr);
    std::vector<StructureFit> found;
    for (Structure& structure : balance_structures(*specimen_)) {
        const Column tried = column(structure);
        if ((tried.array() == 0).all())
            continue;
        const Result after = regress(columns, &tried);
        StructureFit fit{
            std::move(structure), std::max(0.0, after.log_posterior - before.log_posterior), after.size, after.sd, {}};
        for (std::size_t r = 0; r < after.by_run.size(); ++r)
            fit.gain_by_run.push_back(after.by_run[r] - before.by_run[r]);
        found.push_back(std::move(fit));
    }
    std::sort(found.begin(), found.end(), [](const StructureFit& a, const StructureFit& b) { return a.gain > b.gain; });
    return found;
}

std::vector<Structure> balance_structures(const Specimen& specimen)
{
    std::vector<Structure> all;
    for (const FrictionStructure& f : frictions)
        all.push_back({-1, "x", f.depends_on, f.text, true});
    for (int block = -1; block < specimen.blocks(); ++block) {
        const std::string who = block < 0 ? "each block" : fmt::format("block {}", block);
        for (const ForceStructure& f : force_structures)
            all.push_back({block, component_names[static_cast<std::size_t>(f.to)], f.depends_on,
                           fmt::format("a {} on {} that varies with {}",
                                       f.to == in_x   ? "sideways force"
                                       : f.to == in_y ? "vertical force"
                                                      : "moment",
                                       who, f.on),
                           false});
    }
    return all;
}

std::vector<Cause> balance_causes(const Specimen& specimen, const CampaignScales& scales)
{
    const double length = scales.time_s * scales.time_s * specimen.gravity_m_s2; // height of the specimen
    const double speed = length / scales.time_s;
    std::vector<Cause> causes;
    const int joints = static_cast<int>(specimen.joints.size());
    for (int j = 0; j < joints; ++j) {
        Cause friction{"joint_friction", fmt::format("joint {}", j), "ratio", "", 1};
        friction.joint = j;
        causes.push_back(friction);
    }
    for (const double part : {0.005, 0.01, 0.02, 0.04, 0.08, 0.16}) {
        Cause stribeck{"stribeck", "all", "dynamic_ratio", "", 1};
        stribeck.fixed = part * speed;
        causes.push_back(stribeck);
    }
    // Wear goes on for ever, or ends after a path. Where one joint alone slides, that joint is named, not all of them.
    for (int j = 0; j <= joints; ++j)
        for (const double part : {0.0, 0.1, 0.2, 0.4, 0.8})
            for (const bool persists : {false, true}) {
                const bool all = j == joints;
                Cause worn{"friction_wear", all ? "all" : fmt::format("joint {}", j), "wear_per_m", "1/m", 0};
                worn.joint = all ? -1 : j;
                worn.fixed = part * length;
                worn.persists = persists;
                causes.push_back(worn);
            }
    for (int j = 0; j < joints; ++j) {
        for (const std::optional<std::string>& side :
             std::array<std::optional<std::string>, 3>{std::nullopt, "left", "right"}) {
            Cause chip{"corner_loss", fmt::format("joint {}", j), "loss_m", "m", 0};
            chip.joint = j;
            chip.side = side;
            causes.push_back(chip);
        }
        Cause wear{"corner_wear", fmt::format("joint {}", j), "wear_m_rad", "m/rad", 0};
        wear.joint = j;
        for (const bool persists : {false, true}) {
            wear.persists = persists;
            causes.push_back(wear);
        }
        for (const double gap : {0.0, 0.0025, 0.005, 0.01, 0.02}) {
            Cause dowel{"dowel", fmt::format("joint {}", j), "stiffness_n_m", "N/m", 0};
            dowel.joint = j;
            dowel.fixed = gap * length;
            causes.push_back(dowel);
        }
    }
    causes.push_back({"drag", "all", "coefficient_n_s2_m2", "N s2/m2", 0});
    causes.push_back({"drag", "all", "linear_n_s_m", "N s/m", 0});
    for (int b = 0; b < specimen.blocks(); ++b) {
        Cause drag{"drag", fmt::format("block {}", b), "coefficient_n_s2_m2", "N s2/m2", 0};
        drag.block = b;
        causes.push_back(drag);
        Cause centre{"eccentricity", fmt::format("block {}", b), "offset_m", "m", 0};
        centre.block = b;
        causes.push_back(centre);
    }
    return causes;
}

} // namespace stylobate
