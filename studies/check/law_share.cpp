#include "studies/check/law_share.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

/// Those of the part that are no replicas, as many as are wanted, spread over all of them.
std::vector<std::uint64_t> chosen_indices(const Study& study, const PartRun& plain, std::uint64_t wanted)
{
    std::vector<std::uint64_t> originals;
    for (const std::uint64_t index : plain.indices)
        if (!study.replica(index))
            originals.push_back(index);
    std::vector<std::uint64_t> chosen;
    for (const std::uint64_t i : spread_evenly(wanted, originals.size()))
        chosen.push_back(originals[i]);
    return chosen;
}

} // namespace

std::vector<std::string> LawShare::names() const
{
    std::vector<std::string> all = {"as given"};
    for (const LawResult& law : laws)
        all.push_back(law.name);
    return all;
}

LawBand::Place LawShare::probabilities() const
{
    LawBand::Place all{{base_probability()}};
    for (const LawResult& law : laws)
        all.probability.push_back(law.probability()); // NaN without a valid realization
    return all;
}

LawShare measure_law_share(const Experiment& study, const RunOptions& options, const PartRun& plain, double seconds,
                           const std::function<void(const std::string&)>& tell, Observer& observer)
{
    std::vector<ContactLaw> laws = contact_laws(study.study());
    LawShare share;
    double cost = 0;
    std::string names;
    for (ContactLaw& law : laws)
        if (law.study) {
            try {
                cost += law_cost(study, Experiment(*law.study, study.motions()));
                names += (names.empty() ? "" : ", ") + law.name;
            } catch (const InputError& error) {
                law.why_not = error.what();
                law.study.reset();
            }
        }
    share.left_out = laws_left_out(laws);
    if (names.empty()) {
        share.why_none = "No other contact law applies to the study.";
        return share;
    }
    share.whole_run = cost;
    const auto there = static_cast<double>(plain.indices.size());
    const double each_s = cost * plain.seconds / there; // of one realization under all laws
    const double fits = each_s > 0 ? seconds / each_s : there;
    const auto wanted = static_cast<std::uint64_t>(std::min(fits, there));
    if (wanted < std::min<std::uint64_t>(least_law_realizations, plain.indices.size())) {
        share.why_none = fmt::format("{} realizations under each law ({}) would take about {}: --law-seconds {:.0f} "
                                     "runs them.",
                                     least_law_realizations, names,
                                     seconds_text(each_s * static_cast<double>(least_law_realizations)),
                                     std::ceil(1.5 * each_s * static_cast<double>(least_law_realizations)));
        return share;
    }
    const std::vector<std::uint64_t> indices = chosen_indices(study.study(), plain, wanted);
    share.realizations = indices.size();
    share.estimated_s = each_s * static_cast<double>(indices.size());
    if (tell)
        tell(fmt::format("contact laws ({}): {} realizations under each, about {}", names, indices.size(),
                         seconds_text(share.estimated_s)));
    for (const std::uint64_t index : indices) {
        const auto at = std::ranges::lower_bound(plain.indices, index) - plain.indices.begin();
        if (const std::optional<bool>& fell = plain.collapsed[static_cast<std::size_t>(at)]) {
            ++share.base_valid;
            share.base_collapsed += *fell;
        }
    }
    for (const ContactLaw& law : laws) {
        if (!law.study)
            continue;
        const PartRun run = run_part(Experiment(*law.study, study.motions()), options, indices, observer);
        if (observer.stop_requested())
            return share;
        PairedCollapses pairs = paired_collapses(plain, run); // the study first
        std::swap(pairs.first, pairs.second);
        pairs.difference = 0 - pairs.difference; // without -0
        share.laws.push_back({law.name, law.words, law.note, pairs, run.seconds});
    }
    return share;
}

std::string law_share_text(const LawShare& share, const NumericsCheck* numerics, const std::string& file)
{
    std::string text;
    if (share.measured()) {
        text = law_range_words(share.probabilities(), share.names());
        if (numerics)
            text += fmt::format("; numerics: {:+.3f} ± {:.3f}", numerics->difference, numerics->sd);
        text += fmt::format("; of the same {} realizations, collapse probability {:.3g} as given\n", share.realizations,
                            share.base_probability());
        for (const LawResult& law : share.laws) {
            if (law.pairs.realizations > 0)
                text += fmt::format("  {:<8} {:<50} {:.3g}, difference {:+.3f} ± {:.3f}; {:.2g} % end differently\n",
                                    law.name, law.words, law.probability(), law.pairs.difference, law.pairs.sd,
                                    100 * static_cast<double>(law.pairs.differ) /
                                        static_cast<double>(law.pairs.realizations));
            else
                text += fmt::format("  {:<8} {:<50} no valid realization\n", law.name, law.words);
            if (law.note)
                text += "           " + *law.note + "\n";
        }
    } else {
        text = "contact law: not measured. " + *share.why_none + "\n";
    }
    for (const std::string& law : share.left_out)
        text += "  left out: " + law + "\n";
    if (share.whole_run > 0)
        text += fmt::format("  Single cells may change more, with both signs. The band of each: stylobate run {} "
                            "--laws, about {:.2g} times the time of the run in addition.\n",
                            file, share.whole_run);
    return text;
}

Json law_share_json(const LawShare& share)
{
    Json json = Json::object();
    json.member("measured", share.measured()).member("left_out", Json::list(share.left_out));
    if (share.whole_run > 0)
        json.member("cost_of_the_whole_study", share.whole_run);
    if (!share.measured())
        return json.member("why_not", *share.why_none);
    Json laws = Json::list();
    for (const LawResult& law : share.laws)
        laws.item(Json::object()
                      .member("name", law.name)
                      .member("words", law.words)
                      .member("note", law.note.value_or(""))
                      .member("realizations", law.pairs.realizations)
                      .member("collapsed", law.pairs.first)
                      .member("collapse_probability", law.probability())
                      .member("difference", law.pairs.difference)
                      .member("its_standard_error", law.pairs.sd)
                      .member("end_differently", law.pairs.differ)
                      .member("seconds", law.seconds));
    json.member("realizations", share.realizations)
        .member("estimated_seconds", share.estimated_s)
        .member("as_given", share.base_probability());
    add_law_range(json, share.probabilities(), share.names());
    return json.member("laws", laws);
}

} // namespace stylobate
