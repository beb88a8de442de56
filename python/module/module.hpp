#pragma once
/// The parts of the module `stylobate._core`. Each adds classes and functions that the Python files in `stylobate/`
/// use.

#include <pybind11/pybind11.h>

namespace stylobate::python {

void add_study(pybind11::module_& module);       ///< Study, Record, and errors
void add_result(pybind11::module_& module);      ///< Result, Surface, Fragility, Trajectory
void add_run(pybind11::module_& module);         ///< run, run_to_file, follow
void add_check(pybind11::module_& module);       ///< check
void add_calibration(pybind11::module_& module); ///< calibrate
void add_diagnosis(pybind11::module_& module);   ///< diagnose

} // namespace stylobate::python
