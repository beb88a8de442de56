#include "studies/diagnosis/decision/chance.hpp"

#include "io/files/atomic_file.hpp"
#include "io/files/toml_document.hpp"
#include "studies/diagnosis/decision/window_evidence.hpp"
#include "studies/diagnosis/ensemble_fit/virtual_campaign.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace stylobate {

namespace {

/// Campaigns that are simulated together: a bundle's lanes are full with their runs.
constexpr std::uint64_t together = 8;

/// Gains of one campaign, by channel and mechanism.
struct OneCampaign {
    std::string contacts;
    std::vector<CauseFit> balance, windows;
    std::vector<StructureFit> structures;
};

std::string line_of(const OneCampaign& one)
{
    std::string text = one.contacts;
    const auto list = [&](const char* channel, const std::vector<CauseFit>& fits) {
        ChanceGains gains;
        gains.add(channel == std::string("balance") ? Channel::balance : Channel::windows, fits);
        for (const auto& [key, values] : gains.gains())
            text += fmt::format("\t{}\t{}\t{:.17g}", channel, key.second, values.front());
    };
    list("balance", one.balance);
    list("windows", one.windows);
    text += fmt::format("\tbalance\tstructure\t{:.17g}", one.structures.empty() ? 0 : one.structures.front().gain);
    return text;
}

/// A line as above, back into gains. False: it is none.
bool take_line(const std::string& line, Chance& chance)
{
    std::vector<std::string> parts;
    std::stringstream in(line);
    for (std::string part; std::getline(in, part, '\t');)
        parts.push_back(part);
    if (parts.size() % 3 != 1 || parts.size() < 4)
        return false;
    std::vector<CauseFit> balance, windows;
    std::vector<StructureFit> structures;
    for (std::size_t k = 1; k + 2 < parts.size(); k += 3) {
        const char* number = parts[k + 2].c_str();
        char* end = nullptr;
        const double gain = std::strtod(number, &end);
        if (end == number || *end != '\0' || !std::isfinite(gain))
            return false;
        if (parts[k + 1] == "structure") {
            structures.push_back({{}, gain, 0, 0, {}});
            continue;
        }
        CauseFit fit;
        fit.cause.mechanism = parts[k + 1];
        fit.gain = gain;
        (parts[k] == "balance" ? balance : windows).push_back(fit);
    }
    chance.gains.add(Channel::balance, balance);
    chance.gains.add(Channel::windows, windows);
    chance.gains.add(structures);
    chance.contacts.push_back(parts.front());
    ++chance.campaigns;
    return true;
}

} // namespace

std::string chance_key(const Campaign& campaign, const Study& study, const ChanceOptions& options)
{
    return campaign_key(campaign, study, options.seed) + (options.windows ? " windows" : "");
}

Chance chance_of(const Campaign& campaign, const Study& study, const ChanceOptions& options,
                 const std::function<void(std::uint64_t done, std::uint64_t cached)>& told, Observer& observer)
{
    Chance out;
    const std::string key = "# stylobate chance gains " + chance_key(campaign, study, options);
    std::string text = key + "\n";
    if (!options.cache.empty()) {
        std::ifstream in(options.cache);
        std::string line;
        if (std::getline(in, line) && line == key)
            while (out.campaigns < options.campaigns && std::getline(in, line) &&
                   !in.eof() && // a line without its end is cut
                   take_line(line, out))
                text += line + "\n";
        out.cached = out.campaigns;
        if (out.cached > 0)
            told(out.campaigns, out.cached);
    }
    const TrackScales scales = track_scales(campaign);
    while (out.campaigns < options.campaigns) {
        const std::uint64_t count = std::min(together, options.campaigns - out.campaigns);
        const VirtualCampaigns made =
            virtual_campaigns(campaign, study, options.seed, out.campaigns, count, {}, {}, options.run, observer);
        out.simulations += made.simulations;
        out.block_steps += made.block_steps;
        if (!made.complete)
            return out;
        for (std::size_t c = 0; c < made.campaigns.size(); ++c) {
            const Campaign& one = made.campaigns[c];
            const DirectResult direct = direct_tests(one, scales);
            OneCampaign found;
            found.contacts = made.contacts[c];
            BalanceEvidence balance = balance_evidence(one, scales, direct.base_m);
            found.balance = std::move(balance.causes);
            found.structures = std::move(balance.structures);
            if (options.windows) {
                const WindowEvidence windows = window_evidence(one, study, scales, {}, true, options.run, observer);
                out.simulations += windows.simulations;
                out.window_simulations += windows.window_simulations;
                out.block_steps += windows.block_steps;
                if (!windows.complete)
                    return out;
                found.windows = windows.causes;
            }
            const std::string line = line_of(found);
            take_line(line, out);
            text += line + "\n";
            if (!options.cache.empty()) {
                AtomicFile file(options.cache);
                file.write(text);
                file.commit();
            }
            told(out.campaigns, out.cached);
        }
    }
    out.complete = true;
    return out;
}

} // namespace stylobate
