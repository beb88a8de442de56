#pragma once
/// What the classes of the public headers hold. Here `inner` is the engine's own namespace, whose names are partly the
/// same.

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"
#include "io/records/record.hpp"
#include "studies/calibration/calibration.hpp"
#include "studies/check/check_report.hpp"
#include "studies/diagnosis/findings/diagnosis.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "stylobate/stylobate.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::api {

namespace inner = ::stylobate;

struct Study::Data {
    inner::Study study;
    std::filesystem::path file;        ///< that it was read from; empty: from a text
    std::string source;                ///< that text
    std::vector<std::string> settings; ///< of it all
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
    inner::Calibration calibration;
    inner::Study start;
    std::filesystem::path measured;
    std::vector<CalibratedForm> forms;
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

/// Polls `go_on` of the caller during long work; a stop is permanent.
class Asked : public inner::Observer {
public:
    explicit Asked(const std::function<bool()>& go_on) : go_on_(go_on) {}
    bool stop_requested() override
    {
        stopped_ = stopped_ || (go_on_ && !go_on_());
        return stopped_;
    }

private:
    const std::function<bool()>& go_on_;
    bool stopped_ = false;
};

/// Where and how to run. @param threads, simd as in `RunOptions`
/// @throws inner::InputError if this machine lacks the instruction set
inner::RunOptions run_options(int threads, const std::string& simd);

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
