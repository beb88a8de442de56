#include "studies/measured/calibration/calibration_evidence.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/files/file_handle.hpp"
#include "io/store/result_seal.hpp"
#include "io/study/study_file.hpp"
#include "studies/measured/windows/window_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

class HistoryEvidence : public CalibrationEvidence {
public:
    explicit HistoryEvidence(WindowComparison comparison) : comparison_(std::move(comparison))
    {
        for (const WindowPlace& place : comparison_.windows())
            runs_.push_back(place.run);
    }

    const std::vector<std::size_t>& runs() const override { return runs_; }
    std::size_t candidates() const override { return residuals_.size(); }

    std::optional<Predictions> predict(const std::vector<Study>& candidates, const RunOptions& options,
                                       Observer& observer) override
    {
        std::vector<ModelVariant> variants;
        for (const Study& study : candidates)
            variants.push_back({study});
        const std::vector<WindowResiduals> z = comparison_.residuals(variants, options, observer);
        if (z.size() != candidates.size())
            return std::nullopt;
        Predictions all;
        for (const WindowResiduals& windows : z) {
            std::vector<double>& one = all.emplace_back();
            for (const std::vector<double>& window : windows)
                one.insert(one.end(), window.begin(), window.end());
        }
        return all;
    }

    std::vector<double> own_scores(std::size_t candidate, const std::vector<std::size_t>& used) const override
    {
        return comparison_.scores(residuals_[candidate], comparison_.fit_scales(residuals_[candidate], used));
    }

    std::vector<double> scores(std::size_t candidate, std::size_t scales_of) const override
    {
        if (!scales_[scales_of])
            scales_[scales_of] = comparison_.fit_scales(residuals_[scales_of]);
        return comparison_.scores(residuals_[candidate], *scales_[scales_of]);
    }

    SimulationCount cost() const override { return comparison_.cost(); }

    bool take(const Predictions& predictions) override
    {
        std::size_t length = 0;
        for (std::size_t w = 0; w < runs_.size(); ++w)
            length += comparison_.seen(w).size();
        for (const std::vector<double>& all : predictions)
            if (all.size() != length)
                return false;
        for (const std::vector<double>& all : predictions) {
            WindowResiduals z;
            auto at = all.begin();
            for (std::size_t w = 0; w < runs_.size(); ++w) {
                const auto end = at + static_cast<std::ptrdiff_t>(comparison_.seen(w).size());
                z.emplace_back(at, end);
                at = end;
            }
            residuals_.push_back(std::move(z));
        }
        scales_.resize(residuals_.size());
        return true;
    }

private:
    WindowComparison comparison_;
    std::vector<std::size_t> runs_;                             ///< (windows)
    std::vector<WindowResiduals> residuals_;                    ///< (candidates)
    mutable std::vector<std::optional<ResidualScales>> scales_; ///< (candidates) once they were asked for
};

class OutcomeEvidence : public CalibrationEvidence {
public:
    OutcomeEvidence(OutcomeTests tests, std::vector<Perturbation> perturbations, std::uint64_t ensemble)
        : tests_(std::move(tests)), perturbations_(std::move(perturbations)), ensemble_(ensemble)
    {
        for (const OutcomeTest& test : tests_.tests)
            runs_.push_back(test.run);
    }

    const std::vector<std::size_t>& runs() const override { return runs_; }
    std::size_t candidates() const override { return scores_.size(); }

