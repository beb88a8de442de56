#include "python/module/module.hpp"
#include "stylobate/stylobate.hpp"

#include <pybind11/stl.h>

namespace stylobate::python {

namespace {

namespace py = pybind11;
namespace sb = stylobate::api;
using namespace pybind11::literals;

} // namespace

void add_figure(py::module_& module)
{
    using K = sb::SeriesKind;
    py::enum_<K>(module, "SeriesKind").value("line", K::line).value("points", K::points).value("bars", K::bars);
    using S = sb::FigureSeries;
    add_options<S>(module, "FigureSeries", "name", &S::name, "kind", &S::kind, "x", &S::x, "y", &S::y, "lower",
                   &S::lower, "upper", &S::upper, "group", &S::group);
    using F = sb::Figure;
    add_options<F>(module, "Figure", "title", &F::title, "x_label", &F::x_label, "y_label", &F::y_label, "x_log",
                   &F::x_log, "y_log", &F::y_log, "x_ticks", &F::x_ticks, "series", &F::series);
    module.def("svg", py::overload_cast<const sb::Figure&>(&sb::svg), "figure"_a);
    module.def("svg", py::overload_cast<const sb::Surface&>(&sb::svg), "surface"_a);
    module.def("svg", py::overload_cast<const sb::Study&>(&sb::svg), "study"_a);
    module.def("svg", py::overload_cast<const sb::Check&>(&sb::svg), "check"_a);
    module.def("svg", py::overload_cast<const sb::Trajectory&, double>(&sb::svg), "trajectory"_a, "time_s"_a);
}

} // namespace stylobate::python
