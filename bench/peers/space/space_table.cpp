#include "bench/peers/space/space_table.hpp"

#include "bench/peers/table.hpp"
#include "io/tables/table.hpp"
#include "studies/report/json.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate::peers {

std::vector<SpaceResult> run_in_space(const SpaceContender& contender)
{
    std::vector<SpaceResult> results;
    const SpaceScene column = space_column();
    for (const double dial : contender.dials) {
        SpaceResult r{contender, dial, contender.make(column, dial).step_s, space_cost_s(contender, column, dial), {}};
        for (const SpaceTrial& trial : space_trials())
            r.errors.push_back(trial.errors(contender, dial));
        results.push_back(std::move(r));
    }
    return results;
}

bool passes(const SpaceResult& result, std::size_t trial)
{
    const std::vector<double>& errors = result.errors[trial];
    return std::all_of(errors.begin(), errors.end(), [](double e) { return std::fabs(e) <= space_target; });
}

const SpaceResult* cheapest(const std::vector<SpaceResult>& results, const std::string& engine,
                            const std::vector<std::size_t>& trials)
{
    const SpaceResult* best = nullptr;
    for (const SpaceResult& r : results)
        if (r.contender.engine == engine && (best == nullptr || r.cost_s < best->cost_s) &&
            std::all_of(trials.begin(), trials.end(), [&](std::size_t t) { return passes(r, t); }))
            best = &r;
    return best;
}

namespace {

std::string percent_text(double error)
{
    if (!std::isfinite(error))
        return "none";
    return std::fabs(error) < 10 ? fmt::format("{:+.2f}", 100 * error) : fmt::format("{:+.1e}", 100 * error);
}

std::string dial_text(const SpaceResult& r)
{
    return r.contender.own ? fmt::format("k = {:.0e} N/m3, {:.2g} s", r.dial, r.step_s)
                           : fmt::format("1/{:.0f} s", 1 / r.step_s);
}

std::string cost_text(double cost_s)
{
    return fmt::format("{:.2g}", cost_s);
}

std::vector<std::string> engine_names(const std::vector<SpaceResult>& results)
{
    std::vector<std::string> names;
    for (const SpaceResult& r : results)
        if (std::find(names.begin(), names.end(), r.contender.engine) == names.end())
            names.push_back(r.contender.engine);
    return names;
}

/// One row for these trials together: the cheapest result of every engine that passes them.
std::string passed_row(const std::vector<SpaceResult>& results, const std::string& name,
                       const std::vector<std::size_t>& trials)
{
    std::string row = name;
    for (const std::string& engine : engine_names(results)) {
        const SpaceResult* best = cheapest(results, engine, trials);
        row += best == nullptr
                   ? " | none"
                   : fmt::format(" | {} ({}; {})", cost_text(best->cost_s), best->contender.setting, dial_text(*best));
    }
    return markdown_row("{}", row);
}

/// The trials of rocking on its own, which the rigid limit decides.
std::vector<std::size_t> rocking_trials()
{
    std::vector<std::size_t> found;
    for (std::size_t t = 0; t < space_trials().size(); ++t)
        if (space_trials()[t].name.starts_with("quarter period") || space_trials()[t].name.starts_with("overturning"))
            found.push_back(t);
    return found;
}

std::string passed_table(const std::vector<SpaceResult>& results)
{
    std::string head = "trial";
    for (const std::string& engine : engine_names(results))
        head += " | " + engine;
    std::string text = markdown_head(head);
    for (std::size_t t = 0; t < space_trials().size(); ++t)
        text += passed_row(results, space_trials()[t].name, {t});
    return text + passed_row(results, "quarter period and overturning together", rocking_trials());
}

std::string errors_table(const std::vector<SpaceResult>& results, std::size_t first, std::size_t last)
{
    std::string head = "engine | setting | step | cost";
    for (std::size_t t = first; t < last; ++t)
        for (const std::string& column : space_trials()[t].columns)
            head += fmt::format(" | {}: {}", space_trials()[t].name, column);
    std::string text = markdown_head(head);
    for (const SpaceResult& r : results) {
        std::string row = fmt::format("{} | {} | {} | {}", r.contender.engine, r.contender.setting, dial_text(r),
                                      cost_text(r.cost_s));
        for (std::size_t t = first; t < last; ++t)
            for (const double error : r.errors[t])
                row += " | " + percent_text(error);
        text += markdown_row("{}", row);
    }
    return text;
}

/// What the rigid limit costs Stylobate against the cheapest of the others.
std::string limit_text(const std::vector<SpaceResult>& results)
{
    const SpaceResult *own = cheapest(results, "Stylobate", rocking_trials()), *other = nullptr;
    for (const std::string& engine : engine_names(results))
        if (const SpaceResult* best = cheapest(results, engine, rocking_trials());
            engine != "Stylobate" && best != nullptr && (other == nullptr || best->cost_s < other->cost_s))
            other = best;
    const std::string limit =
        "The bodies of the trials are rigid, and Stylobate's beds are not: they tend to the rigid "
        "limit as they get stiffer, and the step gets shorter with the root of the stiffness. ";
    if (own == nullptr || other == nullptr)
        return limit + fmt::format("{} passes quarter period and overturning together.\n",
                                   own != nullptr     ? "No other engine that Debian packages"
                                   : other != nullptr ? "At the stiffnesses that were run Stylobate never"
                                                      : "No engine");
    return limit +
           fmt::format("For quarter period and overturning together a realization costs {:.2g} times that of {} "
                       "({}).\n",
                       own->cost_s / other->cost_s, other->contender.engine, other->contender.setting);
}

} // namespace

