#include "python/module/arrays.hpp"
#include "python/module/module.hpp"
#include "stylobate/stylobate.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>

namespace stylobate::python {

namespace {

namespace sb = stylobate::api;
using namespace pybind11::literals;

/// Every number of an outcome but its lists, under the name that files and tables have it: f(name, unit, member).
template <class F>
void visit_outcome(const F& f)
{
    using O = sb::Outcome;
    f("index", "1", &O::index);
    f("cell", "1", &O::cell);
    f("frequency_hz", "Hz", &O::frequency_hz);
    f("pga_m_s2", "m/s2", &O::pga_m_s2);
    f("state", "1", &O::state);
    f("invalid_reason", "1", &O::invalid_reason);
    f("collapse_time_s", "s", &O::collapse_time_s);
    f("first_collapse_block", "1", &O::first_fallen_block);
    f("fallen_blocks", "1", &O::fallen_blocks);
    f("at_rest", "1", &O::at_rest);
    f("unseated_block", "1", &O::unseated_block);
    f("unseating_time_s", "s", &O::unseating_time_s);
    f("total_collapse_time_s", "s", &O::total_collapse_time_s);
    f("peak_top_displacement_m", "m", &O::peak_top_displacement_m);
    f("residual_top_displacement_m", "m", &O::residual_top_displacement_m);
    f("top_path_m", "m", &O::top_path_m);
    f("total_sliding_m", "m", &O::total_sliding_m);
    f("sliding_path_m", "m", &O::sliding_path_m);
    f("residual_sliding_m", "m", &O::residual_sliding_m);
    f("residual_dislocation", "1", &O::residual_dislocation);
    f("total_rocking_rad", "rad", &O::total_rocking_rad);
    f("rocking_path_rad", "rad", &O::rocking_path_rad);
    f("max_relative_rotation_rad", "rad", &O::max_relative_rotation_rad);
    f("energy_kinetic_j", "J", &O::energy_kinetic_j);
    f("energy_potential_j", "J", &O::energy_potential_j);
    f("energy_spring_j", "J", &O::energy_spring_j);
    f("energy_friction_j", "J", &O::energy_friction_j);
    f("energy_damping_j", "J", &O::energy_damping_j);
    f("energy_base_work_j", "J", &O::energy_base_work_j);
    f("energy_residual", "1", &O::energy_residual);
    f("end_time_s", "s", &O::end_time_s);
    f("step_s", "s", &O::step_s);
    f("steps", "1", &O::steps);
}

/// Names to (unit, values of one outcome).
py::dict outcome_dict(const sb::Outcome& outcome)
{
    py::dict all;
    visit_outcome([&](const char* name, const char*, auto member) {
        if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(outcome.*member)>>)
            all[name] = sb::to_string(outcome.*member);
        else
            all[name] = outcome.*member;
    });
    all["fall_time_s"] = copied(outcome.fall_time_s);
    all["inputs"] = copied(outcome.inputs);
    return all;
}

void add_surface(py::module_& module)
{
    using S = sb::Surface;
    py::class_<S> surface(module, "Surface");
    surface.def_readonly("limit_state", &S::limit_state).def_readonly("interval", &S::interval);
    const auto axis = [&](const char* name, std::vector<double> S::*member) {
        surface.def_property_readonly(
            name, [member](const py::object& self) { return view(self, self.cast<const S&>().*member); });
    };
    axis("frequency_hz", &S::frequency_hz);
    axis("pga_m_s2", &S::pga_m_s2);
    const auto cells = [&](const char* name, auto member) {
        surface.def_property_readonly(name, [member](const py::object& self) {
            const S& of = self.cast<const S&>();
            return view(
                self, of.*member,
                {static_cast<py::ssize_t>(of.frequency_hz.size()), static_cast<py::ssize_t>(of.pga_m_s2.size())});
        });
    };
    cells("trials", &S::trials);
    cells("reached", &S::reached);
    cells("probability", &S::probability);
    cells("lower", &S::lower);
    cells("upper", &S::upper);
}

void add_fragility(py::module_& module)
{
    const auto values = [](const std::vector<sb::Estimate>& list) {
        return matrix(list, 3, [](const sb::Estimate& e) { return std::array{e.value, e.lower, e.upper}; });
    };
    py::class_<sb::FragilityCurve>(module, "FragilityCurve")
        .def_readonly("limit_state", &sb::FragilityCurve::limit_state)
        .def_readonly("meaning", &sb::FragilityCurve::meaning)
        .def_readonly("trials", &sb::FragilityCurve::trials)
        .def_readonly("reached", &sb::FragilityCurve::reached)
        .def_property_readonly("median", [values](const sb::FragilityCurve& c) { return values({c.median}); })
        .def_property_readonly("dispersion", [values](const sb::FragilityCurve& c) { return values({c.dispersion}); })
        .def_property_readonly("probability", [values](const sb::FragilityCurve& c) { return values(c.probability); })
        .def_property_readonly("share", [values](const sb::FragilityCurve& c) { return values(c.share); });
    py::class_<sb::Fragility>(module, "Fragility")
        .def_readonly("measure", &sb::Fragility::measure)
        .def_property_readonly("intensity", [](const sb::Fragility& f) { return copied(f.intensity); })
        .def_property_readonly("stripe", [](const sb::Fragility& f) { return copied(f.stripe); })
        .def_readonly("curves", &sb::Fragility::curves);
}

void add_trajectory(py::module_& module)
{
    using T = sb::Trajectory;
    py::class_<T> trajectory(module, "Trajectory");
    const auto list = [&](const char* name, std::vector<double> T::*member) {
        trajectory.def_property_readonly(
            name, [member](const py::object& self) { return view(self, self.cast<const T&>().*member); });
    };
    const auto history = [&](const char* name, std::vector<double> T::*member) {
        trajectory.def_property_readonly(name, [member](const py::object& self) {
            const T& of = self.cast<const T&>();
            return view(self, of.*member,
                        {static_cast<py::ssize_t>(of.time_s.size()), static_cast<py::ssize_t>(of.blocks())});
        });
    };
    list("time_s", &T::time_s);
    history("x_m", &T::x_m);
    history("y_m", &T::y_m);
    history("theta_rad", &T::theta_rad);
    list("base_x_m", &T::base_x_m);
    list("rest_x_m", &T::rest_x_m);
    list("rest_y_m", &T::rest_y_m);
    list("half_width_m", &T::half_width_m);
    list("half_height_m", &T::half_height_m);
    trajectory.def_readonly("name", &T::name)
        .def_readonly("fixed", &T::fixed)
        .def_readonly("epistyle", &T::epistyle)
        .def_readonly("column", &T::column)
        .def("outcome", [](const T& of) { return outcome_dict(of.outcome); });
}

} // namespace

