/// Checks of tests of single joints, and of the laboratory that does them.

#include "ensemble/model/input_error.hpp"
#include "io/measured/measured_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace stylobate {
namespace {

class TestChecks {
public:
    TestChecks(const Campaign& campaign, const MeasuredRun& run)
        : campaign_(campaign), specimen_(campaign.specimen), run_(run)
    {
    }

    void check() const
    {
        check_joints();
        check_blocks();
        check_taped();
        check_dummies();
        check_tilt();
        for (const ForceGauge& gauge : run_.forces)
            check_gauge(gauge);
        check_needs();
        check_seen();
        if (run_.released_s && !(std::abs(*run_.released_s) < 1e7))
            refuse(fmt::format("released_s = {:g} is no time.\n  Seconds of the cameras' clock.", *run_.released_s));
    }

private:
    [[noreturn]] void refuse(const std::string& text) const
    {
        throw InputError(campaign_.source, 0, fmt::format("run {}: {}", run_.name, text));
    }
    int blocks() const { return static_cast<int>(block_count(campaign_)); }
    int joints() const { return static_cast<int>(specimen_.joints.size()); }

    void check_joint(int joint, const char* key) const
    {
        if (joint < 0 || joint >= joints())
            refuse(
                fmt::format("{} names joint {}, which does not exist: {}.\n  Joints are counted from 0, in the order "
                            "of specimen/joints.",
                            key, joint,
                            joints() > 0 ? fmt::format("the joints are 0 to {}", joints() - 1)
                                         : std::string("specimen/joints is absent or empty")));
    }

    void check_joints() const
    {
        if (run_.joint)
            check_joint(*run_.joint, "joint");
        for (const int joint : run_.clamped)
            check_joint(joint, "clamped");
        if (run_.joint && std::ranges::find(run_.clamped, *run_.joint) != run_.clamped.end())
            refuse(fmt::format("joint {} is under test and clamped.\n  Clamp the joints below it alone.", *run_.joint));
    }

    void check_block(int block, const char* key) const
    {
        if (block < 0 || block >= blocks())
            refuse(fmt::format("{} names block {}, which does not exist: the blocks are 0 to {}.\n  Blocks are counted "
                               "from 0.",
                               key, block, blocks() - 1));
        if (!run_.has(block))
            refuse(fmt::format("{} names block {}, which is not among the blocks present.\n  Add it to present, or "
                               "name another one.",
                               key, block));
    }

    void check_blocks() const
    {
        for (const int block : run_.present)
            check_block(block, "present");
        if (run_.joint)
            check_block(specimen_.joints[static_cast<std::size_t>(*run_.joint)].second, "the tested joint");
    }

    /// A group hangs together by joints between its own blocks.
    void check_taped() const
    {
        std::set<int> seen;
        for (const std::vector<int>& group : run_.taped) {
            if (group.size() < 2)
                refuse("a group of taped has fewer than two blocks.\n  Name all blocks that move as one.");
            for (const int block : group) {
                check_block(block, "taped");
                if (!seen.insert(block).second)
                    refuse(fmt::format("taped names block {} twice.\n  A block is in one group; join the groups if "
                                       "all of them move as one.",
                                       block));
            }
            std::set<int> reached = {group.front()};
            const std::set<int> all(group.begin(), group.end());
            for (bool grown = true; grown;) {
                grown = false;
                for (const auto& [lower, upper] : specimen_.joints)
                    if (all.contains(lower) && all.contains(upper) &&
                        reached.contains(lower) != reached.contains(upper))
                        grown = reached.insert(lower).second + reached.insert(upper).second > 0;
            }
            for (const int block : group)
                if (!reached.contains(block))
                    refuse(fmt::format("taped joins blocks {} and {}, but no joint of the group connects them: they "
                                       "are not adjacent.\n  Name the blocks between them too, or correct the group.",
                                       group.front(), block));
        }
    }

