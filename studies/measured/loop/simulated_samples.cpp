#include "studies/measured/loop/simulated_samples.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/measured/diagnosis/campaigns/number_rows.hpp"
#include "studies/measured/joint_tests/procedures.hpp"
#include "studies/measured/joint_tests/simulated_test.hpp"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace stylobate {

namespace {

constexpr double missing_estimate = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t samples_together = 32;                    ///< specimens whose runs are in memory at once
constexpr double bearing_noise_m = 1e-4, centre_noise_m = 1e-4; // of callipers and scales

/// Whether two joints bear the same body on the same face: what a cause does at one of them it does at the other.
bool same_bodies(const Specimen& s, int joint, int other)
{
    const auto face = [&](int block) { // below: the block, or what stands for the table
        return block >= 0 ? s.half_width_m[static_cast<std::size_t>(block)]
                          : s.base_block_half_width_m.value_or(std::numeric_limits<double>::infinity());
    };
    const auto [lower, upper] = s.joints[static_cast<std::size_t>(joint)];
    const auto [other_lower, other_upper] = s.joints[static_cast<std::size_t>(other)];
    const auto a = static_cast<std::size_t>(upper), b = static_cast<std::size_t>(other_upper);
    return face(lower) == face(other_lower) && s.half_width_m[a] == s.half_width_m[b] &&
           s.half_height_m[a] == s.half_height_m[b] && s.mass_kg[a] == s.mass_kg[b];
}

/// A specimen that is simulated: a healthy one, or one of a cause.
struct SampleSubject {
    int cause = -1;           ///< -1: healthy
    std::uint64_t number = 0; ///< of its law and scatter
};

/// Rows of one test: the estimates of each specimen that went through it.
class SampleTable {
public:
    SampleTable(const Specimen& specimen, const std::vector<PlannedTest>& tests, const std::vector<LoopCause>& causes,
                const SamplePlan& plan)
    {
        for (const PlannedTest& test : tests) {
            first_.push_back(columns.size());
            for (const EstimatorName& estimator : estimator_names(test.kind))
                columns.push_back({test.kind, test.joint, estimator.name, estimator.unit, estimator.depends_on, 0,
                                   estimator.of_the_law});
        }
        first_.push_back(columns.size());
        for (std::uint64_t i = 0; i < plan.healthy; ++i)
            subjects.push_back({-1, i});
        for (std::size_t c = 0; c < causes.size(); ++c) {
            twin_.push_back(twin_of(specimen, causes, c));
            for (std::uint64_t i = 0; i < plan.of_each_cause; ++i)
                subjects.push_back({static_cast<int>(c), i});
        }
        const auto simulated = [&](const SampleSubject& subject, int joint) {
            if (subject.cause < 0)
                return true;
            const auto c = static_cast<std::size_t>(subject.cause);
            return twin_[c] == c && causes[c].acts_at(joint);
        };
        for (std::size_t t = 0; t < tests.size(); ++t)
            for (std::size_t s = 0; s < subjects.size(); ++s)
                if (simulated(subjects[s], tests[t].joint))
                    wanted.push_back({t, s});
        values.assign(subjects.size() * columns.size(), missing_estimate);
        floors_.resize(columns.size());
        errors_.resize(columns.size());
    }

    /// Values of a test's columns, then their floors, then their errors.
    std::vector<double> row_of(std::size_t test, const std::vector<Estimate>& estimates) const
    {
        const std::size_t n = width(test);
        std::vector<double> row(3 * n, missing_estimate);
        for (const Estimate& e : estimates)
            for (std::size_t k = 0; k < n; ++k)
                if (columns[first_[test] + k].name == e.name && columns[first_[test] + k].joint == e.joint) {
                    row[k] = e.value;
                    row[n + k] = e.floor_sd;
                    row[2 * n + k] = e.sd;
                }
        return row;
    }
    void put(std::size_t test, std::size_t subject, const std::vector<double>& row)
    {
        for (std::size_t k = 0; k < width(test); ++k) {
            values[subject * columns.size() + first_[test] + k] = row[k];
            if (subjects[subject].cause < 0 && std::isfinite(row[k])) {
                floors_[first_[test] + k].push_back(row[width(test) + k]);
                errors_[first_[test] + k].push_back(row[2 * width(test) + k]);
            }
        }
    }
    std::size_t width(std::size_t test) const { return first_[test + 1] - first_[test]; }

