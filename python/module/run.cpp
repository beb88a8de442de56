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

using Tell = std::function<bool(const std::optional<sb::Progress>&)>;

/// What the caller's function makes of the progress; only False stops.
std::function<bool(const sb::Progress&)> listener(const py::object& progress)
{
    if (progress.is_none())
        return {};
    return [progress](const sb::Progress& news) { return !progress(news).is(py::bool_(false)); };
}

sb::Result run(const sb::Experiment& experiment, const std::optional<std::filesystem::path>& output, int threads,
               const std::string& simd, const py::object& progress)
{
    return interruptible<sb::Progress, sb::Result>(
        [&](const Tell& tell) {
            const sb::RunOptions options{threads, simd, [&](const sb::Progress& news) { return tell(news); }};
            return output ? sb::run_to_file(experiment, *output, options) : sb::run(experiment, options);
        },
        listener(progress));
}

sb::Trajectory replay(const sb::Result& result, std::uint64_t index, const std::vector<std::string>& settings)
{
    return interruptible<sb::Progress, sb::Trajectory>(
        [&](const Tell& tell) { return sb::replay(result, index, settings, [&] { return tell(std::nullopt); }); }, {});
}

} // namespace

void add_run(py::module_& module)
{
    using P = sb::Progress;
    attributes(py::class_<P>(module, "Progress"), "done", &P::done, "total", &P::total, "collapsed", &P::collapsed,
               "invalid", &P::invalid, "seconds", &P::seconds, "realizations_per_second", &P::realizations_per_second,
               "probability", &P::probability, "lower", &P::lower, "upper", &P::upper)
        .def("__repr__", [](const P& p) {
            return "<Progress: " + std::to_string(p.done) + " of " + std::to_string(p.total) + " realizations>";
        });
    module.def("run", &run, "experiment"_a, "output"_a, "threads"_a, "simd"_a, "progress"_a);
    module.def("replay", &replay, "result"_a, "index"_a, "settings"_a = std::vector<std::string>());
}

} // namespace stylobate::python
