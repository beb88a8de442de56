#include "studies/kinds/replicas/replicas.hpp"

#include "io/tables/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

std::string number(double value)
{
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : std::isnan(value) ? "–" : value > 0 ? "∞" : "-∞";
}

std::string percent(double share)
{
    return std::isfinite(share) ? fmt::format("{:.2g} %", 100 * share) : "–";
}

std::string interval(double lower, double upper)
{
    return fmt::format("{} to {}", number(lower), number(upper));
}

std::string interval(const Estimated& e)
{
    return interval(e.lower, e.upper);
}

std::string percents(double lower, double upper)
{
    return fmt::format("{:.2g} to {:.2g} %", 100 * lower, 100 * upper);
}

/// The smallest move at which the verdict of a cell is not certain, and in how many cells it is that one.
std::string lost_text(const Replicas& replicas)
{
    std::string text;
    for (std::size_t k = 0; k <= replicas.moves + 1; ++k) {
        const auto cells = std::count(replicas.lost_at.begin(), replicas.lost_at.end(), k);
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                            k < replicas.moves    ? fmt::format("{:g} m", replicas.kinds[k].kind.size)
                            : k == replicas.moves ? "none"
                                                  : too_few_pairs,
                            cells);
    }
    return text;
}

/// Where no verdict can be stated, and how many pairs it takes; nullopt where all can.
std::optional<std::string> open_text(const Replicas& replicas)
{
    std::uint64_t open = 0, all = 0;
    for (const KindDiscordance& kind : replicas.kinds) {
        open += kind.open;
        all += kind.open + kind.classes[0] + kind.classes[1] + kind.classes[2];
    }
    if (open == 0)
        return std::nullopt;
    return fmt::format("{} in {} of {} cells of all kinds of perturbed replicas ({} pairs in each). A cell without "
                       "a discordant pair needs {}, a cell at the edge of a class more: raise study.realizations.",
                       too_few_pairs, open, all, replicas.realizations, fewest_pairs());
}

/// In words, the growth of one displacement.
std::string growth_sentence(const Replicas& replicas, const ReplicaGrowth& growth)
{
    std::string text = fmt::format("{}: {} of {} pairs diverge; median growth {}/s ({}), median horizon {} s ({})",
                                   replicas.kinds[growth.kind].name, growth.pairs_lost, growth.pairs,
                                   number(growth.all_exponents_per_s.value), interval(growth.all_exponents_per_s),
                                   number(growth.all_horizons_s.value), interval(growth.all_horizons_s));
    if (growth.gained_s.count > 0)
        text +=
            fmt::format("; {} s ({}) longer than that of the next displacement where both diverge, {}/s",
                        number(growth.gained_s.value), interval(growth.gained_s), number(growth.gained_exponent_per_s));
    return text;
}

Json estimated_json(const Estimated& e)
{
    return Json::object()
        .member("count", e.count)
        .member("value", e.value)
        .member("lower", e.lower)
        .member("upper", e.upper);
}

void add_cell(CsvRow& row, const Replicas& replicas, std::size_t cell)
{
    const std::size_t np = replicas.pga_m_s2.size();
    row << cell << replicas.frequency_hz[cell / np] << replicas.pga_m_s2[cell % np] << replicas.probability[cell];
}

/// What the console shows, and the first part of the page.
void add_replicas(const Replicas& replicas, Document& page)
{
    HtmlTable table{"lrrrrrrrrr",
                    {"replica", "discordant", "share", "95 %", "relative", "95 %", "certain", "probable", "coin flip",
                     too_few_pairs},
                    {},
                    "Discordant pairs over all cells, relative to independent realizations, and cells by class"};
    for (const KindDiscordance& kind : replicas.kinds)
        table.rows.push_back({kind.name, fmt::format("{} of {}", kind.all.all.discordant, kind.all.all.trials),
                              percent(kind.all.all.probability), percents(kind.all.all.lower, kind.all.all.upper),
                              number(kind.all.ratio), interval(kind.all.lower, kind.all.upper),
                              fmt::format("{}", kind.classes[0]), fmt::format("{}", kind.classes[1]),
                              fmt::format("{}", kind.classes[2]), fmt::format("{}", kind.open)});
    page.table(table);
    if (const std::optional<std::string> open = open_text(replicas))
        page.box("warn", "Note", *open);
    page.paragraph(
        fmt::format("The smallest displacement at which the verdict is not certain, and the number of cells: {}.",
                    lost_text(replicas)));
    if (replicas.invalid_pairs > 0)
        page.note(fmt::format("{} pairs with an invalid member are omitted.", replicas.invalid_pairs));
    if (replicas.growth.empty())
        return;
    page.heading("Predictability horizon of the motion");
    std::vector<Html> items;
    for (const ReplicaGrowth& each : replicas.growth)
        items.emplace_back(growth_sentence(replicas, each) + ".");
    page.list(items);
}

} // namespace

std::string replicas_text(const Replicas& replicas)
{
    Document page;
    add_replicas(replicas, page);
    return console_text(page);
}

