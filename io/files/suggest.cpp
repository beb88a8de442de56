#include "io/files/suggest.hpp"

#include <algorithm>
#include <array>

namespace stylobate {

namespace {

constexpr char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

} // namespace

std::size_t edit_distance(std::string_view a, std::string_view b)
{
    // three rows of the table are enough: a swap looks two rows back
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, now);
    }
    return last[b.size()];
}

std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& candidates)
{
    std::string small(word);
    std::transform(small.begin(), small.end(), small.begin(), lower);

    std::optional<std::string> best;
    std::size_t best_distance = 0;
    for (const auto& candidate : candidates) {
        const std::size_t allowed = std::max<std::size_t>(1, candidate.size() / 3);
        const std::size_t longer = std::max(small.size(), candidate.size());
        const std::size_t shorter = std::min(small.size(), candidate.size());
        if (longer - shorter > allowed)
            continue; // the distance is at least this; keeps absurdly long words cheap
        const std::size_t distance = edit_distance(small, candidate);
        if (distance <= allowed && (!best || distance < best_distance)) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string_view without_unit(std::string_view key)
{
    // a unit that ends in another one stands before it
    constexpr std::array<std::string_view, 11> units = {"_n_s_m", "_n_m_s", "_kg_m3", "_n_m2", "_m_s2", "_n_m",
                                                        "_rad",   "_hz",    "_kg",    "_m",    "_s"};
    for (const auto unit : units)
        if (key.size() > unit.size() && key.substr(key.size() - unit.size()) == unit)
            return key.substr(0, key.size() - unit.size());
    return key;
}

std::optional<std::string> meant_key(std::string_view key, const std::vector<std::string>& known)
{
    // the longest stem wins, so that normal_damping_x is not taken for a shorter name that begins alike
    std::optional<std::string> best;
    for (const auto& candidate : known) {
        const auto stem = without_unit(candidate);
        if (stem.size() == candidate.size() || key.substr(0, stem.size()) != stem)
            continue;
        const bool same_name = key.size() == stem.size() || key[stem.size()] == '_';
        if (same_name && (!best || stem.size() > without_unit(*best).size()))
            best = candidate;
    }
    if (!best)
        best = nearest_word(key, known);
    return best ? best : nearest_word(without_unit(key), known);
}

std::string counted(std::uint64_t n, std::string_view noun)
{
    return std::to_string(n) + " " + std::string(noun) + (n == 1 ? "" : "s");
}

} // namespace stylobate
