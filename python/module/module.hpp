#pragma once
/// The parts of the module `stylobate._core`. Each adds classes and functions that the Python files in `stylobate/`
/// use.

#include <pybind11/pybind11.h>

#include <type_traits>

namespace stylobate::python {

/// Adds read-only attributes: a name, and a member or a function without arguments, each.
template <class Class>
Class attributes(Class of)
{
    return of;
}
template <class Class, class Member, class... Rest>
Class attributes(Class of, const char* name, Member member, Rest... rest)
{
    if constexpr (!std::is_member_object_pointer_v<Member>)
        of.def_property_readonly(name, member);
    else
        of.def_readonly(name, member);
    return attributes(of, rest...);
}

/// The options of a function, which Python sets by their names: a name and a member each.
template <class Options, class... Members>
void add_options(pybind11::module_& module, const char* name, Members... members)
{
    pybind11::class_<Options> made(module, name);
    made.def(pybind11::init<>());
    const auto add = [&](const auto& self, const char* field, auto member, auto... rest) {
        made.def_readwrite(field, member);
        if constexpr (sizeof...(rest) > 0)
            self(self, rest...);
    };
    add(add, members...);
}

void add_study(pybind11::module_& module);       ///< Study, Record, and errors
void add_result(pybind11::module_& module);      ///< Result, Surface, Fragility, Trajectory
void add_figure(pybind11::module_& module);      ///< SVG
void add_run(pybind11::module_& module);         ///< run, run_to_file, follow
void add_check(pybind11::module_& module);       ///< check
void add_calibration(pybind11::module_& module); ///< calibrate
void add_diagnosis(pybind11::module_& module);   ///< diagnose
void add_answers(pybind11::module_& module);     ///< compare, risk, past, report

} // namespace stylobate::python
