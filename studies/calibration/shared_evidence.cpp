#include "studies/calibration/shared_evidence.hpp"

#include "io/study/study_file.hpp"

#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <utility>

namespace stylobate {

namespace {

/// What a rank has made of its part: costs, and the predictions one after the other. Nothing: it was stopped.
std::string bytes_of(const std::optional<Predictions>& made, const EvidenceCost& cost)
{
    if (!made)
        return {};
    std::string bytes(reinterpret_cast<const char*>(&cost), sizeof cost);
    for (const std::vector<double>& one : *made) {
        const std::uint64_t count = one.size();
        bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
        bytes.append(reinterpret_cast<const char*>(one.data()), count * sizeof(double));
    }
    return bytes;
}

std::pair<Predictions, EvidenceCost> of_bytes(std::string_view bytes)
{
    const auto take = [&](void* to, std::size_t size) {
        std::memcpy(to, bytes.data(), size);
        bytes.remove_prefix(size);
    };
    std::pair<Predictions, EvidenceCost> all;
    take(&all.second, sizeof all.second);
    while (!bytes.empty()) {
        std::uint64_t count = 0;
        take(&count, sizeof count);
        std::vector<double>& one = all.first.emplace_back(count);
        if (count > 0)
            take(one.data(), count * sizeof(double));
    }
    return all;
}

/// Predicts with this rank's part: every size-th study. @return what all have made, by rank
std::vector<std::string> predict_together(Ranks& ranks, CalibrationEvidence& evidence,
                                          const std::vector<Study>& candidates, const RunOptions& options,
                                          Observer& observer)
{
    std::vector<Study> mine;
    for (std::size_t i = static_cast<std::size_t>(ranks.rank()); i < candidates.size();
         i += static_cast<std::size_t>(ranks.size()))
        mine.push_back(candidates[i]);
    const EvidenceCost before = evidence.cost();
    std::optional<Predictions> made(std::in_place);
    if (!mine.empty())
        made = evidence.predict(mine, options, observer);
    return ranks.of_all(bytes_of(made, evidence.cost() - before));
}

} // namespace

SharedEvidence::SharedEvidence(std::unique_ptr<CalibrationEvidence> inner, Ranks& ranks)
    : inner_(std::move(inner)), ranks_(ranks)
{
}

SharedEvidence::~SharedEvidence()
{
    if (std::uncaught_exceptions() == 0) // else all ranks are ended
        ranks_.of_first({});
}

std::optional<Predictions> SharedEvidence::predict(const std::vector<Study>& candidates, const RunOptions& options,
                                                   Observer& observer)
{
    std::string texts;
    for (const Study& study : candidates)
        texts += study.text + '\0';
    ranks_.of_first(texts);
    const std::vector<std::string> made = predict_together(ranks_, *inner_, candidates, options, observer);
    std::vector<Predictions> of_rank;
    for (std::size_t rank = 0; rank < made.size(); ++rank) {
        if (made[rank].empty())
            return std::nullopt;
        auto [predictions, cost] = of_bytes(made[rank]);
        if (rank > 0)
            elsewhere_ += cost;
        of_rank.push_back(std::move(predictions));
    }
    Predictions all;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        all.push_back(std::move(of_rank[i % made.size()][i / made.size()]));
    return all;
}

EvidenceCost SharedEvidence::cost() const
{
    EvidenceCost cost = inner_->cost();
    return cost += elsewhere_;
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
