/// Pairs of realizations, from rows made by hand.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "studies/decisions/compare/compare_studies.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/decisions/compare/pairing.hpp"
#include "studies/decisions/search/search_objective.hpp"
#include "tests/studies/decisions/interval_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace stylobate {
namespace {

const std::string structure = "[structure]\nblocks = 3\ndrum_width_m = 1\ndrum_height_m = 1\ndepth_m = 1\n"
                              "density_kg_m3 = 2700\n[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = 0.7\n";
const std::string surface = "[study]\nkind = \"surface\"\nrealizations = 4\n" + structure +
                            "[excitation]\nkind = \"harmonic\"\n[surface]\nfrequency_hz = { from = 1, to = 2, count = "
                            "2 }\npga_m_s2 = { from = 1, to = 3, count = 3 }\n";
const std::string fragility =
    "[study]\nkind = \"fragility\"\nrealizations = 4\n" + structure +
    "[excitation]\nkind = \"pulse\"\nfrequency_hz = 1\n[fragility]\nmotions = 9\nintensity = { from = 1, to = 2, "
    "count = 2 }\n";

ResultRow row(std::uint64_t index, State state, std::vector<double> inputs = {})
{
    ResultRow made;
    made.index = index;
    made.inputs = std::move(inputs);
    made.outcome.state = state;
    return made;
}

struct Sides {
    explicit Sides(const std::string& text)
        : study(parse_study(text, "study.toml")), base(study, header), variant(study, header)
    {
    }
    VariantComparison compared() const
    {
        return compare_sides(base, names, variant, names, pair_layout(study, {}, 0.95));
    }

    Study study;
    ResultHeader header;
    StudySide base, variant;
    std::vector<std::string> names;
};

TEST(Pairing, CountsPairsInTheirCells)
{
    Sides s(surface); // 6 cells of 4
    for (std::uint64_t index = 24; index-- > 0;) {
        s.base.add(row(index, index / 4 == 1 && index % 4 < 3 ? State::collapsed : State::stood));
        s.variant.add(row(index, index / 4 == 1 && index % 4 == 3 ? State::collapsed : State::slid));
    }
    const VariantComparison found = s.compared();
    ASSERT_EQ(found.pairs, 24U);
    const LimitComparison& collapse = found.limits.front();
    EXPECT_EQ(collapse.name, "collapse");
    ASSERT_EQ(collapse.cells.size(), 6U);
    EXPECT_EQ(collapse.cells[1].counts, (PairedCounts{0, 3, 1, 0}));
    EXPECT_EQ(collapse.cells[0].counts, (PairedCounts{0, 0, 0, 4}));
    EXPECT_EQ(collapse.cells[1].difference, -0.5);
    EXPECT_NEAR(collapse.overall.difference, -0.5 / 6, 1e-15);
    EXPECT_NEAR(collapse.cells[1].p, 2 * 5 / 16.0, 1e-14); // P(at most 1 of 4)
    EXPECT_EQ(collapse.cells[1].p_adjusted, 1);
    const LimitComparison& slid = found.limits[found.limits.size() - 2];
    EXPECT_EQ(slid.name, "slid");
    EXPECT_EQ(found.limits.back().name, "moving");
    EXPECT_FALSE(slid.damage);
    EXPECT_EQ(slid.cells[0].counts, (PairedCounts{0, 0, 4, 0}));
    EXPECT_EQ(slid.verdict(slid.overall), ChangeVerdict::more);
}

/// A search counts what is valid at all of its points, and says where nothing is.
TEST(Pairing, OfASearchIsOverWhatIsValidEverywhere)
{
    for (const std::string& text : {surface, fragility}) {
        Sides s(text);
        const PairLayout layout = pair_layout(s.study, {}, 0.95);
        const SearchObjective objective({}, "study.toml", s.study, 0.95);
        const std::uint64_t all = s.base.size();
        for (std::uint64_t index = 0; index < all; ++index) {
            s.base.add(row(index, index % 2 == 0 ? State::collapsed : State::invalid));
            s.variant.add(row(index, index % 4 == 0   ? State::collapsed
                                     : index % 4 == 2 ? State::stood
                                                      : State::invalid));
        }
        const PairedNoise noise = objective.noise({&s.base, &s.variant}, 0, layout);
        EXPECT_EQ(noise.share, (std::vector<double>{1, 0.5}));
        StudySide none(s.study, s.header);
        for (std::uint64_t index = 0; index < all; ++index)
            none.add(row(index, index % 2 == 0 ? State::invalid : State::stood));
        try {
            objective.noise({&s.base, &none}, 0, layout);
            ADD_FAILURE() << "nothing is valid in both";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("no realization is valid at all of the points"),
                      std::string::npos);
        }
    }
}

