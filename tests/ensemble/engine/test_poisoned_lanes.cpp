/// A realization that goes wrong, in whatever way and in whatever lane: its neighbours' outcomes keep their bits, it is
/// set aside with its index and the reason, and the next realization in its lane finds nothing of it.

#include "ensemble/planar/device/host_device.hpp"
#include "ensemble/planar/device/slots.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "studies/workflow/bench/scenes.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"
#include "tests/ensemble/engine/rigid_study.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace stylobate {

#if defined(__x86_64__)
extern const KernelTable portable_kernels; // taken for `scalar` on processors without a fused multiply-add
#endif

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Poison {
    const char* name;
    void (*spoil)(Realization&);
    InvalidReason reason;
};

/// A base that moves at such a rate that the energy of the blocks is a number, but its balance is lost in rounding.
void shake_beyond_balance(Realization& r)
{
    r.pga_m_s2 = 1e100;
}

std::vector<Poison> poisons(const Study& study)
{
    const InvalidReason not_finite = InvalidReason::not_finite;
    std::vector<Poison> all{
        {"motion that is not a number", [](Realization& r) { r.pga_m_s2 = std::numeric_limits<double>::quiet_NaN(); },
         not_finite},
        {"friction that is not a number",
         [](Realization& r) { r.joints.front().friction = std::numeric_limits<double>::quiet_NaN(); }, not_finite},
        {"infinite motion", [](Realization& r) { r.pga_m_s2 = infinity; }, not_finite},
        {"infinite weight", [](Realization& r) { r.gravity_m_s2 = infinity; }, not_finite},
        {"enormous velocity", [](Realization& r) { r.pga_m_s2 = 1e300; }, not_finite},
        {"enormous step", [](Realization& r) { r.step_s *= 1e100; }, not_finite},
    };
    if (study.contact.form != ContactForm::rigid)
        // far above the stable step: the stack flies apart
        all.push_back({"energy that explodes", [](Realization& r) { r.step_s *= 4; }, InvalidReason::energy});
    else if (study.run.precision == Precision::single)
        all.push_back({"energy out of nothing", [](Realization& r) { r.step_s *= 1e6; }, InvalidReason::energy});
    else
        all.push_back({"energy beyond its balance", shake_beyond_balance, InvalidReason::energy});
    return all;
}

/// A study, and whether its realizations are stepped by the model with mechanisms.
struct Setting {
    std::string name;
    Study study;
    bool mechanisms = false;

    Realization realization(const Sampler& sampler, int index) const
    {
        Realization r = sampler.realization(static_cast<std::uint64_t>(index));
        r.with_mechanisms = mechanisms;
        return r;
    }
};

/// Two seconds of a few cycles: blocks rock, slide and meet, and lie still at the end.
Study briefly(Study study)
{
    study.excitation.cycles = 4;
    study.excitation.tail_s = 0.2;
    study.excitation.frequency_hz = 4;
    study.excitation.pga_m_s2 = 7;
    return study;
}

Setting column(ContactForm form, bool mechanisms, Precision precision)
{
    Study study = briefly(rocking_column(3));
    if (form == ContactForm::rigid)
        study = rigid_of(study);
    study.contact.form = form;
    study.run.precision = precision;
    return {"form " + std::to_string(static_cast<int>(form)) + (mechanisms ? ", with mechanisms" : "") +
                (precision == Precision::single ? ", single precision" : ""),
            study, mechanisms};
}

std::vector<Setting> settings()
{
    std::vector<Setting> all;
    for (const ContactForm form : {ContactForm::area, ContactForm::two_corner, ContactForm::points}) {
        all.push_back(column(form, false, Precision::double_));
        all.push_back(column(form, true, Precision::double_));
    }
    all.push_back(column(ContactForm::rigid, false, Precision::double_));
    all.push_back(column(ContactForm::area, false, Precision::single));
    all.push_back(column(ContactForm::rigid, false, Precision::single));
    Study pairs = briefly(shaken_colonnade(2, 1, 4));
    pairs.outcome.follow = Follow::collapse;
    all.push_back({"watched pairs", pairs});
    return all;
}

struct Width {
    std::string name;
    const KernelTable* table;
    bool twice; ///< two registers at a time, where the structure is small enough
};

std::vector<Width> widths()
{
    std::vector<Width> all;
#if defined(__x86_64__)
    all.push_back({"portable", &portable_kernels, false});
#endif
    for (const Isa isa : usable_isas())
        for (const bool twice : {false, true})
            all.push_back({std::string(to_string(isa)) + (twice ? ", twice" : ""), &kernels(isa), twice});
    return all;
}

/// The outcomes of the first realizations, each alone.
std::vector<Bits> alone(const Setting& setting, const Sampler& sampler, int count)
{
    std::vector<Bits> outcomes;
    for (int i = 0; i < count; ++i) {
        const Realization r = setting.realization(sampler, i);
        LaneSet lanes(setting.study, nullptr, kernels(Isa::scalar), r);
        lanes.load(0, r);
        while (!lanes.outcome(0))
            lanes.advance();
        EXPECT_NE(lanes.outcome(0)->state, State::invalid);
        outcomes.push_back(outcome_bits(*lanes.outcome(0)));
    }
    return outcomes;
}

