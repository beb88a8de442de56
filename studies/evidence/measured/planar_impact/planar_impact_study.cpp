#include "studies/evidence/measured/planar_impact/planar_impact_study.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

namespace stylobate::measured::impact {

namespace {

constexpr int term_evaluations = 200; ///< a term more, from the fit without it
constexpr int shufflings = 999;       ///< of a regression
constexpr int refitted_shufflings = 19;
constexpr int shuffled_evaluations = 80; ///< of each; of the true places too
/// Of the smooth regression: standard deviations of each column, and the ridge. Chosen by tenfold cross-validation
/// among lengths 1.5 to 5 and ridges 0.1 to 1.
constexpr double smooth_length = 2, smooth_ridge = 0.3;

template <class T>
std::vector<T> pick(const std::vector<T>& all, const std::vector<std::size_t>& at)
{
    std::vector<T> some;
    for (const std::size_t k : at)
        some.push_back(all[k]);
    return some;
}

std::vector<Arms> published_arms(const std::vector<Impact>& impacts)
{
    std::vector<Arms> arms;
    for (const Impact& i : impacts)
        arms.push_back({i.arm_n, i.arm_t});
    return arms;
}

std::vector<Arms> lowest_points(const Body& body, const std::vector<Impact>& impacts)
{
    std::vector<Arms> arms;
    for (const Impact& i : impacts)
        arms.push_back(lowest_point(body, i.theta));
    return arms;
}

/// Parameters of a model from those of one with fewer terms.
std::vector<double> extended_start(const Body& body, const Model& model, std::vector<double> parameters)
{
    const std::vector<double> neutral = model.start(body);
    parameters.insert(parameters.end(), neutral.begin() + static_cast<std::ptrdiff_t>(parameters.size()),
                      neutral.end());
    return parameters;
}

class Maker {
public:
    Maker(ImpactStudy& study, const std::function<void(const std::string&)>& progress)
        : s_(study), progress_(progress), training_(pick(s_.impacts, s_.training)), other_(pick(s_.impacts, s_.other))
    {
    }

    void rigid_laws()
    {
        const auto add = [&](const char* name, const char* word, Restitution rule, const std::vector<Arms>& arms) {
            const RigidFit f = fit_rigid(s_.body, rule, training_, pick(arms, s_.training));
            judge({name, word, {f.mu, f.e}, predict_rigid(s_.body, rule, f, s_.impacts, arms), {}});
        };
        const std::vector<Arms> published = published_arms(s_.impacts), own = lowest_points(s_.body, s_.impacts);
        add("Newton's e, Coulomb's cone on the whole impulse", "newton", Restitution::total_impulse, published);
        add("Newton's e, Coulomb's friction at every instant (Routh)", "routh_newton", Restitution::newton, own);
        add("Poisson's e, Coulomb's friction at every instant (Routh)", "routh_poisson", Restitution::poisson, own);
        s_.pair_on_all = fit_rigid(s_.body, Restitution::total_impulse, s_.impacts, published);
        s_.pair_on_all_error =
            errors(s_.body, predict_rigid(s_.body, Restitution::total_impulse, s_.pair_on_all, s_.impacts, published),
                   s_.impacts);
    }

    void contact_laws()
    {
        s_.models.resize(ImpactStudy::law_count);
        simulated(ImpactStudy::constant, "**the engine's law**: constant K_N, C_N, K_T, C_T, mu", "constant", {});
        simulated(ImpactStudy::constant_rate, "rate damping instead of the dashpot", "rate", {Loss::rate, {}});
        from(ImpactStudy::place_dashpot, ImpactStudy::constant, "dashpot as a function of the place", "place_dashpot",
             s_.models[ImpactStudy::constant].with(Term::place));
        from(ImpactStudy::place_rate, ImpactStudy::constant_rate, "rate damping as a function of the place",
             "place_rate", s_.models[ImpactStudy::constant_rate].with(Term::place));
        simulated(ImpactStudy::place_recoil, "constant rate damping, recoil of the surface as a function of the place",
                  "place_recoil", {Loss::recoil, {Term::place}});
        from(ImpactStudy::extended, ImpactStudy::place_rate,
             "**extended**: rate damping as a function of the place, orientation corrected", "extended",
             s_.models[ImpactStudy::place_rate].with(Term::orientation));
        s_.orientation = 0.01 * law(ImpactStudy::extended).parameters.back();
        s_.rate_against_dashpot_p =
            sign_flip_p(law(ImpactStudy::place_dashpot).error, law(ImpactStudy::place_rate).error, shufflings, 1);
        s_.rate_place_against_recoil_p =
            sign_flip_p(law(ImpactStudy::place_recoil).error, law(ImpactStudy::place_rate).error, shufflings, 2);
    }

