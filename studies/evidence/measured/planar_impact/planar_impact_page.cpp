/// The page `planar_impact`: one impact of a rigid ellipse on a surface, the contact law against 1110 measured ones;
/// its text and its pictures.

#include "io/files/atomic_file.hpp"
#include "io/tables/table.hpp"
#include "studies/evidence/measured/parts/page_case.hpp"
#include "studies/evidence/measured/planar_impact/planar_impact_study.hpp"
#include "studies/evidence/picture/picture.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

namespace stylobate::measured::impact {

namespace {

std::string percent(double part, int digits = 1)
{
    return fmt::format("{:.{}f} %", 100 * part, digits);
}

std::string interval(const Gain& g)
{
    return fmt::format("{} [{}, {}]", percent(g.value), percent(g.low), percent(g.high));
}

/// A share with its p; bold where the null gives as much in fewer than 1 of 100 shufflings.
std::string cell(const Dependence& d)
{
    const std::string share = percent(d.share);
    return d.p < 0.01 ? fmt::format("**{}**", share) : share;
}

std::string laws_table(const ImpactStudy& s)
{
    std::string text =
        markdown_head("law | free numbers | median error | 90 % | against constant (mu, e) | against the engine's law");
    for (std::size_t k = 0; k < s.laws.size(); ++k) {
        const JudgedLaw& law = s.laws[k];
        const auto against = [&](std::size_t base) {
            return k <= base ? std::string() : interval(gain(s.laws[base].error, law.error, 7));
        };
        text += markdown_row("{} | {} | {} | {} | {} | {}", law.name, law.parameters.size(),
                             percent(quantile(law.error, 0.5)), percent(quantile(law.error, 0.9)),
                             against(ImpactStudy::newton), against(ImpactStudy::constant));
    }
    return text;
}

/// Median error and restitution in fifths of a quantity, other half, constant (mu, e).
std::string fifths(const ImpactStudy& s)
{
    struct Quantity {
        const char* name;
        double (*of)(const Impact&, const Arms&, const ContactVelocity&);
        double unit;
    };
    using I = const Impact&;
    using A = const Arms&;
    using C = const ContactVelocity&;
    const Quantity quantities[] = {
        {"place along the surface, m", [](I i, A, C) { return i.x; }, 1},
        {"normal speed of the contact point, m/s", [](I, A, C c) { return -c.n; }, 1},
        {"tangential speed, m/s", [](I, A, C c) { return c.t; }, 1},
        {"spin, rad/s", [](I i, A, C) { return i.before.spin; }, 1},
        {"lever arm of the normal, mm", [](I, A a, C) { return a.n; }, 1000},
        {"lever arm of the tangent (height of the centre), mm", [](I, A a, C) { return a.t; }, 1000},
        {"order in time", [](I i, A, C) { return static_cast<double>(i.index); }, 1}};
    std::string text = markdown_head(
        "quintiles of | upper ends | restitution, median | error of constant (mu, e) | error of the extended law");
    for (const Quantity& q : quantities) {
        std::vector<double> value;
        for (const std::size_t k : s.other) {
            const Arms arms = lowest_point(s.body, s.impacts[k].theta);
            value.push_back(q.unit * q.of(s.impacts[k], arms, at_contact(s.impacts[k].before, arms)));
        }
        std::string ends, e, before, after;
        for (int fifth = 0; fifth < 5; ++fifth) {
            const double low = fifth == 0 ? -HUGE_VAL : quantile(value, 0.2 * fifth);
            const double high = quantile(value, 0.2 * (fifth + 1));
            std::vector<double> r, b, a;
            for (std::size_t k = 0; k < value.size(); ++k) {
                if (!(value[k] > low && value[k] <= high))
                    continue;
                const Impact& i = s.impacts[s.other[k]];
                const Arms arms = lowest_point(s.body, i.theta);
                r.push_back(-at_contact(i.after, arms).n / at_contact(i.before, arms).n);
                b.push_back(s.laws[ImpactStudy::newton].error[k]);
                a.push_back(s.laws[ImpactStudy::extended].error[k]);
            }
            const char* gap = fifth == 0 ? "" : " / ";
            ends += fmt::format("{}{:.3g}", gap, high);
            e += fmt::format("{}{:.2f}", gap, quantile(r, 0.5));
            before += fmt::format("{}{:.0f}", gap, 100 * quantile(b, 0.5));
            after += fmt::format("{}{:.0f}", gap, 100 * quantile(a, 0.5));
        }
        text += markdown_row("{} | {} | {} | {} % | {} %", q.name, ends, e, before, after);
    }
    return text;
}

std::string regressions(const ImpactStudy& s)
{
    std::string text =
        markdown_head("candidate | restitution | given the place | the place given the candidate | restitution, "
                      "extended law | friction P_t / P_n, extended law | line of action (no law)");
    for (const CandidateLine& l : s.lines) {
        const bool place = &l == &s.lines.front();
        text += markdown_row("{} | {} | {} | {} | {} | {} | {}", l.name, cell(l.restitution),
                             place ? "" : cell(l.restitution_given_place), place ? "" : cell(l.place_given_it),
                             cell(l.restitution_extended), cell(l.friction), cell(l.lever));
    }
    return text;
}

std::string added_terms(const ImpactStudy& s)
{
    const auto row = [](const std::vector<AddedTerm>& all, Term term) {
        for (const AddedTerm& a : all)
            if (a.term == term)
                return fmt::format("{} | {}", percent(a.training_gain), interval(a.gain));
        return std::string(" | ");
    };
    std::string text =
        markdown_head("term | engine's law: fitted half | held-out half | extended law: fitted half | held-out half");
    for (const AddedTerm& a : s.to_constant)
        text += markdown_row("{} | {} | {}", to_string(a.term), row(s.to_constant, a.term), row(s.to_extended, a.term));
    return text;
}

std::string parameters(const ImpactStudy& s)
{
    std::string text = markdown_head("law | fitted");
    for (const std::size_t which : {ImpactStudy::constant, ImpactStudy::place_rate, ImpactStudy::extended}) {
        const std::vector<double>& p = s.laws[which].parameters;
        const std::vector<std::string> names = s.models[which].names();
        std::string values = fmt::format(
            "mu {:.3f}, K_T {:.3g} N/m, C_T {:.3g} N s/m, {} {:.3g}", std::exp(p[0]), std::exp(p[1]), std::exp(p[2]),
            s.models[which].loss == Loss::dashpot ? "C_N [N s/m]" : "lambda [s/m]", std::exp(p[3]));
        for (std::size_t k = 4; k < p.size(); ++k)
            values += fmt::format("; {} {:+.3f}", names[k], p[k]);
        text += markdown_row("{} | {}", s.laws[which].name, values);
    }
    return text;
}

/// How the surface takes the energy, from the data.
std::string way_of_loss(const ImpactStudy& s)
{
    const auto both = [&](std::size_t which) {
        return fmt::format("{} (90 %: {})", percent(quantile(s.laws[which].error, 0.5)),
                           percent(quantile(s.laws[which].error, 0.9)));
    };
    const auto verdict = [](double p) { return p < 0.01 ? "the data separate them" : "the data do not separate them"; };
    return fmt::format("- rate damping (C_N = lambda K_N A_c) as a function of the place: {}; a dashpot as a function "
                       "of the place: {}. p = {:.3g}: {}.\n"
                       "- a surface that recoils as a free body, its mass as a function of the place: {}. Against rate "
                       "damping p = {:.3g}: {}.\n",
                       both(ImpactStudy::place_rate), both(ImpactStudy::place_dashpot), s.rate_against_dashpot_p,
                       verdict(s.rate_against_dashpot_p), both(ImpactStudy::place_recoil),
                       s.rate_place_against_recoil_p, verdict(s.rate_place_against_recoil_p));
}

/// Whether the place along the surface is named: it explains restitution beyond chance, alone and besides each other
/// candidate, and helps on the other half.
bool place_is_named(const ImpactStudy& s)
{
    bool named = s.lines.front().restitution.p < 0.01 && s.true_place > quantile(s.shuffled_place, 1);
    for (std::size_t k = 1; k < s.lines.size(); ++k)
        named = named && s.lines[k].place_given_it.p < 0.01;
    for (const AddedTerm& a : s.to_constant)
        named = named && (a.term != Term::place || a.gain.low > 0);
    return named;
}

const CandidateLine& first_harmonic(const ImpactStudy& s)
{
    return *std::find_if(s.lines.begin(), s.lines.end(),
                         [](const CandidateLine& l) { return l.name.find("first harmonic") != std::string::npos; });
}

/// What the extended law's residuals still depend on.
std::string unexplained(const ImpactStudy& s)
{
    std::string text;
    const auto add = [&](const char* residual, const CandidateLine& l, const Dependence& d) {
        if (d.p < 0.01)
            text += fmt::format("{}{} on {} ({})", text.empty() ? "" : ", ", residual, l.name, percent(d.share));
    };
    for (const CandidateLine& l : s.lines)
        add("restitution", l, l.restitution_extended);
    for (const CandidateLine& l : s.lines)
        add("friction", l, l.friction);
    return text.empty() ? "none of the tested candidates" : text;
}

/// Where a number lies against a floor.
const char* against(double value, double floor)
{
    return value < 0.95 * floor ? "below" : value > 1.05 * floor ? "above" : "within 5 % of";
}

/// Terms whose gain on the other half is above 0 with its whole interval.
std::string helpful(const std::vector<AddedTerm>& all)
{
    std::string names;
    for (const AddedTerm& a : all)
        if (a.gain.low > 0)
            names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", to_string(a.term), interval(a.gain));
    return names.empty() ? "none" : names;
}

std::string median_error(const ImpactStudy& s, std::size_t law)
{
    return percent(quantile(s.laws[law].error, 0.5));
}

std::string high_error(const ImpactStudy& s, std::size_t law)
{
    return percent(quantile(s.laws[law].error, 0.9));
}

std::string opening(const ImpactStudy& s, const std::string& made_by)
{
    const Gain over_pair = gain(s.laws[ImpactStudy::newton].error, s.laws[ImpactStudy::extended].error, 7);
    const Gain over_engine = gain(s.laws[ImpactStudy::constant].error, s.laws[ImpactStudy::extended].error, 7);
    return fmt::format(
        "# Planar impacts of an ellipse\n\nThis page is generated by `scripts/measured.sh --case planar_impact`. {}\n\n"
        "**Errors:** the best constant (mu, e) has an error of {} in the velocity after an impact (median; 90 %: {}), "
        "the engine's contact law with constant numbers an error of {} ({}). **Cause:** {} With rate damping that "
        "depends on the place and an orientation corrected by {:.1f} degrees the error is {} ({}). On held-out impacts "
        "it is {} smaller than with the constant pair, {} smaller than with the engine's law (95 % intervals).\n\n",
        made_by, median_error(s, ImpactStudy::newton), high_error(s, ImpactStudy::newton),
        median_error(s, ImpactStudy::constant), high_error(s, ImpactStudy::constant),
        place_is_named(s) ? "the restitution depends on the *place along the surface* of the impact; this candidate is "
                            "separated from all others."
                          : "the data do not separate one candidate from the others.",
        s.orientation * 180 / M_PI, median_error(s, ImpactStudy::extended), high_error(s, ImpactStudy::extended),
        interval(over_pair), interval(over_engine));
}

std::string data_section(const ImpactStudy& s)
{
    return fmt::format(
        "## Data and question\n\nMCube Lab, MIT (Fazeli, Donlon, Drumwright, Rodriguez): a rigid ellipse (semi-axes 35 "
        "and 25 mm, 36.4 g, radius of gyration 19.2 mm) falls on a flat surface; state before and after each impact, "
        "sampled at 250 Hz. {} of the 1718 published impacts are used here; the others are reserved for a later test "
        "(`--predict TABLE` writes the predictions of the laws of this page).\n\n"
        "The stored vx has the opposite sign of x, spin and lever arms (with the stored sign the moment balance "
        "fails). Its sign is reversed when the table is read.\n\n"
        "The law of the engine (`kernels/planar/contact.hpp`: penalty on the overlap's area, dashpot, elastic spring "
        "under "
        "Coulomb's cone) is integrated by central differences from the measured state before the impact to separation; "
        "the overlap of an ellipse and a half plane is in closed form. The error of a predicted velocity v is "
        "sqrt(T(v - v_measured) / T(v_measured)), T the kinetic energy.\n\n"
        "*Halves:* blocks of {} consecutive numbers in the published order, alternating: {} impacts for fitting, {} "
        "held out. A fit minimizes the mean error, with each error limited to 60 %. Intervals are 95 % over resampled "
        "held-out impacts. The forms of the laws were chosen with knowledge of both halves; only their parameters come "
        "from one half. The reserved impacts are the independent test.\n\n",
        s.impacts.size(), split_block, s.training.size(), s.other.size());
}

std::string laws_section(const ImpactStudy& s)
{
    return fmt::format(
        "## Errors of the laws\n\n{}\nThe first law fitted on all {} impacts: mu {:.3f}, e {:.3f}, error {} "
        "(90 %: {}); the notes of the data set give 14.7 % and 30.4 % on all 1718, by a grid search. They also give 40 "
        "to 49 % for six published impact laws, compared in the same way; these values are quoted and not computed "
        "here.\n\n"
        "![Errors of the laws](images/planar_impact_errors.png)\n\n*Errors on the held-out half. The last curve is not "
        "a law: it is the best impulse at the contact point, computed from the measured velocities.*\n\n{}\n",
        laws_table(s), s.impacts.size(), s.pair_on_all.mu, s.pair_on_all.e, percent(quantile(s.pair_on_all_error, 0.5)),
        percent(quantile(s.pair_on_all_error, 0.9)), fifths(s));
}

std::string cause_section(const ImpactStudy& s)
{
    return fmt::format(
        "## The cause\n\nShare of the residual's variance that a candidate explains (cubic, or cosine and sine), on "
        "the "
        "fitted half; **bold** where shuffled residuals explain as much in fewer than 1 of 100 cases. The first "
        "columns are for the engine's constant law. *Given* means after the effect of the other candidate is "
        "removed.\n\n{}\n"
        "Horizontal speed correlates with the place (a faster body falls farther), so their shares alone do not "
        "separate them; the conditional columns do. The term `place` as part of the fitted law removes {} of the "
        "misfit. With the places permuted among the impacts, the maximum of {} fits is {}.\n\n"
        "![Restitution along the surface](images/planar_impact_place.png)\n\n*Restitution along the surface, held-out "
        "half, in 14 bins with equal numbers of impacts.*\n\n"
        "Each possible term of the law, added alone and refitted: the reduction of the misfit on the fitted half, and "
        "of the median error on the held-out half with its interval. The terms above the orientation act on the "
        "loss.\n\n{}\nTerms with a significant gain on the held-out half: for the engine's law {}; for the extended "
        "law {}.\n\n",
        regressions(s), percent(s.true_place), s.shuffled_place.size(), percent(quantile(s.shuffled_place, 1)),
        added_terms(s), helpful(s.to_constant), helpful(s.to_extended));
}

std::string named_section(const ImpactStudy& s)
{
    return fmt::format(
        "**Identified:** {}. **Not identified:** the physical property of the surface that varies. Possible "
        "dissipation mechanisms, fitted in the same way:\n\n{}\nThe velocities of the body alone do not show whether "
        "the energy is lost in the material of the surface, at its supports or in its vibration.\n\n"
        "**Orientation.** The laws prefer an orientation {:+.4f} rad beyond the table's. The moment balance, which is "
        "independent of the law, has its smallest residual at {:+.4f} rad [{:+.4f}, {:+.4f}]. A centre of mass off the "
        "ellipse's "
        "centre would show as the first harmonic of the orientation in the line of action, of which it explains {} (p "
        "= {:.2g}). The term corrects the observation and is not a property of the contact.\n\n"
        "![Sliding after the impact](images/planar_impact_sliding.png)\n\n*Sliding of the contact point after the "
        "impact, held-out half. A cone on the whole impulse cannot represent sliding that ends, sticks or reverses "
        "during the impact.*\n\n",
        place_is_named(s) ? "the place along the surface" : "none", way_of_loss(s), s.orientation,
        s.orientation_interval.value, s.orientation_interval.low, s.orientation_interval.high,
        percent(first_harmonic(s).lever.share), first_harmonic(s).lever.p);
}

std::string floor_section(const ImpactStudy& s)
{
    return fmt::format(
        "## Lower bound of the error\n\n| | median | 90 % |\n|---|---|---|\n"
        "| extended law | {} | {} |\n"
        "| extended law plus a smooth regression of its residuals on the state before the impact (kernel ridge, "
        "trained on the fitted half) "
        "| {} | {} |\n"
        "| best impulse at the contact point, computed from the measured velocities: lower bound for laws with point "
        "contact | "
        "{} "
        "| {} |\n| the same, scaled from the direction of the moment balance to all three directions under the "
        "assumption of equal errors "
        "| {} | {} |\n\n"
        "The residual moment mixes errors of the measured velocities (250 Hz), of the orientation at the contact and "
        "forces outside the point, and the scaling assumes equal errors in the norm's three directions: the last line "
        "is "
        "an estimate of the measurement's floor, not a bound. The median of the extended law lies {} that estimate; "
        "its 90 % quantile lies {} the corresponding one. "
        "Neighbouring residuals of the restitution correlate by {:+.3f} (standard error {:.3f}).\n\n**Left "
        "unexplained.** On the fitted half the residuals of the extended law still depend significantly on: {}. None "
        "of the tested terms removes this dependence, and the smooth regression predicts part of it, so the law is "
        "incomplete.\n\n",
        median_error(s, ImpactStudy::extended), high_error(s, ImpactStudy::extended), percent(quantile(s.smooth, 0.5)),
        percent(quantile(s.smooth, 0.9)), percent(quantile(s.point_floor, 0.5)), percent(quantile(s.point_floor, 0.9)),
        percent(s.isotropic_floor[0]), percent(s.isotropic_floor[1]),
        against(quantile(s.laws[ImpactStudy::extended].error, 0.5), s.isotropic_floor[0]),
        against(quantile(s.laws[ImpactStudy::extended].error, 0.9), s.isotropic_floor[1]), s.residual_neighbours,
        1 / std::sqrt(static_cast<double>(s.training.size())), unexplained(s));
}

std::string robustness_and_limits(const ImpactStudy& s)
{
    std::string text = "## Robustness\n\n" + markdown_head("K_N [N/m2], others refitted | duration | median | 90 %");
    for (const auto& line : s.stiffness)
        text += markdown_row("{:.0e} | {:.2f} ms | {} | {}", line.K_N, 1000 * line.duration_s,
                             percent(quantile(line.error, 0.5)), percent(quantile(line.error, 0.9)));
    text += fmt::format(
        "\nVelocities before and after the impact do not determine K_N, which is fixed at 1e8 N/m2. With the halves "
        "exchanged the gain of the extended law over the engine's law is {}. A tenth of the time step changes its "
        "velocities by {} on average.\n\n{}\n"
        "Loss terms are exponents: the loss is multiplied by exp(c1 z + c2 z^2), z the covariate about the middle of "
        "its range (place: 0.37 m, in 0.1 m).\n\n"
        "## Limits\n\n"
        "- The forms of the laws, the tested terms and the settings of the ridge regression were chosen with knowledge "
        "of both halves; only the parameters come from one half. The gains on the held-out half may be overestimated "
        "by this choice. The reserved impacts were not used, but the notes of the data set, quoted above, describe all "
        "1718.\n"
        "- Both halves come from one body on one surface, in alternating blocks of the same order: a dependence on the "
        "place that holds on the held-out half need not hold on another surface.\n"
        "- One body, one surface, closing speeds of 2.2 to 2.9 m/s, sliding almost always to one side. The results do "
        "not apply to rest, to faces in full contact, or to other materials. The dependence on the place is a property "
        "of this surface. The general conclusion is that a constant restitution hides such a dependence, and that it "
        "has to be fitted before friction and damping are assessed.\n",
        interval(s.swapped), percent(s.step_error, 2), parameters(s));
    return text;
}

using verification::curves;
using verification::Series;
using verification::write_small;

/// Part of the errors below each of them.
Series cumulative(const std::string& title, std::vector<double> errors, int colour)
{
    std::sort(errors.begin(), errors.end());
    Series s{title, {}, {}, true, {}, {}, colour};
    for (std::size_t k = 0; k < errors.size(); ++k) {
        s.x.push_back(100 * errors[k]);
        s.y.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(errors.size()));
    }
    return s;
}

double restitution(const ImpactStudy& s, std::size_t impact, const Velocity& after)
{
    const Impact& one = s.impacts[impact];
    const Arms arms = lowest_point(s.body, one.theta + s.orientation);
    return -at_contact(after, arms).n / at_contact(one.before, arms).n;
}

/// Medians of a value in bins of equally many impacts along the surface, quartiles as bars if asked for.
template <class Value>
Series along_surface(const ImpactStudy& s, const std::string& title, const Value& value, bool bars, int colour)
{
    std::vector<std::size_t> order = s.other;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return s.impacts[a].x < s.impacts[b].x; });
    Series series{title, {}, {}, !bars, {}, {}, colour};
    constexpr std::size_t bins = 14;
    for (std::size_t bin = 0; bin < bins; ++bin) {
        std::vector<double> x, y;
        for (std::size_t k = bin * order.size() / bins; k < (bin + 1) * order.size() / bins; ++k) {
            x.push_back(s.impacts[order[k]].x);
            y.push_back(value(order[k]));
        }
        series.x.push_back(quantile(x, 0.5));
        series.y.push_back(quantile(y, 0.5));
        if (bars) {
            series.low.push_back(quantile(y, 0.25));
            series.high.push_back(quantile(y, 0.75));
        }
    }
    return series;
}

