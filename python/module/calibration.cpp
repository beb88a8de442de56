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
    py::class_<P>(module, "CalibratedParameter")
        .def_readonly("key", &P::key)
        .def_readonly("start", &P::start)
        .def_readonly("value", &P::value)
        .def_readonly("lower", &P::lower)
        .def_readonly("upper", &P::upper)
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
    py::class_<R>(module, "CalibratedRun")
        .def_readonly("run", &R::run)
        .def_readonly("motion_id", &R::motion_id)
        .def_readonly("units", &R::units)
        .def_readonly("start", &R::start)
        .def_readonly("calibrated", &R::calibrated)
        .def("__repr__", [](const R& r) { return "<CalibratedRun: " + r.run + ">"; });
    using G = sb::HeldOutGain;
    py::class_<G>(module, "HeldOutGain")
        .def_readonly("nats", &G::nats)
        .def_readonly("lower", &G::lower)
        .def_readonly("upper", &G::upper)
        .def("__repr__", [](const G& g) { return py::str("<HeldOutGain: {:+.1f} nats>").format(g.nats); });
    using F = sb::CalibratedForm;
    py::class_<F>(module, "CalibratedForm")
        .def_readonly("form", &F::form)
        .def_readonly("parameters", &F::parameters)
        .def_readonly("score", &F::score)
        .def_readonly("start_score", &F::start_score)
        .def_readonly("runs", &F::runs)
        .def_readonly("held_out", &F::held_out)
        .def("__repr__", [](const F& f) {
            return py::str("<CalibratedForm: {}, {} parameters>").format(f.form, f.parameters.size());
        });
}

} // namespace

void add_calibration(py::module_& module)
{
    add_forms(module);
    using C = sb::Calibration;
    py::class_<C>(module, "Calibration")
        .def_property_readonly("measured", &C::measured)
        .def_property_readonly("evidence", &C::evidence)
        .def_property_readonly("forms", &C::forms)
        .def_property_readonly("best", &C::best)
        .def_property_readonly("notes", &C::notes)
        .def_property_readonly("calibrated_study", &C::calibrated_study)
        .def_property_readonly("parameter_sets", &C::parameter_sets)
        .def_property_readonly("restored_sets", &C::restored_sets)
        .def_property_readonly("seconds", &C::seconds)
        .def("text", &C::text)
        .def("json", &C::json)
        .def("write", &C::write, "file"_a);
    using Words = std::vector<std::string>;
    module.def(
        "calibrate",
        [](const std::filesystem::path& measured, const std::optional<sb::Study>& study, const Words& forms,
           const Words& fit, const Words& hold, bool outcomes, bool held_out, int threads, const std::string& simd,
           const std::filesystem::path& cache, const py::object& progress) {
            sb::CalibrationOptions options;
            options.study = study;
            options.forms = forms;
            options.fit = fit;
            options.hold = hold;
            options.outcomes = outcomes;
            options.held_out = held_out;
            options.threads = threads;
            options.simd = simd;
            options.cache = cache;
            return interruptible_lines<std::optional<C>>(
                std::move(options), progress,
                [&](const sb::CalibrationOptions& told) { return sb::calibrate(measured, told); });
        },
        "measured"_a, "study"_a, "forms"_a, "fit"_a, "hold"_a, "outcomes"_a, "held_out"_a, "threads"_a, "simd"_a,
        "cache"_a, "progress"_a);
}

} // namespace stylobate::python
