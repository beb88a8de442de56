#include "ensemble/model/input_error.hpp"
#include "io/files/file_handle.hpp"
#include "io/files/hdf5.hpp"
#include "io/files/suggest.hpp"
#include "io/measured/measured_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace stylobate {
namespace {

class Reader {
public:
    explicit Reader(Campaign& campaign) : campaign_(campaign) {}

    void read(hid_t file)
    {
        check_format(file);
        known_only(file, "", since_2({"specimen", "runs"}, {"laboratory"}));
        Specimen& specimen = campaign_.specimen;
        specimen.name = text(file, "specimen").value_or("");
        specimen.gravity_m_s2 = number(file, "gravity_m_s2").value_or(specimen.gravity_m_s2);
        if (hdf5::exists(file, "specimen"))
            read_specimen(hdf5::open_group(file, "specimen").id());
        if (version_ >= 2 && hdf5::exists(file, "laboratory"))
            read_laboratory(hdf5::open_group(file, "laboratory").id());
        if (!hdf5::exists(file, "runs"))
            return;
        const hdf5::Handle runs = hdf5::open_group(file, "runs");
        for (const std::string& name : hdf5::names_in(runs.id())) {
            place_ = "runs/" + name;
            const hdf5::Handle group = hdf5::open_group(runs.id(), name);
            if (const auto kind = kind_of(group.id(), name))
                campaign_.runs.push_back(read_run(group.id(), name, *kind));
        }
    }

private:
    [[noreturn]] void refuse(const std::string& text) const { throw InputError(campaign_.source, 0, text); }
    void tell(const std::string& where, const std::string& text)
    {
        campaign_.findings.push_back({Severity::note, where, text});
    }
    std::string at(const std::string& name) const { return place_.empty() ? name : place_ + "/" + name; }

    std::optional<double> number(hid_t object, const char* name) const
    {
        if (!hdf5::has_attribute(object, name))
            return std::nullopt;
        const double value = hdf5::read_any_number(object, name);
        if (!std::isfinite(value))
            refuse(fmt::format("{} = {} is not a number.\n  Write a number, or omit the attribute.", at(name), value));
        return value;
    }
    std::optional<std::string> text(hid_t object, const char* name) const
    {
        if (!hdf5::has_attribute(object, name))
            return std::nullopt;
        return hdf5::read_any_text(object, name);
    }

    /// In version 1 only the first names are known.
    std::vector<std::string> since_2(std::vector<std::string> names, const std::vector<std::string>& more) const
    {
        if (version_ >= 2)
            names.insert(names.end(), more.begin(), more.end());
        return names;
    }

    void check_format(hid_t file)
    {
        const std::string format = text(file, "format").value_or("");
        if (format == "stylobate")
            refuse("contains results, not measured data.\n  Give measured data; 'stylobate info' prints the content of "
                   "a file.");
        if (format != measured_format)
            refuse(fmt::format(
                "is not a file of measured data: its attribute format is \"{}\", not \"{}\".\n  io/FORMAT.md has "
                "the layout.",
                format, measured_format));
        const double version = number(file, "format_version").value_or(0);
        if (version != 1 && version != measured_version)
            refuse(fmt::format("has format_version {}; this program reads 1 and {}.", version, measured_version));
        version_ = static_cast<int>(version);
    }

    /// Unknown items are reported, so that a misspelt data set is not silently absent.
    void known_only(hid_t group, const std::string& path, const std::vector<std::string>& known)
    {
        for (const std::string& name : hdf5::names_in(group))
            if (std::find(known.begin(), known.end(), name) == known.end()) {
                const auto meant = nearest_word(name, known);
                tell(at(path + name), "is unknown and ignored." + (meant ? " Did you mean " + *meant + "?" : ""));
            }
    }

    /// A data set in SI, by its attribute `unit`; without one it is SI already.
    /// @param factor receives what one of its units is
    hdf5::Numbers quantity(hid_t group, const std::string& path, Dimension dimension, double& factor)
    {
        hdf5::Numbers numbers = hdf5::read_numbers(group, path);
        const hdf5::Handle object = hdf5::open_object(group, path);
        factor = 1;
        if (const auto unit = text(object.id(), "unit")) {
            const auto si = unit_in_si(*unit, dimension);
            if (!si)
                refuse(fmt::format("{}: its unit \"{}\" is not known.\n  Known ones: {}.", at(path), *unit,
                                   known_units(dimension)));
            factor = *si;
        }
        if (factor != 1) {
            for (double& value : numbers.values)
                value *= factor;
            tell(at(path), fmt::format("was converted from {} to SI.", *text(object.id(), "unit")));
        }
        for (const double value : numbers.values)
            if (std::isinf(value))
                refuse(fmt::format("{} has an infinite value.\n  Write NaN where nothing was measured.", at(path)));
        return numbers;
    }