/// Every fitted law's prediction for the impacts of a table.
void predict_table(const ImpactStudy& study, const std::filesystem::path& table, const std::filesystem::path& out)
{
    const std::vector<Impact> impacts = read_impacts(table);
    std::vector<Arms> published;
    for (const Impact& i : impacts)
        published.push_back({i.arm_n, i.arm_t});
    const JudgedLaw& pair = study.laws[ImpactStudy::newton];
    std::vector<Prediction> predictions{
        {pair.word, predict_rigid(study.body, Restitution::total_impulse, {pair.parameters[0], pair.parameters[1]},
                                  impacts, published)}};
    for (const std::size_t which : {ImpactStudy::constant, ImpactStudy::extended})
        predictions.push_back(
            {study.laws[which].word, predict(study.body, study.models[which], study.laws[which].parameters, impacts)});
    write_predictions(out, impacts, predictions);
}

/// @param made_by line with the version and machine of the computation
std::string page_text(const ImpactStudy& s, const std::string& made_by)
{
    return opening(s, made_by) + data_section(s) + laws_section(s) + cause_section(s) + named_section(s) +
           floor_section(s) + robustness_and_limits(s);
}

/// planar_impact_{errors,place,sliding}.png. @throws InputError as `write_picture`
void draw(const ImpactStudy& s, const std::filesystem::path& folder)
{
    const auto& laws = s.laws;
    const auto put = [&](const char* name, const Figure& figure) {
        write_small({figure}, folder / (std::string("planar_impact_") + name + ".png"));
    };
    put("errors", curves({"error of the velocity after the impact, % (kinetic energy norm)", false, 0, 60},
                         {"part of the other half's impacts", false, 0, 1},
                         {cumulative("constant mu, e (Newton, Coulomb)", laws[ImpactStudy::newton].error, 5),
                          cumulative("the engine's law, constant", laws[ImpactStudy::constant].error, 1),
                          cumulative("rate damping as a function of the place", laws[ImpactStudy::place_rate].error, 2),
                          cumulative("extended law", laws[ImpactStudy::extended].error, 0),
                          cumulative("best impulse in the contact point", s.point_floor, 3)}));
    const auto of = [&](std::size_t which) {
        return [&s, which](std::size_t k) { return restitution(s, k, s.laws[which].after[k]); };
    };
    put("place", curves({"place of the impact along the surface, m", false, 0, 0},
                        {"normal restitution at the contact point", false, 0.4, 0.75},
                        {along_surface(
                             s, "measured, median and quartiles",
                             [&s](std::size_t k) { return restitution(s, k, s.impacts[k].after); }, true, 5),
                         along_surface(s, "the engine's law, constant", of(ImpactStudy::constant), false, 1),
                         along_surface(s, "extended law", of(ImpactStudy::extended), false, 0)}));
    const auto sliding = [&](std::size_t which, const std::string& title, int colour) {
        Series series{title, {}, {}, false, {}, {}, colour, 0.5};
        for (const std::size_t k : s.other) {
            const Arms arms = lowest_point(s.body, s.impacts[k].theta + s.orientation);
            series.x.push_back(at_contact(s.impacts[k].after, arms).t);
            series.y.push_back(at_contact(laws[which].after[k], arms).t);
        }
        return series;
    };
    put("sliding", curves({"measured sliding speed of the contact point after the impact, m/s", false, -2, 1.5},
                          {"predicted, m/s", false, -2, 1.5},
                          {sliding(ImpactStudy::newton, "constant mu, e (Newton, Coulomb)", 1),
                           sliding(ImpactStudy::extended, "extended law", 0),
                           {std::nullopt, {-2, 1.5}, {-2, 1.5}, true, {}, {}, 5}}));
}

} // namespace

} // namespace stylobate::measured::impact

namespace stylobate::measured {

void planar_impact(const PagePlace& place)
{
    const std::filesystem::path table = place.data / "planar_impact" / "impacts.csv";
    using namespace impact;
    const ImpactStudy study = study_impacts(read_impacts(table), [&](const std::string& done) {
        if (!place.quiet)
            fmt::print(stderr, "planar_impact: {}\n", done);
    });
    draw(study, place.images());
    if (place.predict)
        predict_table(study, *place.predict, place.docs / "planar_impact_predictions.csv");
    write_whole(place.docs / "planar_impact.md", page_text(study, fmt::format("Version {}.", code_version())));
}

} // namespace stylobate::measured
