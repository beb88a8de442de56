/// A realization is a function of the study and its index: the same bits for every instruction set, number of threads,
/// lane and neighbour, alone or in the ensemble, in one go or stopped and continued.

#include "ensemble/numerics/random.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/spatial/spatial_model.hpp"
#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/trajectory.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"
#include "tests/ensemble/engine/rigid_study.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <limits>
#include <map>
#include <unistd.h>
#include <utility>

using namespace stylobate;

namespace {

const std::string input = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/small_scale_column.toml",
                  round_column = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/round_column.toml";

Study mix(const std::string& frequencies, const std::string& pgas, const std::vector<std::string>& more = {})
{
    std::vector<std::string> settings{"study.realizations=10", "surface.frequency_hz=" + frequencies,
                                      "surface.pga_m_s2=" + pgas};
    settings.insert(settings.end(), more.begin(), more.end());
    return read_study(input, settings);
}

/// Most realizations fall: lanes are refilled all the time, and the general overlap is often needed.
Study collapse_heavy(const std::vector<std::string>& more = {})
{
    return mix("{ from = 1.0, to = 4.0, count = 3, spacing = \"log\" }",
               "{ from = 3.0, to = 11.0, count = 3, spacing = \"linear\" }", more);
}

/// Hardly any falls.
Study quiet()
{
    return mix("{ from = 3.0, to = 10.0, count = 3, spacing = \"log\" }",
               "{ from = 0.5, to = 1.4, count = 2, spacing = \"linear\" }", {"contact.damping_per=\"chord\""});
}

void same_everywhere(const Study& study)
{
    const EnsembleRun want = run_all(study, {Isa::scalar, 1});
    ASSERT_EQ(want.outcomes.size(), study.total());
    for (const Isa isa : usable_isas())
        for (const int threads : {1, 2, 3}) {
            const EnsembleRun got = run_all(study, {isa, threads});
            EXPECT_EQ(got.outcomes, want.outcomes) << to_string(isa) << ", " << threads << " threads";
            EXPECT_EQ(got.progress.done, study.total());
        }
}

/// Columns of drums in space, about half of which fall.
Study in_space(const std::vector<std::string>& more = {})
{
    std::vector<std::string> settings{"study.realizations=3", "structure.blocks=4", "excitation.cycles=5",
                                      "surface.frequency_hz={ from = 0.6, to = 1.2, count = 2 }",
                                      "surface.pga_m_s2={ from = 2.5, to = 6.0, count = 2 }"};
    settings.insert(settings.end(), more.begin(), more.end());
    return read_study(round_column, settings);
}

/// Every bed law and every mechanism of the spatial step.
std::vector<Study> all_in_space()
{
    return {in_space(),
            in_space({"structure.bed_inner_ratio=0.5", "excitation.vertical_ratio=0.5",
                      "mechanisms.eccentricity={ block = 2, offset_m = 0.01 }",
                      "mechanisms.wedge={ joint = 1, angle_rad = 0.002, angle_x_rad = 0.001 }"}),
            in_space({"structure.shape=\"square\"", "structure.capital={ width_m = 1.2, height_m = 0.4 }",
                      "mechanisms.dowel={ stiffness_n_m = 1e8, yield_n = 2e4, gap_m = 0.001 }",
                      "mechanisms.stribeck={ dynamic_friction = 0.5, velocity_m_s = 0.05 }",
                      "mechanisms.adhesion={ strength_pa = 1e4 }"})};
}

/// @param index one that falls among others that come and go
template <class Set>
void same_in_every_lane(const Study& study, std::uint64_t index)
{
    const Sampler sampler(study, nullptr);
    const EnsembleRun want = run_all(study, {Isa::scalar, 1});
    for (const Isa isa : usable_isas()) {
        const KernelTable& table = kernels(isa);
        for (int lane = 0; lane < table.lanes; ++lane) {
            Set lanes(study, nullptr, table, sampler.realization(0));
            std::uint64_t neighbour = 7 * static_cast<std::uint64_t>(lane);
            // the neighbours start earlier, by another number of chunks for each lane
            for (int other = 0; other < table.lanes; ++other)
                if (other != lane)
                    lanes.load(other, sampler.realization(neighbour++ % study.total()));
            for (int chunk = 0; chunk < 13 * lane; ++chunk)
                lanes.advance();
            lanes.load(lane, sampler.realization(index));
            while (!lanes.outcome(lane)) {
                lanes.advance();
                for (int other = 0; other < table.lanes; ++other)
                    if (other != lane && lanes.outcome(other))
                        lanes.load(other, sampler.realization(neighbour++ % study.total()));
            }
            EXPECT_EQ(outcome_bits(*lanes.outcome(lane)), want.outcomes.at(index))
                << to_string(isa) << ", lane " << lane;
        }
    }
}

/// @param from index of the first of the neighbours
template <class Set>
void sets_broken_lanes_aside(const Study& study, std::uint64_t from)
{
    const Sampler sampler(study, nullptr);
    const EnsembleRun want = run_all(study, {Isa::scalar, 1});
    for (const Isa isa : usable_isas()) {
        const KernelTable& table = kernels(isa);
        Set lanes(study, nullptr, table, sampler.realization(0));
        // far above the stable step: the stack flies apart
        Realization broken = sampler.realization(3);
        broken.step_s *= 4;
        lanes.load(0, broken);
        // not a number from the start
        if (table.lanes > 1) {
            Realization nothing = sampler.realization(4);
            nothing.pga_m_s2 = std::numeric_limits<double>::quiet_NaN();
            lanes.load(1, nothing);
        }
        for (int lane = 2; lane < table.lanes; ++lane)
            lanes.load(lane, sampler.realization(from + static_cast<std::uint64_t>(lane)));
        const auto all_ended = [&] {
            for (int lane = 0; lane < table.lanes; ++lane)
                if (!lanes.outcome(lane))
                    return false;
            return true;
        };
        while (!all_ended())
            lanes.advance();
        EXPECT_EQ(lanes.outcome(0)->state, State::invalid) << to_string(isa);
        EXPECT_NE(lanes.outcome(0)->invalid_reason, InvalidReason::none);
        if (table.lanes > 1) {
            EXPECT_EQ(lanes.outcome(1)->state, State::invalid);
            EXPECT_EQ(lanes.outcome(1)->invalid_reason, InvalidReason::not_finite);
        }
        for (int lane = 2; lane < table.lanes; ++lane)
            EXPECT_EQ(outcome_bits(*lanes.outcome(lane)), want.outcomes.at(from + static_cast<std::uint64_t>(lane)))
                << to_string(isa) << ", lane " << lane;
    }
}

/// Stopped again and again after some realizations, and continued with other numbers of threads.
/// @param part realizations of a part, at least; half as many at most are added to them by chance
void same_after_stops(const Study& study, std::uint64_t part)
{
    struct Stopper : Observer {
        std::uint64_t after = 0;
        bool stop_requested() override { return asked >= after; }
        void progress(const Progress& p) override { asked = p.done; }
        std::uint64_t asked = 0;
    };
    const Experiment experiment(study);
    const EnsembleRun want = run_all(study, {best_isa(), 2});
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("stylobate-continue-" + std::to_string(getpid()) + ".h5");
    std::filesystem::remove(file);
    ResultHeader header;
    header.kind = "surface";
    header.dimensions = study.structure.dimensions;
    header.study_toml = study.text;
    header.seed = study.seed;
    header.code_version = "test";
    header.total = study.total();
    header.input_names = experiment.sampler().input_names();
    header.block_names = block_names(study);
    for (const Axis* axis : {&study.surface->frequency_hz, &study.surface->pga_m_s2})
        for (int i = 0; i < axis->count; ++i)
            (axis == &study.surface->frequency_hz ? header.frequency_hz : header.pga_m_s2).push_back(axis->value(i));

    int parts = 0;
    bool complete = false;
    while (!complete) {
        ASSERT_LT(parts, 40);
        const auto writer = parts == 0 ? ResultWriter::create(file, header) : ResultWriter::resume(file, header);
        RunPlan plan;
        plan.total = study.total();
        plan.mark_done([&](std::uint64_t index) { return writer->state(index); });
        plan.sink = [&](const Realization& r, const Outcome& o) { writer->add(result_row(study, r, o)); };
        Stopper observer;
        // a random part of what is left, fixed by the number of the part
        observer.after =
            writer->rows() + part + random_bits(1, static_cast<std::uint64_t>(parts), Stream::friction, 0) % (part / 2);
        const Progress p = run_ensemble(experiment, {best_isa(), 1 + parts % 3}, plan, observer);
        complete = p.done == p.total;
        if (complete)
            writer->finish(nullptr);
        else
            writer->flush();
        ++parts;
    }
    EXPECT_GT(parts, 1) << "it was never stopped";
    const ResultReader reader(file);
    for (std::uint64_t index = 0; index < study.total(); ++index)
        ASSERT_EQ(outcome_bits(reader.row(index).outcome), want.outcomes.at(index)) << "realization " << index;
    std::filesystem::remove(file);
}

/// What the balance lacks stays far below the bound that makes a realization invalid.
/// @param most of the residual of those that stand; of those that fall it is 0.1
void expect_balance(const Study& study, double most = 0.1)
{
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization& r, const Outcome& o) {
        EXPECT_LT(std::abs(o.energy_residual), o.state == State::collapsed ? 0.1 : most) << "realization " << r.index;
        EXPECT_GE(o.energy_friction_j, 0);
        EXPECT_NE(o.state, State::invalid);
    };
    Observer observer;
    run_ensemble(Experiment(study), {best_isa(), 2}, plan, observer);
}

} // namespace