    void check_dummies() const
    {
        for (const Dummy& dummy : run_.dummies) {
            check_block(dummy.block, "dummies");
            if (!(dummy.mass_kg > 0 && dummy.mass_kg <= 1e7))
                refuse(
                    fmt::format("the dummy on block {} has mass_kg = {:g}.\n  Weigh it: a dummy without a mass is no "
                                "known body.",
                                dummy.block, dummy.mass_kg));
            for (const auto& [name, value] :
                 {std::pair("half_width_m", dummy.half_width_m), std::pair("half_height_m", dummy.half_height_m)})
                if (!(value > 0 && value <= 20))
                    refuse(fmt::format("the dummy on block {} has {} = {:g}, outside (0, 20].\n  Units are SI, and "
                                       "sizes are half sizes.",
                                       dummy.block, name, value));
            if (!(std::abs(dummy.x_m) <= 20 && std::abs(dummy.y_m) <= 40))
                refuse(fmt::format("the dummy on block {} has its centre {:g} m to the right and {:g} m above that of "
                                   "the block.\n  Units are SI.",
                                   dummy.block, dummy.x_m, dummy.y_m));
        }
    }

    void check_tilt() const
    {
        for (const double tilt : run_.base_tilt_rad.values)
            if (std::abs(tilt) > std::numbers::pi / 2)
                refuse(fmt::format("base/tilt_rad has the value {:g}, more than a right angle.\n  It looks like "
                                   "degrees: give the unit deg (attribute unit, or the column base_tilt_deg). Did you "
                                   "mean {:.4g}?",
                                   tilt, tilt * std::numbers::pi / 180));
    }

    /// Of the block and what is taped on it, above the block's lower face.
    double top_m(int block) const
    {
        const auto b = static_cast<std::size_t>(block);
        if (b >= specimen_.half_height_m.size())
            return std::numeric_limits<double>::infinity();
        double top = 2 * specimen_.half_height_m[b];
        for (const Dummy& dummy : run_.dummies)
            if (dummy.block == block)
                top = std::max(top, specimen_.half_height_m[b] + dummy.y_m + dummy.half_height_m);
        return top;
    }

    void check_gauge(const ForceGauge& gauge) const
    {
        const std::string name = "force/" + gauge.name;
        check_block(gauge.block, name.c_str());
        constexpr double slack = 1.001;
        if (!(gauge.height_m >= 0 && gauge.height_m <= slack * top_m(gauge.block)))
            refuse(
                fmt::format("{} has height_m = {:g}, but the body on which it acts reaches from 0 to {:.4g} m.\n  It "
                            "is the height above the lower face of block {}. Units are SI. Did you mean {:.4g}?",
                            name, gauge.height_m, top_m(gauge.block), gauge.block, gauge.height_m / 1000));
        for (const GaugeNumber& number : gauge_numbers())
            if (const double value = gauge.*number.member; !(value >= number.low && value <= number.high))
                refuse(fmt::format("{} has {} = {:g}, outside [{:g}, {:g}].\n  Units are SI.", name, number.name, value,
                                   number.low, number.high));
        const std::vector<double>& values = gauge.value_n.values;
        if (!values.empty() && std::ranges::all_of(values, [](double x) { return std::isnan(x); }))
            refuse(fmt::format("{}/value_n is NaN everywhere.\n  Omit it where nothing was measured.", name));
        for (const double value : values)
            if (const double largest = largest_of_series(Dimension::force); std::abs(value) > largest)
                refuse(fmt::format("{}/value_n has the value {:g}, beyond {:g} N.\n  Units are SI.", name, value,
                                   largest));
        if (gauge.value_n.noise_sd && !(*gauge.value_n.noise_sd >= 0 && *gauge.value_n.noise_sd < 1e6))
            refuse(fmt::format("{}: noise_sd = {:g} is not a valid deviation.\n  It is one standard deviation, in the "
                               "unit of the values.",
                               name, *gauge.value_n.noise_sd));
    }

    /// Whether blocks were seen while hands did not hold them: a plan has no such samples.
    bool measured() const
    {
        const std::size_t n = block_count(campaign_);
        for (const SeriesName& name : series_names())
            for (std::size_t k = 0; name.per_block && k < name.in(run_).values.size(); ++k)
                if (!std::isnan(name.in(run_).values[k]) &&
                    !(run_.released_s && run_.time_s[k / n] <= *run_.released_s))
                    return true;
        return false;
    }