TEST(Pairing, DropsWhatIsInvalidInEither)
{
    Sides s(surface);
    for (std::uint64_t index = 0; index < 24; ++index) {
        s.base.add(row(index, index == 0 ? State::invalid : State::collapsed));
        if (index != 23) // has not been run
            s.variant.add(row(index, index < 2 ? State::invalid : State::collapsed));
    }
    const VariantComparison found = s.compared();
    EXPECT_EQ(found.invalid_base, 1U);
    EXPECT_EQ(found.invalid_variant, 2U);
    EXPECT_EQ(found.dropped, 2U);
    EXPECT_EQ(found.pairs, 21U);
    EXPECT_EQ(found.limits.front().cells[0].counts, (PairedCounts{2, 0, 0, 0}));
    EXPECT_EQ(found.limits.front().overall.counts.pairs(), 21U);
}

TEST(Pairing, AFragilityStudyIsGroupedByItsMotions)
{
    Sides s(fragility); // 9 motions x 2 stripes x 4 structures
    for (std::uint64_t index = 0; index < 72; ++index) {
        const bool strong = index / 4 % 2 == 1, first = index / 8 < 3;
        s.base.add(row(index, strong && first ? State::collapsed : State::stood));
        s.variant.add(row(index, State::stood));
    }
    const VariantComparison found = s.compared();
    const LimitComparison& collapse = found.limits.front();
    EXPECT_EQ(collapse.name, "collapse");
    ASSERT_EQ(collapse.cells.size(), 2U);
    EXPECT_EQ(collapse.cells[1].counts, (PairedCounts{0, 12, 0, 24}));
    // three of nine motions, however many structures: the exact test has 2^3 patterns
    EXPECT_NEAR(collapse.cells[1].p, 0.25, 1e-14);
    EXPECT_GT(collapse.cells[1].upper - collapse.cells[1].lower, 0.4);
    EXPECT_EQ(collapse.overall.counts, (PairedCounts{0, 12, 0, 60}));
}

/// Two motions of two pairs each that end alike: nothing is known of the variance.
TEST(Pairing, WithoutADiscordantPairTheUnpairedNumberIsNotKnown)
{
    const std::vector<PairedCounts> motions = {{1, 0, 0, 1}, {2, 0, 0, 0}};
    const PlaceComparison grouped = compare_place(motions, {.groups = 2, .level = 0.95});
    EXPECT_EQ(grouped.difference, 0);
    EXPECT_TRUE(std::isnan(grouped.unpaired));
    EXPECT_TRUE(std::isnan(compare_place(std::vector<PairedCounts>{{3, 0, 0, 1}}, {.level = 0.95}).unpaired));
    // one discordant pair of two motions: excesses -+1/2 in each, of the base 0, and their difference -+1/2
    EXPECT_NEAR(
        compare_place(std::vector<PairedCounts>{{1, 1, 0, 0}, {2, 0, 0, 0}}, {.groups = 2, .level = 0.95}).unpaired, 4,
        1e-12);
}