    /// Of a specimen with a cause the tests at joints where it does not act are those of the healthy specimen of the
    /// same law. A cause of a joint is simulated at the first joint of those that bear the same body: what it changes
    /// there it changes at each of them.
    TestSamples samples(const std::vector<LoopCause>& causes, const SamplePlan& plan) const
    {
        TestSamples out;
        out.columns = columns;
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (!floors_[k].empty()) {
                out.columns[k].floor_sd = upper_median(floors_[k]);
                out.columns[k].own_sd = upper_median(errors_[k]);
            }
        const auto p = static_cast<Eigen::Index>(columns.size()), n = static_cast<Eigen::Index>(plan.healthy);
        const auto row = [&](std::size_t subject) {
            return Eigen::Map<const Eigen::RowVectorXd>(values.data() + subject * columns.size(), p);
        };
        out.healthy.resize(n, p);
        for (Eigen::Index i = 0; i < n; ++i)
            out.healthy.row(i) = row(static_cast<std::size_t>(i));
        for (std::size_t c = 0; c < causes.size(); ++c) {
            CauseSamples& of = out.causes.emplace_back();
            of.cause = causes[c].named;
            of.rows = out.healthy.topRows(static_cast<Eigen::Index>(plan.of_each_cause));
            for (Eigen::Index k = 0; k < p; ++k) {
                const TestColumn& column = columns[static_cast<std::size_t>(k)];
                if (!causes[c].acts_at(column.joint))
                    continue;
                const Eigen::Index from = twin_[c] == c ? k : column_at(column, causes[twin_[c]].joint);
                for (Eigen::Index i = 0; i < of.rows.rows(); ++i)
                    of.rows(i, k) +=
                        row(plan.healthy + twin_[c] * plan.of_each_cause + static_cast<std::size_t>(i))(from) -
                        out.healthy(i, from);
            }
            for (std::uint64_t i = 0; i < plan.of_each_cause; ++i)
                of.pairs.push_back(static_cast<int>(i));
        }
        return out;
    }

    std::vector<TestColumn> columns;
    std::vector<SampleSubject> subjects;
    std::vector<std::pair<std::size_t, std::size_t>> wanted; ///< test, subject
    std::vector<double> values;                              ///< (subjects x columns)

private:
    /// The first cause of the same kind and size at a joint with the same bodies: it is simulated in the place of c.
    static std::size_t twin_of(const Specimen& specimen, const std::vector<LoopCause>& causes, std::size_t c)
    {
        const LoopCause& cause = causes[c];
        for (std::size_t other = 0; other < c; ++other)
            if (const LoopCause& o = causes[other];
                cause.joint >= 0 && o.joint >= 0 && o.named.mechanism == cause.named.mechanism &&
                o.named.form == cause.named.form && o.named.size == cause.named.size &&
                same_bodies(specimen, o.joint, cause.joint))
                return other;
        return c;
    }
    Eigen::Index column_at(const TestColumn& like, int joint) const
    {
        const auto at = std::find_if(columns.begin(), columns.end(), [&](const TestColumn& column) {
            return column.name == like.name && column.joint == joint;
        });
        return at - columns.begin();
    }

