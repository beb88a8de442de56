#include "studies/loaded_study.hpp"

#include "ensemble/input_error.hpp"
#include "io/ground_motion.hpp"
#include "io/record.hpp"
#include "io/study_file.hpp"
#include "studies/block_names.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>
#include <zlib.h>

namespace stylobate {

namespace {

std::string fingerprint(const Motion& motion)
{
    uLong crc = crc32(0, nullptr, 0);
    crc = crc32(crc, reinterpret_cast<const Bytef*>(motion.acceleration_m_s2.data()),
                static_cast<uInt>(motion.acceleration_m_s2.size() * sizeof(double)));
    return fmt::format("# record: {} samples, dt {} s, PGA {:.4f} m/s2, predominant frequency {:.4f} Hz, crc {:08x}\n",
                       motion.acceleration_m_s2.size(), motion.dt_s, motion.pga_m_s2, motion.predominant_frequency_hz,
                       crc);
}

} // namespace

LoadedStudy::LoadedStudy(Study study) : study_(std::make_unique<Study>(std::move(study)))
{
    text_ = study_->text;
    const ExcitationSpec& excitation = study_->excitation;
    if (excitation.kind == ExcitationKind::record) {
        motion_ = make_motion(read_record(excitation.file, excitation.component, excitation.unit), excitation.baseline,
                              excitation.band_pass);
        text_ += fingerprint(*motion_);
    }
    sampler_ = std::make_unique<Sampler>(*study_, record());
}

LoadedStudy LoadedStudy::from_file(const std::string& file, const std::vector<std::string>& settings)
{
    return LoadedStudy(read_study(file, settings));
}

LoadedStudy LoadedStudy::from_results(const ResultHeader& header, const std::string& file,
                                      const std::vector<std::string>& settings)
{
    for (const std::string& setting : settings)
        if (!setting.starts_with("excitation.file="))
            throw InputError(fmt::format("--set {}: the study of {} is fixed; only excitation.file may be set, to say "
                                         "where its record lies now",
                                         setting, file));
    LoadedStudy loaded(parse_study(header.study_toml, file + " (its study)", settings));
    if (!settings.empty() && !loaded.motion_)
        throw InputError(fmt::format("--set {}: the study of {} is not driven by a record", settings.front(), file));
    if (loaded.motion_ && header.study_toml.find(fingerprint(*loaded.motion_)) == std::string::npos)
        throw InputError(fmt::format("{} is not the record that {} was made with: its samples differ. Give the right "
                                     "one by --set excitation.file=PATH",
                                     loaded.study().excitation.file, file));
    return loaded;
}

ResultHeader LoadedStudy::result_header() const
{
    ResultHeader header;
    header.kind = study_->surface ? "surface" : "single";
    header.study_toml = text_;
    header.seed = study_->seed;
    header.code_version = code_version();
    header.total = study_->total();
    header.input_names = sampler_->input_names();
    header.block_names = block_names(*study_);
    if (study_->surface) {
        const auto values = [](const Axis& axis) {
            std::vector<double> all;
            for (int i = 0; i < axis.count; ++i)
                all.push_back(axis.value(i));
            return all;
        };
        header.frequency_hz = values(study_->surface->frequency_hz);
        header.pga_m_s2 = values(study_->surface->pga_m_s2);
    }
    return header;
}

} // namespace stylobate
