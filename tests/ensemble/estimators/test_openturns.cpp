/// OpenTURNS as an independent check: given the same design and the same outcomes, its indices lie in our intervals.
/// Built where CMake finds it (Debian: libopenturns-dev); the project itself does not need it.

#ifdef STYLOBATE_OPENTURNS

#include "tests/program/program.hpp"

#include "ensemble/estimators/designs/sobol_indices.hpp"
#include "io/store/result_store.hpp"
#include "tests/ensemble/estimators/sensitivity_functions.hpp"

#include <openturns/JansenSensitivityAlgorithm.hxx>
#include <openturns/SaltelliSensitivityAlgorithm.hxx>

namespace stylobate {
namespace {

/// Of outcomes with one realization a point. OpenTURNS asks for A, then B, then A with each column of B in turn.
template <class Algorithm>
Algorithm of_openturns(const DesignValues& values)
{
    const std::size_t points = values.factors + 2;
    const OT::UnsignedInteger n = values.rows;
    OT::Sample in(n * points, values.factors), out(n * points, 1);
    for (std::size_t point = 0; point < points; ++point)
        for (std::size_t row = 0; row < n; ++row)
            out(point * n + row, 0) = values.at(row, point, 0, points);
    return Algorithm(in, out, n);
}

/// Total indices lie in the intervals. First indices, by Jansen's and by Saltelli's formulas, do where ours is no surer
/// than they are; of strong and of idle factors it is.
void expect_agreement(const SobolIndices& ours, const DesignValues& values, bool in_intervals)
{
    const auto jansen = of_openturns<OT::JansenSensitivityAlgorithm>(values);
    const auto saltelli = of_openturns<OT::SaltelliSensitivityAlgorithm>(values);
    const OT::Point first = jansen.getFirstOrderIndices(), total = jansen.getTotalOrderIndices();
    const OT::Point first_by_saltelli = saltelli.getFirstOrderIndices();
    for (std::size_t k = 0; k < values.factors; ++k) {
        const Estimate& f = ours.of_mean[k].first;
        const Estimate& t = ours.of_mean[k].total;
        std::printf("factor %zu: first %.3f (%.3f to %.3f), OpenTURNS %.3f, %.3f; total %.3f (%.3f to %.3f), %.3f\n", k,
                    f.value, f.lower, f.upper, first[k], first_by_saltelli[k], t.value, t.lower, t.upper, total[k]);
        EXPECT_TRUE(t.contains(total[k])) << k;
        for (const double other : {first[k], first_by_saltelli[k]}) {
            if (in_intervals)
                EXPECT_TRUE(f.contains(other)) << k;
            else
                EXPECT_NEAR(other, f.value, std::max(0.06, f.upper - f.lower)) << k;
        }
    }
}

TEST(OpenTurnsLong, AgreesOnKnownFunctions)
{
    std::mt19937_64 random(1);
    const DesignValues ishigami = testing::sobol_design(4000, 3, 1, random, testing::ishigami);
    expect_agreement(sobol_indices(ishigami, {}), ishigami, false);
    const DesignValues g = testing::sobol_design(4000, 4, 1, random, testing::GFunction{{0, 1, 4.5, 99}});
    expect_agreement(sobol_indices(g, {}), g, false);
}

class OpenTurnsStudyLong : public Program {};

/// The ready study with every perturbed quantity a factor, so that the outcome is a function of the factors alone.
TEST_F(OpenTurnsStudyLong, AgreesOnTheReadyStudy)
{
    const std::string study = STYLOBATE_SOURCE_DIR "/studies/inputs/sensitivity_column.toml";
    const Ended ended =
        run(run_words(study,
                      {"sensitivity.samples=1000", "sensitivity.inner=1",
                       "sensitivity.factors=[\"friction\", \"normal_stiffness\", \"damping_ratio\", \"drum_width\", "
                       "\"drum_height\", \"drum_offset\", \"density\", \"tilt\", \"phase\"]"},
                      {"-o", "factors.h5", "--quiet"}));
    ASSERT_EQ(ended.status, 0) << ::testing::PrintToString(ended);
    const ResultReader reader(folder / "factors.h5");
    DesignValues collapse{1000, 9, 1, {}};
    for (const ResultRow& row : reader.rows())
        collapse.value.push_back(row.outcome.state == State::collapsed ? 1 : 0);
    expect_agreement(sobol_indices(collapse, {}), collapse, true);
}

} // namespace
} // namespace stylobate

#else

#include <gtest/gtest.h>

TEST(OpenTurnsLong, IsNotThere)
{
    GTEST_SKIP() << "OpenTURNS was not found when this was configured (Debian: libopenturns-dev)";
}

#endif