    void terms()
    {
        const auto add_all = [&](std::size_t base, std::vector<AddedTerm>& to) {
            for (int t = 0; t < term_count; ++t)
                if (const Term term = static_cast<Term>(t); !s_.models[base].has(term))
                    to.push_back(added(base, term));
        };
        add_all(ImpactStudy::constant, s_.to_constant);
        add_all(ImpactStudy::extended, s_.to_extended);
    }

    /// The null of the place: the same fit with the places dealt out anew among the impacts.
    void shuffled_places()
    {
        const Model model = s_.models[ImpactStudy::constant].with(Term::place);
        const std::vector<double> start = extended_start(s_.body, model, law(ImpactStudy::constant).parameters);
        const double without = training_misfit(ImpactStudy::constant);
        const auto gained = [&](const std::vector<Impact>& impacts) {
            const std::vector<double> p = fit(s_.body, model, impacts, start, shuffled_evaluations);
            return 1 - misfit(errors(s_.body, predict(s_.body, model, p, impacts), impacts)) / without;
        };
        s_.true_place = gained(training_);
        std::mt19937_64 random(3);
        std::vector<Impact> impacts = training_;
        for (int k = 0; k < refitted_shufflings; ++k) {
            for (std::size_t i = impacts.size(); i > 1; --i)
                std::swap(impacts[i - 1].x, impacts[random() % i].x);
            s_.shuffled_place.push_back(gained(impacts));
        }
        say("the null of the place");
    }

    void regressions()
    {
        const Residuals before = residuals(s_.body, training_, predicted(ImpactStudy::constant), 0);
        const Residuals after = residuals(s_.body, training_, predicted(ImpactStudy::extended), s_.orientation);
        const std::vector<Candidate> all = candidates(s_.body, training_);
        const Eigen::MatrixXd none(static_cast<Eigen::Index>(training_.size()), 0);
        const Eigen::MatrixXd& place = all.front().columns;
        std::uint64_t seed = 10;
        for (const Candidate& c : all) {
            const auto on = [&](const std::vector<double>& r, const Eigen::MatrixXd& columns,
                                const Eigen::MatrixXd& given) {
                return dependence(r, columns, given, shufflings, ++seed);
            };
            const bool is_place = &c == &all.front();
            s_.lines.push_back({c.name, on(before.restitution, c.columns, none),
                                is_place ? Dependence{} : on(before.restitution, c.columns, place),
                                is_place ? Dependence{} : on(before.restitution, place, c.columns),
                                on(after.restitution, c.columns, none), on(after.friction, c.columns, none),
                                on(before.lever, c.columns, none)});
        }
        s_.residual_neighbours = neighbour_correlation(after.restitution);
        say("regressions");
    }

    void orientation()
    {
        s_.orientation_by_moments = orientation_by_moments(s_.body, training_);
        std::mt19937_64 random(4);
        std::vector<double> values;
        for (int k = 0; k < 400; ++k) {
            std::vector<Impact> again;
            for (std::size_t i = 0; i < training_.size(); ++i)
                again.push_back(training_[random() % training_.size()]);
            values.push_back(orientation_by_moments(s_.body, again));
        }
        s_.orientation_interval = {s_.orientation_by_moments, quantile(values, 0.025), quantile(values, 0.975)};
    }

