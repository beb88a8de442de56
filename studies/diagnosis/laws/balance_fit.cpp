#include "studies/diagnosis/laws/balance_fit.hpp"

#include "studies/diagnosis/laws/robust_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

// What smoothing, finite contacts and small rotations leave out, over the weight: samples of wide windows would else
// count as exact.
constexpr double least_sd = 0.01;
// What the path costs after which wear ends, in nats: half of ln(samples) for some fifty of them.
constexpr double price_of_an_end = 2;
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

/// Sum over the terms of a law at a joint (-1: any) of weight x what `value` says.
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

} // namespace

double CauseFit::gain_without_best() const
{
    return gain_by_run.empty() ? gain : gain - *std::max_element(gain_by_run.begin(), gain_by_run.end());
}

BalanceFit::BalanceFit(const Specimen& specimen, std::vector<LawSample> samples, double friction, int runs,
                       const Scatter& scatter)
    : specimen_(specimen), samples_(std::move(samples)), friction_(friction), runs_(runs), scatter_(scatter)
{
    if (!samples_.empty())
        baseline_ = regress({}, nullptr);
}

BalanceFit::Column BalanceFit::column(const Cause& cause) const
{
    const double mu = friction_;
    Column values;
    for (const LawSample& s : samples_) {
        double v = 0;
        if (cause.mechanism == "joint_friction")
            v = sum_of(s, Law::sliding, cause.joint, [&](const LawTerm& t) { return mu * t.normal; });
        else if (cause.mechanism == "stribeck")
            v = sum_of(s, Law::sliding, cause.joint, [&](const LawTerm& t) {
                return mu * t.normal * std::exp(-std::fabs(t.slip_m_s) / cause.fixed);
            });
        else if (cause.mechanism == "friction_wear")
            v = sum_of(s, Law::sliding, cause.joint, [&](const LawTerm& t) {
                return -mu * t.normal * (cause.fixed > 0 ? std::min(t.slip_path_m, cause.fixed) : t.slip_path_m);
            });
        else if (cause.mechanism == "dowel")
            v = sum_of(s, Law::sliding, cause.joint,
                       [&](const LawTerm& t) { return t.sign * dead_zone(t.slip_m, cause.fixed) / t.rest_weight_n; });
        else if (cause.mechanism == "corner_loss")
            v = sum_of(s, Law::rocking, cause.joint, [&](const LawTerm& t) {
                const bool left = t.sign > 0;
                const bool chipped = cause.side.empty() || (cause.side == "left") == left;
                return chipped ? t.normal / t.half_width_m : 0;
            });
        else if (cause.mechanism == "corner_wear")
            v = sum_of(s, Law::rocking, cause.joint,
                       [&](const LawTerm& t) { return t.normal / t.half_width_m * t.rotation_path_rad; });
        else if (cause.mechanism == "drag")
            v = over_blocks(s, cause.block, [&](int b) {
                const auto k = static_cast<std::size_t>(b);
                const double vx = s.motion[1][in_x][k], vy = s.motion[1][in_y][k], speed = std::hypot(vx, vy);
                return pushed(s, b, -speed * vx, -speed * vy, 0);
            });
        else if (cause.mechanism == "eccentricity")
            v = over_blocks(s, cause.block, [&](int b) { return off_centre(specimen_, s, b); });
        values.push_back(v);
    }
    return values;
}