TEST(Determinism, CollapseHeavyMixHasTheSameBitsForEveryWidthAndThreadCount)
{
    const Study study = collapse_heavy();
    const EnsembleRun result = run_all(study, {best_isa(), 2});
    EXPECT_GT(result.states.at(State::collapsed), static_cast<int>(study.total()) / 2)
        << "the mix is not what it should be";
    same_everywhere(study);
}

/// Two columns of two drums and an epistyle that fall, hit each other and are followed until they lie still.
TEST(Determinism, ACollapsingColonnadeHasTheSameBitsForEveryWidthAndThreadCount)
{
    const Study study = read_study(
        std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/small_scale_colonnade_drums.toml",
        {"study.realizations=6", "excitation.cycles=6", "surface.frequency_hz={ from = 1.5, to = 3.0, count = 2 }",
         "surface.pga_m_s2={ from = 10.0, to = 16.0, count = 2 }"});
    const EnsembleRun result = run_all(study, {best_isa(), 2});
    EXPECT_GT(result.states.at(State::collapsed), static_cast<int>(study.total()) / 2)
        << "the mix is not what it should be";
    EXPECT_EQ(result.states.count(State::invalid), 0U);
    same_everywhere(study);
}

TEST(Determinism, RigidBlocksHaveTheSameBitsForEveryWidthAndThreadCount)
{
    for (const char* name : {"small_scale_column.toml", "small_scale_colonnade_drums.toml"}) {
        const Study study =
            rigid_of(read_study(std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/" + name,
                                {"study.realizations=6", "surface.frequency_hz={ from = 2.0, to = 4.0, count = 3 }",
                                 "surface.pga_m_s2={ from = 3.0, to = 11.0, count = 3 }"}));
        const EnsembleRun result = run_all(study, {best_isa(), 2});
        EXPECT_GT(result.states.at(State::collapsed), 10) << name;
        EXPECT_LT(result.states.at(State::collapsed), static_cast<int>(study.total()) - 5) << name;
        same_everywhere(study);
    }
}

