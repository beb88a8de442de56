#include "python/module/interruptible.hpp"
#include "python/module/module.hpp"
#include "stylobate/stylobate.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace stylobate::python {

namespace {

namespace py = pybind11;
namespace sb = stylobate::api;
using namespace pybind11::literals;

py::tuple pair(const sb::Range& range)
{
    return py::make_tuple(range.lower, range.upper);
}

void add_findings(py::module_& module)
{
    using W = sb::WeakSpot;
    py::class_<W>(module, "WeakSpot")
        .def_readonly("name", &W::name)
        .def_readonly("text", &W::text)
        .def_readonly("remedy", &W::remedy)
        .def("__repr__", [](const W& spot) { return "<WeakSpot: " + spot.name + ">"; });
    using K = sb::ChosenKey;
    py::class_<K>(module, "ChosenKey")
        .def_readonly("key", &K::key)
        .def_readonly("value", &K::value)
        .def_readonly("reason", &K::reason)
        .def("__repr__", [](const K& chosen) { return "<ChosenKey: " + chosen.key + " = " + chosen.value + ">"; });
    using T = sb::Trial;
    py::class_<T>(module, "Trial")
        .def_readonly("realizations", &T::realizations)
        .def_readonly("valid", &T::valid)
        .def_readonly("collapsed", &T::collapsed)
        .def_readonly("whole", &T::whole)
        .def_readonly("seconds", &T::seconds)
        .def("__repr__",
             [](const T& trial) { return "<Trial: " + std::to_string(trial.realizations) + " realizations>"; });
    using R = sb::RunTime;
    py::class_<R>(module, "RunTime")
        .def_readonly("seconds", &R::seconds)
        .def_property_readonly("range_s", [](const R& time) { return pair(time.range_s); })
        .def_readonly("at_most", &R::at_most)
        .def_readonly("processor_s", &R::processor_s)
        .def_readonly("block_steps", &R::block_steps)
        .def_property_readonly("steps", [](const R& time) { return pair(time.steps); })
        .def("__repr__", [](const R& time) {
            return py::str("<RunTime: {:.2g} to {:.2g} s>").format(time.range_s.lower, time.range_s.upper);
        });
    using P = sb::Pilot;
    py::class_<P>(module, "Pilot")
        .def_readonly("realizations", &P::realizations)
        .def_readonly("collapsed", &P::collapsed)
        .def_readonly("collapsed_finer", &P::collapsed_finer)
        .def_readonly("difference", &P::difference)
        .def_readonly("standard_error", &P::standard_error)
        .def_readonly("accuracy_missed", &P::accuracy_missed)
        .def("__repr__", [](const P& pilot) {
            return py::str("<Pilot: {:+.4f} \u00b1 {:.4f}>").format(pilot.difference, pilot.standard_error);
        });
}

} // namespace

void add_check(py::module_& module)
{
    add_findings(module);
    using C = sb::Check;
    py::class_<C>(module, "Check")
        .def_property_readonly("kind", &C::kind)
        .def_property_readonly("form", &C::form)
        .def_property_readonly("realizations", &C::realizations)
        .def_property_readonly("at_most", &C::at_most)
        .def_property_readonly("cells", &C::cells)
        .def_property_readonly("blocks", &C::blocks)
        .def_property_readonly("free_blocks", &C::free_blocks)
        .def_property_readonly("step_s", [](const C& check) { return pair(check.step_s()); })
        .def_property_readonly("longest_steps", [](const C& check) { return pair(check.longest_steps()); })
        .def_property_readonly("trial", &C::trial)
        .def_property_readonly("time", &C::time)
        .def_property_readonly("memory_bytes", &C::memory_bytes)
        .def_property_readonly("file_bytes", &C::file_bytes)
        .def_property_readonly("chosen", &C::chosen)
        .def_property_readonly("weak_spots", &C::weak_spots)
        .def_property_readonly("pilot", &C::pilot)
        .def_property_readonly("warnings", &C::warnings)
        .def("text", &C::text)
        .def("json", &C::json)
        .def("draw", &C::draw, "picture"_a, py::call_guard<py::gil_scoped_release>());
    module.def(
        "check",
        [](const sb::Experiment& experiment, std::uint64_t pilot, double trial_seconds, double law_seconds, int threads,
           const std::string& simd, const py::object& progress) {
            sb::CheckOptions options;
            options.pilot = pilot;
            options.trial_seconds = trial_seconds;
            options.law_seconds = law_seconds;
            options.threads = threads;
            options.simd = simd;
            return interruptible_lines<std::optional<C>>(
                std::move(options), progress,
                [&](const sb::CheckOptions& told) { return sb::check(experiment, told); });
        },
        "experiment"_a, "pilot"_a, "trial_seconds"_a, "law_seconds"_a, "threads"_a, "simd"_a, "progress"_a);
}

} // namespace stylobate::python
