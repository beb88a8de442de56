#include "stylobate/diagnosis.hpp"

#include "library/inside.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/workflow/diagnose.hpp"

namespace stylobate::api {

Diagnosis::Diagnosis(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Verdict Diagnosis::verdict() const
{
    return static_cast<Verdict>(data_->diagnosis.verdict);
}

std::string Diagnosis::verdict_text() const
{
    return data_->diagnosis.verdict_text;
}

std::vector<Cause> Diagnosis::causes() const
{
    std::vector<Cause> causes;
    for (const inner::Candidate* c : inner::named_causes(data_->diagnosis))
        causes.push_back({c->mechanism, c->place, c->parameter, c->unit, c->size, c->low, c->high, c->probability,
                          c->gain_nats, c->p});
    return causes;
}

std::optional<Gain> Diagnosis::gain() const
{
    const std::optional<inner::ModelGain>& gain = data_->diagnosis.gain;
    if (!gain)
        return {};
    return Gain{gain->error_before, gain->error_after, gain->low, gain->high, gain->unit};
}

std::optional<std::string> Diagnosis::extended_study() const
{
    return data_->diagnosis.extended_study;
}

std::string Diagnosis::text() const
{
    return inner::diagnosis_text(data_->diagnosis);
}

std::string Diagnosis::json() const
{
    return inner::diagnosis_json(data_->diagnosis).text();
}

void Diagnosis::write(const std::filesystem::path& file) const
{
    translated([&] { inner::write_diagnosis(data_->diagnosis, file); });
}

std::optional<Diagnosis> diagnose(const std::filesystem::path& measured, const DiagnosisOptions& options)
{
    return translated([&]() -> std::optional<Diagnosis> {
        inner::DiagnosisRequest request{.measured = measured.string()};
        if (options.study)
            request.start = Inside::of(*options.study).study;
        request.nulls = options.nulls;
        request.seed = options.seed;
        request.cache = options.cache;
        Teller teller(options);
        std::optional<inner::Diagnosis> found = inner::diagnose_measured(request, machine_of(options), teller);
        if (!found)
            return {};
        return Inside::make<Diagnosis>({std::move(*found)});
    });
}

} // namespace stylobate::api
