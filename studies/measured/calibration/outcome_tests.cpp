#include "studies/measured/calibration/outcome_tests.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/words.hpp"
#include "io/measured/measured_motion.hpp"
#include "io/records/ground_motion.hpp"
#include "io/records/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>

namespace stylobate {

namespace {

bool is_sampled(ExcitationKind kind)
{
    return kind == ExcitationKind::record || kind == ExcitationKind::table;
}

double largest(const std::vector<double>& values)
{
    double most = 0;
    for (const double value : values)
        most = std::max(most, std::fabs(value));
    return most;
}

/// Peak velocity over peak acceleration of an excitation in closed form, at 1 Hz [s].
double pgv_over_pga_at_1_hz(ExcitationSpec e)
{
    constexpr double samples_per_s = 2048;
    e.frequency_hz = e.pga_m_s2 = 1;
    RealizationHeader r;
    r.frequency_hz = r.pga_m_s2 = 1;
    r.phase_rad = e.phase_rad;
    r.pulse_gamma = e.gamma;
    r.step_s = 1 / samples_per_s;
    const BaseMotion base(e, r, nullptr);
    const auto samples = static_cast<std::size_t>(base.duration_s() * samples_per_s);
    double most = 0, before = base.displacement_m(0);
    for (std::size_t i = 1; i <= samples; ++i) {
        const double now = base.displacement_m(static_cast<double>(i) / samples_per_s);
        most = std::max(most, std::fabs(now - before) * samples_per_s);
        before = now;
    }
    return most;
}

/// What shook the specimen in the rows of one table.
class TableShakings {
public:
    TableShakings(const OutcomeTable& table, const Study& study) : table_(table), study_(study.excitation) {}

    TestShaking of(const MeasuredOutcome& row)
    {
        TestShaking s;
        if (row.motion_file)
            s = of_file(row);
        else if (row.amplitude_m && row.frequency_hz)
            s = of_amplitude(row);
        else
            s = of_peak(row);
        check(row, "peak acceleration", "m/s2", s.excitation.pga_m_s2, acceleration_range,
              is_sampled(s.excitation.kind));
        return s;
    }

private:
    [[noreturn]] void refuse(const MeasuredOutcome& row, const std::string& text) const
    {
        throw InputError(table_.source, row.line, text);
    }

    const char* kind() const { return word_for(excitation_kind_names, study_.kind); }

    void check(const MeasuredOutcome& row, const char* what, const char* unit, double value, const Range& range,
               bool zero_is_as_it_stands = false) const
    {
        if (!range.contains(value) && !(zero_is_as_it_stands && value == 0))
            refuse(row, fmt::format("makes a {} of {:.4g} {}, outside {}.\n  {}", what, value, unit, range.text(),
                                    range.hint));
    }

    std::shared_ptr<const Motion> read(const MeasuredOutcome& row, const std::string& file, bool of_columns)
    {
        std::shared_ptr<const Motion>& motion = files_[file];
        if (motion)
            return motion;
        try {
            motion = std::make_shared<const Motion>(
                of_columns
                    ? read_base_table(file, study_.run)
                    : make_motion(read_record(file, study_.component, study_.unit), study_.baseline, study_.band_pass));
        } catch (const InputError& error) {
            refuse(row, fmt::format("its motion cannot be used.\n  {}", error.what()));
        }
        return motion;
    }

    TestShaking of_file(const MeasuredOutcome& row)
    {
        TestShaking s;
        s.excitation = is_sampled(study_.kind) ? study_ : ExcitationSpec{};
        s.excitation.tail_s = study_.tail_s;
        if (!is_sampled(study_.kind))
            s.excitation.kind = ExcitationKind::record;
        const std::filesystem::path file = std::filesystem::path(table_.source).parent_path() / *row.motion_file;
        s.motion = read(row, file.string(), s.excitation.kind == ExcitationKind::table);
        s.excitation.file = file.string();
        s.excitation.pga_m_s2 = row.pga_m_s2.value_or(0);
        return s;
    }