    void check_needs() const
    {
        const RunKind kind = run_.test;
        if (kind != RunKind::shake && kind != RunKind::rest && !run_.joint)
            refuse(fmt::format("kind = \"{}\" is a test of a joint, but joint is absent.\n  Name the joint under test.",
                               to_string(kind)));
        if (kind != RunKind::shake && kind != RunKind::rest && run_.time_s.empty())
            refuse("there are no samples.\n  Give rows with what was measured, or in a plan with what the laboratory "
                   "shall "
                   "do.");
        const bool forced = kind == RunKind::pull || kind == RunKind::push;
        if (forced && run_.forces.empty())
            refuse(fmt::format("kind = \"{}\" needs the force on the block, but there is no gauge.\n  Add force/NAME "
                               "with block, height_m and value_n (in campaign.toml a [[run.force]], and its column).",
                               to_string(kind)));
        if (forced && measured() && std::ranges::all_of(run_.forces, [](const auto& g) { return g.value_n.empty(); }))
            refuse(fmt::format("kind = \"{}\" needs the force on the block, but force/{}/value_n is absent.\n  Add it "
                               "(of a folder the column force_{}_n).",
                               to_string(kind), run_.forces.front().name, run_.forces.front().name));
        if ((kind == RunKind::board || kind == RunKind::tilt) && run_.base_tilt_rad.empty())
            refuse(
                fmt::format("kind = \"{}\" needs the tilt of the board, but base/tilt_rad is absent.\n  Add it (of a "
                            "folder the column base_tilt_rad or base_tilt_deg).",
                            to_string(kind)));
    }

    bool is_clamped(int block) const
    {
        return std::ranges::any_of(
            run_.clamped, [&](int j) { return specimen_.joints[static_cast<std::size_t>(j)].second == block; });
    }

    /// Blocks that are seen but not present, or present but never seen; of those that are clamped nobody need see.
    void check_seen() const
    {
        if (run_.present.empty() || !measured())
            return;
        const std::size_t n = block_count(campaign_);
        for (int block = 0; block < blocks(); ++block) {
            const char* seen = nullptr;
            for (const SeriesName& name : series_names())
                for (std::size_t k = static_cast<std::size_t>(block);
                     name.per_block && !seen && k < name.in(run_).values.size(); k += n)
                    if (!std::isnan(name.in(run_).values[k]))
                        seen = name.path;
            if (seen && !run_.has(block))
                refuse(fmt::format("{} has values of block {}, which is not among the blocks present.\n  Add it to "
                                   "present, or remove its columns (NaN).",
                                   seen, block));
            if (!seen && run_.has(block) && !is_clamped(block))
                refuse(fmt::format("block {} is present but was never seen.\n  Remove it from present, or give its "
                                   "series.",
                                   block));
        }
    }

    const Campaign& campaign_;
    const Specimen& specimen_;
    const MeasuredRun& run_;
};

} // namespace

void check_tests(const Campaign& campaign)
{
    for (const MeasuredRun* run : every_run(campaign))
        TestChecks(campaign, *run).check();
}

void check_laboratory(const Campaign& campaign)
{
    const Laboratory& laboratory = campaign.laboratory;
    for (const LaboratoryNumber& number : laboratory_numbers())
        if (const auto& value = laboratory.*number.member; value && !(*value >= 0 && *value <= number.largest))
            throw InputError(campaign.source, 0,
                             fmt::format("laboratory: {} = {:g} is outside [0, {:.4g}].\n  Units are SI; 0: there is "
                                         "none.",
                                         number.name, *value, number.largest));
    for (const auto& [kind, cost] : laboratory.cost)
        if (!(cost > 0 && cost <= 1e9))
            throw InputError(
                campaign.source, 0,
                fmt::format("laboratory: {} = {:g} is outside (0, 1e9].\n  Costs are in any unit, the same "
                            "for all kinds.",
                            cost_key(kind), cost));
}

} // namespace stylobate
