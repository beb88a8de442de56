/// The case of the boulders on the shaking table: fits on one half of the ground motions, judges on the other.

#include "io/files/atomic_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/evidence/measured/boulders/boulder_model.hpp"
#include "studies/evidence/measured/parts/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace stylobate::measured {

namespace {

constexpr int realizations = 64;
const std::vector<double> heights{0.4, 0.55};
const std::vector<double> stiffnesses{3e8, 1e9};

/// Ways to lose energy in an impact; the first is the baseline's.
struct Dashpot {
    bool ends;
    double ratio;
};
const std::vector<Dashpot> dashpots{{false, 0.1}, {false, 0.5}, {true, 0.1}, {true, 0.5}};
bool has(const BoulderModel& model, const Dashpot& dashpot)
{
    return model.ends == dashpot.ends && model.damping_ratio == dashpot.ratio;
}
const std::vector<double> no_spread{0};
const std::vector<double> spreads{0.05, 0.1, 0.15, 0.2, 0.3, 0.4};

/// The tests that are held out, once for each boulder.
template <class Probability>
Predictor predictor(const BoulderResults& r, const std::string& name, Probability probability)
{
    Predictor p{name, {}, 0};
    for (std::size_t s = 0; s < boulders; ++s)
        for (std::size_t i = 0; i < r.data.tests.size(); ++i)
            if (!r.fits[i])
                p.held.push_back({probability(i, s), r.data.tests[i].fell[s], r.data.tests[i].ground_motion});
    return p;
}

/// What an answer of a yes-or-no model is worth, by the fitting half.
Answers worth(const BoulderResults& r, std::size_t boulder, const std::vector<bool>& answer)
{
    std::vector<bool> predicted, fell;
    for (std::size_t i = 0; i < r.data.tests.size(); ++i)
        if (r.fits[i]) {
            predicted.push_back(answer[i]);
            fell.push_back(r.data.tests[i].fell[boulder]);
        }
    return answers_worth(predicted, fell);
}

std::vector<bool> column(const BoulderData& data, std::size_t boulder, std::size_t model)
{
    std::vector<bool> answers;
    for (const BoulderTest& test : data.tests)
        answers.push_back(test.predicted[boulder][model]);
    return answers;
}

void published_models(BoulderResults& r)
{
    std::array<std::size_t, boulders> best{};
    for (std::size_t s = 0; s < boulders; ++s) {
        double most = -1;
        for (std::size_t m = 0; m < r.data.published[s].size(); ++m) {
            const std::vector<bool> answers = column(r.data, s, m);
            Predictor p{r.data.published[s][m], {}, 0};
            double right = 0;
            for (std::size_t i = 0; i < r.data.tests.size(); ++i) {
                const BoulderTest& test = r.data.tests[i];
                if (r.fits[i])
                    right += answers[i] == test.fell[s];
                else
                    p.held.push_back({answers[i] ? 1.0 : 0.0, test.fell[s], test.ground_motion}); // as it stands
            }
            if (right > most) {
                most = right;
                best[s] = m;
            }
            r.published[s].push_back(std::move(p));
        }
    }
    std::array<Answers, boulders> value;
    for (std::size_t s = 0; s < boulders; ++s)
        value[s] = worth(r, s, column(r.data, s, best[s]));
    r.by_published =
        predictor(r, "published numerical model, the one that is best on the fitting half",
                  [&](std::size_t i, std::size_t s) { return value[s].of(r.data.tests[i].predicted[s][best[s]]); });
}

void simple_rules(BoulderResults& r)
{
    std::array<double, boulders> rate{};
    std::array<Logistic, boulders> rule;
    const auto numbers = [&](std::size_t i) {
        return std::vector<double>{std::log(r.data.tests[i].pga_g), std::log(r.data.tests[i].pgv_over_pga_s)};
    };
    for (std::size_t s = 0; s < boulders; ++s) {
        std::vector<std::vector<double>> x;
        std::vector<bool> fell;
        for (std::size_t i = 0; i < r.data.tests.size(); ++i)
            if (r.fits[i]) {
                x.push_back(numbers(i));
                fell.push_back(r.data.tests[i].fell[s]);
                rate[s] += r.data.tests[i].fell[s];
            }
        rate[s] /= static_cast<double>(fell.size());
        rule[s] = fit_logistic(x, fell);
    }
    r.by_rate =
        predictor(r, "the share that fell in the fitting half", [&](std::size_t, std::size_t s) { return rate[s]; });
    r.by_intensity = predictor(r, "logistic rule of ln PGA and ln(PGV/PGA)",
                               [&](std::size_t i, std::size_t s) { return rule[s].probability(numbers(i)); });
}

/// Judges a fit by ensembles of the study that `stylobate run` takes.
Predictor judged(BoulderResults& r, const std::string& name, const BoulderFit& fit, const RunOptions& run)
{
    std::array<Study, boulders> study;
    for (std::size_t s = 0; s < boulders; ++s)
        study[s] =
            parse_study(boulder_study(fit.model[s], fit.model[s].slenderness_spread > 0 ? realizations : 1).text, name);
    Predictor p = predictor(r, name, [&](std::size_t i, std::size_t s) {
        const Ends ends = ensemble_ends(study[s], r.data.tests[i].motion, run);
        r.judging.add(ends);
        const std::uint64_t valid = ends.total - ends.set_aside;
        return with_slip(valid == 0 ? 0 : static_cast<double>(ends.fallen) / static_cast<double>(valid), fit.slip);
    });
    p.log_likelihood = fit.log_likelihood;
    return p;
}

/// The mesh's bounding box as the block.
Predictor box(const BoulderResults& r, const RunOptions& run)
{
    BoulderModel model = r.baseline.model[0];
    model.height_m = r.body.extent_m[2];
    model.slenderness = std::min(r.body.extent_m[0], r.body.extent_m[1]) / model.height_m;
    std::vector<bool> falls;
    for (const BoulderTest& test : r.data.tests)
        falls.push_back(falls_in(test.motion, {boulder_study(model)}, run.isa)[0] != 0);
    std::array<Answers, boulders> value{worth(r, 0, falls), worth(r, 1, falls)};
    return predictor(r, "block of the size of the boulder's box",
                     [&](std::size_t i, std::size_t s) { return value[s].of(falls[i]); });
}

/// From the table itself, for tests that are in one half or the other.
std::vector<Forecast> from_table(const BoulderData& data, const std::vector<BoulderTable>& tables,
                                 const BoulderFit& fit, const std::vector<bool>& use)
{
    const auto table = std::find_if(tables.begin(), tables.end(), [&](const BoulderTable& t) {
        return t.variant.height_m == fit.model[0].height_m &&
               t.variant.normal_stiffness_n_m2 == fit.model[0].normal_stiffness_n_m2 &&
               has(t.variant, {fit.model[0].ends, fit.model[0].damping_ratio});
    });
    std::vector<Forecast> forecasts;
    for (std::size_t s = 0; s < boulders; ++s) {
        const auto median = static_cast<std::size_t>(
            std::find(table->falls.slenderness.begin(), table->falls.slenderness.end(), fit.model[s].slenderness) -
            table->falls.slenderness.begin());
        for (std::size_t i = 0; i < data.tests.size(); ++i)
            if (use[i])
                forecasts.push_back(
                    {with_slip(table->falls.share(i, median, fit.model[s].slenderness_spread), fit.slip),
                     data.tests[i].fell[s], data.tests[i].ground_motion});
    }
    return forecasts;
}

std::string study_file(const BoulderFit& fit, const std::string& what)
{
    const bool many = fit.model[0].slenderness_spread > 0;
    const Study study = boulder_study(fit.model[0], many ? realizations : 1);
    return fmt::format(
        "# {}\n"
        "# Generated by `stylobate_measured` with the page docs/measured/rock_shake_table.md.\n"
        "# The motion of the table in a test, as FILE: `stylobate_measured DATA_DIR --boulder-motion TEST --to FILE`\n"
        "#\n"
        "#   stylobate run THIS.toml --set excitation.file=FILE\n"
        "#\n"
        "# The other boulder: --set structure.drum_width_m={:.6g}\n\n{}",
        what, fit.model[1].slenderness * fit.model[1].height_m, study.text);
}

void say(const PagePlace& place, const std::string& text)
{
    if (!place.quiet)
        fmt::print(stderr, "rock_shake_table: {}\n", text);
}

/// Reads the tests and deals the ground motions out to the two halves.
void read_tests(const std::filesystem::path& folder, BoulderResults& r)
{
    r.data = read_boulders(folder);
    std::vector<std::string> motions;
    for (const BoulderTest& test : r.data.tests)
        motions.push_back(test.ground_motion);
    r.fits = fitting_half(motions);
    std::set<std::string> fitting, held;
    for (std::size_t i = 0; i < motions.size(); ++i)
        (r.fits[i] ? fitting : held).insert(motions[i]);
    r.fitting_motions = fitting.size();
    r.held_motions = held.size();
}

/// Every dashpot, stiffness and height under every test.
std::vector<BoulderTable> simulate_all(BoulderResults& r, const PagePlace& place)
{
    std::vector<BoulderTable> tables;
    for (const Dashpot& dashpot : dashpots) {
        for (const double stiffness : stiffnesses)
            for (const double height : heights) {
                BoulderModel variant;
                variant.height_m = height;
                variant.normal_stiffness_n_m2 = stiffness;
                variant.ends = dashpot.ends;
                variant.damping_ratio = dashpot.ratio;
                tables.push_back(simulate(variant, r.data.tests, place.run));
                const BoulderFit now = best_fit({tables.back()}, r.data.tests, r.fits, spreads);
                say(place, fmt::format("{}, {}, K_N {:g}, height {}: log-likelihood {:.1f}",
                                       dashpot.ends ? "ends" : "centroid", dashpot.ratio, stiffness, height,
                                       now.log_likelihood));
            }
    }
    for (const BoulderTable& table : tables)
        for (const Ends& ends : table.falls.ends)
            r.fitting.add(ends);
    return tables;
}

std::vector<BoulderTable> with_dashpot(const std::vector<BoulderTable>& tables, const Dashpot& dashpot)
{
    std::vector<BoulderTable> some;
    for (const BoulderTable& table : tables)
        if (has(table.variant, dashpot))
            some.push_back(table);
    return some;
}

/// The baseline, its extensions, and what each dashpot and stiffness comes to.
void fit_models(BoulderResults& r, const std::vector<BoulderTable>& tables, const PagePlace& place)
{
    const std::vector<BoulderTable> plain = with_dashpot(tables, dashpots.front());
    r.baseline = best_fit(plain, r.data.tests, r.fits, no_spread);
    r.scattered = best_fit(plain, r.data.tests, r.fits, spreads);
    r.extended = best_fit(tables, r.data.tests, r.fits, spreads);
    for (const double part : {-0.15, 0.15}) {
        BoulderModel variant = r.extended.model[0];
        variant.eccentricity_m = part * variant.slenderness * variant.height_m / 2;
        const BoulderFit leaning =
            best_fit({simulate(variant, r.data.tests, place.run)}, r.data.tests, r.fits, spreads);
        if (part == -0.15 || leaning.log_likelihood > r.one_sided.log_likelihood)
            r.one_sided = leaning;
    }
    for (const Dashpot& dashpot : dashpots)
        for (const double stiffness : stiffnesses) {
            std::vector<BoulderTable> some = with_dashpot(tables, dashpot);
            std::erase_if(some, [&](const BoulderTable& t) { return t.variant.normal_stiffness_n_m2 != stiffness; });
            Dissipation d{best_fit(some, r.data.tests, r.fits, spreads), 0, 0};
            d.restitution = restitution(d.best.model[0]);
            const double sine = std::sin(std::atan(d.best.model[0].slenderness));
            d.housner = 1 - 1.5 * sine * sine;
            r.dissipation.push_back(d);
        }
}

/// All predictors on the half that was held out.
void judge_models(BoulderResults& r, const std::filesystem::path& folder, const RunOptions& run)
{
    const Mesh mesh = read_obj(folder / "mesh" / "final_sp2_1.obj.gz");
    r.body = body_of(mesh);
    r.stances = stances(mesh, 36);
    simple_rules(r);
    published_models(r);
    r.by_box = box(r, run);
    r.by_baseline = judged(r, "baseline: fitted block, one realization", r.baseline, run);
    r.by_scattered = judged(r, "the same with scatter: ensemble", r.scattered, run);
    r.by_extended = judged(r, "extended: scatter and dissipation", r.extended, run);
    for (std::size_t s = 0; s < boulders; ++s) {
        const std::size_t count = r.by_extended.held.size() / boulders;
        const auto first = r.by_extended.held.begin() + static_cast<std::ptrdiff_t>(s * count);
        r.extended_of[s] = {"extended", {first, first + static_cast<std::ptrdiff_t>(count)}, 0};
    }
}

/// The gain with the halves exchanged.
void swap_halves(BoulderResults& r, const std::vector<BoulderTable>& tables)
{
    std::vector<bool> other;
    for (const bool fits : r.fits)
        other.push_back(!fits);
    const std::vector<Forecast> extended =
        from_table(r.data, tables, best_fit(tables, r.data.tests, other, spreads), r.fits);
    const std::vector<BoulderTable> plain = with_dashpot(tables, dashpots.front());
    const std::vector<Forecast> baseline =
        from_table(r.data, tables, best_fit(plain, r.data.tests, other, no_spread), r.fits);
    r.swapped_brier = difference(extended, baseline, brier);
    r.swapped_right = difference(extended, baseline, share_right);
}

} // namespace

void rock_shake_table(const PagePlace& place)
{
    const std::filesystem::path folder = place.data / "rock_shake_table";
    BoulderResults r;
    r.realizations = realizations;
    read_tests(folder, r);
    const std::vector<BoulderTable> tables = simulate_all(r, place);
    fit_models(r, tables, place);
    say(place, "evaluation on the held-out half");
    judge_models(r, folder, place.run);
    swap_halves(r, tables);

    draw_boulders(r, place);
    write_whole(place.studies / "boulder_baseline.toml",
                study_file(r.baseline, "A boulder on a shaking table as a planar block, fitted: the baseline."));
    write_whole(
        place.studies / "boulder_extended.toml",
        study_file(r.extended, "The baseline with scatter from test to test and dissipation at impacts, fitted."));
    write_whole(place.docs / "rock_shake_table.md", boulder_page(r, "images/"));
}

} // namespace stylobate::measured
