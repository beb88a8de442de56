/// `stylobate diagnose`: from a measured campaign to a diagnosis.

#include "ensemble/input_error.hpp"
#include "io/atomic_file.hpp"
#include "io/measured_file.hpp"
#include "io/result_seal.hpp"
#include "io/study_file.hpp"
#include "studies/command.hpp"
#include "studies/console.hpp"
#include "studies/diagnosis/calibration.hpp"
#include "studies/diagnosis/diagnosis_file.hpp"
#include "studies/diagnosis/diagnosis_json.hpp"
#include "studies/diagnosis/diagnosis_text.hpp"
#include "studies/diagnosis/pipeline.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace stylobate {

namespace {

/// "crc32 1a2b3c4d" of a file, or of a folder's files.
std::string fingerprint(const std::filesystem::path& path)
{
    std::uint32_t sum = 0;
    const auto add = [&](const std::filesystem::path& file) {
        std::ifstream in(file, std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
        sum = crc32_of(std::as_bytes(std::span(content)), sum);
    };
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path, error))
            if (entry.is_regular_file(error))
                files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const auto& file : files)
            add(file);
    } else {
        add(path);
    }
    return fmt::format("crc32 {:08x}", sum);
}

} // namespace

int diagnose_command(const CommonOptions& options, const std::string& measured, const std::string& study_file,
                     std::string output, long long nulls, long long seed, bool windows)
{
    const Campaign campaign = read_campaign(measured);
    const Study study = study_file.empty() ? default_study(campaign) : read_study(study_file, options.set);
    if (output.empty())
        output = std::filesystem::path(measured).stem().string() + "_diagnosis.h5";
    std::error_code error;
    if (std::filesystem::is_directory(output, error))
        throw InputError(output, 0, "is a folder.\n  Give the name of a file for the diagnosis.");
    const std::filesystem::path beside = std::filesystem::path(output).parent_path();
    const std::string stem = std::filesystem::path(output).stem().string();

    DiagnosisOptions how;
    how.seed = static_cast<std::uint64_t>(seed);
    how.nulls = static_cast<std::uint64_t>(nulls);
    how.windows = windows;
    how.cache = beside / (stem + "_chance.txt");
    how.extension = beside / (stem + "_extended.toml");
    how.run = {options.isa(), options.thread_count()};
    Console console(options.quiet);
    const auto tell = [&](const std::string& line) {
        if (!options.quiet)
            fmt::print(stderr, "{}\n", line);
    };
    class Quiet : public Observer {
    public:
        explicit Quiet(Console& console) : console_(console) {}
        bool stop_requested() override { return console_.stop_requested(); }

    private:
        Console& console_;
    } observer(console);
    std::optional<Diagnosis> diagnosis = diagnose(campaign, study, how, tell, observer);
    if (!diagnosis) {
        tell("Interrupted. The same command goes on: what chance gives is kept in " + how.cache.string() + ".");
        return exit_interrupted;
    }
    diagnosis->measured_fingerprint = fingerprint(measured);
    diagnosis->command = fmt::format("stylobate diagnose {}{} -o {} --nulls {} --seed {}{}", measured,
                                     study_file.empty() ? "" : " --study " + study_file, output, nulls, seed,
                                     windows ? " --windows" : "");
    if (!diagnosis->extended_study.empty()) {
        AtomicFile file(how.extension);
        file.write(diagnosis->extended_study);
        file.commit();
        diagnosis->extended_study_file = how.extension.string();
    }
    write_diagnosis(*diagnosis, output);
    if (options.json)
        fmt::print("{}\n", diagnosis_json(*diagnosis).text());
    else
        fmt::print("{}", diagnosis_text(*diagnosis));
    tell(fmt::format("Diagnosis: {}. A page of it: stylobate report {}", output, output));
    return exit_done;
}

} // namespace stylobate
