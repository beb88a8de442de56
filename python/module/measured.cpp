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

void add_forms(py::module_& module)
{
    using P = sb::CalibratedParameter;
    attributes(py::class_<P>(module, "CalibratedParameter"), "key", &P::key, "start", &P::start, "value", &P::value,
               "lower", &P::lower, "upper", &P::upper, "bounded_below", &P::bounded_below, "bounded_above",
               &P::bounded_above, "determined", &P::determined, "effective", &P::effective, "note", &P::note)
        .def_property_readonly("range", [](const P& p) { return py::make_tuple(p.range_from, p.range_to); })
        .def("__repr__", [](const P& p) {
            return py::str("<CalibratedParameter: {} = {:.5g}, {}>")
                .format(p.key, p.value,
                        p.determined  ? "determined"
                        : p.effective ? "effective"
                                      : "not determined");
        });
    using R = sb::CalibratedRun;
    attributes(py::class_<R>(module, "CalibratedRun"), "run", &R::run, "motion_id", &R::motion_id, "units", &R::units,
               "start", &R::start, "calibrated", &R::calibrated)
        .def("__repr__", [](const R& r) { return "<CalibratedRun: " + r.run + ">"; });
    using G = sb::HeldOutGain;
    attributes(py::class_<G>(module, "HeldOutGain"), "nats", &G::nats, "lower", &G::lower, "upper", &G::upper)
        .def("__repr__", [](const G& g) { return py::str("<HeldOutGain: {:+.1f} nats>").format(g.nats); });
    using F = sb::CalibratedForm;
    attributes(py::class_<F>(module, "CalibratedForm"), "form", &F::form, "parameters", &F::parameters, "score",
               &F::score, "start_score", &F::start_score, "runs", &F::runs, "held_out", &F::held_out)
        .def("__repr__", [](const F& f) {
            return py::str("<CalibratedForm: {}, {} parameters>").format(f.form, f.parameters.size());
        });
}

} // namespace

void add_calibration(py::module_& module)
{
    add_forms(module);
    using C = sb::Calibration;
    attributes(py::class_<C>(module, "Calibration"), "measured", &C::measured, "evidence", &C::evidence, "forms",
               &C::forms, "best", &C::best, "notes", &C::notes, "calibrated_study", &C::calibrated_study,
               "parameter_sets", &C::parameter_sets, "restored_sets", &C::restored_sets, "seconds", &C::seconds)
        .def("text", &C::text)
        .def("json", &C::json)
        .def("write", &C::write, "file"_a);
    using O = sb::CalibrationOptions;
    add_options<O>(module, "CalibrationOptions", "study", &O::study, "forms", &O::forms, "fit", &O::fit, "hold",
                   &O::hold, "outcomes", &O::outcomes, "held_out", &O::held_out, "threads", &O::threads, "simd",
                   &O::simd, "cache", &O::cache);
    add_told<O, std::filesystem::path>(module, "calibrate",
                                       [](const auto&... given) { return sb::calibrate(given...); });
}

void add_diagnosis(py::module_& module)
{
    attributes(py::class_<sb::Cause>(module, "Cause"), "mechanism", &sb::Cause::mechanism, "place", &sb::Cause::place,
               "parameter", &sb::Cause::parameter, "unit", &sb::Cause::unit, "size", &sb::Cause::size, "lower",
               &sb::Cause::lower, "upper", &sb::Cause::upper, "probability", &sb::Cause::probability, "gain_nats",
               &sb::Cause::gain_nats, "p", &sb::Cause::p)
        .def("__repr__", [](const sb::Cause& c) { return "<Cause: " + c.mechanism + " at " + c.place + ">"; });
    const auto verdict = [](const sb::Diagnosis& d) {
        constexpr const char* words[] = {"none", "named", "unexplained"};
        return words[static_cast<int>(d.verdict())];
    };
    attributes(py::class_<sb::Diagnosis>(module, "Diagnosis"), "verdict", verdict, "verdict_text",
               &sb::Diagnosis::verdict_text, "causes", &sb::Diagnosis::causes, "extended_study",
               &sb::Diagnosis::extended_study)
        .def("text", &sb::Diagnosis::text)
        .def("json", &sb::Diagnosis::json)
        .def("write", &sb::Diagnosis::write, "file"_a);
    using O = sb::DiagnosisOptions;
    add_options<O>(module, "DiagnosisOptions", "study", &O::study, "nulls", &O::nulls, "seed", &O::seed, "threads",
                   &O::threads, "simd", &O::simd, "cache", &O::cache);
    add_told<O, std::filesystem::path>(module, "diagnose", [](const auto&... given) { return sb::diagnose(given...); });
}

} // namespace stylobate::python