/// Cells of 10 and 90 pairs have equal weights: the mean of two shares has the variance of 2^2 / (1/10 + 1/90) = 36
/// trials. The limits are the quantiles of Beta(18.5, 18.5) by the continued fraction of the incomplete beta function.
TEST(Pairing, TheMeanOfCellsHasTheIntervalOfItsVariance)
{
    const std::vector<PairedCounts> cells = {{5, 0, 0, 5}, {40, 5, 5, 40}};
    const PlaceComparison overall = compare_overall(cells, {.cells = 2, .level = 0.95});
    for (const Share& share : {overall.base, overall.variant}) {
        EXPECT_NEAR(share.probability, 0.5, 1e-15);
        EXPECT_NEAR(share.lower, 0.34198404, 1e-7);
        EXPECT_NEAR(share.upper, 0.65801596, 1e-7);
        EXPECT_EQ(share.trials, 100U);
        EXPECT_EQ(share.count, 50U);
    }
}

/// The residual of what still moves is not known: such pairs are left out of its limit states, and counted.
TEST(Pairing, CountsWhatStillMoves)
{
    Sides s(fragility);
    for (std::uint64_t index = 0; index < 72; ++index) {
        ResultRow base = row(index, State::stood), variant = base;
        base.outcome.at_rest = index >= 5;
        variant.outcome.at_rest = index < 70;
        s.base.add(base);
        s.variant.add(variant);
    }
    const VariantComparison found = s.compared();
    const auto residual = std::ranges::find_if(
        found.limits, [](const LimitComparison& limit) { return limit.name.starts_with("residual"); });
    ASSERT_NE(residual, found.limits.end());
    EXPECT_EQ(found.pairs, 72U);
    EXPECT_EQ(found.unknown(found.limits.front()), 0U);
    EXPECT_EQ(found.unknown(*residual), 7U);
    Comparison comparison;
    comparison.variants = {found};
    EXPECT_NE(comparison_text(comparison).find("(7 pairs left out: still moving at the end)"), std::string::npos)
        << comparison_text(comparison);
    EXPECT_NE(comparison_json(comparison).text().find("\"unknown_pairs\": 7"), std::string::npos);
}

void expect_jeffreys(const Share& share, double k, double n)
{
    const auto [lower, upper] = jeffreys_limits(k, n, 0.95);
    EXPECT_NEAR(share.lower, lower, 1e-9);
    EXPECT_NEAR(share.upper, upper, 1e-9);
}

/// Cells of 10 and of 40 pairs have equal weights: their mean share has the variance of 4 / (1/10 + 1/40) = 32 trials
/// of one cell.
TEST(Pairing, OverallEachCellHasTheSameWeight)
{
    const std::vector<PairedCounts> cells = {{2, 3, 1, 4}, {6, 2, 10, 22}};
    const PlaceComparison all = compare_overall(cells, {.cells = 2, .per_cell = 40});
    EXPECT_NEAR(all.base.probability, (0.5 + 0.2) / 2, 1e-15);
    EXPECT_NEAR(all.variant.probability, (0.3 + 0.4) / 2, 1e-15);
    expect_jeffreys(all.base, 11, 32); // 0.35 x 32 = 11.2
    expect_jeffreys(all.variant, 11, 32);
    EXPECT_NEAR(all.difference, (-0.2 + 0.2) / 2, 1e-15);
    EXPECT_EQ(all.counts, (PairedCounts{8, 5, 11, 26}));
    // cell by cell
    const PlaceComparison one = compare_place(std::span(cells).first(1), {.cells = 2, .per_cell = 40});
    expect_jeffreys(one.base, 5, 10);
    expect_jeffreys(one.variant, 3, 10);
    EXPECT_NEAR(one.p, 2 * 5 / 16.0, 1e-14) << "McNemar's: at most 1 of 4";
    // 10 pairs x (1/4 + 0.21) / (4/10 - 1/25)
    EXPECT_NEAR(one.unpaired, 10 * 0.46 / 0.36, 1e-12);
    EXPECT_NEAR(all.unpaired, 50 * (0.46 / 9 + (0.16 + 0.24) / 39) / (0.36 / 9 + (0.3 - 0.04) / 39), 1e-12);
}

