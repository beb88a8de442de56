#include "python/module/interruptible.hpp"
#include "python/module/module.hpp"
#include "python/module/tables.hpp"
#include "stylobate/stylobate.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace stylobate::python {

namespace {

namespace sb = stylobate::api;
using namespace pybind11::literals;

} // namespace

void add_answers(py::module_& module)
{
    using A = sb::Answer;
    py::class_<A>(module, "Answer")
        .def("text", &A::text)
        .def("json", &A::json)
        .def("rows", [](const py::object& self) { return table(self, self.cast<const A&>().rows()); })
        .def("tables", [](const py::object& self) { return tables(self, self.cast<const A&>().tables()); })
        .def("write", &A::write, "file"_a)
        .def("draw", &A::draw, "picture"_a, "limit_state"_a, py::call_guard<py::gil_scoped_release>());
    py::class_<sb::Comparison, A>(module, "Comparison").def_static("from_file", &sb::Comparison::from_file, "file"_a);
    py::class_<sb::Risk, A>(module, "Risk").def_static("from_file", &sb::Risk::from_file, "file"_a);
    py::class_<sb::Past, A>(module, "Past");
    using Files = std::vector<std::filesystem::path>;
    using C = sb::CompareOptions;
    add_options<C>(module, "CompareOptions", "settings", &C::settings, "folder", &C::folder, "level", &C::level,
                   "adaptive", &C::adaptive, "margin", &C::margin, "threads", &C::threads, "simd", &C::simd);
    add_told<C, Files>(module, "compare", [](const auto&... given) { return sb::compare(given...); });
    using R = sb::RiskOptions;
    add_options<R>(module, "RiskOptions", "site", &R::site, "limit_state", &R::limit_state, "years", &R::years, "level",
                   &R::level, "most_outside", &R::most_outside, "sequences", &R::sequences, "threshold", &R::threshold,
                   "pause_s", &R::pause_s, "seed", &R::seed, "settings", &R::settings, "threads", &R::threads, "simd",
                   &R::simd);
    add_told<R, std::filesystem::path, std::vector<std::string>>(
        module, "risk", [](const auto&... given) { return sb::risk(given...); });
    module.def(
        "past", [](const Files& files) { return sb::past(files); }, "files"_a,
        py::call_guard<py::gil_scoped_release>());
    using P = sb::ReportOptions;
    add_options<P>(module, "ReportOptions", "title", &P::title, "animate", &P::animate, "animate_mb", &P::animate_mb,
                   "animate_seconds", &P::animate_seconds, "settings", &P::settings, "threads", &P::threads, "simd",
                   &P::simd);
    attributes(py::class_<sb::Page>(module, "Page"), "html", &sb::Page::html, "warnings", &sb::Page::warnings)
        .def("write", &sb::Page::write, "file"_a);
    add_told<P, std::filesystem::path>(module, "report", [](const auto&... given) { return sb::report(given...); });
}

} // namespace stylobate::python