    void floors()
    {
        for (const Impact& i : other_) {
            const Arms arms = lowest_point(s_.body, i.theta + s_.orientation);
            const Impulse best = nearest_impulse(s_.body, i.after - i.before, arms);
            s_.point_floor.push_back(relative_error(s_.body, after_impulse(s_.body, i.before, arms, best), i.after));
        }
        // If the error of the velocity had the same spread in all three directions of the norm: chi with 3 degrees of
        // freedom where the moment balance shows chi with 1.
        const std::size_t n = s_.point_floor.size();
        for (const double part : {0.5, 0.9}) {
            const double one = length_quantile(1, part);
            const double three = length_quantile(3, part);
            s_.isotropic_floor.push_back(quantile(s_.point_floor, part) * three / one);
        }
        const auto columns = [&](const std::vector<Impact>& impacts) {
            Eigen::MatrixXd m(static_cast<Eigen::Index>(impacts.size()), 8);
            for (std::size_t k = 0; k < impacts.size(); ++k) {
                const Impact& i = impacts[k];
                const Arms arms = lowest_point(s_.body, i.theta);
                m.row(static_cast<Eigen::Index>(k)) << i.before.x, i.before.y, i.before.spin, arms.n, arms.t, i.x,
                    std::cos(i.theta), std::sin(i.theta);
            }
            return m;
        };
        const double k = s_.body.gyration;
        const std::vector<Velocity> said = predicted(ImpactStudy::extended);
        Eigen::MatrixXd left(static_cast<Eigen::Index>(training_.size()), 3);
        Eigen::VectorXd weight(static_cast<Eigen::Index>(training_.size()));
        for (std::size_t i = 0; i < training_.size(); ++i) {
            const Velocity d = training_[i].after - said[i];
            left.row(static_cast<Eigen::Index>(i)) << d.x, d.y, k * d.spin;
            weight[static_cast<Eigen::Index>(i)] =
                s_.body.mass / (2 * kinetic_energy(s_.body, training_[i].after)); // (m/s)^-2: errors count relatively
        }
        const Eigen::MatrixXd more =
            smooth_prediction(columns(training_), left, weight, columns(other_), smooth_length, smooth_ridge);
        for (std::size_t i = 0; i < n; ++i) {
            Velocity v = law(ImpactStudy::extended).after[s_.other[i]];
            const auto row = static_cast<Eigen::Index>(i);
            v.x += more(row, 0);
            v.y += more(row, 1);
            v.spin += more(row, 2) / k;
            s_.smooth.push_back(relative_error(s_.body, v, other_[i].after));
        }
        say("floors");
    }

    void robustness()
    {
        const Model& model = s_.models[ImpactStudy::extended];
        for (const double K_N : {1e7, 1e9}) {
            Model other = model;
            other.K_N = K_N;
            // the law scales: at the same approach the depth goes as K_N^-0.4, stiffness and rate of the contact as 0.4
            std::vector<double> p = law(ImpactStudy::extended).parameters;
            const double scale = std::log(K_N / model.K_N);
            p[1] += 0.8 * scale;
            p[2] += 0.4 * scale;
            p = fit(s_.body, other, training_, p, term_evaluations);
            add_stiffness(other, p);
        }
        add_stiffness(model, law(ImpactStudy::extended).parameters);
        std::sort(s_.stiffness.begin(), s_.stiffness.end(), [](const auto& a, const auto& b) { return a.K_N < b.K_N; });

        const auto fitted_on_other = [&](std::size_t which) {
            const std::vector<double> p =
                fit(s_.body, s_.models[which], other_, law(which).parameters, term_evaluations);
            return errors(s_.body, predict(s_.body, s_.models[which], p, training_), training_);
        };
        s_.swapped = gain(fitted_on_other(ImpactStudy::constant), fitted_on_other(ImpactStudy::extended), 5);

        for (const Impact& i : other_) {
            const ImpactLaw l = model.law(s_.body, i, law(ImpactStudy::extended).parameters);
            const Velocity usual = simulate_impact(s_.body, l, i.before, i.theta).after;
            const Velocity fine = simulate_impact(s_.body, l, i.before, i.theta, usual_step_fraction / 10).after;
            s_.step_error += relative_error(s_.body, usual, fine) / static_cast<double>(other_.size());
        }
        say("robustness");
    }

private:
    const JudgedLaw& law(std::size_t which) const { return s_.laws[which]; }
    void say(const std::string& what) const
    {
        if (progress_)
            progress_(what);
    }

    std::vector<Velocity> predicted(std::size_t which) const { return pick(law(which).after, s_.training); }
    double training_misfit(std::size_t which) const { return misfit(errors(s_.body, predicted(which), training_)); }

    void judge(JudgedLaw law)
    {
        law.error = errors(s_.body, pick(law.after, s_.other), other_);
        s_.laws.push_back(std::move(law));
        say(s_.laws.back().word);
    }