TEST(Determinism, StructuresInSpaceHaveTheSameBitsForEveryWidthAndThreadCount)
{
    for (const Study& study : all_in_space()) {
        const EnsembleRun result = run_all(study, {best_isa(), 2});
        EXPECT_GE(result.states.at(State::collapsed), 3) << study.text;
        EXPECT_LE(result.states.at(State::collapsed), static_cast<int>(study.total()) - 3) << study.text;
        same_everywhere(study);
    }
}

/// Realizations with steep faces beside others without.
TEST(Determinism, CollapsesOfAnotherFormHaveTheSameBitsForEveryWidthAndThreadCount)
{
    same_everywhere(collapse_heavy({"contact.form=\"two_corner\""}));
}

TEST(Determinism, QuietMixHasTheSameBitsForEveryWidthAndThreadCount)
{
    const Study study = quiet();
    const EnsembleRun result = run_all(study, {best_isa(), 2});
    EXPECT_EQ(result.states.count(State::collapsed), 0U) << "the mix is not what it should be";
    same_everywhere(study);
}

TEST(Determinism, LaneAndNeighboursDoNotMatter)
{
    same_in_every_lane<LaneSet>(collapse_heavy(), 31);
    for (const Study& study : all_in_space())
        same_in_every_lane<SpatialLaneSet>(study, study.total() - 1);
}

