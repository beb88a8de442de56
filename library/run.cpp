#include "stylobate/run.hpp"

#include "io/files/temporary_folder.hpp"
#include "library/inside.hpp"
#include "library/machine.hpp"
#include "library/results.hpp"
#include "library/run_study.hpp"
#include "studies/app/command.hpp"

namespace stylobate::api {

namespace {

/// Tells the caller of a run, who may stop it.
class Teller : public inner::Observer {
public:
    explicit Teller(const std::function<bool(const Progress&)>& tell) : tell_(tell) {}

    void progress(const inner::Progress& p) override
    {
        if (!tell_ || stopped_)
            return;
        stopped_ =
            !tell_({p.done, p.total, p.collapsed, p.invalid, p.seconds, p.rate, p.share, p.share_lower, p.share_upper});
    }
    bool stop_requested() override { return stopped_; }

private:
    const std::function<bool(const Progress&)>& tell_;
    bool stopped_ = false;
};

/// @param name of the results in messages
Result run_into(const Experiment& experiment, const std::string& file, const std::string& name,
                const RunOptions& options)
{
    Teller teller(options.progress);
    run_study(Inside::of(experiment).loaded, run_options(options.threads, options.simd), file, "study", teller);
    return Inside::make<Result>({inner::ResultReader(file), name});
}

} // namespace

inner::RunOptions run_options(int threads, const std::string& simd)
{
    inner::CommonOptions options;
    options.threads = threads;
    options.simd = simd;
    return options.run_options();
}

Result run(const Experiment& experiment, const RunOptions& options)
{
    return translated([&] {
        const inner::TemporaryFolder folder;
        return run_into(experiment, folder / "results.h5", "the result", options);
    });
}

Result run_to_file(const Experiment& experiment, const std::filesystem::path& file, const RunOptions& options)
{
    return translated([&] { return run_into(experiment, file.string(), file.string(), options); });
}

} // namespace stylobate::api