void add_result(py::module_& module)
{
    add_surface(module);
    add_fragility(module);
    add_trajectory(module);
    py::class_<sb::Share>(module, "Share")
        .def_readonly("trials", &sb::Share::trials)
        .def_readonly("count", &sb::Share::count)
        .def_readonly("probability", &sb::Share::probability)
        .def_readonly("lower", &sb::Share::lower)
        .def_readonly("upper", &sb::Share::upper);
    py::class_<sb::Result>(module, "Result")
        .def_static("from_file", &sb::Result::from_file, "file"_a, py::call_guard<py::gil_scoped_release>())
        .def_property_readonly("kind", &sb::Result::kind)
        .def_property_readonly("study_text", &sb::Result::study_text)
        .def_property_readonly("code_version", &sb::Result::code_version)
        .def_property_readonly("complete", &sb::Result::complete)
        .def_property_readonly("realizations", &sb::Result::realizations)
        .def_property_readonly("invalid", &sb::Result::invalid)
        .def_property_readonly("too_many_invalid", &sb::Result::too_many_invalid)
        .def_property_readonly("warnings", &sb::Result::warnings)
        .def_property_readonly("input_names", &sb::Result::input_names)
        .def_property_readonly("input_units", &sb::Result::input_units)
        .def_property_readonly("block_names", &sb::Result::block_names)
        .def("share", &sb::Result::share, "limit_state"_a = "collapse")
        .def("surface", &sb::Result::surface, "limit_state"_a = "collapse")
        .def("fragility", &sb::Result::fragility)
        .def("columns",
             [](const py::object& self) { // name: (unit, values)
                 const auto& rows = self.cast<const sb::Result&>().outcomes();
                 py::dict all;
                 visit_outcome([&](const char* name, const char* unit, auto member) {
                     all[name] = py::make_tuple(unit, column(self, rows, member));
                 });
                 return all;
             })
        .def("fall_time_s",
             [](const sb::Result& result) {
                 return matrix(result.outcomes(), result.block_names().size(),
                               [](const sb::Outcome& row) -> const std::vector<double>& { return row.fall_time_s; });
             })
        .def("inputs", [](const sb::Result& result) {
            return matrix(result.outcomes(), result.input_names().size(),
                          [](const sb::Outcome& row) -> const std::vector<double>& { return row.inputs; });
        });
}

} // namespace stylobate::python