    std::optional<Predictions> predict(const std::vector<Study>& candidates, const RunOptions& options,
                                       Observer& observer) override
    {
        Predictions all;
        StopOnly stop_only(observer);
        for (const Study& candidate : candidates) {
            std::vector<double> share; // of falls, by shaking
            for (const TestShaking& shaking : tests_.shakings) {
                Study study = candidate.as_single(ensemble_);
                study.perturbations = perturbations_;
                study.excitation = shaking.excitation;
                study.outcome.follow = Follow::collapse;
                // the same draws for every candidate: what differs is the parameters' doing
                study.seed = candidate.seed + share.size();
                const Experiment experiment(study,
                                            {.record = shaking.motion ? std::optional(*shaking.motion) : std::nullopt});
                RunPlan plan;
                plan.total = ensemble_;
                std::uint64_t collapsed = 0, valid = 0;
                plan.sink = [&](const Realization& r, const Outcome& o) {
                    collapsed += o.state == State::collapsed;
                    valid += o.state != State::invalid;
                    cost_.block_steps += r.free_blocks() * o.steps;
                };
                const Progress p = run_ensemble(experiment, options, plan, stop_only);
                if (p.done < plan.total)
                    return std::nullopt;
                cost_.simulations += plan.total;
                // the mean of the posterior of Jeffreys' prior: a small ensemble never excludes an outcome
                share.push_back((static_cast<double>(collapsed) + 0.5) / (static_cast<double>(valid) + 1));
            }
            std::vector<double> scores;
            for (const OutcomeTest& test : tests_.tests)
                scores.push_back(std::log(test.collapsed ? share[test.shaking] : 1 - share[test.shaking]));
            all.push_back(std::move(scores));
        }
        return all;
    }

    std::vector<double> own_scores(std::size_t candidate, const std::vector<std::size_t>&) const override
    {
        return scores_[candidate];
    }
    std::vector<double> scores(std::size_t candidate, std::size_t) const override { return scores_[candidate]; }
    SimulationCount cost() const override { return cost_; }
    bool take(const Predictions& predictions) override
    {
        for (const std::vector<double>& scores : predictions)
            if (scores.size() != runs_.size())
                return false;
        scores_.insert(scores_.end(), predictions.begin(), predictions.end());
        return true;
    }

private:
    const OutcomeTests tests_;
    const std::vector<Perturbation> perturbations_;
    const std::uint64_t ensemble_;
    std::vector<std::size_t> runs_;           ///< (tests)
    std::vector<std::vector<double>> scores_; ///< (candidates x tests)
    SimulationCount cost_;
};

} // namespace

std::unique_ptr<CalibrationEvidence> history_evidence(const Campaign& campaign, const std::vector<std::size_t>& runs,
                                                      double window_s)
{
    WindowComparison comparison(campaign, {window_s, runs, {}});
    if (comparison.windows().empty())
        return nullptr;
    return std::make_unique<HistoryEvidence>(std::move(comparison));
}

std::vector<Perturbation> tolerances(const Specimen& specimen)
{
    constexpr double friction_cov = 0.05;
    std::vector<Perturbation> perturbations;
    const auto add = [&](Quantity quantity, Per per, double sd, double cov) {
        Perturbation p;
        p.quantity = quantity;
        p.per = per;
        p.sd = sd;
        p.cov = cov;
        if (sd > 0 || cov > 0)
            perturbations.push_back(p);
    };
    add(Quantity::friction, Per::joint, 0, friction_cov);
    add(Quantity::drum_width, Per::block, 0, specimen.width_tolerance);
    add(Quantity::drum_offset, Per::block, specimen.placement_tolerance_m, 0);
    add(Quantity::density, Per::block, 0, specimen.mass_tolerance);
    return perturbations;
}

std::unique_ptr<CalibrationEvidence> outcome_evidence(OutcomeTests tests, std::vector<Perturbation> perturbations,
                                                      std::uint64_t ensemble)
{
    if (tests.tests.empty())
        return nullptr;
    return std::make_unique<OutcomeEvidence>(std::move(tests), std::move(perturbations), ensemble);
}

