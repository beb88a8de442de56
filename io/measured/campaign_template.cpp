#include "io/measured/campaign_template.hpp"

#include <fmt/format.h>

#include <vector>

namespace stylobate {

namespace {

constexpr int column_blocks = 4;

/// A column of a table: its name as a tracking program may have it, and the name of the format.
struct NamedColumn {
    std::string theirs, ours;
};

bool tests_a_joint(RunKind kind)
{
    return kind != RunKind::shake && kind != RunKind::rest;
}

bool has_rod(RunKind kind)
{
    return kind == RunKind::pull || kind == RunKind::push;
}

/// With two dummies taped on, a block turns about a corner before it slides.
bool has_dummies(RunKind kind)
{
    return kind == RunKind::tilt || kind == RunKind::push || kind == RunKind::drop;
}

/// What the laboratory does, for blocks of 48 x 29 mm. Lengths scale with the blocks' size s, times with sqrt(s).
const char* procedure(RunKind kind)
{
    switch (kind) {
    case RunKind::shake:
        return "# Shake runs: the table shakes the whole column, which stands free. Several motions, each at least\n"
               "# twice, the column put back by hand between them. One [[run]] and one table for each run.\n";
    case RunKind::pull:
        return "# Pull: the blocks below the joint are clamped, one block stands on it. A rod from the laboratory "
               "holds\n"
               "# that block by a force gauge, at a quarter of its height. The table rests for 2 s, then cycles by\n"
               "# +-8 mm: two cycles at 14 mm/s, three at 60 mm/s, two at 14 mm/s. One run for each joint.\n";
    case RunKind::board:
        return "# Board: the blocks below the joint are clamped to a board, one block stands on it. The board is "
               "tilted\n"
               "# from 0 to 40 degrees at 2 degrees/s. Two runs for each joint: to the left, and to the right.\n";
    case RunKind::tilt:
        return "# Tilt: the blocks below the joint are clamped to a board. On it stands a block with two dummies "
               "taped\n"
               "# on top, which turns about a corner before it slides. From 0 to 40 degrees at 2 degrees/s. Two runs\n"
               "# for each joint: to the left, and to the right.\n";
    case RunKind::push:
        return "# Push: the blocks below the joint are clamped. On it stands a block with two dummies taped on top. A "
               "rod\n"
               "# on the table pushes the top dummy by a force gauge, at 4 mm/s, for 10 mm. Two runs for each joint:\n"
               "# from the left, and from the right.\n";
    case RunKind::drop:
        return "# Drop: the blocks below the joint are clamped. A block with two dummies taped on top hangs 3 mm above "
               "its\n"
               "# place by a thread, and is released. Six runs for each joint.\n";
    case RunKind::slide:
        return "# Slide: the blocks below the joint are clamped, one block stands on it. The table moves by +-17 mm "
               "at\n"
               "# 4 Hz (10.7 m/s2) for 3 s, and the block slides. One run for each joint.\n";
    case RunKind::rest:
        return "# Rest: callipers, two scales and inked beds give the three lists at the end of [specimen]. Nothing "
               "moves: the\n"
               "# run needs no table. With the joint, runs/NAME.csv may have what the cameras saw of the block that "
               "lies there.\n";
    }
    return "";
}

std::vector<NamedColumn> columns_of(RunKind kind)
{
    if (kind == RunKind::rest)
        return {};
    std::vector<NamedColumn> columns = {{"Time [s]", "time_s"}};
    if (kind == RunKind::shake)
        columns.push_back({"Table acceleration [m/s2]", "base_acceleration_m_s2"});
    if (kind == RunKind::shake || kind == RunKind::pull || kind == RunKind::slide)
        columns.push_back({"Table [mm]", "base_displacement_mm"});
    if (kind == RunKind::board || kind == RunKind::tilt)
        columns.push_back({"Board [deg]", "base_tilt_deg"});
    if (has_rod(kind))
        columns.push_back({"Rod [N]", "force_rod_n"});
    const int seen = kind == RunKind::shake ? column_blocks : 2;
    for (int block = 0; block < seen; ++block)
        for (const auto& [theirs, ours] : {NamedColumn{"X [mm]", "x{}_mm"}, NamedColumn{"Y [mm]", "y{}_mm"},
                                           NamedColumn{"angle [deg]", "theta{}_deg"}})
            columns.push_back({fmt::format("Marker{} {}", block, theirs), fmt::format(fmt::runtime(ours), block)});
    return columns;
}

constexpr const char* specimen_text = R"([campaign]
format = "stylobate-measured"
format_version = 2
specimen = "small column"
gravity_m_s2 = 9.81

[specimen]                                  # blocks and joints are counted from 0, from the base upwards
half_width_m = [0.024, 0.024, 0.024, 0.024]
half_height_m = [0.0145, 0.0145, 0.0145, 0.0145]
depth_m = [0.048, 0.048, 0.048, 0.048]      # whole depth
mass_kg = [0.135, 0.135, 0.135, 0.135]
rest_x_m = [0.0, 0.0, 0.0, 0.0]             # centres
rest_y_m = [0.0145, 0.0435, 0.0725, 0.1015] # above the table
joints = [[-1, 0], [0, 1], [1, 2], [2, 3]]  # lower block (-1: the base), upper block
mass_tolerance = 0.003                      # 1 sigma, relative
width_tolerance = 0.001                     # 1 sigma, relative
placement_tolerance_m = 0.0002              # 1 sigma
)";

constexpr const char* at_rest_text =
    R"({0}centre_of_mass_m = [0.0, 0.0, 0.0, 0.0]      # of each block, from its geometric centre to the right; nan: not measured
{0}bearing_left_m = [0.0, 0.0, 0.0, 0.0]        # of each joint: where it begins to carry, from the upper block's left edge
{0}bearing_right_m = [0.0, 0.0, 0.0, 0.0]       # from its right edge

[laboratory]                                # omit what is not known; 0: there is none
# stroke_m = 0.02                           # of the table, to either side
# speed_m_s = 0.5
# acceleration_m_s2 = 20.0
# tilt_rad = 0.7                            # of a board
# force_n = 5.0                             # of the force gauge
may_dismantle = true                        # whether blocks may be removed, clamped and taped
# cost_pull = 2.0                           # of one test of a kind, in any unit: cost_board, cost_tilt, ...
)";

