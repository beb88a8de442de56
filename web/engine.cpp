/// The engine as functions that a page calls: a study's text in, JSON out, and outcomes one by one. Each worker of the
/// page has an instance of its own, and shares nothing with the others but the text of the study.

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/run_order.hpp"
#include "ensemble/run/executor.hpp"
#include "io/records/record.hpp"
#include "io/study/study_file.hpp"
#include "kernels/fused_steps.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/report/json.hpp"
#include "studies/results/kept_animations.hpp"

#include <fmt/format.h>

#include <emscripten.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

// A realization that has ended: its place in the order of the run, its index, its state, and the numbers of its outcome
// in the order of `outcome_names`.
EM_JS(void, deliver, (double place, double index, int state, const double* numbers, int count),
      { Module.deliver(place, index, state, HEAPF64.slice(numbers >> 3, (numbers >> 3) + count)); });

// The steps of the module of fused.cpp.
EM_JS(void, step_planar, (const void* topology, const void* bundle, int first, int last),
      { Module.fused.fused_planar(topology, bundle, first, last); });
EM_JS(void, step_spatial, (const void* topology, const void* bundle, int first, int last),
      { Module.fused.fused_spatial(topology, bundle, first, last); });

namespace stylobate {
namespace {

const char* const study_name = "study.toml"; ///< as messages and the page call it

std::optional<LoadedStudy> opened;
std::optional<Experiment> shown; ///< the same, with falls to the ground where the model has them
Progress tallied;
DoneSet done;
std::string reply; ///< the last text that was returned

const char* say(const Json& json)
{
    reply = json.text();
    return reply.c_str();
}

/// What a function returns in place of its reply where it throws.
template <class F>
const char* answered(const F& f)
{
    try {
        return say(f());
    } catch (const std::exception& error) {
        return say(Json::object().member("error", error.what()));
    }
}

/// The numbers of an outcome as results files have them.
std::vector<double> numbers_of(const Outcome& outcome)
{
    std::vector<double> numbers;
    visit_fields(std::type_identity<Outcome>(), [&](const char*, auto field, const FieldFacts& facts) {
        numbers.push_back(static_cast<double>(without_none(facts, outcome.*field)));
    });
    return numbers;
}

/// Kinds that decide by outcomes which realizations they run, or run them in groups, are for the program alone.
void check_kind(const Study& study)
{
    const StudyDesign design = study.design();
    if (design.selected || design.layers > 1)
        throw InputError(fmt::format("{}: which realizations are run depends on the outcomes of others, and the page "
                                     "does not compute such studies.\n  Run it with the program: stylobate run {}",
                                     study_name, study_name));
}

Json describe(const LoadedStudy& loaded)
{
    const Study& study = loaded.study();
    Json names = Json::list();
    visit_fields(std::type_identity<Outcome>(), [&](const char* name, auto, const FieldFacts&) {
        Json text = Json::object();
        names.item(text.member("name", name));
    });
    Json warnings = Json::list(loaded.warnings(study_name));
    return Json::object()
        .member("realizations", study.total())
        .member("cells", study.design().cells)
        .member("title", study.title.value_or(""))
        .member("warnings", warnings)
        .member("outcome_names", names);
}

} // namespace
} // namespace stylobate

using namespace stylobate;

