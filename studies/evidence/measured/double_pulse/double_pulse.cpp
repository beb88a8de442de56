#include "studies/evidence/measured/double_pulse/double_pulse.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/study/study_file.hpp"
#include "io/tables/table.hpp"
#include "studies/evidence/measured/parts/forecast.hpp"
#include "studies/evidence/measured/parts/page_case.hpp"
#include "studies/evidence/measured/parts/table.hpp"
#include "studies/evidence/picture/picture.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <utility>

namespace stylobate::measured {

namespace {

constexpr double gravity = 9.81;
constexpr double density = 2500; // of no consequence: stiffness and dashpots are in proportion to the weight
constexpr double depth = 0.1;
/// Static overlap over width times slenderness: so stiff that the contact's compliance hardly lowers what overturns.
constexpr double softness = 2e-4;

using verification::Series;

const std::vector<double> heights{0.03, 0.05, 0.08, 0.13, 0.2};
const std::vector<double> spreads{0, 0.1, 0.2, 0.3};

constexpr double no_slip = 5; ///< friction

/// What is not stated of the tests, one at a time away from the baseline.
struct Choice {
    std::string name;
    PulsedBlock block; ///< its size is of no meaning
};
std::vector<Choice> choices()
{
    const auto with = [](auto change) {
        PulsedBlock block;
        block.friction = no_slip;
        change(block);
        return block;
    };
    std::vector<Choice> all{{"baseline: no slip, short pulses, dashpot at the centroid", with([](PulsedBlock&) {})}};
    for (const double friction : {1.0, 0.7, 0.6, 0.55, 0.5, 0.45, 0.4, 0.35})
        all.push_back({fmt::format("friction {:g}", friction), with([&](PulsedBlock& b) { b.friction = friction; })});
    for (const double pulse : {0.005, 0.015})
        all.push_back(
            {fmt::format("pulses of {:g} ms", 1000 * pulse), with([&](PulsedBlock& b) { b.pulse_s = pulse; })});
    const auto ends = [](PulsedBlock& b, double ratio) {
        b.ends = true;
        b.damping_ratio = ratio;
    };
    for (const double ratio : {0.2, 0.5})
        all.push_back(
            {fmt::format("dashpot at the ends, ratio {:g}", ratio), with([&](PulsedBlock& b) { ends(b, ratio); })});
    for (const double friction : {0.7, 0.55, 0.45})
        all.push_back(
            {fmt::format("friction {:g} and dashpot at the ends, ratio 0.5", friction), with([&](PulsedBlock& b) {
                 b.friction = friction;
                 ends(b, 0.5);
             })});
    return all;
}

/// A size, with how the outcomes follow from it.
struct SizedBlock {
    PulsedBlock block;
    double spread = 0, slip = 0;
    double log_likelihood = -std::numeric_limits<double>::infinity();
};

std::vector<bool> fell(const std::vector<DoublePulse>& tests)
{
    std::vector<bool> all;
    for (const DoublePulse& test : tests)
        all.push_back(test.fell);
    return all;
}

/// One choice, every height: what every slenderness does in the tests.
struct ChoiceTables {
    Choice choice;
    std::vector<FallTable> tables; ///< (heights)
};

ChoiceTables simulate(const Choice& choice, const std::vector<DoublePulse>& tests, const RunOptions& run)
{
    ChoiceTables all{choice, {}};
    for (const double height : heights) {
        PulsedBlock block = choice.block;
        block.height_m = height;
        const auto study = [block](double slenderness) mutable {
            block.slenderness = slenderness;
            return pulsed_study(block);
        };
        const auto motion = [&](std::size_t i) { return base_motion_of(tests[i], choice.block.pulse_s); };
        all.tables.push_back(simulated_falls(equal_ratios(0.08, 0.6, 16), tests.size(), motion, study, run));
    }
    return all;
}

/// Whether a size is tried.
using Allowed = std::function<bool(double slenderness, double height_m)>;

SizedBlock most_likely(const ChoiceTables& all, const std::vector<bool>& falls, const std::vector<bool>& use,
                       const std::vector<double>& tried_spreads, const Allowed& allowed)
{
    SizedBlock best;
    for (std::size_t h = 0; h < all.tables.size(); ++h)
        for (std::size_t median = 0; median < all.tables[h].slenderness.size(); ++median) {
            if (!allowed(all.tables[h].slenderness[median], heights[h]))
                continue;
            for (const double spread : tried_spreads)
                for (const double slip : slips) {
                    const double likely = log_likelihood(all.tables[h], median, falls, use, spread, slip);
                    if (likely > best.log_likelihood) {
                        best = {all.choice.block, spread, slip, likely};
                        best.block.height_m = heights[h];
                        best.block.slenderness = all.tables[h].slenderness[median];
                    }
                }
        }
    return best;
}

/// The forecasts of a sized block of a choice.
std::vector<Forecast> forecasts(const ChoiceTables& all, const SizedBlock& sized, const std::vector<DoublePulse>& tests,
                                const std::vector<bool>& use)
{
    const auto h =
        static_cast<std::size_t>(std::find(heights.begin(), heights.end(), sized.block.height_m) - heights.begin());
    const FallTable& table = all.tables[h];
    const auto median = static_cast<std::size_t>(
        std::find(table.slenderness.begin(), table.slenderness.end(), sized.block.slenderness) -
        table.slenderness.begin());
    std::vector<Forecast> all_of_them;
    for (std::size_t i = 0; i < tests.size(); ++i)
        if (use[i])
            all_of_them.push_back({with_slip(table.share(i, median, sized.spread), sized.slip), tests[i].fell,
                                   fmt::format("{:g}", tests[i].distance_m)});
    return all_of_them;
}

std::string size_text(const SizedBlock& s)
{
    return fmt::format("{:.0f} x {:.0f} mm", 1000 * s.block.slenderness * s.block.height_m, 1000 * s.block.height_m);
}

/// A reading of what the block was: a model of it and its forecasts of the held-out tests.
struct Reading {
    SizedBlock sized;
    std::vector<Forecast> held;
};
enum { same_size, free_size };

struct ChoiceResult {
    std::string name;
    Scores plain;            ///< of all tests, with the size of the published simulation; nothing fitted to tests
    std::vector<char> falls; ///< (measured) the same
    std::array<Reading, 2> reading; ///< with that size, and with a size of its own
};

struct PulseResults {
    std::vector<DoublePulse> measured, published;
    std::size_t fitted = 0;
    SizedBlock reproduction; ///< the baseline's block fitted to the published simulation
    Scores reproduced;       ///< of that simulation
    std::vector<ChoiceResult> choices;
    std::array<std::size_t, 2> likeliest{}; ///< of each reading, on the fitting half
    std::vector<Forecast> by_rule;          ///< (held out) logistic rule of ln BD and ln velocity
    std::vector<Forecast> by_published;     ///< (held out) the published simulation's nearest point
    Ends simulated;                         ///< of all blocks in all tests
};

/// The nearest published point at the same distance as nearly as the two grids allow.
const DoublePulse& nearest(const std::vector<DoublePulse>& published, const DoublePulse& test)
{
    const auto off = [&](const DoublePulse& p) {
        // steps of the published grid
        const double d = (p.distance_m - test.distance_m) / 0.005, v = (p.velocity_m_s - test.velocity_m_s) / 0.05;
        return d * d + v * v;
    };
    return *std::min_element(published.begin(), published.end(),
                             [&](const DoublePulse& a, const DoublePulse& b) { return off(a) < off(b); });
}

/// What needs no mechanics: a rule fitted to the fitting half, and the published answers, worth what they are there.
void simple_rules(PulseResults& r, const std::vector<bool>& fits)
{
    const auto numbers = [](const DoublePulse& t) {
        return std::vector<double>{std::log(t.distance_m), std::log(t.velocity_m_s)};
    };
    std::vector<std::vector<double>> x;
    std::vector<bool> falls, answers;
    for (std::size_t i = 0; i < r.measured.size(); ++i)
        if (fits[i]) {
            x.push_back(numbers(r.measured[i]));
            falls.push_back(r.measured[i].fell);
            answers.push_back(nearest(r.published, r.measured[i]).fell);
        }
    const Logistic rule = fit_logistic(x, falls);
    const Answers worth = answers_worth(answers, falls);
    for (std::size_t i = 0; i < r.measured.size(); ++i)
        if (const DoublePulse& t = r.measured[i]; !fits[i]) {
            const std::string group = fmt::format("{:g}", t.distance_m);
            r.by_rule.push_back({rule.probability(numbers(t)), t.fell, group});
            r.by_published.push_back({worth.of(nearest(r.published, t).fell), t.fell, group});
        }
}

PulseResults compute(const PagePlace& place)
{
    const std::filesystem::path folder = place.data / "published";
    PulseResults r;
    r.measured = read_double_pulses(folder / "ceh2016_single_block_scale1_experiment.csv");
    r.published = read_double_pulses(folder / "ceh2016_single_block_scale1_nscd_simulation.csv");
    std::vector<bool> fits, held;
    for (std::size_t i = 0; i < r.measured.size(); ++i) {
        fits.push_back(i % 2 == 0);
        held.push_back(i % 2 == 1);
        r.fitted += fits.back();
    }
    simple_rules(r, fits);
    const std::vector<bool> all(r.measured.size(), true), all_published(r.published.size(), true);
    const std::vector<Choice> choice = choices();
    const Allowed any = [](double, double) { return true; };
    const ChoiceTables reproduction = simulate(choice.front(), r.published, place.run);
    r.reproduction = most_likely(reproduction, fell(r.published), all_published, {0}, any);
    r.reproduced = score(forecasts(reproduction, r.reproduction, r.published, all_published));
    const Allowed published_size = [&](double slenderness, double height_m) {
        return slenderness == r.reproduction.block.slenderness && height_m == r.reproduction.block.height_m;
    };
    for (const Choice& c : choice) {
        if (!place.quiet)
            fmt::print(stderr, "ceh2016: {}\n", c.name);
        const ChoiceTables tables = simulate(c, r.measured, place.run);
        for (const FallTable& table : tables.tables)
            for (const Ends& ends : table.ends)
                r.simulated.add(ends);
        ChoiceResult result;
        result.name = c.name;
        SizedBlock sure = r.reproduction;
        sure.slip = 0;
        const std::vector<Forecast> plain = forecasts(tables, sure, r.measured, all);
        result.plain = score(plain);
        for (const Forecast& f : plain)
            result.falls.push_back(f.probability >= 0.5);
        for (const int which : {same_size, free_size}) {
            Reading& reading = result.reading[static_cast<std::size_t>(which)];
            reading.sized =
                most_likely(tables, fell(r.measured), fits, spreads, which == same_size ? published_size : any);
            reading.held = forecasts(tables, reading.sized, r.measured, held);
        }
        r.choices.push_back(std::move(result));
        for (const std::size_t which : {same_size, free_size})
            if (r.choices.back().reading[which].sized.log_likelihood >
                r.choices[r.likeliest[which]].reading[which].sized.log_likelihood)
                r.likeliest[which] = r.choices.size() - 1;
    }
    return r;
}

std::string reading_table(const PulseResults& r, std::size_t which)
{
    std::string text = markdown_head("choice | size | spread | log-likelihood, fitting half | held out: right | false "
                                     "falls | false stands | Brier | log");
    for (std::size_t k = 0; k < r.choices.size(); ++k) {
        const Reading& reading = r.choices[k].reading[which];
        const Scores s = score(reading.held);
        const char* strong = k == r.likeliest[which] ? "**" : "";
        text += markdown_row("{0}{1}{0} | {2} | {3:g} | {4:.2f} | {5:.3f} | {6} | {7} | {8:.3f} | {9:.3f}", strong,
                             r.choices[k].name, size_text(reading.sized), reading.sized.spread,
                             reading.sized.log_likelihood, s.right, s.false_falls, s.false_stands, s.brier, s.log);
    }
    const std::vector<Forecast>&after = r.choices[r.likeliest[which]].reading[which].held,
          &before = r.choices.front().reading[which].held;
    return text + fmt::format("\nThe choice with the highest likelihood on the fitting half, **{}**, changes the "
                              "scores on the held-out half relative to the baseline: {} of right answers, {} of the "
                              "Brier score, {} of the log score (95 % "
                              "intervals, bootstrap over the distances BD).\n\n",
                              r.choices[r.likeliest[which]].name,
                              signed_interval(difference(after, before, share_right)),
                              signed_interval(difference(after, before, brier)),
                              signed_interval(difference(after, before, log_loss)));
}

/// In words, whether a gain of the Brier score is one.
const char* verdict(const Estimate& gain)
{
    return gain.high < 0 ? "a gain" : gain.low > 0 ? "a loss" : "no proven gain";
}

/// How often the published simulation, taken at its nearest point, is right.
Scores published_scores(const PulseResults& r)
{
    Scores published;
    for (const DoublePulse& test : r.measured) {
        const bool foretold = nearest(r.published, test).fell;
        published.right += (foretold == test.fell) / static_cast<double>(r.measured.size());
        published.false_falls += foretold && !test.fell;
        published.false_stands += !foretold && test.fell;
    }
    return published;
}

std::string opening(const PulseResults& r)
{
    std::array<Estimate, 2> gain;
    for (const std::size_t which : {same_size, free_size})
        gain[which] =
            difference(r.choices[r.likeliest[which]].reading[which].held, r.choices.front().reading[which].held, brier);
    return fmt::format(
        "# A block under a double pulse\n\nThis page is generated by `scripts/measured.sh --case ceh2016`. "
        "Version {}.\n\nThe test is a block on a base that is hit, slides and is stopped. A published rigid-body "
        "simulation (non-smooth contact dynamics) predicts falls that did not happen, and so does the engine's block "
        "without slip: {} false falls, {} of {} tests right. This page varies the unstated parameters, first one at a "
        "time and then two, to find which of them move the boundary towards the experiment.\n\n- If the block has the "
        "size that explains the published simulation, the change with the highest likelihood is **{}**: {} on held-out "
        "tests, {} of the Brier score.\n- If the size is free as well, the change with the highest likelihood is "
        "**{}**: {}, {} of the Brier score. A free size improves the baseline as much as the other parameters do: with "
        "{} it is right in {:.3f} of the held-out tests.\n\nThe error can therefore be corrected, but these outcomes "
        "alone do not identify its cause: the block's size would have to be known. A logistic rule of the two numbers, "
        "without mechanics, is right in {:.3f} of the held-out tests, the published simulation in {:.3f}.\n\n",
        code_version(), r.choices.front().plain.false_falls,
        std::lround(r.choices.front().plain.right * static_cast<double>(r.measured.size())), r.measured.size(),
        r.choices[r.likeliest[same_size]].name, verdict(gain[same_size]), signed_interval(gain[same_size]),
        r.choices[r.likeliest[free_size]].name, verdict(gain[free_size]), signed_interval(gain[free_size]),
        size_text(r.choices.front().reading[free_size].sized), score(r.choices.front().reading[free_size].held).right,
        score(r.by_rule).right, score(r.by_published).right);
}

std::string data_section(const PulseResults& r)
{
    const Scores published = published_scores(r);
    return fmt::format(
        "## The data\n\nCeh, Camenen, Bicanic, Pellegrino and Petrinic 2016 (Int. J. Masonry Res. Innov. 1(4), doi "
        "10.1504/IJMRI.2016.081279), the single block of scale 1: {} tests and {} simulations, read from the markers "
        "of two figures (accuracy about 0.004 m/s; circles are interpreted as no fall and triangles as a fall). "
        "The source gives the distance BD that the base moves to its stopper, and its peak velocity. It does **not** "
        "give the block's size, the friction under it, or the time history of the base velocity. Every second test "
        "in the order of the file (BD, then velocity), from the first on, is for fitting ({}); the others are held out "
        "({}).\n\nThe published simulation, evaluated at its nearest point, is right in {:.3f} of the tests, with {} "
        "false falls and {} false stands.\n\n",
        r.measured.size(), r.published.size(), r.fitted, r.measured.size() - r.fitted, published.right,
        published.false_falls, published.false_stands);
}

std::string model_section(const PulseResults& r)
{
    return fmt::format(
        "## The model\n\nA planar rigid rectangle; a triangular pulse of acceleration gives the base its velocity, an "
        "equal pulse stops it, and the velocity is constant in between. Baseline: friction high enough to exclude slip "
        "({:g}), "
        "pulses of {:g} ms, dashpots of ratio {:g} at the centroid.\n\n**Block size.** The size that maximizes the "
        "likelihood of the published *simulation* is {}. With it the engine agrees with {:.3f} of the {} published "
        "simulations. It is an effective size and not a measurement of the block.\n\n",
        no_slip, 1000 * PulsedBlock{}.pulse_s, PulsedBlock{}.damping_ratio, size_text(r.reproduction),
        r.reproduced.right, r.published.size());
}

std::string choices_section(const PulseResults& r)
{
    std::string text =
        "## Errors, and the effect of each parameter\n\nThe block of this size against all tests, with one parameter "
        "changed at a time (then two). Nothing in this table is fitted to the experiment:\n\n" +
        markdown_head("changed | right | false falls | false stands");
    for (const ChoiceResult& c : r.choices)
        text += markdown_row("{} | {:.3f} | {} | {}", c.name, c.plain.right, c.plain.false_falls, c.plain.false_stands);
    return text;
}

std::string gain_section(const PulseResults& r)
{
    std::string text =
        "\nFriction below the slenderness prevents rocking. Friction slightly above it limits the impulse that the "
        "two short pulses transfer to the block.\n\n![Measured outcomes, and the errors of the two "
        "models](images/ceh2016_boundary.png)\n\n## Gain on held-out tests\n\n**Fixed size, as above.** For each "
        "choice, a spread of slenderness and a share of tests "
        "with random outcome are fitted on the fitting half:\n\n";
    text += reading_table(r, same_size);
    text += "**Free size**, also fitted on the fitting half:\n\n" + reading_table(r, free_size);
    return text;
}

std::string without_mechanics(const PulseResults& r)
{
    std::string text = "**Without mechanics**, on the same held-out tests:\n\n" +
                       markdown_head("predictor | right | false falls | false stands | Brier | log");
    for (const auto& [name, held] :
         {std::pair{"the published simulation's nearest point, calibrated on the fitting half", &r.by_published},
          {"logistic rule of ln BD and ln velocity, fitted on the fitting half", &r.by_rule}}) {
        const Scores s = score(*held);
        text += markdown_row("{} | {:.3f} | {} | {} | {:.3f} | {:.3f}", name, s.right, s.false_falls, s.false_stands,
                             s.brier, s.log);
    }
    for (const std::size_t which : {same_size, free_size})
        text += fmt::format(
            "{}he best choice with {} changes the Brier score relative to this rule by {}",
            which == same_size ? "\nT" : ", t", which == same_size ? "that size" : "a free size",
            signed_interval(difference(r.choices[r.likeliest[which]].reading[which].held, r.by_rule, brier)));
    text += ".\n\n";
    return text;
}

std::string limits_section(const PulseResults& r)
{
    return fmt::format(
        "An interval that contains 0 does not demonstrate a gain. The number of held-out tests, {}, is "
        "small.\n\n## Limits\n\n- The block's size is unknown. It is fitted twice for two purposes, and "
        "neither value is claimed to be the true size. Size and friction are partly interchangeable.\n- "
        "The choices were listed with knowledge of the whole boundary (their false falls and false "
        "stands are printed above), and those that combine friction with the dashpot were added after "
        "the scores of both halves were known. The selection among them uses the fitting half alone. The "
        "held-out half is therefore not independent, and the gain on it may be overestimated.\n- The "
        "halves interleave: a held-out test has fitted neighbours on both sides. The scores therefore "
        "assess interpolation within this set-up and not another set-up.\n- A block counts as fallen "
        "when its centre is below 0.85 of its height at rest, or when it has permanently rotated past "
        "the balance point. Lying flat is not required, because a realization could become invalid when "
        "the long side hits the ground. A realization that becomes invalid after a rotation of more than "
        "1 rad counts as fallen, any other invalid one as standing: {} and {} of {}.\n- The velocity of "
        "the base between the two impacts is assumed constant. The base slides and therefore decelerates "
        "by an amount that is not given.\n- The markers are read from a figure; overlapping markers were "
        "separated by hand.\n- It is not known whether the published simulation used a high friction. "
        "Its agreement with a block that does not slip shows only that the behaviour is equivalent.\n",
        r.measured.size() - r.fitted, r.simulated.on_its_side, r.simulated.set_aside, r.simulated.total);
}

std::string page(const PulseResults& r)
{
    return opening(r) + data_section(r) + model_section(r) + choices_section(r) + gain_section(r) +
           without_mechanics(r) + limits_section(r);
}

void draw(const PulseResults& r, const PagePlace& place)
{
    const ChoiceResult &before = r.choices.front(), &after = r.choices[r.likeliest[same_size]];
    Series stood{"stood", {}, {}}, fell_{"fell", {}, {}}, wrong_before{"baseline is wrong", {}, {}},
        wrong_after{after.name + ": wrong", {}, {}};
    for (std::size_t i = 0; i < r.measured.size(); ++i) {
        const DoublePulse& test = r.measured[i];
        Series& s = test.fell ? fell_ : stood;
        s.x.push_back(test.distance_m);
        s.y.push_back(test.velocity_m_s);
        if ((before.falls[i] != 0) != test.fell) {
            wrong_before.x.push_back(test.distance_m - 4e-4);
            wrong_before.y.push_back(test.velocity_m_s + 0.008);
        }
        if ((after.falls[i] != 0) != test.fell) {
            wrong_after.x.push_back(test.distance_m + 4e-4);
            wrong_after.y.push_back(test.velocity_m_s + 0.008);
        }
    }
    wrong_before.colour = 5;
    wrong_after.colour = 3;
    std::vector<Series> shown;
    for (const Series& s : {stood, fell_, wrong_before, wrong_after})
        if (!s.x.empty())
            shown.push_back(s);
    verification::write_small({verification::curves({"distance to the stopper BD [m]", false, 0, 0.045},
                                                    {"velocity of the base [m/s]", false, 0, 0.75}, shown)},
                              place.images() / "ceh2016_boundary.png");
}

std::string study_file(const SizedBlock& sized, const std::string& what)
{
    return fmt::format("# {}\n# Generated by `stylobate_measured` with the page docs/measured/ceh2016.md.\n"
                       "# A base motion, as FILE: `stylobate_measured DATA_DIR --double-pulse BD V --to FILE`\n#\n"
                       "#   stylobate run THIS.toml --set excitation.file=FILE\n\n{}",
                       what, pulsed_study(sized.block).text);
}

} // namespace

std::vector<DoublePulse> read_double_pulses(const std::filesystem::path& file)
{
    const Table table(file);
    std::vector<DoublePulse> tests;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const std::string& marker = table.text(row, "marker");
        const bool stood = marker.find("no overturning") != std::string::npos;
        if (!stood && marker.find("overturning") == std::string::npos)
            throw InputError(file.string(), static_cast<long>(row) + 2,
                             fmt::format("marker = '{}' is neither 'overturning' nor 'no overturning'", marker));
        const DoublePulse test{table.number(row, "BD_m"), table.number(row, "v_peak_m_s"), !stood};
        if (!(test.distance_m > 0 && test.velocity_m_s > 0))
            throw InputError(file.string(), static_cast<long>(row) + 2, "distance and velocity must be above 0");
        tests.push_back(test);
    }
    return tests;
}

