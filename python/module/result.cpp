#include "ensemble/model/outcome.hpp"
#include "library/trajectory.hpp"
#include "python/module/arrays.hpp"
#include "python/module/module.hpp"
#include "python/module/tables.hpp"
#include "stylobate/stylobate.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>

namespace stylobate::python {

namespace {

namespace sb = stylobate::api;
using namespace pybind11::literals;

/// Every number of an outcome but its lists that the model has, under the name that files and tables have it:
/// f(name, member, facts). @param dimensions of the structure, 2 or 3
template <class F>
void visit_outcome(int dimensions, const F& f)
{
    using O = sb::Outcome;
    const auto visit = [&](const char* name, auto member, const FieldFacts& facts) {
        if (has_model(facts.models, dimensions))
            f(name, member, facts);
    };
    visit("index", &O::index, FieldFacts());
    visit("cell", &O::cell, FieldFacts());
    visit("frequency_hz", &O::frequency_hz, FieldFacts());
    visit("pga_m_s2", &O::pga_m_s2, FieldFacts());
#define STYLOBATE_OUTCOME(type, name, value, ...) visit(#name, &O::name, FieldFacts{__VA_ARGS__});
#define STYLOBATE_OUTCOME_AS(public_type, public_name, type, name, value, ...)                                         \
    visit(#name, &O::public_name, FieldFacts{__VA_ARGS__});
#include "stylobate/outcome_fields.inc"
}

/// The unit at the end of a name; "1": none.
std::string unit_in_python(std::string_view name)
{
    return unit_of(name).empty() ? "1" : std::string(unit_of(name));
}

py::dict outcome_dict(const sb::Outcome& outcome, int dimensions)
{
    py::dict all;
    visit_outcome(dimensions, [&](const char* name, auto member, auto) {
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
    axis("direction_deg", &S::direction_deg);
    axis("pga_m_s2", &S::pga_m_s2);
    const auto cells = [&](const char* name, auto member) {
        surface.def_property_readonly(name, [member](const py::object& self) {
            const S& of = self.cast<const S&>();
            return view(self, of.*member,
                        {static_cast<py::ssize_t>(of.rows().size()), static_cast<py::ssize_t>(of.pga_m_s2.size())});
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
    using C = sb::FragilityCurve;
    attributes(py::class_<C>(module, "FragilityCurve"), "limit_state", &C::limit_state, "meaning", &C::meaning,
               "trials", &C::trials, "reached", &C::reached)
        .def_property_readonly("median", [values](const C& c) { return values({c.median}); })
        .def_property_readonly("dispersion", [values](const C& c) { return values({c.dispersion}); })
        .def_property_readonly("probability", [values](const C& c) { return values(c.probability); })
        .def_property_readonly("share", [values](const C& c) { return values(c.share); });
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
    trajectory.def("lists", [](const py::object& self) { // name: (dimensions, unit, meaning, values)
        const T& of = self.cast<const T&>();
        const auto times = static_cast<py::ssize_t>(of.time_s.size()), blocks = static_cast<py::ssize_t>(of.blocks());
        py::dict all;
        sb::visit_channels(of, [&](const TrajectoryChannel& channel, const std::vector<double>& values) {
            py::list dimensions;
            Shape shape;
            if (channel.of != ListOf::blocks) {
                dimensions.append("time_s");
                shape.push_back(times);
            }
            if (channel.of != ListOf::times) {
                dimensions.append("block");
                shape.push_back(blocks);
            }
            all[channel.name] = py::make_tuple(py::tuple(dimensions), unit_in_python(channel.name), channel.meaning,
                                               view(self, values, shape));
        });
        return all;
    });
    // of each sample the polygons that are painted: (points, fill, line, width); "": no fill
    trajectory.def("seen_in_space", [](const T& of, const std::vector<std::size_t>& samples) {
        py::list all;
        for (const std::vector<ShadedPolygon>& polygons : sb::seen_in_space(of, samples)) {
            py::list seen;
            for (const ShadedPolygon& polygon : polygons) {
                py::list points;
                for (const ViewPoint& point : polygon.points)
                    points.append(py::make_tuple(point.x, point.y));
                seen.append(py::make_tuple(points, polygon.fill, polygon.line, polygon.line_width));
            }
            all.append(seen);
        }
        return all;
    });
    trajectory.def_readonly("name", &T::name)
        .def_readonly("fixed", &T::fixed)
        .def_readonly("epistyle", &T::epistyle)
        .def_readonly("column", &T::column)
        .def_readonly("dimensions", &T::dimensions)
        .def("outcome", [](const T& of) { return outcome_dict(of.outcome, of.dimensions); });
}

} // namespace

void add_result(py::module_& module)
{
    add_surface(module);
    add_fragility(module);
    add_trajectory(module);
    attributes(py::class_<sb::Share>(module, "Share"), "trials", &sb::Share::trials, "count", &sb::Share::count,
               "probability", &sb::Share::probability, "lower", &sb::Share::lower, "upper", &sb::Share::upper);
    using R = sb::Result;
    attributes(py::class_<R>(module, "Result"), "kind", &R::kind, "study_text", &R::study_text, "code_version",
               &R::code_version, "dimensions", &R::dimensions, "complete", &R::complete, "realizations",
               &R::realizations, "invalid", &R::invalid, "too_many_invalid", &R::too_many_invalid, "warnings",
               &R::warnings, "input_names", &R::input_names, "input_units", &R::input_units, "block_names",
               &R::block_names)
        .def_static("from_file", &sb::Result::from_file, "file"_a, py::call_guard<py::gil_scoped_release>())
        .def("share", &sb::Result::share, "limit_state"_a = "collapse")
        .def("surface", &sb::Result::surface, "limit_state"_a = "collapse")
        .def("fragility", &sb::Result::fragility)
        .def("tables", [](const py::object& self) { return tables(self, self.cast<const R&>().tables()); })
        .def("columns",
             [](const py::object& self) { // name: (unit, whether -1 is none, values)
                 const auto& result = self.cast<const sb::Result&>();
                 const auto& rows = result.outcomes();
                 py::dict all;
                 visit_outcome(result.dimensions(), [&](const char* name, auto member, const FieldFacts& facts) {
                     all[name] = py::make_tuple(unit_in_python(name), is_event_time(facts), column(self, rows, member));
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
