/// The house keeps its own rules: includes go one way (kernels <- ensemble <- studies, io beside), every header has its
/// guard, no file grows past 600 lines, and no text names the machine that it was written on.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path root = STYLOBATE_SOURCE_DIR;

// ---- the rules ------------------------------------------------------------------------------------------------------

/// The rooms of each floor and which rooms of the same floor each may include; no cycle, which a test sees to. A room
/// is one noun: a folder with all that lies in it. The folders inside a room are its parts, which may include each
/// other as long as they make no cycle either.
const std::map<std::string, std::set<std::string>> rooms = {
    {"kernels", {}},

    {"ensemble/numerics", {}},
    {"ensemble/model", {"ensemble/numerics"}},
    {"ensemble/motion", {"ensemble/model", "ensemble/numerics"}},
    {"ensemble/realization", {"ensemble/model"}},
    {"ensemble/engine", {"ensemble/model", "ensemble/motion", "ensemble/numerics"}},
    {"ensemble/planar", {"ensemble/engine", "ensemble/model", "ensemble/numerics", "ensemble/realization"}},
    {"ensemble/spatial",
     {"ensemble/engine", "ensemble/model", "ensemble/motion", "ensemble/numerics", "ensemble/realization"}},
    {"ensemble/sampling",
     {"ensemble/model", "ensemble/motion", "ensemble/numerics", "ensemble/planar", "ensemble/spatial"}},
    {"ensemble", {"ensemble/model", "ensemble/motion", "ensemble/planar", "ensemble/sampling"}},
    {"ensemble/run",
     {"ensemble", "ensemble/engine", "ensemble/model", "ensemble/numerics", "ensemble/planar", "ensemble/spatial"}},
    {"ensemble/tracking",
     {"ensemble/engine", "ensemble/model", "ensemble/numerics", "ensemble/planar", "ensemble/realization",
      "ensemble/run"}},
    {"ensemble/replicas",
     {"ensemble", "ensemble/engine", "ensemble/model", "ensemble/numerics", "ensemble/planar", "ensemble/run"}},
    {"ensemble/estimators", {"ensemble/model", "ensemble/numerics"}},

    {"io/files", {}},
    {"io/tables", {"io/files"}},
    {"io/hazard", {"io/files", "io/tables"}},
    {"io/records", {"io/files"}},
    {"io/measured", {"io/files", "io/records", "io/store"}},
    {"io/keys", {"io/files"}},
    {"io/study", {"io/files", "io/hazard", "io/keys", "io/records"}},
    {"io/store", {"io/files", "io/tables"}},
    {"io/plots", {"io/files", "io/store", "io/tables"}},

    {"studies", {}},
    {"studies/report", {"studies"}},
    {"studies/reference", {"studies/report"}},
    {"studies/usage", {}},
    {"studies/experiment", {"studies"}},
    {"studies/kinds", {"studies/experiment", "studies/report"}},
    {"studies/check", {"studies/experiment", "studies/kinds", "studies/report"}},
    {"studies/cluster", {"studies/experiment"}},
    {"studies/results", {"studies/cluster", "studies/experiment", "studies/kinds", "studies/report"}},
    {"studies/verify", {"studies", "studies/experiment", "studies/kinds", "studies/report", "studies/results"}},
    {"studies/decisions", {"studies", "studies/experiment", "studies/kinds", "studies/report", "studies/results"}},
    {"studies/measured", {"studies", "studies/report"}},
    {"studies/workflow",
     {"studies", "studies/check", "studies/cluster", "studies/decisions", "studies/experiment", "studies/kinds",
      "studies/measured", "studies/report", "studies/results"}},
    {"studies/cli",
     {"studies", "studies/cluster", "studies/decisions", "studies/experiment", "studies/measured", "studies/reference",
      "studies/report", "studies/results", "studies/usage", "studies/verify", "studies/workflow"}},

    {"studies/evidence/picture", {}},
    {"studies/evidence/claims",
     {"studies", "studies/evidence/picture", "studies/experiment", "studies/kinds", "studies/report",
      "studies/workflow"}},
    {"studies/evidence/verification", {"studies", "studies/evidence/picture"}},
    {"studies/evidence/measured",
     {"studies", "studies/evidence/picture", "studies/evidence/verification", "studies/workflow"}},

    {"library", {}},
};

/// Floors below, which every room of a floor may include. Who is not listed here may include everything.
const std::map<std::string, std::set<std::string>> floors_below = {
    {"kernels", {}},
    {"ensemble", {"kernels"}},
    {"io", {}},
    {"studies", {"kernels", "ensemble", "io"}},
    {"library", {"kernels", "ensemble", "io", "studies"}},
    {"include", {}},
};