Json replicas_json(const Replicas& replicas)
{
    Json kinds = Json::list();
    for (const KindDiscordance& kind : replicas.kinds) {
        Json cells = Json::object();
        for (std::size_t i = 0; i < sureness_names.size(); ++i)
            cells.member(sureness_names[i], kind.classes[i]);
        cells.member(too_few_pairs, kind.open);
        kinds.item(Json::object()
                       .member("name", kind.name)
                       .member("pairs", kind.all.all.trials)
                       .member("flips", kind.all.all.discordant)
                       .member("probability", kind.all.all.probability)
                       .member("lower", kind.all.all.lower)
                       .member("upper", kind.all.all.upper)
                       .member("independent", kind.all.all.independent)
                       .member("ratio", kind.all.ratio)
                       .member("ratio_lower", kind.all.lower)
                       .member("ratio_upper", kind.all.upper)
                       .member("cells", cells));
    }
    Json lost_at = Json::list();
    for (std::size_t k = 0; k <= replicas.moves + 1; ++k) {
        Json lost = Json::object();
        lost.member("move_m", k < replicas.moves ? replicas.kinds[k].kind.size : std::nan(""))
            .member("known", k <= replicas.moves)
            .member("cells", std::count(replicas.lost_at.begin(), replicas.lost_at.end(), k));
        lost_at.item(lost);
    }
    Json growths = Json::list();
    for (const ReplicaGrowth& growth : replicas.growth)
        growths.item(Json::object()
                         .member("name", replicas.kinds[growth.kind].name)
                         .member("start", growth.start)
                         .member("pairs", growth.pairs)
                         .member("pairs_lost", growth.pairs_lost)
                         .member("median_exponent_per_s", estimated_json(growth.all_exponents_per_s))
                         .member("median_horizon_s", estimated_json(growth.all_horizons_s))
                         .member("gained_s", estimated_json(growth.gained_s))
                         .member("gained_exponent_per_s", growth.gained_exponent_per_s));
    return Json::object()
        .member("tolerance", replicas.tolerance)
        .member("invalid_pairs", replicas.invalid_pairs)
        .member("kinds", kinds)
        .member("lost_at", lost_at)
        .member("growth", growths);
}

void replicas_section(const Replicas& replicas, PageWriter& writer)
{
    Document& page = writer.page;
    page.section("Predictability of the verdict");
    page.paragraph(fmt::format(
        "Each of the {} realizations of a cell was repeated as perturbed replicas, which share all draws and differ in "
        "one quantity. A verdict (collapsed or not) is certain where fewer than {:g} % of the pairs are discordant, "
        "and a coin flip where more than {:g} % are (two independent tosses of a fair coin differ in 50 %). A class is "
        "assigned only where the 95 % interval of that share lies within it. Relative to independent: the share of "
        "discordant pairs over that of two independent realizations of the same cell. It is the fraction of the "
        "verdict's variance in a cell that is due to the quantity in which the replicas differ.",
        replicas.realizations, 100 * certain_below, 100 * coin_flip_above));
    writer.picture(
        "Predictability of the verdict: a map for each kind of perturbed replica, with contours of the "
        "probability of collapse.",
        [&](const std::filesystem::path& png) { plot_discordance(replicas, "Predictability of the verdict", png); });
    add_replicas(replicas, page);
    if (replicas.growth.empty())
        return;
    writer.picture(
        "Growth of the separation, and the predictability horizon of the motion.",
        [&](const std::filesystem::path& png) { plot_growth(replicas, "Predictability horizon of the motion", png); });
    page.note(fmt::format("{} pairs of each cell were tracked. Growth: slope of the logarithm of the separation over "
                          "time, from the first motion of the original. Horizon: the time until the replicas are {:g} "
                          "% of a drum's width apart (or as many radians); a pair that ends before is counted as one "
                          "that does not diverge. Medians over all pairs with the interval of order statistics.",
                          replicas.followed, 100 * replicas.tolerance));
}

std::string replicas_csv(const Replicas& replicas)
{
    std::string text = "cell,frequency_hz,pga_m_s2,collapse_probability,twin,pairs,flips,probability,lower,upper,"
                       "independent,class\n";
    for (std::size_t cell = 0; cell < replicas.probability.size(); ++cell)
        for (const KindDiscordance& kind : replicas.kinds) {
            const DiscordantShare& s = kind.cells[cell];
            CsvRow row(text);
            add_cell(row, replicas, cell);
            row << kind.name << s.trials << s.discordant << s.probability << s.lower << s.upper << s.independent
                << (s.verdict()    ? sureness_names[static_cast<std::size_t>(*s.verdict())]
                    : s.trials > 0 ? too_few_pairs
                                   : "");
        }
    return text;
}

std::string predictability_csv(const Replicas& replicas)
{
    std::string text = "cell,frequency_hz,pga_m_s2,collapse_probability,twin,lost,exponents,exponent_per_s,"
                       "exponent_lower,exponent_upper,horizons,horizon_s,horizon_lower_s,horizon_upper_s\n";
    for (std::size_t cell = 0; cell < replicas.probability.size(); ++cell)
        for (const ReplicaGrowth& each : replicas.growth) {
            const Estimated& e = each.exponent_per_s[cell];
            const Estimated& h = each.horizon_s[cell];
            CsvRow row(text);
            add_cell(row, replicas, cell);
            row << replicas.kinds[each.kind].name << each.lost[cell] << e.count << e.value << e.lower << e.upper
                << h.count << h.value << h.lower << h.upper;
        }
    return text;
}

} // namespace stylobate