    std::vector<int> whole_numbers(hid_t group, const std::string& path)
    {
        std::vector<int> whole;
        if (hdf5::exists(group, path))
            for (const double value : hdf5::read_numbers(group, path).values)
                whole.push_back(whole_number(campaign_, at(path), value));
        return whole;
    }

    std::vector<double> list(hid_t group, const std::string& path, Dimension dimension)
    {
        double factor = 1;
        hdf5::Numbers numbers = quantity(group, path, dimension, factor);
        if (numbers.dims.size() != 1)
            refuse(fmt::format("{} has {} dimensions; it should be a list.", at(path), numbers.dims.size()));
        return std::move(numbers.values);
    }

    void read_specimen(hid_t group)
    {
        place_ = "specimen";
        Specimen& specimen = campaign_.specimen;
        std::vector<std::string> known = {"joints"};
        for (const SpecimenList& names : specimen_lists()) {
            if (names.since() > version_)
                continue;
            known.emplace_back(names.name);
            if (hdf5::exists(group, names.name))
                specimen.*names.member = list(group, names.name, names.dimension);
        }
        known_only(group, "", known);
        for (const SpecimenNumber& names : specimen_numbers())
            specimen.*names.member = number(group, names.name).value_or(specimen.*names.member);
        specimen.friction_nominal = number(group, "friction_nominal");
        specimen.base_block_half_width_m = number(group, "base_block_half_width_m");
        if (!hdf5::exists(group, "joints"))
            return;
        const hdf5::Numbers joints = hdf5::read_numbers(group, "joints");
        if (joints.dims.size() != 2 || joints.dims[1] != 2)
            refuse("specimen/joints should have a row for each joint and two columns: lower block, upper block.");
        for (std::size_t j = 0; 2 * j + 1 < joints.values.size(); ++j)
            specimen.joints.emplace_back(whole_number(campaign_, "specimen/joints", joints.values[2 * j]),
                                         whole_number(campaign_, "specimen/joints", joints.values[2 * j + 1]));
    }

    void read_laboratory(hid_t group)
    {
        place_ = "laboratory";
        known_only(group, "", {});
        Laboratory& laboratory = campaign_.laboratory;
        for (const LaboratoryNumber& names : laboratory_numbers())
            laboratory.*names.member = number(group, names.name);
        if (const auto may = number(group, "may_dismantle"))
            laboratory.may_dismantle = *may != 0;
        for (const RunKind kind : run_kinds)
            if (const auto cost = number(group, cost_key(kind).c_str()))
                laboratory.cost.emplace_back(kind, *cost);
    }

    /// Nothing: the run is left out. In version 1 `kind` is that of the motion.
    std::optional<RunKind> kind_of(hid_t group, const std::string& name)
    {
        return version_ < 2 ? RunKind::shake : known_run_kind(campaign_, name, text(group, "kind"));
    }

    MeasuredRun read_run(hid_t group, const std::string& name, RunKind kind)
    {
        MeasuredRun run;
        run.name = name;
        run.test = kind;
        known_only(group, "", since_2({"time_s", "base", "blocks"}, {"clamped", "taped", "dummies", "force"}));
        const auto whole = [&](const char* key) -> std::optional<int> {
            const auto value = number(group, key);
            return value ? std::optional(whole_number(campaign_, at(key), *value)) : std::nullopt;
        };
        run.motion_id = whole("motion_id").value_or(0);
        run.repeat = whole("repeat").value_or(0);
        run.kind = text(group, version_ < 2 ? "kind" : "motion");
        if (version_ < 2)
            report_old_kind(campaign_, run);
        run.rate_hz = number(group, "rate_hz").value_or(0);
        run.run_order = whole("run_order");
        if (const auto collapsed = number(group, "collapsed"))
            run.collapsed = *collapsed != 0;
        run.collapse_time_s = number(group, "collapse_time_s").value_or(-1);
        if (hdf5::exists(group, "time_s"))
            run.time_s = list(group, "time_s", Dimension::time);
        for (const char* part : {"base", "blocks"})
            if (hdf5::exists(group, part)) {
                std::vector<std::string> known;
                if (version_ >= 2 && std::string(part) == "blocks")
                    known.emplace_back("present");
                const auto of_part = [&](const SeriesName& series) {
                    return series.since <= version_ && std::string(series.path).starts_with(std::string(part) + "/");
                };
                for (const SeriesName& series : series_names())
                    if (const std::string path = series.path; of_part(series))
                        known.push_back(path.substr(path.find('/') + 1));
                known_only(hdf5::open_group(group, part).id(), std::string(part) + "/", known);
                for (const SeriesName& series : series_names())
                    if (of_part(series) && hdf5::exists(group, series.path))
                        read_series(group, series, run);
            }
        if (version_ >= 2)
            read_test(group, run);
        return run;
    }