BalanceFit::Result BalanceFit::regress(const std::vector<Column>& given, const Column* tried) const
{
    std::vector<Column> columns;
    std::vector<double> prior;
    const auto add = [&](Column column, double sd) {
        columns.push_back(std::move(column));
        prior.push_back(sd);
    };
    const auto each = [&](auto&& value) {
        Column column;
        for (const LawSample& s : samples_)
            column.push_back(value(s));
        return column;
    };
    const auto normal = [](const LawTerm& t) { return t.normal; };
    const auto slides = [&](int joint) {
        return each([&](const LawSample& s) { return friction_ * sum_of(s, Law::sliding, joint, normal); });
    };
    const auto turns = [&](int joint) {
        return each([&](const LawSample& s) { return sum_of(s, Law::rocking, joint, normal); });
    };
    add(slides(-1), scatter_.common_friction);
    add(turns(-1), scatter_.common_turning);
    for (int j = 0; j < static_cast<int>(specimen_.joints.size()); ++j) {
        add(slides(j), scatter_.friction);
        add(turns(j), scatter_.turning_point);
    }
    for (int b = 0; b < specimen_.blocks(); ++b)
        add(each([&](const LawSample& s) { return off_centre(specimen_, s, b); }),
            scatter_.mass_centre * specimen_.half_width_m[static_cast<std::size_t>(b)]);
    for (const Column& column : given)
        add(column, std::numeric_limits<double>::infinity());
    if (tried)
        add(*tried, std::numeric_limits<double>::infinity());

    const auto n = static_cast<Eigen::Index>(samples_.size()), p = static_cast<Eigen::Index>(columns.size());
    RegressionData data;
    data.columns.resize(n, p);
    data.values.resize(n);
    data.sd.resize(n);
    data.prior_sd.resize(p);
    data.groups = 2;
    // columns of one size: the regression then knows no units
    std::vector<double> size(columns.size(), 1);
    for (Eigen::Index k = 0; k < p; ++k) {
        const auto c = static_cast<std::size_t>(k);
        double most = 0;
        for (const double v : columns[c])
            most = std::max(most, std::fabs(v));
        size[c] = most > 0 ? most : 1;
        data.prior_sd(k) = prior[c] * size[c];
        for (Eigen::Index i = 0; i < n; ++i)
            data.columns(i, k) = columns[c][static_cast<std::size_t>(i)] / size[c];
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const LawSample& s = samples_[static_cast<std::size_t>(i)];
        data.values(i) = s.value;
        data.sd(i) = std::hypot(s.sd, least_sd);
        data.group.push_back(s.terms.front().law == Law::sliding ? 0 : 1);
    }
    const RobustFit fit = robust_fit(data);

    Result result;
    result.log_posterior = fit.log_posterior;
    result.by_run.assign(static_cast<std::size_t>(runs_), 0);
    for (Eigen::Index i = 0; i < n; ++i)
        result.by_run[static_cast<std::size_t>(samples_[static_cast<std::size_t>(i)].run)] += fit.log_density(i);
    if (tried) {
        result.size = fit.coefficients(p - 1) / size.back();
        result.sd = std::sqrt(fit.covariance(p - 1, p - 1)) / size.back();
    }
    result.friction = fit.coefficients(0) / size[0];
    result.friction_sd = std::sqrt(fit.covariance(0, 0)) / size[0];
    const Eigen::VectorXd rest = data.values - data.columns * fit.coefficients;
    for (Eigen::Index i = 0; i < n; ++i)
        result.residuals.push_back(rest(i) / (data.sd(i) * fit.scale(data.group[static_cast<std::size_t>(i)])));
    return result;
}

