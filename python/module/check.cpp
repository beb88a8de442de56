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
    attributes(py::class_<W>(module, "WeakSpot"), "name", &W::name, "text", &W::text, "remedy", &W::remedy)
        .def("__repr__", [](const W& spot) { return "<WeakSpot: " + spot.name + ">"; });
    using K = sb::ChosenKey;
    attributes(py::class_<K>(module, "ChosenKey"), "key", &K::key, "value", &K::value, "reason", &K::reason)
        .def("__repr__", [](const K& chosen) { return "<ChosenKey: " + chosen.key + " = " + chosen.value + ">"; });
    using T = sb::Trial;
    attributes(py::class_<T>(module, "Trial"), "realizations", &T::realizations, "valid", &T::valid, "collapsed",
               &T::collapsed, "whole", &T::whole, "seconds", &T::seconds)
        .def("__repr__",
             [](const T& trial) { return "<Trial: " + std::to_string(trial.realizations) + " realizations>"; });
    using R = sb::RunTime;
    attributes(py::class_<R>(module, "RunTime"), "seconds", &R::seconds, "at_most", &R::at_most, "processor_s",
               &R::processor_s, "block_steps", &R::block_steps)
        .def_property_readonly("range_s", [](const R& time) { return pair(time.range_s); })
        .def_property_readonly("steps", [](const R& time) { return pair(time.steps); })
        .def("__repr__", [](const R& time) {
            return py::str("<RunTime: {:.2g} to {:.2g} s>").format(time.range_s.lower, time.range_s.upper);
        });
    using P = sb::Pilot;
    attributes(py::class_<P>(module, "Pilot"), "realizations", &P::realizations, "collapsed", &P::collapsed,
               "collapsed_finer", &P::collapsed_finer, "difference", &P::difference, "standard_error",
               &P::standard_error, "accuracy_missed", &P::accuracy_missed)
        .def("__repr__", [](const P& pilot) {
            return py::str("<Pilot: {:+.4f} \u00b1 {:.4f}>").format(pilot.difference, pilot.standard_error);
        });
}

} // namespace

void add_check(py::module_& module)
{
    add_findings(module);
    using C = sb::Check;
    attributes(py::class_<C>(module, "Check"), "kind", &C::kind, "form", &C::form, "realizations", &C::realizations,
               "at_most", &C::at_most, "cells", &C::cells, "blocks", &C::blocks, "free_blocks", &C::free_blocks,
               "trial", &C::trial, "time", &C::time, "memory_bytes", &C::memory_bytes, "file_bytes", &C::file_bytes,
               "chosen", &C::chosen, "weak_spots", &C::weak_spots, "pilot", &C::pilot, "warnings", &C::warnings)
        .def_property_readonly("step_s", [](const C& check) { return pair(check.step_s()); })
        .def_property_readonly("longest_steps", [](const C& check) { return pair(check.longest_steps()); })
        .def("text", &C::text)
        .def("json", &C::json)
        .def("draw", &C::draw, "picture"_a, py::call_guard<py::gil_scoped_release>());
    using O = sb::CheckOptions;
    add_options<O>(module, "CheckOptions", "pilot", &O::pilot, "trial_seconds", &O::trial_seconds, "law_seconds",
                   &O::law_seconds, "threads", &O::threads, "simd", &O::simd);
    add_told<O, sb::Experiment>(module, "check", [](const auto&... given) { return sb::check(given...); });
}

} // namespace stylobate::python