/// With a single look the interval is that of a fixed number of pairs, and p that of a normal z.
TEST(Pairing, AtASingleLookLimitsAndPAreTheNormalOnes)
{
    const RepeatedLooks looks({50}, 0.95);
    const PairLayout layout{.cells = 2, .per_cell = 50, .asked = {50, 50}, .looks = &looks};
    const std::vector<PairedCounts> cells = {{10, 1, 6, 33}, {20, 4, 12, 14}};
    const PlaceComparison place = compare_place(std::span(cells).first(1), layout);
    const PlaceComparison fixed = compare_place(std::span(cells).first(1), {.cells = 2, .per_cell = 50});
    EXPECT_NEAR(looks.quantile(), 1.959964, 1e-4) << "the integral over the increments is a sum";
    EXPECT_NEAR(place.lower, fixed.lower, 1e-4);
    EXPECT_NEAR(place.upper, fixed.upper, 1e-4);
    EXPECT_NEAR(place.base.lower, fixed.base.lower, 1e-4);
    EXPECT_NEAR(place.base.upper, fixed.base.upper, 1e-4);
    EXPECT_NEAR(place.p, std::erfc(5 / std::sqrt(7.0) / std::sqrt(2.0)), 1e-4) << "|b - c| / sqrt(b + c)";
    const PlaceComparison overall = compare_overall(cells, layout);
    EXPECT_NEAR(overall.difference, (5 / 50.0 + 8 / 50.0) / 2, 1e-15);
    // V, the variance of each cell's difference: (q - d^2) / (n - 1), over the square of two cells; Tango's interval of
    // (Q - d^2) / V pairs
    const double variance = ((0.14 - 0.01) / 49 + (0.32 - 0.0256) / 49) / 4, q = 0.23, d = 0.13;
    const double n = (q - d * d) / variance, more = n * (q + d) / 2, less = n * (q - d) / 2;
    EXPECT_NEAR(tango_score(more, less, n, overall.lower), 1.959964, 1e-3);
    EXPECT_NEAR(tango_score(more, less, n, overall.upper), -1.959964, 1e-3);
    EXPECT_NEAR(overall.p, std::erfc(d / (overall.upper - overall.lower) * 2 * 1.959964 / std::sqrt(2.0)), 1e-5);
}

/// Three of nine motions are reached by all of their runs: Clopper and Pearson's limits of 3 in 9 (record_share.hpp).
TEST(Pairing, SidesOfAFragilityStudyHaveTheLimitsOfItsMotions)
{
    std::vector<PairedCounts> counts(18);
    for (std::size_t g = 0; g < 9; ++g) {
        counts[g] = {0, 0, 0, 4};
        counts[9 + g] = g < 3 ? PairedCounts{0, 4, 0, 0} : PairedCounts{0, 0, 0, 4};
    }
    const PairLayout layout{.cells = 2, .groups = 9, .per_cell = 4};
    const PlaceComparison place = compare_place(std::span(counts).subspan(9), layout);
    EXPECT_NEAR(place.base.probability, 1.0 / 3, 1e-15);
    EXPECT_NEAR(place.base.lower, quantile(boost::math::beta_distribution<double>(3, 7), 0.025), 2e-3);
    EXPECT_NEAR(place.base.upper, quantile(boost::math::beta_distribution<double>(4, 6), 0.975), 2e-3);
    // over both stripes each of the three has 4 of 8: sums by motion, not by stripe
    const PlaceComparison overall = compare_overall(counts, layout);
    EXPECT_NEAR(overall.difference, -1.0 / 6, 1e-15);
    EXPECT_NEAR(overall.p, 0.25, 1e-14) << "2 of 2^3 patterns of signs";
}