std::string run_text(RunKind kind, const std::string& name)
{
    std::string text =
        fmt::format("\n{}[[run]]\nname = \"{}\"\nkind = \"{}\"\n", procedure(kind), name, to_string(kind));
    if (kind == RunKind::shake)
        text += "motion = \"harmonic\"                         # of the table, in any word\n"
                "motion_id = 0                               # runs with the same one repeat one motion\n"
                "repeat = 0\n"
                "collapsed = false\n";
    if (tests_a_joint(kind))
        text += "joint = 1                                   # under test\n"
                "present = [0, 1]                            # blocks on the table\n"
                "clamped = [0]                               # joints that cannot move: those below\n"
                "# taped = [[2, 3]]                          # groups of blocks that move as one\n";
    if (kind == RunKind::drop)
        text += "released_s = 0.2                            # by the clock of its samples: hands hold the block until "
                "then\n";
    if (kind != RunKind::rest)
        text += "noise_x_m = 0.00005                         # 1 sigma of the cameras; omit what is not known\n"
                "noise_y_m = 0.00005\n"
                "noise_theta_rad = 0.001\n";
    if (kind == RunKind::board || kind == RunKind::tilt)
        text += "noise_base_tilt_rad = 0.0005\n";
    if (has_dummies(kind))
        for (const char* above : {"0.029", "0.058"})
            text += fmt::format("\n[[run.dummy]]                               # taped on the block\n"
                                "block = 1\n"
                                "mass_kg = 0.135\n"
                                "half_width_m = 0.024\n"
                                "half_height_m = 0.0145\n"
                                "y_m = {}                                 # its centre above that of the block\n",
                                above);
    if (has_rod(kind)) {
        const bool pushes = kind == RunKind::push;
        text += fmt::format("\n[[run.force]]\n"
                            "name = \"rod\"                                # its column is force_rod_n\n"
                            "block = 1                                   # on which it acts\n"
                            "height_m = {:<32} # above the block's lower face\n"
                            "to = {:<38} # where the rod's other end is: \"laboratory\" or \"table\"\n"
                            "speed_m_s = {:<31} # of that end, positive to the right; 0: held\n"
                            "stiffness_n_m = 2e4                         # of rod and gauge; 0: not known\n"
                            "gain_sd = 0.005                             # 1 sigma, relative\n"
                            "noise_n = 0.02                              # 1 sigma\n",
                            pushes ? "0.0783" : "0.00725", pushes ? "\"table\"" : "\"laboratory\"",
                            pushes ? "0.004" : "0.0");
    }
    return text;
}

} // namespace

CampaignTemplate campaign_template(RunKind kind)
{
    CampaignTemplate made;
    made.run = fmt::format("{}_1", to_string(kind));
    made.toml = specimen_text + fmt::format(fmt::runtime(at_rest_text), kind == RunKind::rest ? "" : "# ");
    const std::vector<NamedColumn> columns = columns_of(kind);
    if (!columns.empty())
        made.toml +=
            "\n# The names in the first line of your tables, and what they are. The unit is that of the values. A "
            "column\n"
            "# with \"ignore\" is not read. Without this table the names on the right stand in the first line.\n"
            "[columns]\n";
    for (const auto& [theirs, ours] : columns) {
        made.toml += fmt::format("\"{}\" = \"{}\"\n", theirs, ours);
        made.header += (made.header.empty() ? "" : ",") + theirs;
    }
    made.toml += run_text(kind, made.run);
    return made;
}

} // namespace stylobate