/// What other programs include needs nothing but the standard's headers and its own.
const std::regex public_include(R"re([a-z_]+|stylobate/[a-z_]+\.(hpp|inc))re");

/// The list of an outcome's numbers, from which the floors and the public headers make theirs.
const std::string list_for_all = "include/stylobate/outcome_fields.inc";

/// What `io` may include besides: plain data, and the mathematics that both need.
const std::set<std::string> rooms_for_io = {"ensemble/model", "ensemble/numerics"};
const std::set<std::string> headers_for_io = {"ensemble/estimators/past/agreeing_states.hpp",
                                              "ensemble/estimators/risk/hazard_curve.hpp",
                                              "ensemble/motion/noise_duration.hpp",
                                              "ensemble/planar/fastening.hpp",
                                              "ensemble/planar/planar_poses.hpp",
                                              "ensemble/sampling/plausible.hpp",
                                              "ensemble/spatial/placed_solid.hpp",
                                              "ensemble/spatial/spatial_poses.hpp"};

/// Libraries, and the folders among `may_include` and `studies` that they are for.
const std::map<std::string, std::set<std::string>> library_folders = {
    {"xsimd/", {"kernels"}},
    {"tbb/", {"ensemble", "studies", "library"}},
    {"Eigen/", {"ensemble", "studies"}},
    {"boost/", {"ensemble"}},
    {"Random123/", {"ensemble"}},
    {"fmt/", {"ensemble", "io", "studies", "library"}},
    {"hdf5", {"io"}},
    {"toml++/", {"io"}},
    {"pugixml", {"io"}},
    {"zlib.h", {"io", "studies"}},
    {"CLI/", {"studies"}},
};

/// The kernel has no I/O, no threads, no allocation.
const std::set<std::string> not_in_kernels = {"iostream", "fstream", "sstream", "cstdio", "stdio.h",   "thread",
                                              "mutex",    "future",  "memory",  "map",    "filesystem"};

const std::set<std::string> folders = {"kernels", "ensemble", "io",    "studies", "library", "include",
                                       "bench",   "examples", "tests", "python",  "web"};

constexpr long most_lines = 600;
constexpr std::size_t most_rooms = 45; ///< that one picture shows

// ---- and how a breach is found --------------------------------------------------------------------------------------

/// "ensemble" of "ensemble/model/study.hpp"
std::string first_part(const std::string& path)
{
    return path.substr(0, path.find('/'));
}

std::vector<std::string> includes_of(const std::string& text)
{
    static const std::regex line(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"])re");
    std::vector<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i)
        found.push_back((*i)[1]);
    return found;
}

std::string folder_of(const std::string& path)
{
    return fs::path(path).parent_path().generic_string();
}

/// The room that a file lies in, or its folder where none has it. Files beside the rooms of a floor are a room of their
/// own, without parts.
std::string room_of(const std::string& path)
{
    const std::string folder = folder_of(path);
    for (std::string at = folder; at.find('/') != std::string::npos || at == "kernels"; at = folder_of(at))
        if (rooms.contains(at))
            return at;
    return first_part(folder) == "kernels" ? "kernels" : folder;
}

/// What is wrong with an include in a file (a path relative to the root); empty if nothing is.
std::string breach(const std::string& file, const std::string& include)
{
    const std::string from = first_part(file), to = first_part(include);
    const auto below = floors_below.find(from);
    const std::string says = file + " includes " + include;
    if (include.find("..") != std::string::npos)
        return says + ": headers are named from the root";
    if (below == floors_below.end())
        return {};
    if (from == to && room_of(file) != room_of(include)) {
        const auto room = rooms.find(room_of(file));
        if (room == rooms.end() || !room->second.contains(room_of(include)))
            return says + ": the graph of the rooms at the top of this test does not have it";
    }
    if (room_of(include) == "studies/cli" && room_of(file) != "studies/cli")
        return says + ": nothing includes the command line; what others need is in studies/workflow";
    if (include.starts_with("CLI/") && room_of(file) == "studies/workflow")
        return says + ": a workflow knows no command line";
    if (from == "include" && !std::regex_match(include, public_include))
        return says + ": an outside program may not have it";
    if (from == "studies" && (to == "tests" || to == "bench" || to == "python"))
        return says + ": the program stands without it";
    if (from != to && folders.contains(to) && !below->second.contains(to) && include != list_for_all &&
        !(from == "io" && (rooms_for_io.contains(room_of(include)) || headers_for_io.contains(include))))
        return says + ": includes go one way, kernels <- ensemble <- studies, io beside with plain data only";
    if (from == "kernels" && not_in_kernels.contains(include))
        return says + ": the kernel has no I/O, no threads, no allocation";
    for (const auto& [library, users] : library_folders)
        if (include.starts_with(library) && !users.contains(from))
            return says + ": that library is for other folders";
    return {};
}