/// A search for the least frequency: each motion's own frequency, over the power law 1e-3 a^-2.
TEST(Pairing, AFrequencyThatIsSearchedIsTheMeanOfTheMotions)
{
    Sides s(fragility); // 9 motions x stripes at 1 and 2 x 4 structures
    const PairLayout layout = pair_layout(s.study, {}, 0.95);
    const SearchObjective objective({.hazard = "k0=1e-3,k=2,measure=pga_m_s2", .keys = {}}, "study.toml", s.study,
                                    0.95);
    for (std::uint64_t index = 0; index < 72; ++index) {
        const std::uint64_t structure = index % 4, stripe = index / 4 % 2, motion = index / 8;
        const std::uint64_t of_base = stripe == 0 ? (motion < 3 ? 2 : 0) : (motion < 6 ? 4 : 1);
        s.base.add(row(index, structure < of_base ? State::collapsed : State::stood));
        s.variant.add(row(index, stripe == 1 && structure < 2 ? State::collapsed : State::stood));
    }
    // P falls linearly in ln a to 0 at 1/2, is linear between 1 and 2 and constant beyond, by parts
    const auto exceeded = [](double a) { return 1e-3 / (a * a); };
    const auto piece = [&](double a, double from, double to) {
        return from * exceeded(a) - to * exceeded(2 * a) +
               (to - from) / std::log(2.0) / 2 * (exceeded(a) - exceeded(2 * a));
    };
    const auto frequency = [&](double at_1, double at_2) {
        return piece(0.5, 0, at_1) + piece(1, at_1, at_2) + at_2 * exceeded(2);
    };
    const std::vector<double> own = {frequency(0.5, 1), frequency(0, 1), frequency(0, 0.25)}; // of three motions each
    const double mean = (own[0] + own[1] + own[2]) / 3;
    const PairedNoise noise = objective.noise({&s.base, &s.variant}, 0, layout);
    ASSERT_EQ(noise.share.size(), 2U);
    EXPECT_NEAR(noise.share[0], mean, 1e-15);
    EXPECT_NEAR(noise.share[1], frequency(0, 0.5), 1e-15) << "no motion differs";
    EXPECT_NEAR(noise.most, frequency(1, 1), 1e-12) << "a state that is always reached";
    EXPECT_EQ(noise.groups, 9);
    // the variance of a mean of nine, and that of half of 72 counts
    double squares = 0;
    for (const double y : own)
        squares += 3 * (y - mean) * (y - mean);
    const double half = 0.5 * std::pow(frequency(1, 1) / 72, 2);
    EXPECT_NEAR(noise.half, half, 1e-6 * half);
    EXPECT_NEAR(noise.covariance[0], squares / 8 / 9 + half, 1e-6 * noise.covariance[0]);
    EXPECT_NEAR(noise.covariance[1], 0, 1e-9 * noise.covariance[0]);
    EXPECT_NEAR(noise.covariance[3], half, 1e-6 * half);
    EXPECT_NEAR(objective.frequency(s.base, 0, layout).frequency.value, mean, 1e-12);
    EXPECT_NEAR(objective.change(s.base, s.variant, 0, layout).value, frequency(0, 0.5) - mean, 1e-12);
}

TEST(Pairing, FindsWhichDrawsAreCommon)
{
    std::vector<StudySide::Draws> base, variant;
    for (std::uint64_t i = 0; i < 50; ++i) {
        const double u = std::fmod(0.618 * static_cast<double>(i), 1);
        base.push_back({i, {u, u, u, 1}});
        variant.push_back({i, {u, std::exp(u), std::fmod(7.3 * u, 1), 2}});
    }
    const auto found = common_inputs(base, {"friction[0]", "friction[1]", "density[0]", "tilt"}, variant,
                                     {"friction[0]", "friction[1]", "density[0]", "phase"});
    ASSERT_EQ(found.size(), 5U);
    EXPECT_EQ(found[0].draws, CommonDraws::same);
    EXPECT_EQ(found[1].name, "friction");
    EXPECT_EQ(found[1].draws, CommonDraws::quantiles);
    EXPECT_EQ(found[2].draws, CommonDraws::other);
    EXPECT_EQ(found[3].draws, CommonDraws::base_only);
    EXPECT_EQ(found[4].name, "phase");
    EXPECT_EQ(found[4].draws, CommonDraws::variant_only);
}

/// The first realizations of each cell have their draws kept: those that an adaptive comparison has.
TEST(Pairing, DrawsAreKeptWhereAnAdaptiveComparisonHasPairs)
{
    std::string large = surface;
    large.replace(large.find("realizations = 4"), 16, "realizations = 100000");
    Sides s(large);
    s.names = {"friction[0]"};
    for (std::uint64_t cell = 0; cell < 6; ++cell)
        for (std::uint64_t k = 0; k < 8; ++k) {
            const double u = std::fmod(0.618 * static_cast<double>(8 * cell + k), 1);
            s.base.add(row(cell * 100000 + k, State::stood, {u}));
            s.variant.add(row(cell * 100000 + k, State::stood, {std::fmod(7.3 * u, 1)}));
        }
    EXPECT_EQ(s.base.draws().size(), 48U);
    EXPECT_EQ(s.compared().inputs.front().draws, CommonDraws::other);
}

