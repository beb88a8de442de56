#include "python/module/arrays.hpp"
#include "python/module/module.hpp"
#include "stylobate/stylobate.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace stylobate::python {

namespace {

namespace sb = stylobate::api;
using namespace pybind11::literals;

/// A list of numbers from whatever Python has them in. @param what for the message
std::vector<double> numbers(const py::object& values, const std::string& what)
{
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(values);
    if (!array) {
        PyErr_Clear();
        throw sb::InputError(what + ": these are no numbers; a list of numbers is needed");
    }
    if (array.ndim() != 1) {
        const std::string shape = py::str(array.attr("shape"));
        throw sb::InputError(what + " has the shape " + shape + "; a list of numbers, of shape (n,), is needed");
    }
    return {array.data(), array.data() + array.size()};
}

void add_errors(py::module_& module)
{
    const py::exception<std::runtime_error> error(module, "Error", PyExc_Exception);
    py::register_exception<sb::InputError>(module, "InputError",
                                           py::make_tuple(error, py::reinterpret_borrow<py::object>(PyExc_ValueError)));
    // a full disk, a folder that cannot be written
    // NOLINTNEXTLINE(performance-unnecessary-value-param): the type that pybind11 wants
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown)
                std::rethrow_exception(thrown);
        } catch (const std::system_error& failure) {
            PyErr_SetObject(PyExc_OSError, py::make_tuple(failure.code().value(), failure.what()).ptr());
        }
    });
}

} // namespace

void add_study(py::module_& module)
{
    add_errors(module);
    py::class_<sb::Study>(module, "Study")
        .def_static("from_file", &sb::Study::from_file, "file"_a, "settings"_a = std::vector<std::string>())
        .def_static("from_text", &sb::Study::from_text, "toml"_a, "settings"_a = std::vector<std::string>())
        .def("set", &sb::Study::set, "setting"_a)
        .def("text", &sb::Study::text)
        .def("summary", &sb::Study::summary)
        .def("kind", &sb::Study::kind)
        .def("seed", &sb::Study::seed)
        .def("realizations", &sb::Study::realizations)
        .def("__copy__", [](const sb::Study& study) { return sb::Study(study); });

    attributes(py::class_<sb::Intensity>(module, "Intensity"), "pga_m_s2", &sb::Intensity::pga_m_s2, "pgv_m_s",
               &sb::Intensity::pgv_m_s, "pgd_m", &sb::Intensity::pgd_m, "arias_m_s", &sb::Intensity::arias_m_s,
               "d5_95_s", &sb::Intensity::d5_95_s, "cav_m_s", &sb::Intensity::cav_m_s, "predominant_frequency_hz",
               &sb::Intensity::predominant_frequency_hz, "mean_frequency_hz", &sb::Intensity::mean_frequency_hz);

    py::class_<sb::Record>(module, "Record")
        .def_static(
            "read",
            [](const std::filesystem::path& file, std::optional<std::string> component,
               std::optional<std::string> unit) {
                for (std::optional<std::string>* text : {&component, &unit})
                    if (*text == "") // not given, either
                        text->reset();
                return sb::Record::read(file, component, unit);
            },
            "file"_a, "component"_a = py::none(), "unit"_a = py::none())
        .def_static(
            "from_samples",
            [](const py::object& acceleration, double dt_s, const std::string& name) {
                return sb::Record::from_samples(numbers(acceleration, "acceleration_m_s2"), dt_s, name);
            },
            "acceleration_m_s2"_a, "dt_s"_a, "name"_a = "samples")
        .def_property_readonly(
            "acceleration_m_s2",
            [](const py::object& self) { return view(self, self.cast<const sb::Record&>().acceleration_m_s2()); })
        .def_property_readonly("dt_s", &sb::Record::dt_s)
        .def_property_readonly("duration_s", &sb::Record::duration_s)
        .def_property_readonly("file", &sb::Record::file)
        .def_property_readonly("format", &sb::Record::format)
        .def_property_readonly("component", &sb::Record::component)
        .def_property_readonly("title", &sb::Record::title)
        .def("intensity", &sb::Record::intensity)
        .def(
            "spectral_acceleration_m_s2",
            [](const sb::Record& record, const py::object& periods, double damping_ratio) {
                return copied(record.spectral_acceleration_m_s2(numbers(periods, "periods_s"), damping_ratio));
            },
            "periods_s"_a, "damping_ratio"_a = 0.05);

    py::class_<sb::Experiment>(module, "Experiment")
        .def(py::init<const sb::Study&>(), "study"_a, py::call_guard<py::gil_scoped_release>())
        .def(py::init<const sb::Study&, const sb::Record&>(), "study"_a, "record"_a,
             py::call_guard<py::gil_scoped_release>())
        .def("study", &sb::Experiment::study)
        .def("warnings", &sb::Experiment::warnings);
}

} // namespace stylobate::python