namespace {

constexpr std::string_view head = "stylobate calibration, sets kept: ";
// A record longer than this is none of ours: 16 sets of 8 million numbers.
constexpr std::uint64_t longest = std::uint64_t{1} << 30;

/// One portion of parameter sets.
struct Portion {
    std::string studies; ///< texts of all of them
    Predictions predictions;
    SimulationCount cost;
};

std::string texts_of(const std::vector<Study>& studies)
{
    std::string text;
    for (const Study& study : studies)
        text += study.text + '\0';
    return text;
}

void put(std::string& bytes, const void* from, std::size_t count)
{
    bytes.append(static_cast<const char*>(from), count);
}

void put(std::string& bytes, std::uint64_t number)
{
    put(bytes, &number, sizeof number);
}

std::string bytes_of(const Portion& portion)
{
    std::string bytes;
    put(bytes, portion.cost.simulations);
    put(bytes, portion.cost.window_simulations);
    put(bytes, portion.cost.block_steps);
    put(bytes, portion.studies.size());
    put(bytes, portion.studies.data(), portion.studies.size());
    put(bytes, portion.predictions.size());
    for (const std::vector<double>& numbers : portion.predictions) {
        put(bytes, numbers.size());
        put(bytes, numbers.data(), numbers.size() * sizeof(double));
    }
    return bytes;
}

/// Reads a portion. The checksum has been verified before, so that the bytes are those that were written.
Portion portion_of(std::string_view bytes)
{
    const auto number = [&] {
        std::uint64_t value = 0;
        std::memcpy(&value, bytes.data(), sizeof value);
        bytes.remove_prefix(sizeof value);
        return value;
    };
    Portion portion;
    portion.cost.simulations = number();
    portion.cost.window_simulations = number();
    portion.cost.block_steps = number();
    const std::uint64_t length = number();
    portion.studies = bytes.substr(0, length);
    bytes.remove_prefix(length);
    portion.predictions.resize(number());
    for (std::vector<double>& numbers : portion.predictions) {
        numbers.resize(number());
        std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
        bytes.remove_prefix(numbers.size() * sizeof(double));
    }
    return portion;
}

/// Before each record: its length and its checksum.
struct RecordHead {
    std::uint64_t length = 0;
    std::uint64_t crc32 = 0;
};

std::uint32_t crc_of(std::string_view bytes)
{
    return crc32_of(std::as_bytes(std::span(bytes)));
}

/// Predicts with this rank's part: every size-th study. @return what all have made, by rank; nothing of one that was
/// stopped
std::vector<std::string> predict_together(Ranks& ranks, CalibrationEvidence& evidence,
                                          const std::vector<Study>& candidates, const RunOptions& options,
                                          Observer& observer)
{
    std::vector<Study> mine;
    for (std::size_t i = static_cast<std::size_t>(ranks.rank()); i < candidates.size();
         i += static_cast<std::size_t>(ranks.size()))
        mine.push_back(candidates[i]);
    const SimulationCount before = evidence.cost();
    std::optional<Predictions> made(std::in_place);
    if (!mine.empty())
        made = evidence.predict(mine, options, observer);
    return ranks.of_all(made ? bytes_of({{}, std::move(*made), evidence.cost() - before}) : std::string());
}

} // namespace

struct KeptEvidence::File {
    std::filesystem::path path;
    FileHandle handle;
    std::uint64_t end = 0;                   ///< of what is good [bytes]
    std::map<std::string, Portion> portions; ///< by their studies
    std::size_t sets = 0;

    void write(std::string_view bytes)
    {
        try {
            handle.write(end, std::as_bytes(std::span(bytes)));
        } catch (const std::system_error& error) {
            throw InputError(path.string(), 0, std::string("cannot be written: ") + error.what());
        }
        end += bytes.size();
    }

    std::string read(std::uint64_t offset, std::uint64_t length) const
    {
        std::string bytes(length, '\0');
        handle.read(offset, std::as_writable_bytes(std::span(bytes)));
        return bytes;
    }

    /// Everything up to the first record that is cut or damaged.
    void read_all(const std::string& first_line)
    {
        const std::uint64_t size = handle.size();
        if (size < first_line.size() || read(0, first_line.size()) != first_line)
            return;
        end = first_line.size();
        RecordHead record;
        while (end + sizeof record <= size) {
            handle.read(end, std::as_writable_bytes(std::span(&record, 1)));
            if (record.length > longest || end + sizeof record + record.length > size)
                return;
            const std::string bytes = read(end + sizeof record, record.length);
            if (crc_of(bytes) != record.crc32)
                return;
            Portion portion = portion_of(bytes);
            sets += portion.predictions.size();
            end += sizeof record + record.length;
            std::string studies = portion.studies;
            portions.emplace(std::move(studies), std::move(portion));
        }
    }
};