    std::vector<std::size_t> twin_;                    ///< (causes)
    std::vector<std::vector<double>> floors_, errors_; ///< (columns) of healthy specimens
    std::vector<std::size_t> first_;                   ///< (tests + 1) columns
};

constexpr std::string_view samples_head = "# stylobate simulated tests ";

/// What a file of rows is of.
std::string samples_key(const Specimen& specimen, const Study& about, const std::vector<PlannedTest>& tests,
                        const std::vector<LoopCause>& causes, const SamplePlan& plan)
{
    Campaign all;
    all.specimen = specimen;
    for (const PlannedTest& test : tests)
        all.runs.insert(all.runs.end(), test.runs.begin(), test.runs.end());
    std::string key = std::string(samples_head) + campaign_key(all, about, plan.seed) +
                      fmt::format(" {} {} floor {:g} {:g} {:g} {:g}", plan.healthy, plan.of_each_cause,
                                  plan.floor.friction, plan.floor.geometry_m, plan.floor.force, plan.floor.damping);
    for (const PlannedTest& test : tests) {
        key += fmt::format(" {} {}", to_string(test.kind), test.joint);
        for (const MeasuredRun& run : test.runs) {
            key += fmt::format(" {}", run.dummies.size());
            for (const ForceGauge& gauge : run.forces)
                key += fmt::format(" {:g} {:g} {:g}", gauge.height_m, gauge.speed_m_s, gauge.stiffness_n_m);
            double tilt = 0;
            for (const double value : run.base_tilt_rad.values)
                tilt = std::max(tilt, std::fabs(value));
            key += fmt::format(" {:g}", tilt);
        }
    }
    for (const LoopCause& cause : causes)
        key += fmt::format(" {} {:g} {:g} {:g}", cause.cause.cause.label(), cause.cause.size, cause.least_fixed,
                           cause.most_fixed);
    return key;
}

/// "test TAB subject TAB value ..."; false: it is none, or of another shape.
bool read_sample(const std::string& line, const SampleTable& table, std::pair<std::size_t, std::size_t>& at,
                 std::vector<double>& row)
{
    const std::optional<std::vector<double>> numbers = numbers_of_row(line);
    if (!numbers || numbers->size() < 2)
        return false;
    at = {static_cast<std::size_t>((*numbers)[0]), static_cast<std::size_t>((*numbers)[1])};
    row.assign(numbers->begin() + 2, numbers->end());
    return std::binary_search(table.wanted.begin(), table.wanted.end(), at) && row.size() == 3 * table.width(at.first);
}

/// Rows in a file that the same call has begun.
class SampleFile {
public:
    SampleFile(const std::optional<std::filesystem::path>& file, const std::string& key)
        : file_(file), text_(key + "\n")
    {
        if (!file_)
            return;
        std::ifstream in(*file_, std::ios::binary);
        std::string line;
        if (!in)
            return;
        if (std::getline(in, line) && !line.starts_with(samples_head))
            throw InputError(
                file_->string(), 1,
                "is no file of simulated tests, and would be overwritten.\n  Move it, or give the diagnosis "
                "another name (-o).");
        if (line == key)
            while (std::getline(in, line))
                lines.push_back(line);
    }
    void add(std::size_t test, std::size_t subject, const std::vector<double>& row)
    {
        std::vector<double> all = {static_cast<double>(test), static_cast<double>(subject)};
        all.insert(all.end(), row.begin(), row.end());
        text_ += number_row(all) + "\n";
    }
    void save() const
    {
        if (file_)
            write_whole(*file_, text_);
    }

    std::vector<std::string> lines; ///< that it had

private:
    std::optional<std::filesystem::path> file_;
    std::string text_;
};

/// What callipers, level and scales give of a specimen.
Specimen measured_at_rest(const Specimen& specimen, const HealthyLaw& law, const std::vector<SizedCause>& causes,
                          std::uint64_t seed, const SampleSubject& subject)
{
    Specimen seen = specimen; // in which the measured one's numbers may stand
    seen.centre_of_mass_m.clear();
    seen.bearing_left_m.clear();
    seen.bearing_right_m.clear();
    std::uint64_t element = 0;
    const std::uint64_t index = subject.number + (static_cast<std::uint64_t>(subject.cause + 1) << 32U);
    const auto noise = [&](double sd) {
        return sd * to_normal(uniform01(seed, index, Stream::joint_test_noise, (1ULL << 40U) + element++));
    };
    for (std::size_t b = 0; b < specimen.half_width_m.size(); ++b)
        seen.centre_of_mass_m.push_back(noise(centre_noise_m));
    for (const auto& [lower, upper] : specimen.joints) {
        const double inset = law.inset * specimen.half_width_m[static_cast<std::size_t>(upper)];
        seen.bearing_left_m.push_back(inset + noise(bearing_noise_m));
        seen.bearing_right_m.push_back(inset + noise(bearing_noise_m));
    }
    for (const SizedCause& sized : causes) {
        const Cause& c = sized.cause;
        if (c.mechanism == "eccentricity")
            seen.centre_of_mass_m[static_cast<std::size_t>(c.block)] += sized.size;
        if (c.mechanism == "corner_loss" && c.side == "left")
            seen.bearing_left_m[static_cast<std::size_t>(c.joint)] += sized.size;
        if (c.mechanism == "corner_loss" && c.side == "right")
            seen.bearing_right_m[static_cast<std::size_t>(c.joint)] += sized.size;
    }
    return seen;
}

/// The next specimens of one test: [from, to) of what is wanted, as far as they are not known.
class SampleMaker {
public:
    SampleMaker(const Specimen& specimen, const Study& about, const std::vector<LoopCause>& causes,
                const SamplePlan& plan, const RunOptions& options, Observer& observer)
        : specimen_(specimen), about_(about), causes_(causes), plan_(plan), options_(options), observer_(observer)
    {
    }