TEST(Determinism, OneRealizationFollowedStepByStepHasTheBitsOfTheEnsemble)
{
    using Settings = std::vector<std::string>;
    const Settings in_plane{"study.realizations=10", "surface.frequency_hz={ from = 1.5, to = 3.0, count = 2 }",
                            "surface.pga_m_s2={ from = 2.0, to = 5.0, count = 2 }", "output.trajectory_rate_hz=333"},
        spatial{"study.realizations=10",
                "structure.blocks=3",
                "excitation.cycles=4",
                "surface.frequency_hz={ from = 0.7, to = 1.2, count = 2 }",
                "surface.pga_m_s2={ from = 2.0, to = 5.0, count = 2 }",
                "output.trajectory_rate_hz=333"};
    for (const auto& [file, settings] : {std::pair(input, in_plane), std::pair(round_column, spatial)}) {
        const LoadedStudy loaded = LoadedStudy::from_file(file, settings);
        const EnsembleRun want = run_all(loaded.study(), {best_isa(), 2});
        for (const std::uint64_t index : {0U, 13U, 27U, 39U})
            for (const Isa isa : usable_isas()) {
                const TracedRealization f = trace(loaded.experiment(), index, isa);
                EXPECT_EQ(outcome_bits(f.outcome), want.outcomes.at(index))
                    << file << ", " << to_string(isa) << ", realization " << index;
                // samples from 0 to the end, evenly
                ASSERT_FALSE(f.trajectory.time_s.empty());
                EXPECT_EQ(f.trajectory.time_s.front(), 0);
                EXPECT_NEAR(f.trajectory.time_s.back(), f.outcome.end_time_s, 1.0 / 333 + f.outcome.step_s);
                EXPECT_EQ(f.trajectory["x_m"].size(), f.trajectory.time_s.size() * f.trajectory.blocks());
            }
        EXPECT_EQ(trace(loaded.experiment(), 0, Isa::scalar).trajectory.blocks(), file == input ? 7U : 3U);
    }
}

TEST(Determinism, ABrokenLaneIsSetAsideAndItsNeighboursKeepTheirBits)
{
    sets_broken_lanes_aside<LaneSet>(collapse_heavy(), 20);
    sets_broken_lanes_aside<SpatialLaneSet>(in_space(), 4);
}

TEST(Determinism, ARunThatIsStoppedAndContinuedGivesTheSameBits)
{
    same_after_stops(mix("{ from = 1.0, to = 8.0, count = 8, spacing = \"log\" }",
                         "{ from = 3.0, to = 11.0, count = 8, spacing = \"linear\" }"),
                     256);
    same_after_stops(in_space({"study.realizations=32", "structure.blocks=3", "excitation.cycles=4"}), 32);
}

TEST(Ensemble, LanesStayFullWhenMostRealizationsFall)
{
    // so many realizations that the idle lanes of the last ones, whatever their luck, are far less than 5 %
    const Study study = mix("{ from = 1.0, to = 6.0, count = 8, spacing = \"log\" }",
                            "{ from = 1.0, to = 11.0, count = 8, spacing = \"linear\" }", {"study.realizations=40"});
    const EnsembleRun result = run_all(study, {best_isa(), 2});
    EXPECT_GT(result.states.at(State::collapsed), static_cast<int>(study.total()) / 2);
    EXPECT_GT(result.progress.occupancy, 0.95);
}

TEST(Ensemble, RealizationsAtRestEndBeforeTheirTime)
{
    const Study study = quiet();
    int early = 0;
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization& r, const Outcome& o) {
        const double shaking = study.excitation.cycles / r.frequency_hz;
        EXPECT_TRUE(o.state == State::collapsed || o.end_time_s >= shaking) << "ended while it was shaken";
        early += o.end_time_s < shaking + 0.9 * tail_after_shaking(scales_of(r));
    };
    Observer observer;
    run_ensemble(Experiment(study), {best_isa(), 2}, plan, observer);
    EXPECT_GT(early, static_cast<int>(study.total()) / 2);
}

TEST(Ensemble, EnergyBalances)
{
    expect_balance(collapse_heavy());
}

/// A block that falls slides with its steep face over the corner of the one under it (`mechanisms/two_corner.hpp`).
TEST(Ensemble, EnergyBalancesWhereFormsOfSpringsFall)
{
    expect_balance(collapse_heavy({"contact.form=\"two_corner\""}));
    expect_balance(collapse_heavy({"contact.form=\"points\""}));
}

/// Its errors go with the square of the step.
TEST(Ensemble, EnergyBalancesInSpace)
{
    for (const Study& study : all_in_space())
        expect_balance(study, 1e-2);
    for (const char* shape : {"structure.shape=\"round\"", "structure.shape=\"square\""})
        expect_balance(in_space({shape, "run.step_fraction=0.25"}), 1e-3);
}