    TestShaking of_amplitude(const MeasuredOutcome& row) const
    {
        if (study_.kind != ExcitationKind::harmonic && study_.kind != ExcitationKind::tapered)
            refuse(row, fmt::format("an amplitude and a frequency are those of a harmonic motion, and the study has "
                                    "excitation.kind = \"{}\".\n  Give it kind = \"harmonic\" (or \"tapered\"), with "
                                    "its cycles and ramps: they are those of all these tests.",
                                    kind()));
        TestShaking s{study_, nullptr};
        const double omega = 2 * std::numbers::pi * *row.frequency_hz;
        s.excitation.frequency_hz = *row.frequency_hz;
        s.excitation.pga_m_s2 = *row.amplitude_m * omega * omega;
        return s;
    }

    TestShaking of_peak(const MeasuredOutcome& row)
    {
        if (study_.kind == ExcitationKind::none)
            refuse(row, "a peak acceleration does not define the base motion, and the study has excitation.kind = "
                        "\"none\".\n  Give it the motion of the tests, such as kind = \"full_sine\".");
        TestShaking s{study_, nullptr};
        ExcitationSpec& e = s.excitation;
        e.pga_m_s2 = *row.pga_m_s2;
        if (is_sampled(e.kind)) {
            s.motion = read(row, e.file, e.kind == ExcitationKind::table);
            if (row.pgv_over_pga_s)
                e.time_scale = *row.pgv_over_pga_s / (largest(s.motion->velocity_m_s) / s.motion->pga_m_s2);
            else if (row.frequency_hz)
                e.time_scale = s.motion->predominant_frequency_hz / *row.frequency_hz;
            check(row, "time scale", "", e.time_scale, time_scale_range);
            return s;
        }
        const bool stretches = e.kind != ExcitationKind::noise && e.kind != ExcitationKind::sweep;
        if (row.pgv_over_pga_s && !stretches)
            refuse(row, fmt::format("pgv_over_pga_s gives no frequency to excitation.kind = \"{}\".\n  Leave the "
                                    "column out, or give the study the motion of the tests.",
                                    kind()));
        if (row.frequency_hz && e.kind != ExcitationKind::sweep)
            e.frequency_hz = *row.frequency_hz;
        else if (row.pgv_over_pga_s) {
            if (!at_1_hz_)
                at_1_hz_ = pgv_over_pga_at_1_hz(study_);
            e.frequency_hz = *at_1_hz_ / *row.pgv_over_pga_s;
        }
        if (e.kind != ExcitationKind::sweep)
            check(row, "frequency", "Hz", e.frequency_hz,
                  e.kind == ExcitationKind::noise ? noise_frequency_range : frequency_range);
        return s;
    }

    const OutcomeTable& table_;
    const ExcitationSpec study_;
    std::map<std::string, std::shared_ptr<const Motion>> files_;
    std::optional<double> at_1_hz_; ///< peak velocity over peak acceleration of the study's motion [s]
};

} // namespace

OutcomeTests outcome_tests(const Campaign& campaign, const std::vector<std::size_t>& runs)
{
    OutcomeTests out;
    for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
        const MeasuredRun& run = campaign.runs[i];
        const bool wanted = runs.empty() || std::find(runs.begin(), runs.end(), i) != runs.end();
        if (!wanted || !run.collapsed || !run.has_base())
            continue;
        TestShaking s;
        s.excitation.kind = ExcitationKind::record;
        s.motion = std::make_shared<const Motion>(base_motion_of(run));
        out.tests.push_back({i, out.shakings.size(), *run.collapsed});
        out.shakings.push_back(std::move(s));
    }
    return out;
}

OutcomeTests outcome_tests(const OutcomeTable& table, const Study& study)
{
    OutcomeTests out;
    TableShakings shakings(table, study);
    std::map<decltype(MeasuredOutcome().motion()), std::size_t> known;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const MeasuredOutcome& row = table.rows[i];
        const auto [found, first] = known.emplace(row.motion(), out.shakings.size());
        if (first)
            out.shakings.push_back(shakings.of(row));
        out.tests.push_back({i, found->second, row.fell});
    }
    return out;
}

} // namespace stylobate