    /// @return (subjects) estimates; empty: the observer stopped it
    std::vector<std::vector<Estimate>> estimates_of(const PlannedTest& test, const std::vector<SampleSubject>& subjects,
                                                    SimulationCount& cost) const
    {
        std::vector<TestSubject> simulated;
        for (const SampleSubject& subject : subjects)
            simulated.push_back(of(subject));
        const SimulatedTests done =
            simulated_tests(specimen_, about_, test.runs, simulated, plan_.seed, options_, observer_);
        cost += done.cost;
        std::vector<std::vector<Estimate>> out(done.runs.size());
        tbb::task_arena(options_.threads).execute([&] {
            in_parallel(std::size_t{0}, out.size(), [&](std::size_t s) {
                out[s] = estimates(
                    test.kind == RunKind::rest
                        ? measured_at_rest(specimen_, *simulated[s].law, simulated[s].causes, plan_.seed, subjects[s])
                        : specimen_,
                    done.runs[s], plan_.floor);
            });
        });
        return out;
    }

private:
    TestSubject of(const SampleSubject& subject) const
    {
        TestSubject out{subject.number, draw_law(plan_.family, plan_.seed, subject.number), {}};
        if (subject.cause >= 0)
            out.causes.push_back(causes_[static_cast<std::size_t>(subject.cause)].drawn(
                uniform01(plan_.seed, subject.number, Stream::joint_test_placement,
                          (1ULL << 40U) + static_cast<std::uint64_t>(subject.cause))));
        return out;
    }

    const Specimen& specimen_;
    const Study& about_;
    const std::vector<LoopCause>& causes_;
    const SamplePlan& plan_;
    const RunOptions& options_;
    Observer& observer_;
};

} // namespace

std::vector<PlannedTest> planned_tests_of(const Specimen& specimen, const Laboratory& laboratory,
                                          const std::vector<RunKind>& kinds, const std::vector<int>& joints)
{
    std::vector<PlannedTest> tests;
    for (const RunKind kind : kinds)
        for (const int joint : joints)
            tests.push_back({kind, joint, planned_runs(specimen, laboratory, kind, joint)});
    return tests;
}

SimulatedSamples simulated_samples(const Specimen& specimen, const Study& about, const std::vector<PlannedTest>& tests,
                                   const std::vector<LoopCause>& causes, const SamplePlan& plan,
                                   const std::optional<std::filesystem::path>& cache, const RunOptions& options,
                                   const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                   Observer& observer)
{
    SimulatedSamples out;
    SampleTable table(specimen, tests, causes, plan);
    SampleFile file(cache, samples_key(specimen, about, tests, causes, plan));
    std::vector<bool> known(table.wanted.size(), false);
    for (const std::string& line : file.lines) {
        std::pair<std::size_t, std::size_t> at;
        std::vector<double> row;
        if (!read_sample(line, table, at, row))
            break;
        table.put(at.first, at.second, row);
        file.add(at.first, at.second, row);
        const auto place = std::lower_bound(table.wanted.begin(), table.wanted.end(), at) - table.wanted.begin();
        known[static_cast<std::size_t>(place)] = true;
        ++out.cached;
    }
    const SampleMaker maker(specimen, about, causes, plan, options, observer);
    std::uint64_t done = out.cached;
    for (std::size_t i = 0; i < table.wanted.size();) {
        const std::size_t test = table.wanted[i].first;
        std::vector<std::size_t> numbers;
        for (; i < table.wanted.size() && table.wanted[i].first == test && numbers.size() < samples_together; ++i)
            if (!known[i])
                numbers.push_back(table.wanted[i].second);
        if (numbers.empty())
            continue;
        std::vector<SampleSubject> subjects;
        for (const std::size_t s : numbers)
            subjects.push_back(table.subjects[s]);
        const std::vector<std::vector<Estimate>> found = maker.estimates_of(tests[test], subjects, out.cost);
        if (found.size() != subjects.size())
            return out;
        for (std::size_t s = 0; s < numbers.size(); ++s) {
            const std::vector<double> row = table.row_of(test, found[s]);
            table.put(test, numbers[s], row);
            file.add(test, numbers[s], row);
        }
        file.save();
        done += numbers.size();
        if (progress)
            progress(done, table.wanted.size());
    }
    out.samples = table.samples(causes, plan);
    out.complete = true;
    return out;
}

} // namespace stylobate
