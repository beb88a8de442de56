#pragma once
/// What the classes of the public headers hold. Here `inner` is the engine's own namespace, whose names are partly the
/// same.

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"
#include "io/records/record.hpp"
#include "studies/check/check_report.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/workflow/calibrate.hpp"
#include "stylobate/stylobate.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::api {

namespace inner = ::stylobate;

struct Study::Data {
    inner::Study study;
    std::optional<std::filesystem::path> file; ///< that it was read from; nullopt: from a text
    std::string source;                        ///< that text
    std::vector<std::string> settings;         ///< of it all
};

struct Record::Data {
    inner::Record record;
    bool from_file = false;
};

struct Experiment::Data {
    inner::LoadedStudy loaded;
    std::string name; ///< of its study in messages
    std::vector<std::string> warnings;

    static Data checked(inner::Experiment experiment, const std::string& name);
};

struct Diagnosis::Data {
    inner::Diagnosis diagnosis;
};

struct Calibration::Data {
    inner::CalibrationEnd end;
    std::filesystem::path measured;
    std::vector<CalibratedForm> forms;

    const inner::Calibration& calibration() const { return end.found; }
};

struct Check::Data {
    inner::CheckReport report;
};

/// The way from a public object to what it holds, and back.
struct Inside {
    template <class T>
    static const auto& of(const T& object)
    {
        return *object.data_;
    }
    template <class T>
    static T make(typename T::Data data)
    {
        return T(std::make_shared<const typename T::Data>(std::move(data)));
    }
    static Result run(const Experiment& experiment, const RunOptions& options);
};

/// Tells the caller of long work each line through `tell`, and polls `go_on`; a stop is permanent.
class Teller : public inner::WorkObserver {
public:
    /// @param options with `tell` and `go_on`
    template <class Options>
    explicit Teller(const Options& options) : tell_(options.tell), go_on_(options.go_on)
    {
    }

    void note(const std::string& line) override
    {
        if (tell_)
            tell_(line);
    }
    void stage(const std::string& line) override { note(line); }
    void progress(const inner::Progress& p) override { note(inner::progress_line(p)); }
    void counted(const char*, const std::string& line, const inner::Progress& p) override
    {
        if (std::exchange(done_, p.done) != p.done)
            note(line);
    }
    bool stop_requested() override
    {
        stopped_ = stopped_ || (go_on_ && !go_on_());
        return stopped_;
    }

private:
    const std::function<void(const std::string&)>& tell_;
    const std::function<bool()>& go_on_;
    std::optional<std::uint64_t> done_;
    bool stopped_ = false;
};

/// Where to compute. @param options with `threads` and `simd`
template <class Options>
inner::Machine machine_of(const Options& options)
{
    return {.threads = options.threads, .simd = options.simd};
}

/// Calls f; the engine's error comes out as the library's.
template <class F>
auto translated(const F& f) -> decltype(f())
{
    try {
        return f();
    } catch (const inner::InputError& error) {
        throw InputError(error.what());
    }
}

} // namespace stylobate::api
