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
    py::class_<sb::Cause>(module, "Cause")
        .def_readonly("mechanism", &sb::Cause::mechanism)
        .def_readonly("place", &sb::Cause::place)
        .def_readonly("parameter", &sb::Cause::parameter)
        .def_readonly("unit", &sb::Cause::unit)
        .def_readonly("size", &sb::Cause::size)
        .def_readonly("lower", &sb::Cause::lower)
        .def_readonly("upper", &sb::Cause::upper)
        .def_readonly("probability", &sb::Cause::probability)
        .def_readonly("gain_nats", &sb::Cause::gain_nats)
        .def_readonly("p", &sb::Cause::p)
        .def("__repr__", [](const sb::Cause& c) { return "<Cause: " + c.mechanism + " at " + c.place + ">"; });
    py::class_<sb::Diagnosis>(module, "Diagnosis")
        .def_property_readonly("verdict", [](const sb::Diagnosis& d) { return word(d.verdict()); })
        .def_property_readonly("verdict_text", &sb::Diagnosis::verdict_text)
        .def_property_readonly("causes", &sb::Diagnosis::causes)
        .def_property_readonly("extended_study", &sb::Diagnosis::extended_study)
        .def("text", &sb::Diagnosis::text)
        .def("json", &sb::Diagnosis::json)
        .def("write", &sb::Diagnosis::write, "file"_a);
    module.def(
        "diagnose",
        [](const std::filesystem::path& measured, const std::optional<sb::Study>& study, std::uint64_t nulls,
           std::uint64_t seed, int threads, const std::string& simd, const std::filesystem::path& cache,
           const py::object& progress) {
            sb::DiagnosisOptions options;
            options.study = study;
            options.nulls = nulls;
            options.seed = seed;
            options.threads = threads;
            options.simd = simd;
            options.cache = cache;
            return interruptible_lines<std::optional<sb::Diagnosis>>(
                std::move(options), progress,
                [&](const sb::DiagnosisOptions& told) { return sb::diagnose(measured, told); });
        },
        "measured"_a, "study"_a, "nulls"_a, "seed"_a, "threads"_a, "simd"_a, "cache"_a, "progress"_a);
}

} // namespace stylobate::python