    void simulated(std::size_t which, const char* name, const char* word, Model model, std::vector<double> start = {})
    {
        const std::vector<double> p = fit(s_.body, model, training_, std::move(start), term_evaluations);
        judge({name, word, p, predict(s_.body, model, p, s_.impacts), {}});
        s_.models[which] = std::move(model);
    }
    void from(std::size_t which, std::size_t base, const char* name, const char* word, const Model& model)
    {
        simulated(which, name, word, model, extended_start(s_.body, model, law(base).parameters));
    }

    AddedTerm added(std::size_t base, Term term) const
    {
        const Model model = s_.models[base].with(term);
        AddedTerm a{term, 0, {}, {}};
        a.parameters =
            fit(s_.body, model, training_, extended_start(s_.body, model, law(base).parameters), term_evaluations);
        a.training_gain = 1 - misfit(errors(s_.body, predict(s_.body, model, a.parameters, training_), training_)) /
                                  training_misfit(base);
        a.gain = gain(law(base).error, errors(s_.body, predict(s_.body, model, a.parameters, other_), other_), 6);
        say(fmt::format("{} with {}", law(base).word, to_string(term)));
        return a;
    }

    void add_stiffness(const Model& model, const std::vector<double>& p)
    {
        std::vector<double> duration;
        for (const Impact& i : other_)
            duration.push_back(simulate_impact(s_.body, model.law(s_.body, i, p), i.before, i.theta).duration_s);
        s_.stiffness.push_back(
            {model.K_N, quantile(duration, 0.5), errors(s_.body, predict(s_.body, model, p, other_), other_)});
    }

    ImpactStudy& s_;
    const std::function<void(const std::string&)>& progress_;
    std::vector<Impact> training_, other_;
};

bool in_training(const Impact& impact)
{
    return impact.index / split_block % 2 == 0;
}

} // namespace

ImpactStudy study_impacts(std::vector<Impact> impacts, const std::function<void(const std::string&)>& progress)
{
    ImpactStudy s;
    s.impacts = std::move(impacts);
    for (std::size_t k = 0; k < s.impacts.size(); ++k)
        (in_training(s.impacts[k]) ? s.training : s.other).push_back(k);
    Maker make(s, progress);
    make.rigid_laws();
    make.contact_laws();
    make.terms();
    make.shuffled_places();
    make.regressions();
    make.orientation();
    make.floors();
    make.robustness();
    return s;
}

double sign_flip_p(const std::vector<double>& a, const std::vector<double>& b, int flips, std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    double observed = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        observed += std::min(a[k], 0.6) - std::min(b[k], 0.6);
    int as_much = 0;
    for (int f = 0; f < flips; ++f) {
        double sum = 0;
        for (std::size_t k = 0; k < a.size(); ++k)
            sum += (random() & 1 ? 1 : -1) * (std::min(a[k], 0.6) - std::min(b[k], 0.6));
        as_much += std::fabs(sum) >= std::fabs(observed);
    }
    return (1.0 + as_much) / (1.0 + flips);
}

double length_quantile(int directions, double part)
{
    assert((directions == 1 || directions == 3) && part > 0 && part < 1 && "closed forms of the line and of space");
    const auto below = [&](double length) {
        const double shells = directions == 3 ? 2 * length * std::exp(-0.5 * length * length) / std::sqrt(2 * M_PI) : 0;
        return std::erf(length / std::sqrt(2.0)) - shells;
    };
    double low = 0, high = 10;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (below(middle) < part ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double orientation_by_moments(const Body& body, const std::vector<Impact>& impacts)
{
    const auto sum = [&](double turn) {
        double total = 0;
        for (const Impact& i : impacts)
            total += std::fabs(lever_residual(body, i.after - i.before, lowest_point(body, i.theta + turn)));
        return total;
    };
    const double golden = (std::sqrt(5.0) - 1) / 2;
    double low = -0.15, high = 0.15;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double fa = sum(a), fb = sum(b);
    while (high - low > 1e-4) {
        if (fa < fb) {
            high = b;
            b = a;
            fb = fa;
            a = high - golden * (high - low);
            fa = sum(a);
        } else {
            low = a;
            a = b;
            fa = fb;
            b = low + golden * (high - low);
            fb = sum(b);
        }
    }
    return (low + high) / 2;
}

} // namespace stylobate::measured::impact