namespace {

/// Of the engines that people would look for here.
const char* const left_out =
    "Box2D and Chipmunk have no third dimension. Jolt, PhysX, Project Chrono, Rapier and Box3D are not in Debian 12. "
    "DART, whose solver is that of ODE, and Simbody are, and were not run.\n";

} // namespace

std::string space_markdown(const std::vector<SpaceResult>& results, const std::string& processor)
{
    std::string versions;
    for (const std::string& engine : engine_names(results))
        for (const SpaceResult& r : results)
            if (r.contender.engine == engine) {
                versions += fmt::format("{}{} {}", versions.empty() ? "" : ", ", engine, r.contender.version);
                break;
            }
    const std::size_t half = 6, count = space_trials().size();
    return fmt::format("One core of {}; {}.\n\n", processor, versions) +
           fmt::format("The least cost at which each engine is within {:g} % (ways: {:g} % of the length), among the "
                       "settings and steps that were run: seconds of processor time for one simulated second of a "
                       "column of six drums (of Stylobate that of one realization of a full register), in brackets the "
                       "setting and the step.\n\n",
                       100 * space_target, 100 * space_target) +
           passed_table(results) + '\n' + left_out + '\n' + limit_text(results) + "\nAll errors in per cent.\n\n" +
           errors_table(results, 0, half) + '\n' + errors_table(results, half, count);
}

std::string space_json(const std::vector<SpaceResult>& results, const std::string& processor)
{
    Json rows = Json::list();
    for (const SpaceResult& r : results) {
        Json errors = Json::object();
        for (std::size_t t = 0; t < space_trials().size(); ++t) {
            Json of_trial = Json::object();
            for (std::size_t k = 0; k < r.errors[t].size(); ++k)
                of_trial.member(space_trials()[t].columns[k], r.errors[t][k]);
            errors.member(space_trials()[t].name, of_trial);
        }
        rows.item(Json::object()
                      .member("engine", r.contender.engine)
                      .member("version", r.contender.version)
                      .member("setting", r.contender.setting)
                      .member(r.contender.own ? "stiffness_n_m3" : "step_s", r.dial)
                      .member("column_step_s", r.step_s)
                      .member("cost_s_per_s", r.cost_s)
                      .member("errors", errors));
    }
    return json_head(processor).member("results", rows).text() + '\n';
}

} // namespace stylobate::peers
