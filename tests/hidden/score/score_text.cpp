#include "io/tables/table.hpp"
#include "tests/hidden/score/score.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace stylobate::hidden {

namespace {

std::string share(const Share& of)
{
    if (of.of == 0)
        return "none to judge";
    const BinomialInterval interval = of.interval();
    return fmt::format("{} of {}, {:.0f} % ({:.0f} to {:.0f} %)", of.count, of.of, 100 * of.value(),
                       100 * interval.lower, 100 * interval.upper);
}

} // namespace

std::string markdown(const Score& score)
{
    std::string text = fmt::format("{} campaigns were diagnosed", score.campaigns);
    if (!score.missing.empty()) {
        text += fmt::format("; {} were not, and count nowhere: seeds", score.missing.size());
        for (const std::uint64_t seed : score.missing)
            text += fmt::format(" {}", seed);
    }
    text += ".\n\n| hidden |";
    for (int j = 0; j < judgements; ++j)
        text += fmt::format(" {} |", name_of(static_cast<Judgement>(j)));
    text += " campaigns |\n|---|";
    for (int j = 0; j <= judgements; ++j)
        text += "---:|";
    text += "\n";
    for (int g = 0; g < groups; ++g) {
        text += fmt::format("| {} |", name_of(static_cast<Group>(g)));
        int all = 0;
        for (int j = 0; j < judgements; ++j) {
            const int count = score.counts[static_cast<std::size_t>(g)][static_cast<std::size_t>(j)];
            all += count;
            text += fmt::format(" {} |", count);
        }
        text += fmt::format(" {} |\n", all);
    }

    text += "\n" + markdown_head("measure | value");
    text += markdown_row("points (a hit 1, in a set or one of two 0.5) | {} of {}", score.points, score.to_find);
    text += markdown_row("false alarms | {}", share(score.false_alarms));
    text += markdown_row("of these with a name | {}", share(score.named_alarms));
    text += markdown_row("right place, where the name is right | {}", share(score.places));
    text += markdown_row("sizes within their interval | {}", share(score.coverage));
    if (score.other_parameter > 0)
        text += markdown_row("sizes of another parameter, not compared | {}", score.other_parameter);
    text += markdown_row("stated causes that are there, also beside the first one | {}", share(score.stated));
    if (score.stated.of > 0)
        text += markdown_row("Brier score of {} stated causes | {:.3f}", score.stated.of, score.brier);
    if (score.campaigns > 0)
        text += markdown_row("time of a diagnosis, mean | {:.0f} s", score.seconds / score.campaigns);
    text += "\nIntervals are Jeffreys', 95 %.\n";

    text += "\n| stated probability | causes | mean stated | right | 95 % |\n|---|---:|---:|---:|---|\n";
    for (const ReliabilityBin& bin : score.reliability) {
        const Share right{bin.causes, bin.right};
        const BinomialInterval interval = right.interval();
        text += bin.causes == 0
                    ? markdown_row("{:.1f} to {:.1f} | 0 | | |", bin.from, bin.to)
                    : markdown_row("{:.1f} to {:.1f} | {} | {:.2f} | {:.2f} | {:.2f} to {:.2f}", bin.from, bin.to,
                                   bin.causes, bin.mean_probability, right.value(), interval.lower, interval.upper);
    }

    text += "\n" + markdown_head("strength of a single effect over scatter | campaigns | hits", Align::numbers);
    double from = 0;
    for (const auto& [limit, hits] : score.by_strength) {
        text += std::isinf(limit) ? fmt::format("| {} and above |", from) : fmt::format("| {} to {} |", from, limit);
        text += fmt::format(" {} | {} |\n", hits.of, hits.count);
        from = limit;
    }

    std::set<std::string> said;
    for (const auto& [hidden, row] : score.confusion)
        for (const auto& [name, count] : row)
            said.insert(name);
    text += "\n| hidden \\ said |";
    for (const std::string& name : said)
        text += fmt::format(" {} |", name);
    text += "\n|---|";
    for (std::size_t i = 0; i < said.size(); ++i)
        text += "---:|";
    text += "\n";
    for (const auto& [hidden, row] : score.confusion) {
        text += fmt::format("| {} |", hidden);
        for (const std::string& name : said)
            text += row.contains(name) ? fmt::format(" {} |", row.at(name)) : " |";
        text += "\n";
    }
    return text;
}

} // namespace stylobate::hidden