Comparison sample()
{
    Sides s(surface);
    s.names = {"friction[0]"};
    for (std::uint64_t index = 0; index < 24; ++index) {
        s.base.add(row(index, index % 3 == 0 ? State::collapsed : State::stood, {0.5}));
        s.variant.add(row(index, index % 4 == 0 ? State::collapsed : State::rocked, {0.5}));
    }
    Comparison c;
    c.kind = "surface";
    c.base_name = "base";
    c.base_results = "base.h5";
    c.base_toml = surface;
    c.adjustment = "benjamini-hochberg";
    c.frequency_hz = {1, 2};
    c.pga_m_s2 = {1, 2, 3};
    c.variants.push_back(s.compared());
    c.variants.back().name = "dowels";
    c.variants.back().notes = {"A note."};
    return c;
}

TEST(ComparisonFile, ComesBackAsItWasWritten)
{
    const auto file = std::filesystem::temp_directory_path() / ("comparison-" + std::to_string(::getpid()) + ".h5");
    const Comparison written = sample();
    write_comparison(written, file);
    const Comparison read = read_comparison(file);
    EXPECT_EQ(comparison_json(read).text(), comparison_json(written).text());
    EXPECT_EQ(comparison_text(read), comparison_text(written));
    // a byte that has changed is found
    {
        std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
        bytes.seekp(5000);
        bytes.put('\x7f');
    }
    EXPECT_THROW(read_comparison(file), InputError);
    std::filesystem::remove(file);
}

TEST(Comparable, NamesTheKeyAndBothValues)
{
    const auto header = [](const std::string& text) {
        ResultHeader made;
        made.kind = "surface";
        made.study_toml = parse_study(text, "study.toml").text;
        return made;
    };
    const auto changed = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    const auto refusal = [&](const std::string& text) -> std::string {
        try {
            check_comparable(header(surface), "base.toml", header(text), "other.toml");
            return {};
        } catch (const InputError& error) {
            return error.what();
        }
    };
    EXPECT_EQ(refusal(surface), "");
    EXPECT_EQ(refusal(changed(surface, "friction = 0.7", "friction = 0.4")), "");
    EXPECT_EQ(refusal(changed(surface, "blocks = 3", "blocks = 4")), "");
    EXPECT_EQ(refusal(surface + "[mechanisms]\ndowel = { stiffness_n_m = 1e6, yield_n = 10 }\n"), "");
    for (const auto& [from, to, words] : std::vector<std::array<std::string, 3>>{
             {"realizations = 4", "realizations = 8",
              "other.toml: study.realizations = 8, and base.toml has "
              "study.realizations = 4."},
             {"realizations = 4", "realizations = 4\nseed = 2", "study.seed = 2, and base.toml has study.seed = 1."},
             {"count = 3", "count = 4", "surface.pga_m_s2.count = 4"},
             {"\"harmonic\"", "\"harmonic\"\ncycles = 5",
              "excitation.cycles = 5, and base.toml has excitation.cycles "
              "= 10."},
             {"blocks = 3", "gravity_m_s2 = 1.6\nblocks = 3", "structure.gravity_m_s2 = 1.6"},
             {"[contact]", "[outcome]\ncollapse = { height_fraction = 0.5 }\n[contact]", "outcome.collapse"},
             {"[contact]", "[perturbation]\nphase = { distribution = \"uniform\" }\n[contact]",
              "perturbation.phase.distribution = \"uniform\", and base.toml has perturbation.phase.distribution is "
              "absent"}})
        EXPECT_NE(refusal(changed(surface, from, to)).find(words), std::string::npos)
            << refusal(changed(surface, from, to));
}

} // namespace
} // namespace stylobate
