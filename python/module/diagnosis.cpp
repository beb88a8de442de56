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

const char* word(sb::Verdict verdict)
{
    switch (verdict) {
    case sb::Verdict::none:
        return "none";
    case sb::Verdict::named:
        return "named";
    case sb::Verdict::unexplained:
        break;
    }
    return "unexplained";
}

} // namespace

void add_diagnosis(py::module_& module)
{
    attributes(py::class_<sb::Cause>(module, "Cause"), "mechanism", &sb::Cause::mechanism, "place", &sb::Cause::place,
               "parameter", &sb::Cause::parameter, "unit", &sb::Cause::unit, "size", &sb::Cause::size, "lower",
               &sb::Cause::lower, "upper", &sb::Cause::upper, "probability", &sb::Cause::probability, "gain_nats",
               &sb::Cause::gain_nats, "p", &sb::Cause::p)
        .def("__repr__", [](const sb::Cause& c) { return "<Cause: " + c.mechanism + " at " + c.place + ">"; });
    py::class_<sb::Diagnosis>(module, "Diagnosis")
        .def_property_readonly("verdict", [](const sb::Diagnosis& d) { return word(d.verdict()); })
        .def_property_readonly("verdict_text", &sb::Diagnosis::verdict_text)
        .def_property_readonly("causes", &sb::Diagnosis::causes)
        .def_property_readonly("extended_study", &sb::Diagnosis::extended_study)
        .def("text", &sb::Diagnosis::text)
        .def("json", &sb::Diagnosis::json)
        .def("write", &sb::Diagnosis::write, "file"_a);
    using O = sb::DiagnosisOptions;
    add_options<O>(module, "DiagnosisOptions", "study", &O::study, "nulls", &O::nulls, "seed", &O::seed, "threads",
                   &O::threads, "simd", &O::simd, "cache", &O::cache);
    module.def(
        "diagnose",
        [](const std::filesystem::path& measured, const O& options, const py::object& progress) {
            return interruptible_lines<std::optional<sb::Diagnosis>>(
                options, progress, [&](const O& told) { return sb::diagnose(measured, told); });
        },
        "measured"_a, "options"_a, "progress"_a);
}

} // namespace stylobate::python
