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
               "lower", &P::lower, "upper", &P::upper)
        .def_property_readonly("range", [](const P& p) { return py::make_tuple(p.range_from, p.range_to); })
        .def_readonly("bounded_below", &P::bounded_below)
        .def_readonly("bounded_above", &P::bounded_above)
        .def_readonly("determined", &P::determined)
        .def_readonly("effective", &P::effective)
        .def_readonly("note", &P::note)
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
    module.def(
        "calibrate",
        [](const std::filesystem::path& measured, const O& options, const py::object& progress) {
            return interruptible_lines<std::optional<C>>(options, progress,
                                                         [&](const O& told) { return sb::calibrate(measured, told); });
        },
        "measured"_a, "options"_a, "progress"_a);
}

} // namespace stylobate::python