Motion base_motion_of(const DoublePulse& test, double pulse_s)
{
    // middles of the two pulses are distance / velocity apart, in samples of which half a pulse is a whole number
    const double apart = test.distance_m / test.velocity_m_s;
    const double half = std::min(pulse_s, apart) / 2;
    const auto per_half = std::max(1L, std::lround(half / 2.5e-4));
    const auto samples_apart = std::max(2 * per_half, std::lround(apart / half * static_cast<double>(per_half)));
    const double dt = apart / static_cast<double>(samples_apart);
    const double peak = test.velocity_m_s / (static_cast<double>(per_half) * dt);
    const auto triangle = [&](long from_middle) {
        return peak * std::max(0.0, 1 - std::fabs(static_cast<double>(from_middle)) / static_cast<double>(per_half));
    };
    std::vector<double> acceleration;
    for (long i = 0; i <= samples_apart + 2 * per_half; ++i)
        acceleration.push_back(triangle(i - per_half) - triangle(i - per_half - samples_apart));
    Motion motion = motion_of(std::move(acceleration), dt);
    motion.predominant_frequency_hz = 1; // nothing stretches it
    motion.source = fmt::format("{} m/s over {} m", test.velocity_m_s, test.distance_m);
    return motion;
}

Study pulsed_study(const PulsedBlock& block)
{
    Study study;
    const double width = block.slenderness * block.height_m;
    const double mass = density * width * block.height_m * depth;
    study.structure = equal_column(1, 0, width, block.height_m, depth, mass);
    study.contact.normal_stiffness_n_m2 = mass * gravity / (softness * width * block.slenderness * width);
    study.contact.tangential_stiffness_n_m = study.contact.normal_stiffness_n_m2 * width;
    study.contact.normal_damping_ratio = block.damping_ratio;
    study.contact.tangential_damping_ratio = block.damping_ratio;
    study.contact.friction = block.friction;
    study.contact.damping = block.ends ? DampingAt::ends : DampingAt::centroid;
    study.excitation.kind = ExcitationKind::table;
    study.excitation.file = "motion.csv"; // what --set excitation.file replaces
    // beyond balance, but well before its side hits the ground
    study.outcome.collapse_height_fraction = 0.85;
    study.text = study_text(study);
    return study;
}

void ceh2016(const PagePlace& place)
{
    const PulseResults r = compute(place);
    draw(r, place);
    write_whole(
        place.studies / "double_pulse_baseline.toml",
        study_file(r.choices.front().reading[same_size].sized,
                   "A block under a double pulse, of the size that explains a published simulation: the baseline."));
    write_whole(
        place.studies / "double_pulse_extended.toml",
        study_file(r.choices[r.likeliest[same_size]].reading[same_size].sized,
                   fmt::format("A block under a double pulse, of the size that explains a published simulation: {}.",
                               r.choices[r.likeliest[same_size]].name)));
    write_whole(place.docs / "ceh2016.md", page(r));
}

} // namespace stylobate::measured
