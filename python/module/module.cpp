#include "python/module/module.hpp"

PYBIND11_MODULE(_core, module)
{
    module.doc() = "The C++ library of Stylobate. Use the package `stylobate`.";
    stylobate::python::add_study(module);
    stylobate::python::add_result(module);
    stylobate::python::add_figure(module);
    stylobate::python::add_run(module);
    stylobate::python::add_check(module);
    stylobate::python::add_calibration(module);
    stylobate::python::add_diagnosis(module);
    stylobate::python::add_answers(module);
}