using Graph = std::map<std::string, std::set<std::string>>;

/// The nodes of a cycle in order, or none.
std::vector<std::string> cycle_in(const Graph& graph)
{
    std::set<std::string> done;
    std::vector<std::string> path;
    const std::function<bool(const std::string&)> closes = [&](const std::string& node) {
        if (const auto at = std::find(path.begin(), path.end(), node); at != path.end()) {
            path.erase(path.begin(), at);
            return true;
        }
        if (done.contains(node))
            return false;
        path.push_back(node);
        if (const auto found = graph.find(node); found != graph.end())
            for (const std::string& next : found->second)
                if (closes(next))
                    return true;
        path.pop_back();
        done.insert(node);
        return false;
    };
    for (const auto& [node, next] : graph)
        if (closes(node))
            return path;
    return {};
}

/// A path of somebody's machine in a text, with the character before it; empty if there is none.
std::string machine_path(const std::string& text)
{
    static const std::regex absolute(R"re((^|[\s"'`(=:,<])/(home|root|work|Users|mnt)/[^\s"'`)>]*)re");
    std::smatch match;
    if (std::regex_search(text, match, absolute))
        return match.str();
    const std::string here = root.string() + "/";
    if (std::count(here.begin(), here.end(), '/') > 2 && text.find(here) != std::string::npos)
        return here;
    return {};
}

bool has_pragma_once(const std::string& text)
{
    static const std::regex first_line(R"re(^\s*#pragma once\s*\n)re");
    return std::regex_search(text, first_line, std::regex_constants::match_continuous);
}

struct Text {
    std::string name; ///< path relative to the root, with '/'
    std::string text;
    bool is_header() const { return name.ends_with(".hpp") || name.ends_with(".cuh"); }
    bool is_code() const { return is_header() || name.ends_with(".cpp") || name.ends_with(".cu"); }
};

/// Every text of the project: what lies in its folders and beside them, but nothing that is built or computed.
std::vector<Text> texts()
{
    static const std::set<std::string> kinds = {".hpp", ".cpp", ".cu",   ".cuh", ".py",    ".md", ".toml",
                                                ".txt", ".sh",  ".json", ".cff", ".cmake", ".in", ""};
    std::set<std::string> in = folders;
    in.insert({"scripts", "cmake", "docs", ".ci"});
    std::vector<Text> found;
    const auto take = [&](const fs::path& path) {
        const std::string kind = path.extension().string();
        if (!fs::is_regular_file(path) || !kinds.contains(kind) || path.filename() == ".git") // a worktree's
            return;
        std::ifstream file(path, std::ios::binary);
        std::stringstream content;
        content << file.rdbuf();
        found.push_back({path.lexically_relative(root).generic_string(), content.str()});
    };
    for (const auto& entry : fs::directory_iterator(root))
        if (!entry.is_directory())
            take(entry.path());
    for (const std::string& folder : in)
        if (fs::exists(root / folder))
            for (const auto& entry : fs::recursive_directory_iterator(root / folder))
                take(entry.path());
    return found;
}

// ---- the project ----------------------------------------------------------------------------------------------------

TEST(Includes, GoOneWay)
{
    std::map<std::string, int> code;
    for (const Text& file : texts())
        if (file.is_code()) {
            ++code[first_part(file.name)];
            for (const std::string& include : includes_of(file.text))
                EXPECT_EQ(breach(file.name, include), "");
        }
    for (const char* folder : {"kernels", "ensemble", "io", "studies", "tests"})
        EXPECT_GT(code[folder], 5) << "the files of " << folder << " were not found";
}

TEST(Includes, MakeNoCycleOfRooms)
{
    EXPECT_EQ(cycle_in(rooms), std::vector<std::string>{});
    EXPECT_LE(rooms.size(), most_rooms);
    Graph found, parts; // as the files have it, floors and all
    for (const Text& file : texts())
        if (file.is_code() && floors_below.contains(first_part(file.name)))
            for (const std::string& include : includes_of(file.text)) {
                if (!floors_below.contains(first_part(include)))
                    continue;
                if (room_of(include) != room_of(file.name))
                    found[room_of(file.name)].insert(room_of(include));
                if (folder_of(include) != folder_of(file.name) &&
                    first_part(include) != "kernels") // one step is one part
                    parts[folder_of(file.name)].insert(folder_of(include));
            }
    EXPECT_GT(found.size(), 30U);
    EXPECT_EQ(cycle_in(found), std::vector<std::string>{});
    EXPECT_EQ(cycle_in(parts), std::vector<std::string>{}) << "parts of a room";
    for (const auto& [room, others] : found)
        EXPECT_TRUE(rooms.contains(room)) << room << " is not in the graph of the rooms";
}

TEST(House, ThePictureOfTheRoomsHasThemAll)
{
    std::ifstream file(root / "docs/images/rooms.svg");
    const std::string picture{std::istreambuf_iterator<char>(file), {}};
    std::set<std::string> drawn, known;
    static const std::regex room(R"re(data-room="([^"]+)")re");
    for (std::sregex_iterator i(picture.begin(), picture.end(), room), end; i != end; ++i)
        drawn.insert((*i)[1]);
    for (const auto& [name, includes] : rooms)
        known.insert(name);
    EXPECT_EQ(drawn, known) << "scripts/draw_rooms.py draws it anew";
}

TEST(Includes, NameHeadersThatExist)
{
    for (const Text& file : texts()) {
        if (!file.is_code())
            continue;
        for (const std::string& include : includes_of(file.text)) {
            const bool ours = folders.contains(first_part(include)) && include.find('/') != std::string::npos;
            EXPECT_TRUE(!ours || fs::exists(root / include)) << file.name << " includes " << include;
        }
    }
}

TEST(House, EveryHeaderHasItsGuard)
{
    for (const Text& file : texts())
        EXPECT_TRUE(!file.is_header() || has_pragma_once(file.text)) << file.name << " begins without #pragma once";
}

TEST(House, NoFileHasTooManyLines)
{
    for (const Text& file : texts()) {
        const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
        const bool by_program = file.name.starts_with("bench/results/") || file.name == "docs/verification.md" ||
                                file.name == "docs/claims.md" || file.name == "docs/study_reference.md" ||
                                file.name == "io/FORMAT.md"; // its tables are those of the lists of fields
        EXPECT_TRUE(lines <= most_lines || by_program)
            << file.name << " has " << lines << " lines: look for a second noun";
    }
}

TEST(House, NoTextNamesAMachine)
{
    for (const Text& file : texts())
        EXPECT_EQ(machine_path(file.text), "") << file.name;
}

TEST(House, EveryFolderSaysWhatItIs)
{
    for (const char* folder : {"", "kernels", "ensemble", "io", "studies", "studies/inputs",
                               "studies/evidence/verification", "library", "examples", "bench", "tests", "web"})
        EXPECT_TRUE(fs::exists(root / folder / "README.md")) << folder;
}

TEST(House, LinksBetweenTextsLeadSomewhere)
{
    static const std::regex link(R"re(\]\(([^)#\s]+)[^)]*\))re");
    for (const Text& file : texts()) {
        if (!file.name.ends_with(".md"))
            continue;
        for (std::sregex_iterator i(file.text.begin(), file.text.end(), link), end; i != end; ++i) {
            const std::string target = (*i)[1];
            const bool elsewhere = target.find("://") != std::string::npos;
            EXPECT_TRUE(elsewhere || fs::exists(root / fs::path(file.name).parent_path() / target))
                << file.name << " links to " << target;
        }
    }
}

// ---- the rules can be broken ----------------------------------------------------------------------------------------

TEST(Rules, FindBreaches)
{
    EXPECT_NE(breach("kernels/planar/step.hpp", "ensemble/model/study.hpp"), "");
    EXPECT_NE(breach("kernels/planar/step.hpp", "io/records/record.hpp"), "");
    EXPECT_NE(breach("kernels/planar/step.hpp", "Eigen/Dense"), "");
    EXPECT_NE(breach("kernels/planar/step.hpp", "fstream"), "");
    EXPECT_NE(breach("ensemble/sampling/sampler.cpp", "io/study/study_file.hpp"), "");
    EXPECT_NE(breach("ensemble/sampling/sampler.cpp", "studies/kinds/surface/surface_kind.hpp"), "");
    EXPECT_NE(breach("ensemble/sampling/sampler.cpp", "hdf5.h"), "");
    EXPECT_NE(breach("ensemble/sampling/sampler.cpp", "ensemble/run/executor.hpp"), "");
    EXPECT_NE(breach("ensemble/unheard_of/noun.cpp", "ensemble/model/study.hpp"), "");
    EXPECT_NE(breach("io/records/record.cpp", "ensemble/run/executor.hpp"), "");
    EXPECT_NE(breach("io/records/record.cpp", "kernels/planar/step.hpp"), "");
    EXPECT_NE(breach("io/records/record.cpp", "io/store/result_store.hpp"), "");
    EXPECT_NE(breach("io/records/record.cpp", "../ensemble/run/executor.hpp"), "");
    EXPECT_NE(breach("studies/cli/run.cpp", "tests/model.hpp"), "");
    EXPECT_NE(breach("studies/cli/run.cpp", "hdf5.h"), "");
    EXPECT_NE(breach("studies/cli/run.cpp", "library/inside.hpp"), "");
    EXPECT_NE(breach("library/run.cpp", "studies/cli/command.hpp"), "");
    EXPECT_NE(breach("studies/evidence/claims/main.cpp", "studies/cli/command.hpp"), "");
    EXPECT_NE(breach("studies/workflow/run.cpp", "CLI/CLI.hpp"), "");
    EXPECT_NE(breach("include/stylobate/study.hpp", "ensemble/model/study.hpp"), "");
    EXPECT_NE(breach("include/stylobate/study.hpp", "fmt/format.h"), "");

    EXPECT_EQ(breach("kernels/planar/step.hpp", "kernels/planar/mechanisms/stribeck.hpp"), "");
    EXPECT_EQ(breach("kernels/planar/step.hpp", "cmath"), "");
    EXPECT_EQ(breach("ensemble/sampling/sampler.cpp", "kernels/isa.hpp"), "");
    EXPECT_EQ(breach("ensemble/model/outcome.hpp", "include/stylobate/outcome_fields.inc"), "");
    EXPECT_NE(breach("ensemble/model/outcome.hpp", "include/stylobate/result.hpp"), "");
    EXPECT_EQ(breach("ensemble/run/executor.cpp", "ensemble/planar/planar_model.hpp"), "");
    EXPECT_EQ(breach("ensemble/model/outcome.hpp", "include/stylobate/outcome_fields.inc"), "");
    EXPECT_NE(breach("ensemble/model/outcome.hpp", "include/stylobate/result.hpp"), "");
    EXPECT_EQ(breach("io/records/record.cpp", "ensemble/model/study.hpp"), "");
    EXPECT_EQ(breach("studies/cli/run.cpp", "kernels/planar/step.hpp"), "");
    EXPECT_EQ(breach("studies/cli/run.cpp", "studies/workflow/run.hpp"), "");
    EXPECT_EQ(breach("library/run.cpp", "studies/workflow/run.hpp"), "");
    EXPECT_EQ(breach("library/study.cpp", "io/study/study_file.hpp"), "");
    EXPECT_EQ(breach("include/stylobate/study.hpp", "stylobate/record.hpp"), "");
    EXPECT_EQ(breach("include/stylobate/study.hpp", "vector"), "");
    EXPECT_EQ(breach("tests/kernels/test_wide.cpp", "kernels/planar/step.hpp"), "");
    EXPECT_EQ(breach("tests/io/store/test_result_store.cpp", "hdf5.h"), "");
}

TEST(Rules, FindCycles)
{
    EXPECT_EQ(cycle_in({{"a", {"b"}}, {"b", {"c", "d"}}, {"c", {"d"}}}), std::vector<std::string>{});
    EXPECT_EQ(cycle_in({{"a", {"b"}}, {"b", {"c"}}, {"c", {"d", "b"}}}), (std::vector<std::string>{"b", "c"}));
}

TEST(Rules, ReadIncludesAsTheCompilerDoes)
{
    const std::string text =
        "#include \"a/b.hpp\"\n  #  include <c>\n// #include <d>\nint x; // \"e\"\n#include<f.h> // g\n";
    EXPECT_EQ(includes_of(text), (std::vector<std::string>{"a/b.hpp", "c", "f.h"}));
}

TEST(Rules, FindMissingGuards)
{
    EXPECT_TRUE(has_pragma_once("#pragma once\n/// text\n"));
    EXPECT_FALSE(has_pragma_once("/// text\n#pragma once\n"));
    EXPECT_FALSE(has_pragma_once(""));
}

TEST(Rules, FindPathsOfMachines)
{
    const std::string slash = "/";
    EXPECT_NE(machine_path("see " + slash + "home/me/column.toml"), "");
    EXPECT_NE(machine_path("\"" + slash + "work/x\""), "");
    EXPECT_NE(machine_path("in `" + (root / "tests").string() + "`"), "");
    EXPECT_EQ(machine_path("see https://example.org/home/me and ../work/x and a/root/b"), "");
    EXPECT_EQ(machine_path("/usr/share/stylobate"), "");
}

} // namespace
