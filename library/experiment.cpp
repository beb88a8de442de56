#include "ensemble/experiment.hpp"
#include "io/files/toml_document.hpp"
#include "io/keys/words.hpp"
#include "io/records/ground_motion.hpp"
#include "io/study/study_file.hpp"
#include "library/inside.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate::api {

namespace {

/// The study under a record instead of its own excitation; what it says of a record's scale, correction and tail stays.
/// @param samples of whose baseline nothing is to be corrected
inner::Study under_record(const inner::Study& study, const inner::Record& record, bool samples)
{
    const inner::ExcitationSpec& e = study.excitation;
    const bool had_record = e.kind == inner::ExcitationKind::record;
    std::string table = fmt::format("kind = \"record\", file = {}", inner::toml_quoted(record.file));
    if (!samples && !record.component.empty())
        table += fmt::format(", component = {}", inner::toml_quoted(record.component));
    if (!samples && record.unit != "g/10") // which only a file can say
        table += fmt::format(", unit = {}", inner::toml_quoted(record.unit));
    if (samples || (had_record && !e.baseline))
        table += ", baseline = false";
    else if (had_record && e.band_pass)
        table += fmt::format(", band_pass_hz = [{}, {}]", e.band_pass->low_hz, e.band_pass->high_hz);
    if (had_record && !study.design().pga_m_s2 && e.pga_m_s2 > 0)
        table += fmt::format(", scale_to_pga_m_s2 = {}", e.pga_m_s2);
    if (had_record && !study.design().frequency_hz)
        table += fmt::format(", time_scale = {}", e.time_scale);
    if (e.tail_s)
        table += fmt::format(", tail_s = {}", *e.tail_s);
    return inner::parse_study(study.text, "study", {"excitation={ " + table + " }"});
}

/// "column.toml", or what stands for it.
std::string name_of(const Study& study)
{
    const std::optional<std::filesystem::path>& file = Inside::of(study).file;
    return file ? file->string() : "study";
}

Record sampled(const std::function<double(double)>& acceleration_m_s2, double dt_s, double duration_s)
{
    constexpr double most_samples = 1e7;
    const double count = std::floor(duration_s / dt_s + 0.5) + 1;
    if (!(dt_s > 0 && duration_s > 0 && count <= most_samples))
        throw InputError(
            fmt::format("a base acceleration of {} s in steps of {} s: give a step and a duration above 0, "
                        "and no more than {:g} samples.",
                        duration_s, dt_s, most_samples));
    std::vector<double> samples;
    for (double i = 0; i < count; ++i)
        samples.push_back(acceleration_m_s2(i * dt_s));
    return Record::from_samples(std::move(samples), dt_s, "function of time");
}

} // namespace

/// With the warnings of the command line. @throws InputError where it refuses a study
Experiment::Data Experiment::Data::checked(inner::Experiment experiment, const std::string& name)
{
    Data data{inner::LoadedStudy(std::move(experiment)), name, {}};
    for (const inner::Implausibility& one : data.loaded.implausibilities()) {
        if (one.refused)
            throw InputError(
                fmt::format("{}: {}\n  If it is intended: study.allow = [\"{}\"].", name, one.text, one.check));
        data.warnings.push_back(one.text);
    }
    return data;
}

Experiment::Experiment(const Study& study)
    : data_(translated([&] {
          inner::Study own = Inside::of(study).study;
          inner::Motions motions = inner::motions_of(own);
          return std::make_shared<const Data>(
              Data::checked(inner::Experiment(std::move(own), std::move(motions)), name_of(study)));
      }))
{
}

Experiment::Experiment(const Study& study, const std::function<double(double)>& acceleration_m_s2, double dt_s,
                       double duration_s)
    : Experiment(study, sampled(acceleration_m_s2, dt_s, duration_s))
{
}

Experiment::Experiment(const Study& study, const Record& record)
    : data_(translated([&] {
          const inner::Study& own = Inside::of(study).study;
          if (own.design().motions)
              throw InputError(name_of(study) + ": study.kind = \"fragility\" has its motions in [fragility] and "
                                                "accepts no other one. Give the files in fragility.records.");
          const auto& given = Inside::of(record);
          inner::Study shaken = under_record(own, given.record, !given.from_file);
          inner::Motions motions = inner::motions_of(shaken, &given.record);
          return std::make_shared<const Data>(
              Data::checked(inner::Experiment(std::move(shaken), std::move(motions)), name_of(study)));
      }))
{
}

Study Experiment::study() const
{
    const inner::Study& own = data_->loaded.study();
    return Inside::make<Study>({own, {}, own.text, {}});
}

std::vector<std::string> Experiment::warnings() const
{
    return data_->warnings;
}

} // namespace stylobate::api