CauseFit BalanceFit::fit(const Cause& cause, const std::vector<Cause>& given) const
{
    CauseFit out;
    out.cause = cause;
    out.gain_by_run.assign(static_cast<std::size_t>(runs_), 0);
    out.size = cause.neutral;
    const Column tried = column(cause);
    if (std::all_of(tried.begin(), tried.end(), [](double v) { return v == 0; }))
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
        out.size = mean / (mean + after.size);
        out.sd = after.sd * out.size / (mean + after.size);
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
            return t.law == Law::sliding && at_joint(t, cause.joint) && t.slip_path_m < worn_enough * cause.fixed;
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
    const auto try_column = [&](Structure structure, auto&& value) {
        Column tried;
        for (const LawSample& s : samples_)
            tried.push_back(value(s));
        if (std::all_of(tried.begin(), tried.end(), [](double v) { return v == 0; }))
            return;
        const Result after = regress(columns, &tried);
        StructureFit fit{
            std::move(structure), std::max(0.0, after.log_posterior - before.log_posterior), after.size, after.sd, {}};
        for (std::size_t r = 0; r < after.by_run.size(); ++r)
            fit.gain_by_run.push_back(after.by_run[r] - before.by_run[r]);
        found.push_back(std::move(fit));
    };
    const auto friction = [&](const char* depends_on, const char* text, auto&& value) {
        try_column({-1, "x", depends_on, text}, [&](const LawSample& s) {
            return sum_of(s, Law::sliding, -1, [&](const LawTerm& t) { return t.normal * value(s, t); });
        });
    };
    friction("direction", "friction that differs between slip to the left and to the right",
             [](const LawSample&, const LawTerm& t) { return t.sign; });
    friction("recent slip", "friction that changes with the recent slip of the joint and recovers",
             [](const LawSample&, const LawTerm& t) { return t.recent_slip_m; });
    friction("time", "friction that drifts with time", [](const LawSample& s, const LawTerm&) { return s.time_s; });
    friction("position", "friction that depends on the slip position of the joint",
             [](const LawSample&, const LawTerm& t) { return t.slip_m; });
    friction("normal force", "friction that is not in proportion to the normal force",
             [](const LawSample&, const LawTerm& t) { return t.normal; });

    for (int block = -1; block < specimen_.blocks(); ++block) {
        const std::string who = block < 0 ? "each block" : fmt::format("block {}", block);
        const auto force = [&](Component to, const char* depends_on, const char* on, auto&& value) {
            try_column({block, component_names[static_cast<std::size_t>(to)], depends_on,
                        fmt::format("a {} on {} that varies with {}",
                                    to == in_x   ? "sideways force"
                                    : to == in_y ? "vertical force"
                                                 : "moment",
                                    who, on)},
                       [&](const LawSample& s) {
                           return over_blocks(s, block, [&](int b) {
                               const auto k = static_cast<std::size_t>(b);
                               // in proportion to the mass, or to mass x half width
                               const double by = specimen_.mass_kg[k] * value(s, k) *
                                                 (to == in_theta ? specimen_.half_width_m[k] : 1);
                               return pushed(s, b, to == in_x ? by : 0, to == in_y ? by : 0, to == in_theta ? by : 0);
                           });
                       });
        };
        for (const Component to : {in_x, in_y}) {
            force(to, "nothing", "none: it is constant", [](const LawSample&, std::size_t) { return 1.0; });
            force(to, "time", "time", [](const LawSample& s, std::size_t) { return s.time_s; });
            force(to, "velocity", "its sideways velocity",
                  [](const LawSample& s, std::size_t k) { return s.motion[1][in_x][k]; });
            force(to, "vertical velocity", "its vertical velocity",
                  [](const LawSample& s, std::size_t k) { return s.motion[1][in_y][k]; });
            force(to, "angular velocity", "its angular velocity",
                  [](const LawSample& s, std::size_t k) { return s.motion[1][in_theta][k]; });
            force(to, "position", "its sideways displacement",
                  [&](const LawSample& s, std::size_t k) { return s.motion[0][in_x][k] - specimen_.rest_x_m[k]; });
            force(to, "rotation", "its rotation",
                  [](const LawSample& s, std::size_t k) { return s.motion[0][in_theta][k]; });
        }
        force(in_theta, "angular velocity", "its angular velocity",
              [](const LawSample& s, std::size_t k) { return s.motion[1][in_theta][k]; });
        force(in_theta, "rotation", "its rotation",
              [](const LawSample& s, std::size_t k) { return s.motion[0][in_theta][k]; });
    }
    std::sort(found.begin(), found.end(), [](const StructureFit& a, const StructureFit& b) { return a.gain > b.gain; });
    return found;
}

std::vector<Cause> balance_causes(const Specimen& specimen, const TrackScales& scales)
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
        for (const double part : {0.0, 0.1, 0.2, 0.4, 0.8}) {
            const bool all = j == joints;
            Cause worn{"friction_wear", all ? "all" : fmt::format("joint {}", j), "wear_per_m", "1/m", 0};
            worn.joint = all ? -1 : j;
            worn.fixed = part * length;
            causes.push_back(worn);
        }
    for (int j = 0; j < joints; ++j) {
        for (const char* side : {"", "left", "right"}) {
            Cause chip{"corner_loss", fmt::format("joint {}", j), "loss_m", "m", 0};
            chip.joint = j;
            chip.side = side;
            causes.push_back(chip);
        }
        Cause wear{"corner_wear", fmt::format("joint {}", j), "wear_m_rad", "m/rad", 0};
        wear.joint = j;
        causes.push_back(wear);
        for (const double gap : {0.0, 0.0025, 0.005, 0.01, 0.02}) {
            Cause dowel{"dowel", fmt::format("joint {}", j), "stiffness_n_m", "N/m", 0};
            dowel.joint = j;
            dowel.fixed = gap * length;
            causes.push_back(dowel);
        }
    }
    causes.push_back({"drag", "all", "coefficient_n_s2_m2", "N s2/m2", 0});
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
