#include "studies/diagnosis/decision/chance.hpp"

#include "io/files/atomic_file.hpp"
#include "io/files/toml_document.hpp"
#include "io/store/result_seal.hpp"
#include "studies/diagnosis/decision/virtual_campaign.hpp"
#include "studies/diagnosis/decision/window_evidence.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace stylobate {

namespace {

/// Campaigns that are simulated together: a bundle's lanes are full with their runs.
constexpr std::uint64_t together = 8;

std::uint32_t crc(const std::vector<double>& values, std::uint32_t before)
{
    return crc32_of(std::as_bytes(std::span(values)), before);
}

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
    const Specimen& s = campaign.specimen;
    std::uint32_t sum = 0;
    for (const auto* values : {&s.half_width_m, &s.half_height_m, &s.depth_m, &s.mass_kg, &s.rest_x_m, &s.rest_y_m})
        sum = crc(*values, sum);
    sum = crc({s.gravity_m_s2, s.friction_nominal.value_or(-1), s.mass_tolerance, s.width_tolerance,
               s.placement_tolerance_m, s.base_block_half_width_m.value_or(-1), s.base_block_top_m},
              sum);
    for (const auto& [lower, upper] : s.joints)
        sum = crc({static_cast<double>(lower), static_cast<double>(upper)}, sum);
    for (const MeasuredRun& run : campaign.runs) {
        sum = crc(run.time_s, sum);
        sum = crc(run.base_displacement_m.values, sum);
        sum = crc(run.base_acceleration_m_s2.values, sum);
        sum = crc({run.blocks.x_m.noise_sd.value_or(-1), run.blocks.y_m.noise_sd.value_or(-1),
                   run.blocks.theta_rad.noise_sd.value_or(-1)},
                  sum);
    }
    const ContactSpec& c = study.contact;
    sum = crc({c.normal_stiffness_n_m2, c.tangential_stiffness_n_m, c.friction, static_cast<double>(options.seed),
               options.windows ? 1.0 : 0.0},
              sum);
    return fmt::format("{} {:08x}", code_version(), sum);
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