    void read_test(hid_t group, MeasuredRun& run)
    {
        if (const auto joint = number(group, "joint"))
            run.joint = whole_number(campaign_, at("joint"), *joint);
        run.released_s = number(group, "released_s");
        if (hdf5::exists(group, "blocks"))
            run.present = whole_numbers(group, "blocks/present");
        run.clamped = whole_numbers(group, "clamped");
        if (hdf5::exists(group, "taped"))
            read_taped(group, run);
        if (hdf5::exists(group, "dummies"))
            read_dummies(group, run);
        if (hdf5::exists(group, "force"))
            for (const std::string& name : hdf5::names_in(hdf5::open_group(group, "force").id()))
                read_gauge(group, name, run);
    }

    /// A row for each group; -1 fills it up.
    void read_taped(hid_t group, MeasuredRun& run)
    {
        const hdf5::Numbers table = hdf5::read_numbers(group, "taped");
        if (table.dims.size() != 2)
            refuse(fmt::format("{} has {} dimensions; it should have a row for each group, filled up with -1.",
                               at("taped"), table.dims.size()));
        const std::size_t width = table.dims[1];
        for (std::size_t row = 0; width > 0 && row < table.dims[0]; ++row) {
            std::vector<int> blocks;
            for (std::size_t c = 0; c < width; ++c)
                if (const double block = table.values[row * width + c]; block != -1)
                    blocks.push_back(whole_number(campaign_, at("taped"), block));
            run.taped.push_back(std::move(blocks));
        }
    }

    /// A list for each of their numbers.
    void read_dummies(hid_t group, MeasuredRun& run)
    {
        std::vector<std::string> known = {"block"};
        for (const DummyNumber& names : dummy_numbers())
            known.emplace_back(names.name);
        known_only(hdf5::open_group(group, "dummies").id(), "dummies/", known);
        for (const int block : whole_numbers(group, "dummies/block"))
            run.dummies.push_back({.block = block});
        for (const DummyNumber& names : dummy_numbers()) {
            const std::string path = std::string("dummies/") + names.name;
            std::vector<double> values(run.dummies.size(), 0);
            if (hdf5::exists(group, path))
                values = list(group, path, names.dimension());
            else if (names.needed)
                refuse(fmt::format(
                    "{} is absent.\n  Give block, mass_kg, half_width_m and half_height_m of each dummy.", at(path)));
            if (values.size() != run.dummies.size())
                refuse(fmt::format("{} has {} values where dummies/block has {}.\n  One value for each dummy.",
                                   at(path), values.size(), run.dummies.size()));
            for (std::size_t i = 0; i < values.size(); ++i)
                run.dummies[i].*names.member = values[i];
        }
    }

    void read_gauge(hid_t run_group, const std::string& name, MeasuredRun& run)
    {
        const std::string path = "force/" + name, data = path + "/value_n";
        const hdf5::Handle group = hdf5::open_group(run_group, path);
        known_only(group.id(), path + "/", {"value_n"});
        ForceGauge gauge;
        gauge.name = name;
        const auto block = number(group.id(), "block");
        if (!block)
            refuse(fmt::format("{} has no attribute block.\n  Name the block on which the force acts.", at(path)));
        gauge.block = whole_number(campaign_, at(path + "/block"), *block);
        for (const GaugeNumber& names : gauge_numbers()) {
            const auto value = number(group.id(), names.name);
            if (!value && names.needed)
                refuse(fmt::format("{} has no attribute {}.\n  Give the height of its point above the block's lower "
                                   "face, in metres.",
                                   at(path), names.name));
            gauge.*names.member = value.value_or(gauge.*names.member);
        }
        gauge.to_laboratory = end_in_laboratory(campaign_, at(path + "/to"), text(group.id(), "to"), run.test);
        if (hdf5::exists(group.id(), "value_n")) {
            double factor = 1;
            hdf5::Numbers numbers = quantity(run_group, data, Dimension::force, factor);
            if (numbers.dims.size() != 1)
                refuse(
                    fmt::format("{} has {} dimensions; it should be a list of times.", at(data), numbers.dims.size()));
            gauge.value_n.values = std::move(numbers.values);
            if (const auto noise = number(hdf5::open_object(run_group, data).id(), "noise_sd"))
                gauge.value_n.noise_sd = *noise * factor;
        }
        run.forces.push_back(std::move(gauge));
    }