KeptEvidence::KeptEvidence(std::unique_ptr<CalibrationEvidence> inner, std::filesystem::path file,
                           const std::string& key)
    : EvidenceBy(std::move(inner)), file_(std::make_unique<File>())
{
    file_->path = std::move(file);
    file_->handle = FileHandle::claim(file_->path);
    if (!head.starts_with(file_->read(0, std::min<std::uint64_t>(file_->handle.size(), head.size()))))
        throw InputError(file_->path.string(), 0,
                         "keeps no parameter sets of a calibration, and nothing was written.\n  Remove it, or name "
                         "another file.");
    const std::string first_line = std::string(head) + key + "\n";
    file_->read_all(first_line);
    if (file_->end == 0) {
        // of other data, or of another version: over it, and what is behind the first record is cut off
        std::filesystem::resize_file(file_->path, 0);
        file_->write(first_line);
    } else {
        std::filesystem::resize_file(file_->path, file_->end);
    }
}

KeptEvidence::~KeptEvidence() = default;

bool KeptEvidence::add(const std::vector<Study>& candidates, const RunOptions& options, Observer& observer)
{
    const auto found = file_->portions.find(texts_of(candidates));
    if (found != file_->portions.end() && inner_->take(found->second.predictions)) {
        restored_ += candidates.size();
        elsewhere_ += found->second.cost;
        return true;
    }
    return CalibrationEvidence::add(candidates, options, observer);
}

std::optional<Predictions> KeptEvidence::predict(const std::vector<Study>& candidates, const RunOptions& options,
                                                 Observer& observer)
{
    const SimulationCount before = inner_->cost();
    std::optional<Predictions> made = inner_->predict(candidates, options, observer);
    if (!made)
        return made;
    const std::string bytes = bytes_of({texts_of(candidates), *made, inner_->cost() - before});
    const RecordHead record{bytes.size(), crc_of(bytes)};
    std::string whole;
    put(whole, &record, sizeof record);
    file_->write(whole + bytes);
    file_->sets += candidates.size();
    return made;
}

std::size_t KeptEvidence::kept() const
{
    return file_->sets;
}

void KeptEvidence::remove()
{
    std::error_code ignored;
    std::filesystem::remove(file_->path, ignored);
}

SharedEvidence::~SharedEvidence()
{
    if (std::uncaught_exceptions() == 0) // else all ranks are ended
        ranks_.of_first({});
}

std::optional<Predictions> SharedEvidence::predict(const std::vector<Study>& candidates, const RunOptions& options,
                                                   Observer& observer)
{
    ranks_.of_first(texts_of(candidates));
    const std::vector<std::string> made = predict_together(ranks_, *inner_, candidates, options, observer);
    std::vector<Predictions> of_rank;
    for (std::size_t rank = 0; rank < made.size(); ++rank) {
        if (made[rank].empty())
            return std::nullopt;
        Portion portion = portion_of(made[rank]);
        if (rank > 0)
            elsewhere_ += portion.cost;
        of_rank.push_back(std::move(portion.predictions));
    }
    Predictions all;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        all.push_back(std::move(of_rank[i % made.size()][i / made.size()]));
    return all;
}

void serve_evidence(Ranks& ranks, CalibrationEvidence& evidence, const RunOptions& options, Observer& observer)
{
    for (std::string texts = ranks.of_first({}); !texts.empty(); texts = ranks.of_first({})) {
        std::vector<Study> candidates;
        for (std::string_view rest = texts; !rest.empty();) {
            const std::size_t length = rest.find('\0');
            candidates.push_back(parse_study(std::string(rest.substr(0, length)), "a parameter set"));
            rest.remove_prefix(length + 1);
        }
        predict_together(ranks, evidence, candidates, options, observer);
    }
}

} // namespace stylobate