extern "C" {

/// From now on the steps are those of `Module.fused`.
EMSCRIPTEN_KEEPALIVE void use_fused()
{
    fused_steps.planar = [](const Topology* topology, const Bundle* bundle, int first, int last) {
        step_planar(topology, bundle, first, last);
    };
    fused_steps.spatial = [](const spatial::Topology* topology, const spatial::Bundle* bundle, int first, int last) {
        step_spatial(topology, bundle, first, last);
    };
}

/// Reads a study, with the records that lie in the file system of the instance.
/// @returns its description, or {"error": message}, the program's own
EMSCRIPTEN_KEEPALIVE const char* open_study(const char* text)
{
    return answered([&] {
        opened.reset();
        std::ofstream(study_name, std::ios::binary) << text;
        opened.emplace(LoadedStudy::from_file(study_name, {}));
        check_kind(opened->study());
        Study to_rest = opened->study();
        if (!to_rest.structure.spatial())
            to_rest.outcome.follow = Follow::rest;
        shown.emplace(std::move(to_rest), opened->experiment().motions());
        tallied = {};
        tallied.total = opened->study().total();
        done = DoneSet(RunOrder(tallied.total));
        return describe(*opened);
    });
}

/// The components of a record that lies in the file system of the instance.
/// @param unit of its samples; empty: the file states it
EMSCRIPTEN_KEEPALIVE const char* read_record_file(const char* file, const char* unit)
{
    return answered([&] {
        Json components = Json::list();
        for (const Record& record : read_records(file, std::string(unit), PgaRange::usual)) {
            double pga = 0;
            for (const double a : record.acceleration_m_s2)
                pga = std::max(pga, std::fabs(a));
            Json component = Json::object();
            components.item(component.member("component", record.component)
                                .member("format", record.format)
                                .member("direction", to_string(record.direction))
                                .member("unit", record.unit)
                                .member("dt_s", record.dt_s)
                                .member("samples", record.acceleration_m_s2.size())
                                .member("pga_m_s2", pga));
        }
        return Json::object().member("components", components);
    });
}

/// Runs one realization of every `workers` in the order of the program, from the place `worker` on, and delivers each.
EMSCRIPTEN_KEEPALIVE const char* run_part(int worker, int workers)
{
    return answered([&] {
        RunPlan plan;
        plan.total = opened->study().total();
        const RunOrder order(plan.total);
        std::uint64_t next = static_cast<std::uint64_t>(worker);
        plan.next_place = [&]() -> std::optional<std::uint64_t> {
            const std::uint64_t place = next;
            next += static_cast<std::uint64_t>(workers);
            return place < plan.total ? std::optional(place) : std::nullopt;
        };
        plan.processes = workers;
        plan.sink = [&](const Realization& realization, const Outcome& outcome) {
            const std::vector<double> numbers = numbers_of(outcome);
            deliver(static_cast<double>(order.place(realization.index)), static_cast<double>(realization.index),
                    static_cast<int>(outcome.state), numbers.data(), static_cast<int>(numbers.size()));
        };
        Observer observer;
        const Progress end = run_ensemble(opened->experiment(), {.isa = best_isa()}, plan, observer);
        return Json::object().member("block_steps", end.block_steps).member("seconds", end.seconds);
    });
}

/// Counts a realization that has been delivered. @returns the counts and the interval, as the program reports them
EMSCRIPTEN_KEEPALIVE const char* count_outcome(double place, int state)
{
    return answered([&] {
        const bool collapsed = state == static_cast<int>(State::collapsed);
        const bool invalid = state == static_cast<int>(State::invalid);
        done.add(static_cast<std::uint64_t>(place), collapsed, invalid);
        ++tallied.done;
        tallied.collapsed += collapsed;
        tallied.invalid += invalid;
        const DoneSet::Part sample = done.sample();
        if (sample.end > 0)
            estimate_share(tallied, sample.done(0) - sample.invalid, sample.collapsed);
        return Json::object()
            .member("done", tallied.done)
            .member("total", tallied.total)
            .member("collapsed", tallied.collapsed)
            .member("invalid", tallied.invalid)
            .member("of", sample.end - sample.invalid)
            .member("share", tallied.share)
            .member("lower", tallied.share_lower)
            .member("upper", tallied.share_upper);
    });
}

/// One realization in motion, for the player of the program's pages, with its state; in the plane until all that fell
/// is at rest.
EMSCRIPTEN_KEEPALIVE const char* trace_one(double index)
{
    return answered([&] {
        const Study& study = opened->study();
        const TracedRealization traced = trace(*shown, static_cast<std::uint64_t>(index), best_isa());
        KeptAnimations kept = animations_for(study);
        Animation animation = animation_of(traced.trajectory, kept.stage, animation_stride(study));
        animation.index = traced.realization.index;
        animation.cell = study.cell(animation.index);
        animation.state = traced.outcome.state;
        animation.frequency_hz = traced.realization.frequency_hz;
        animation.pga_m_s2 = traced.realization.pga_m_s2;
        animation.fall_time_s = traced.outcome.fall_time_s;
        animation.azimuth_rad = traced.outcome.fall_azimuth_rad;
        kept.list.push_back(std::move(animation));
        return Json::object()
            .member_as_is("store", animations_json(kept, study))
            .member("state", to_string(traced.outcome.state));
    });
}
}
