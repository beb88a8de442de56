#pragma once
/// Work in a thread of its own, while Python goes on.

#include <pybind11/pybind11.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace stylobate::python {

/// Runs work(tell) without the GIL and returns what it returns. Twenty times a second at least the calling thread,
/// which may be Python's main one, handles signals: Ctrl-C raises KeyboardInterrupt here. (The threads of the work
/// could not: Python handles signals in its main thread only.)
///
/// @param listen called with the GIL, in the calling thread, with the newest that tell(news) was given; false: stop
/// @param work   tell(news) returns false once it is to stop; without news it only asks
template <class News, class Answer>
Answer interruptible(const std::function<Answer(const std::function<bool(const std::optional<News>&)>&)>& work,
                     const std::function<bool(const News&)>& listen)
{
    namespace py = pybind11;
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<News> newest;
    std::optional<Answer> answer;
    bool stop = false, ended = false;
    std::exception_ptr of_work, of_python;

    std::thread worker([&] {
        try {
            answer.emplace(work([&](const std::optional<News>& news) {
                const std::lock_guard lock(mutex);
                if (news) {
                    newest = news;
                    changed.notify_one();
                }
                return !stop;
            }));
        } catch (...) {
            of_work = std::current_exception();
        }
        const std::lock_guard lock(mutex);
        ended = true;
        changed.notify_one();
    });
    {
        const py::gil_scoped_release released;
        std::unique_lock lock(mutex);
        for (bool last = false; !last;) {
            changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return ended || newest.has_value(); });
            last = ended;
            const std::optional<News> news = std::exchange(newest, std::nullopt);
            if (stop)
                continue;
            lock.unlock();
            bool go_on = true;
            {
                const py::gil_scoped_acquire acquired;
                try {
                    if (PyErr_CheckSignals() != 0)
                        throw py::error_already_set();
                    go_on = !news || !listen || listen(*news);
                } catch (...) {
                    of_python = std::current_exception();
                    go_on = false;
                }
            }
            lock.lock();
            stop = !go_on;
        }
    }
    worker.join();
    if (of_python)
        std::rethrow_exception(of_python);
    if (of_work)
        std::rethrow_exception(of_work);
    return std::move(*answer);
}

/// Runs work that tells lines of text, of which none is lost, as `interruptible` does.
/// @param progress None, or a Python function that is called with each line; only False stops
/// @param options  whose `tell` and `go_on` are set here
/// @param work     of (options)
template <class Answer, class Options, class Work>
Answer interruptible_lines(Options options, const pybind11::object& progress, const Work& work)
{
    std::mutex mutex;
    std::vector<std::string> lines;
    struct NewLines {};
    std::function<bool(const NewLines&)> listen;
    if (!progress.is_none())
        listen = [&](const NewLines&) {
            std::vector<std::string> told;
            {
                const std::lock_guard lock(mutex);
                told.swap(lines);
            }
            return std::ranges::none_of(
                told, [&](const std::string& line) { return progress(line).is(pybind11::bool_(false)); });
        };
    using Tell = std::function<bool(const std::optional<NewLines>&)>;
    return interruptible<NewLines, Answer>(
        [&](const Tell& tell) {
            options.tell = [&](const std::string& line) {
                {
                    const std::lock_guard lock(mutex);
                    lines.push_back(line);
                }
                tell(NewLines());
            };
            options.go_on = [&] { return tell(std::nullopt); };
            return work(options);
        },
        listen);
}

/// Adds a function of the library, whose last argument are options with `tell` and `go_on`, as one that works in a
/// thread of its own: NAME(given..., options, progress).
template <class Options, class... Given, class Function>
void add_told(pybind11::module_& module, const char* name, const Function& function)
{
    module.def(name, [function](const Given&... given, const Options& options, const pybind11::object& progress) {
        return interruptible_lines<std::invoke_result_t<Function, const Given&..., const Options&>>(
            options, progress, [&](const Options& told) { return function(given..., told); });
    });
}

} // namespace stylobate::python