    void read_series(hid_t group, const SeriesName& name, MeasuredRun& run)
    {
        double factor = 1;
        hdf5::Numbers numbers = quantity(group, name.path, name.dimension, factor);
        const std::size_t rank = name.per_block ? 2 : 1;
        // of a single block a list is as good
        if (numbers.dims.size() != rank && !(rank == 2 && numbers.dims.size() == 1 && block_count(campaign_) == 1))
            refuse(fmt::format("{} has {} dimensions; it should be {}.", at(name.path), numbers.dims.size(),
                               name.per_block ? "times x blocks" : "a list of times"));
        const std::size_t blocks = block_count(campaign_);
        if (numbers.dims.size() == 2 && blocks > 0 && numbers.dims[1] != blocks)
            refuse(fmt::format("{} is {} x {} where there are {} blocks.\n  {}", at(name.path), numbers.dims[0],
                               numbers.dims[1], blocks,
                               numbers.dims[0] == blocks ? "It looks transposed: one row for each time."
                                                         : "One column for each block."));
        if (!run.time_s.empty() && numbers.dims[0] != run.time_s.size())
            refuse(fmt::format("{} has {} rows where time_s has {} times.\n  One row for each time.", at(name.path),
                               numbers.dims[0], run.time_s.size()));
        Series& series = name.of(run);
        series.values = std::move(numbers.values);
        const hdf5::Handle object = hdf5::open_object(group, name.path);
        if (const auto noise = number(object.id(), "noise_sd"))
            series.noise_sd = *noise * factor;
        if (std::string(name.path).starts_with("base/") && name.dimension != Dimension::angle) {
            if (const auto source = text(object.id(), "source"))
                take_source(base_source(campaign_, at(name.path) + "/source", *source), run);
            if (const auto clock = text(object.id(), "clock"); clock && !run.base_clock)
                run.base_clock = clock;
        }
    }

    void take_source(BaseSource source, MeasuredRun& run)
    {
        if (run.base_source == BaseSource::command && source != BaseSource::command)
            tell(at("base"), "is partly a command and partly measured: all of it is treated as a command.");
        if (source == BaseSource::command)
            run.base_source = source;
    }

    Campaign& campaign_;
    int version_ = measured_version; ///< of the file
    std::string place_;              ///< group that is being read
};

} // namespace

Campaign read_measured_hdf5_here(const std::filesystem::path& path)
{
    Campaign campaign;
    campaign.source = path.string();
    try {
        const hdf5::Handle file = hdf5::open_file(path, false);
        Reader(campaign).read(file.id());
        keep_tests_apart(campaign);
    } catch (const hdf5::Error& error) {
        throw InputError(campaign.source, 0,
                         fmt::format("cannot be read as measured data: {}.\n  io/FORMAT.md has the layout; a folder of "
                                     "CSV files with campaign.toml is read too.",
                                     error.what()));
    }
    return campaign;
}

namespace {

/// In the child process of `try_in_child`: reads the file, and writes to `out` why it is refused.
[[noreturn]] void read_and_exit(const std::filesystem::path& path, std::uint64_t size, int out)
{
    for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU})
        std::signal(fatal, SIG_DFL);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    constexpr std::uint64_t patience_s = 2, slowest_bytes_per_s = 5'000'000;
    const rlimit seconds{patience_s + size / slowest_bytes_per_s, RLIM_INFINITY};
    ::setrlimit(RLIMIT_CPU, &seconds);
    if (const int silent = ::open("/dev/null", O_WRONLY); silent >= 0)
        ::dup2(silent, STDERR_FILENO);
    try {
        read_measured_hdf5_here(path);
    } catch (const InputError& error) {
        const std::string message = error.what();
        ::_exit(::write(out, message.data(), message.size()) < 0 ? 1 : 0);
    } catch (...) {
        ::_exit(1);
    }
    ::_exit(0);
}

/// The HDF5 library breaks on some damaged files, or never comes back from them, and measured data have no seal that
/// would tell (`result_seal.hpp`). So a child process reads the file first.
/// @throws InputError if the file is refused, or if the child did not live
void try_in_child(const std::filesystem::path& path, std::uint64_t size)
{
    int pipe[2] = {};
    if (::pipe2(pipe, O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
    const pid_t child = ::fork();
    if (child == 0)
        read_and_exit(path, size, pipe[1]);
    ::close(pipe[1]);
    std::string refusal;
    char part[4096];
    for (ssize_t n = 0; child > 0 && ((n = ::read(pipe[0], part, sizeof part)) > 0 || (n < 0 && errno == EINTR));)
        refusal.append(part, static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    ::close(pipe[0]);
    if (child < 0)
        throw std::system_error(errno, std::generic_category(), "cannot start a process to test the file");
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!refusal.empty())
        throw InputError(refusal);
    if (status != 0)
        throw InputError(path.string(), 0,
                         "is damaged: the HDF5 library crashes on it.\n  Use another copy of the file.");
}

} // namespace

Campaign read_measured_hdf5(const std::filesystem::path& path)
{
    try_in_child(path, FileHandle::open(path, false).size());
    return read_measured_hdf5_here(path);
}

} // namespace stylobate
