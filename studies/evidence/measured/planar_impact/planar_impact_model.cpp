#include "studies/evidence/measured/planar_impact/planar_impact_model.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

namespace stylobate::measured::impact {

namespace {

struct TermInfo {
    const char* name;
    std::vector<const char*> parameters;
};

const TermInfo& info(Term term)
{
    static const std::array<TermInfo, term_count> all{
        {{"place along the surface", {"place, per 0.1 m", "place squared"}},
         {"normal speed", {"speed, per 0.2 m/s"}},
         {"lever arm", {"lever arm, per 10 mm", "lever arm squared"}},
         {"tangential speed", {"tangential speed, per 0.3 m/s", "tangential speed squared"}},
         {"spin", {"spin, per 10 rad/s", "spin squared"}},
         {"order in time", {"order, per 859 impacts", "order squared"}},
         {"constant error of the orientation", {"orientation [0.01 rad]"}},
         {"delay in the orientation", {"latency [ms]"}},
         {"tilt of the surface", {"tilt [0.01 rad]"}},
         {"friction falls with speed", {"ln of moving over standing friction, negative", "ln velocity [ln m/s]"}},
         {"rolling friction", {"moment over force and chord"}},
         {"effective inertia", {"ln effective over published inertia"}}}};
    return all[static_cast<std::size_t>(term)];
}

/// A covariate about the middle of its range, in units of its spread.
double covariate(const Body& body, Term term, const Impact& impact)
{
    const Arms arms = lowest_point(body, impact.theta);
    const ContactVelocity c = at_contact(impact.before, arms);
    switch (term) {
    case Term::place:
        return (impact.x - 0.37) / 0.1;
    case Term::speed:
        return (-c.n - 2.55) / 0.2;
    case Term::lever_arm:
        return arms.n / 0.01;
    case Term::tangential_speed:
        return (c.t + 0.64) / 0.3;
    case Term::spin:
        return impact.before.spin / 10;
    case Term::order:
        return (static_cast<double>(impact.index) - 859) / 859;
    default:
        return 0;
    }
}

} // namespace

const char* to_string(Term term)
{
    return info(term).name;
}

const char* to_string(Loss loss)
{
    return loss == Loss::dashpot ? "constant dashpot" : loss == Loss::rate ? "rate damping" : "recoil of the surface";
}

Model Model::with(Term term) const
{
    Model extended = *this;
    extended.terms.push_back(term);
    return extended;
}

bool Model::has(Term term) const
{
    return std::find(terms.begin(), terms.end(), term) != terms.end();
}

std::vector<double> Model::start(const Body& body) const
{
    // K_T and C_T of the order of the normal ones at a usual chord; the loss gives e of about 0.6
    const double w = std::sqrt(K_N * 0.009 / body.mass);
    std::vector<double> p{std::log(0.19), std::log(0.4 * K_N * 0.01), std::log(0.7 * body.mass * w)};
    switch (loss) {
    case Loss::dashpot:
        p.push_back(std::log(0.28 * body.mass * w));
        break;
    case Loss::rate:
        p.push_back(std::log(0.37));
        break;
    case Loss::recoil:
        p.insert(p.end(), {std::log(0.15), std::log(0.1)});
        break;
    }
    for (const Term term : terms)
        for (std::size_t k = 0; k < info(term).parameters.size(); ++k)
            p.push_back(term == Term::stribeck ? (k == 0 ? -3.0 : -1.5) : 0.0);
    return p;
}

std::vector<std::string> Model::names() const
{
    std::vector<std::string> names{"ln mu", "ln K_T [ln N/m]", "ln C_T [ln N s/m]"};
    if (loss == Loss::dashpot)
        names.push_back("ln C_N [ln N s/m]");
    else
        names.push_back("ln lambda [ln s/m]");
    if (loss == Loss::recoil)
        names.push_back("ln body's over surface's mass");
    for (const Term term : terms)
        for (const char* name : info(term).parameters)
            names.push_back(name);
    return names;
}

ImpactLaw Model::law(const Body& body, const Impact& impact, std::span<const double> parameters) const
{
    const auto next = [&parameters] {
        const double value = parameters.front();
        parameters = parameters.subspan(1);
        return value;
    };
    ImpactLaw law;
    law.K_N = K_N;
    law.mu = std::exp(next());
    law.K_T = std::exp(next());
    law.C_T = std::exp(next());
    const double ln_damping = next();
    double ln_loss = loss == Loss::recoil ? next() : ln_damping;
    for (const Term term : terms) {
        const double first = next();
        const double second = info(term).parameters.size() > 1 ? next() : 0;
        switch (term) {
        case Term::orientation:
            law.turn += 0.01 * first;
            break;
        case Term::latency:
            law.turn += 1e-3 * first * impact.before.spin;
            break;
        case Term::tilt:
            law.tilt = 0.01 * first;
            break;
        case Term::stribeck:
            law.mu_moving = law.mu * std::exp(-std::exp(first));
            law.stribeck = std::exp(second);
            break;
        case Term::rolling:
            law.rolling = std::max(first, 0.0);
            break;
        case Term::inertia:
            law.inertia_ratio = std::exp(first);
            break;
        default: {
            const double c = covariate(body, term, impact);
            ln_loss += c * (first + c * second);
        }
        }
    }
    if (loss == Loss::dashpot)
        law.C_N = std::exp(ln_loss);
    else
        law.rate = std::exp(loss == Loss::rate ? ln_loss : ln_damping);
    if (loss == Loss::recoil)
        law.surface_mass = body.mass / std::exp(ln_loss);
    return law;
}

std::vector<Velocity> predict(const Body& body, const Model& model, std::span<const double> parameters,
                              const std::vector<Impact>& impacts)
{
    std::vector<Velocity> after;
    after.reserve(impacts.size());
    for (const Impact& impact : impacts)
        after.push_back(simulate_impact(body, model.law(body, impact, parameters), impact.before, impact.theta).after);
    return after;
}

std::vector<double> errors(const Body& body, const std::vector<Velocity>& predicted, const std::vector<Impact>& impacts)
{
    constexpr double failed = 10;
    std::vector<double> e(impacts.size());
    for (std::size_t k = 0; k < e.size(); ++k) {
        e[k] = relative_error(body, predicted[k], impacts[k].after);
        if (!(e[k] < failed))
            e[k] = failed;
    }
    return e;
}

double misfit(const std::vector<double>& errors)
{
    double sum = 0;
    for (const double e : errors)
        sum += std::min(e, 0.6);
    return sum / static_cast<double>(errors.size());
}

std::vector<double> minimize(const std::function<double(std::span<const double>)>& f, std::vector<double> start,
                             double scale, int evaluations)
{
    const std::size_t n = start.size();
    const double dimension = static_cast<double>(n);
    const double expand = 1 + 2 / dimension, contract = 0.75 - 0.5 / dimension, shrink = 1 - 1 / dimension;
    struct Corner {
        std::vector<double> at;
        double value;
    };
    const auto corner = [&](std::vector<double> at) {
        --evaluations;
        const double value = f(at);
        return Corner{std::move(at), value};
    };
    Corner best = corner(std::move(start));
    for (bool gained = true; gained && evaluations > 0; scale *= 0.5) {
        const double before = best.value;
        std::vector<Corner> simplex{best};
        for (std::size_t k = 0; k < n; ++k) {
            std::vector<double> at = best.at;
            at[k] += scale;
            simplex.push_back(corner(std::move(at)));
        }
        const auto by_value = [](const Corner& a, const Corner& b) { return a.value < b.value; };
        std::stable_sort(simplex.begin(), simplex.end(), by_value);
        while (evaluations > 0 && simplex.back().value - simplex.front().value > 1e-7 * std::fabs(before)) {
            std::vector<double> centre(n, 0.0);
            for (std::size_t c = 0; c < n; ++c)
                for (std::size_t k = 0; k < n; ++k)
                    centre[k] += simplex[c].at[k] / dimension;
            Corner& worst = simplex.back();
            const auto along = [&](double t) {
                std::vector<double> at(n);
                for (std::size_t k = 0; k < n; ++k)
                    at[k] = centre[k] + t * (centre[k] - worst.at[k]);
                return corner(std::move(at));
            };
            Corner tried = along(1);
            if (tried.value < simplex.front().value) {
                if (Corner farther = along(expand); farther.value < tried.value)
                    tried = std::move(farther);
                worst = std::move(tried);
            } else if (tried.value < simplex[n - 1].value) {
                worst = std::move(tried);
            } else {
                Corner inner = along(tried.value < worst.value ? contract : -contract);
                if (inner.value < std::min(tried.value, worst.value)) {
                    worst = std::move(inner);
                } else {
                    for (std::size_t c = 1; c <= n; ++c) {
                        std::vector<double> at(n);
                        for (std::size_t k = 0; k < n; ++k)
                            at[k] = simplex[0].at[k] + shrink * (simplex[c].at[k] - simplex[0].at[k]);
                        simplex[c] = corner(std::move(at));
                    }
                }
            }
            std::stable_sort(simplex.begin(), simplex.end(), by_value);
        }
        best = simplex.front();
        gained = before - best.value > 1e-5 * std::fabs(before);
    }
    return best.at;
}

std::vector<double> fit(const Body& body, const Model& model, const std::vector<Impact>& impacts,
                        std::vector<double> from, int evaluations)
{
    return minimize(
        [&](std::span<const double> p) { return misfit(errors(body, predict(body, model, p, impacts), impacts)); },
        from.empty() ? model.start(body) : std::move(from), 0.3, evaluations);
}

RigidFit fit_rigid(const Body& body, Restitution rule, const std::vector<Impact>& impacts,
                   const std::vector<Arms>& arms)
{
    const std::vector<double> p = minimize(
        [&](std::span<const double> at) {
            if (at[0] < 0 || at[1] < 0 || at[1] > 1)
                return 10.0;
            return misfit(errors(body, predict_rigid(body, rule, {at[0], at[1]}, impacts, arms), impacts));
        },
        {0.2, 0.6}, 0.05, 600);
    return {p[0], p[1]};
}

std::vector<Velocity> predict_rigid(const Body& body, Restitution rule, const RigidFit& law,
                                    const std::vector<Impact>& impacts, const std::vector<Arms>& arms)
{
    std::vector<Velocity> after;
    for (std::size_t k = 0; k < impacts.size(); ++k)
        after.push_back(rigid_impact(body, impacts[k].before, arms[k], law.mu, law.e, rule));
    return after;
}

namespace {

/// Zero mean, unit spread.
Eigen::VectorXd standardized(const Eigen::VectorXd& v)
{
    const Eigen::VectorXd centred = v.array() - v.mean();
    const double spread = std::sqrt(centred.squaredNorm() / static_cast<double>(v.size()));
    return spread > 0 ? Eigen::VectorXd(centred / spread) : centred;
}

Eigen::MatrixXd cubic(const Eigen::VectorXd& v)
{
    const Eigen::ArrayXd z = standardized(v).array();
    Eigen::MatrixXd columns(v.size(), 3);
    columns << z.matrix(), z.square().matrix(), z.cube().matrix();
    return columns;
}

/// Orthonormal basis of the columns (those that depend on others left out).
Eigen::MatrixXd basis(const Eigen::MatrixXd& columns)
{
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
    return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

/// A number below n; the same on every platform, which the standard's distributions are not.
std::size_t below(std::mt19937_64& random, std::size_t n)
{
    return static_cast<std::size_t>(random() % n);
}

} // namespace

Residuals residuals(const Body& body, const std::vector<Impact>& impacts, const std::vector<Velocity>& predicted,
                    double turn)
{
    Residuals r;
    for (std::size_t k = 0; k < impacts.size(); ++k) {
        const Impact& one = impacts[k];
        const Arms arms = lowest_point(body, one.theta + turn);
        const Velocity measured = one.after - one.before;
        const Impulse seen = nearest_impulse(body, measured, arms);
        const Impulse said = nearest_impulse(body, predicted[k] - one.before, arms);
        r.restitution.push_back(at_contact(one.after - predicted[k], arms).n / -at_contact(one.before, arms).n);
        r.friction.push_back(seen.t / seen.n - said.t / said.n);
        r.lever.push_back(lever_residual(body, measured, arms));
    }
    return r;
}

std::vector<Candidate> candidates(const Body& body, const std::vector<Impact>& impacts)
{
    const auto of = [&](auto value) {
        Eigen::VectorXd v(static_cast<Eigen::Index>(impacts.size()));
        for (std::size_t k = 0; k < impacts.size(); ++k)
            v[static_cast<Eigen::Index>(k)] = value(impacts[k]);
        return v;
    };
    const auto arms = [&](const Impact& i) { return lowest_point(body, i.theta); };
    const auto contact = [&](const Impact& i) { return at_contact(i.before, arms(i)); };
    const auto harmonic = [&](double n) {
        Eigen::MatrixXd columns(static_cast<Eigen::Index>(impacts.size()), 2);
        columns << of([&](const Impact& i) { return std::cos(n * i.theta); }),
            of([&](const Impact& i) { return std::sin(n * i.theta); });
        return columns;
    };
    return {{"place along the surface", cubic(of([](const Impact& i) { return i.x; }))},
            {"horizontal speed", cubic(of([](const Impact& i) { return i.before.x; }))},
            {"normal speed", cubic(of([&](const Impact& i) { return contact(i).n; }))},
            {"tangential speed", cubic(of([&](const Impact& i) { return contact(i).t; }))},
            {"spin", cubic(of([](const Impact& i) { return i.before.spin; }))},
            {"lever arm, signed", cubic(of([&](const Impact& i) { return arms(i).n; }))},
            {"spin x lever arm", cubic(of([&](const Impact& i) { return i.before.spin * arms(i).n; }))},
            {"tangential speed x lever arm", cubic(of([&](const Impact& i) { return contact(i).t * arms(i).n; }))},
            {"which end is down (first harmonic of the orientation)", harmonic(1)},
            {"fourth harmonic of the orientation", harmonic(4)},
            {"order in time", cubic(of([](const Impact& i) { return static_cast<double>(i.index); }))}};
}

Dependence dependence(const std::vector<double>& residual, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& given,
                      int shufflings, std::uint64_t seed)
{
    const auto n = static_cast<Eigen::Index>(residual.size());
    Eigen::MatrixXd first(n, given.cols() + 1);
    first.col(0).setOnes();
    first.rightCols(given.cols()) = given;
    const Eigen::MatrixXd base = basis(first);
    const auto free_of_given = [&](const Eigen::MatrixXd& m) {
        return Eigen::MatrixXd(m - base * (base.transpose() * m));
    };
    const Eigen::MatrixXd added = basis(free_of_given(columns));
    Eigen::VectorXd left = free_of_given(Eigen::Map<const Eigen::VectorXd>(residual.data(), n));
    const auto share = [&](const Eigen::VectorXd& v) {
        const Eigen::VectorXd clean = free_of_given(v);
        return (added.transpose() * clean).squaredNorm() / clean.squaredNorm();
    };
    Dependence d;
    d.share = share(left);
    std::mt19937_64 random(seed);
    std::vector<double> null;
    int as_much = 0;
    for (int k = 0; k < shufflings; ++k) {
        for (std::size_t i = residual.size(); i > 1; --i)
            std::swap(left[static_cast<Eigen::Index>(i - 1)], left[static_cast<Eigen::Index>(below(random, i))]);
        null.push_back(share(left));
        as_much += null.back() >= d.share;
    }
    d.null_99 = quantile(null, 0.99);
    d.p = (1.0 + as_much) / (1.0 + shufflings);
    return d;
}

double neighbour_correlation(const std::vector<double>& values)
{
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    double product = 0, square = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        square += (values[k] - mean) * (values[k] - mean);
        if (k > 0)
            product += (values[k] - mean) * (values[k - 1] - mean);
    }
    return product / square;
}

Eigen::MatrixXd smooth_prediction(const Eigen::MatrixXd& from, const Eigen::MatrixXd& values,
                                  const Eigen::VectorXd& weight, const Eigen::MatrixXd& to, double length, double ridge)
{
    const Eigen::RowVectorXd mean = from.colwise().mean();
    const Eigen::RowVectorXd spread = (from.rowwise() - mean).colwise().norm() / std::sqrt(double(from.rows()));
    const auto scaled = [&](const Eigen::MatrixXd& m) {
        return Eigen::MatrixXd(((m.rowwise() - mean).array().rowwise() / (spread.array() * length)).matrix());
    };
    const Eigen::MatrixXd a = scaled(from), b = scaled(to);
    const auto kernel = [](const Eigen::MatrixXd& p, const Eigen::MatrixXd& q) {
        Eigen::MatrixXd k = -2 * p * q.transpose();
        k.colwise() += p.rowwise().squaredNorm();
        k.rowwise() += q.rowwise().squaredNorm().transpose();
        return Eigen::MatrixXd((-0.5 * k.array()).exp().matrix());
    };
    Eigen::MatrixXd k = kernel(a, a);
    k.diagonal() += ridge * weight.cwiseInverse();
    return kernel(b, a) * k.ldlt().solve(values);
}

double quantile(std::vector<double> values, double part)
{
    std::sort(values.begin(), values.end());
    return sorted_quantile(values, part, QuantileDefinition::linear);
}

Gain gain(const std::vector<double>& before, const std::vector<double>& after, std::uint64_t seed)
{
    const auto of = [](const std::vector<double>& a, const std::vector<double>& b) {
        return 1 - quantile(b, 0.5) / quantile(a, 0.5);
    };
    constexpr int resamplings = 2000;
    std::mt19937_64 random(seed);
    std::vector<double> values, a(before.size()), b(before.size());
    for (int k = 0; k < resamplings; ++k) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            const std::size_t at = below(random, a.size());
            a[i] = before[at];
            b[i] = after[at];
        }
        values.push_back(of(a, b));
    }
    return {of(before, after), quantile(values, 0.025), quantile(values, 0.975)};
}

} // namespace stylobate::measured::impact