/// Steps until a realization has ended, within the number of chunks that the longest one may take.
template <class Set>
void until(Set& set, const auto& ended)
{
    for (int chunk = 0; chunk < 20000 && !ended(); ++chunk)
        set.advance();
    ASSERT_TRUE(ended()) << "it does not end";
}

/// A poisoned realization in one place of a set, among neighbours that started before it, and its successor there.
template <class Set>
void poison(Set& set, int width, int place, const Poison& with, const Setting& setting, const Sampler& sampler,
            const std::vector<Bits>& want)
{
    SCOPED_TRACE(std::string(with.name) + ", place " + std::to_string(place) + " of " + std::to_string(width));
    for (int other = 0; other < width; ++other)
        if (other != place)
            set.load(other, setting.realization(sampler, other));
    set.advance();
    set.advance();
    Realization bad = setting.realization(sampler, place);
    with.spoil(bad);
    set.load(place, bad);
    until(set, [&] { return set.outcome(place).has_value(); });
    EXPECT_EQ(set.outcome(place)->state, State::invalid);
    EXPECT_EQ(set.outcome(place)->invalid_reason, with.reason);
    EXPECT_EQ(set.realization(place).index, static_cast<std::uint64_t>(place));

    set.load(place, setting.realization(sampler, place));
    until(set, [&] {
        for (int i = 0; i < width; ++i)
            if (!set.outcome(i))
                return false;
        return true;
    });
    for (int i = 0; i < width; ++i)
        EXPECT_EQ(outcome_bits(*set.outcome(i)), want[static_cast<std::size_t>(i)]) << "realization " << i;
}

TEST(PoisonedLanes, LeaveTheirNeighboursAloneInEveryLaneOfEveryWidth)
{
    for (const Setting& setting : settings()) {
        SCOPED_TRACE(setting.name);
        const Sampler sampler(setting.study, nullptr);
        const Realization pattern = setting.realization(sampler, 0);
        std::vector<Bits> want;
        for (const Width& width : widths()) {
            SCOPED_TRACE(width.name);
            const auto set = [&] {
                return LaneSet(setting.study, nullptr, *width.table, pattern, width.twice ? 1000 : 1);
            };
            const int lanes = set().lanes();
            if (static_cast<int>(want.size()) < lanes)
                want = alone(setting, sampler, lanes);
            for (const Poison& with : poisons(setting.study))
                for (int lane = 0; lane < lanes; ++lane) {
                    LaneSet one = set();
                    poison(one, lanes, lane, with, setting, sampler, want);
                }
        }
    }
}

TEST(PoisonedLanes, LeaveTheirNeighboursAloneInEverySlotOfADevice)
{
    constexpr int slots = 3;
    for (const Setting& setting : settings()) {
        SCOPED_TRACE(setting.name);
        const Sampler sampler(setting.study, nullptr);
        const Realization pattern = setting.realization(sampler, 0);
        const std::vector<Bits> want = alone(setting, sampler, slots);
        const std::shared_ptr<Device> device = host_device();
        for (const Poison& with : poisons(setting.study))
            for (int slot = 0; slot < slots; ++slot) {
                SlotSet set(setting.study, nullptr, pattern, *device, slots, slots);
                ASSERT_EQ(set.lanes(), slots);
                poison(set, slots, slot, with, setting, sampler, want);
            }
    }
}

/// By the executor, which hands results on by their index.
TEST(PoisonedLanes, AreReportedWithTheirIndexByARunThatGoesOn)
{
    Study study = column(ContactForm::area, false, Precision::double_).study;
    study.realizations = 12;
    const Experiment experiment(study);
    const EnsembleRun want = run_all(study, {Isa::scalar, 1});
    for (const Poison& with : poisons(study)) {
        SCOPED_TRACE(with.name);
        const auto spoilt = [](std::uint64_t index) { return index == 3 || index == 10; };
        RunPlan plan;
        plan.total = study.total();
        plan.realize = [&](std::uint64_t index) {
            Realization r = experiment.sampler().realization(index);
            if (spoilt(index))
                with.spoil(r);
            return r;
        };
        std::vector<RunOptions> ways;
        for (const Isa isa : usable_isas())
            for (const int threads : {1, 2})
                ways.push_back({isa, threads});
        ways.push_back({.isa = Isa::scalar, .threads = 2, .devices = {host_device()}, .slots = 4});
        for (const RunOptions& options : ways) {
            std::map<std::uint64_t, Outcome> got;
            plan.sink = [&](const Realization& r, const Outcome& o) { got.emplace(r.index, o); };
            Observer observer;
            const Progress progress = run_ensemble(experiment, options, plan, observer);
            EXPECT_EQ(progress.done, study.total());
            EXPECT_EQ(progress.invalid, 2U);
            ASSERT_EQ(got.size(), study.total());
            for (const auto& [index, outcome] : got)
                if (spoilt(index)) {
                    EXPECT_EQ(outcome.state, State::invalid) << index;
                    EXPECT_EQ(outcome.invalid_reason, with.reason) << index;
                } else {
                    EXPECT_EQ(outcome_bits(outcome), want.outcomes.at(index)) << index;
                }
        }
    }
}

} // namespace
} // namespace stylobate
