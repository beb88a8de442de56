/// The house keeps its own rules: includes go one way (kernels <- ensemble <- studies, io beside), every header has its
/// guard, no file grows past 600 lines, and no text names the machine that it was written on.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
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

/// Folders that may be included as a whole. Who is not listed here may include everything.
const std::map<std::string, std::set<std::string>> may_include = {
    {"kernels", {"kernels"}},
    {"ensemble", {"ensemble", "kernels"}},
    {"io", {"io"}},
};

/// What `io` may include besides: plain data, and the mathematics that both need.
const std::set<std::string> plain_data = {
    "ensemble/model/followed_twin.hpp",   "ensemble/numerics/interval.hpp", "ensemble/model/input_error.hpp",
    "ensemble/model/motion.hpp",          "ensemble/model/observer.hpp",    "ensemble/model/outcome.hpp",
    "ensemble/sampling/plausible.hpp",    "ensemble/model/realization.hpp", "ensemble/numerics/run_order.hpp",
    "ensemble/model/study.hpp",           "kernels/topology.hpp",           "ensemble/model/nominal.hpp",
    "ensemble/model/structure.hpp",       "ensemble/model/campaign.hpp",    "ensemble/model/outcome_table.hpp",
    "ensemble/model/time_counts.hpp",     "ensemble/numerics/fourier.hpp",  "ensemble/model/mechanism_spec.hpp",
    "ensemble/model/fragility_model.hpp",
};

/// Libraries, and the folders among `may_include` and `studies` that they are for.
const std::map<std::string, std::set<std::string>> library_folders = {
    {"xsimd/", {"kernels"}},
    {"tbb/", {"ensemble", "studies"}},
    {"Eigen/", {"ensemble", "studies"}},
    {"boost/", {"ensemble"}},
    {"Random123/", {"ensemble"}},
    {"fmt/", {"ensemble", "io", "studies"}},
    {"hdf5", {"io"}},
    {"toml++/", {"io"}},
    {"pugixml", {"io"}},
    {"zlib.h", {"io", "studies"}},
    {"CLI/", {"studies"}},
};

/// The kernel has no I/O, no threads, no allocation.
const std::set<std::string> not_in_kernels = {"iostream", "fstream", "sstream", "cstdio", "stdio.h",   "thread",
                                              "mutex",    "future",  "memory",  "map",    "filesystem"};

const std::set<std::string> folders = {"kernels", "ensemble", "io", "studies", "bench", "tests", "python"};

constexpr long most_lines = 600;

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

/// What is wrong with an include in a file (a path relative to the root); empty if nothing is.
std::string breach(const std::string& file, const std::string& include)
{
    const std::string from = first_part(file);
    const std::string to = first_part(include);
    const auto allowed = may_include.find(from);
    const std::string says = file + " includes " + include;
    if (include.find("..") != std::string::npos)
        return says + ": headers are named from the root";
    if (folders.contains(to) && allowed != may_include.end() && !allowed->second.contains(to) &&
        !(from == "io" && plain_data.contains(include)))
        return says + ": includes go one way, kernels <- ensemble <- studies, io beside with plain data only";
    if (from == "studies" && (to == "tests" || to == "bench" || to == "python"))
        return says + ": the program stands without it";
    if (from == "kernels" && not_in_kernels.contains(include))
        return says + ": the kernel has no I/O, no threads, no allocation";
    if (allowed != may_include.end() || from == "studies")
        for (const auto& [library, users] : library_folders)
            if (include.starts_with(library) && !users.contains(from))
                return says + ": that library is for other folders";
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

TEST(Includes, NameHeadersThatExist)
{
    for (const Text& file : texts()) {
        if (!file.is_code() || file.name.starts_with("tests/consumer/"))
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

TEST(House, NoFileIsTooLong)
{
    for (const Text& file : texts()) {
        const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
        const bool by_program = file.name.starts_with("bench/results/") || file.name == "docs/verification.md" ||
                                file.name == "docs/claims.md";
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
                               "studies/evidence/verification", "bench", "tests"})
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
    EXPECT_NE(breach("kernels/step.hpp", "ensemble/model/study.hpp"), "");
    EXPECT_NE(breach("kernels/step.hpp", "io/records/record.hpp"), "");
    EXPECT_NE(breach("kernels/step.hpp", "Eigen/Dense"), "");
    EXPECT_NE(breach("kernels/step.hpp", "fstream"), "");
    EXPECT_NE(breach("ensemble/sampling/sampler.cpp", "io/study/study_file.hpp"), "");
    EXPECT_NE(breach("ensemble/sampling/sampler.cpp", "studies/kinds/surface/surface.hpp"), "");
    EXPECT_NE(breach("ensemble/sampling/sampler.cpp", "hdf5.h"), "");
    EXPECT_NE(breach("io/records/record.cpp", "ensemble/engine/executor.hpp"), "");
    EXPECT_NE(breach("io/records/record.cpp", "kernels/step.hpp"), "");
    EXPECT_NE(breach("io/records/record.cpp", "../ensemble/engine/executor.hpp"), "");
    EXPECT_NE(breach("studies/app/run.cpp", "tests/model.hpp"), "");
    EXPECT_NE(breach("studies/app/run.cpp", "hdf5.h"), "");

    EXPECT_EQ(breach("kernels/step.hpp", "kernels/real.hpp"), "");
    EXPECT_EQ(breach("kernels/step.hpp", "cmath"), "");
    EXPECT_EQ(breach("ensemble/sampling/sampler.cpp", "kernels/isa.hpp"), "");
    EXPECT_EQ(breach("io/records/record.cpp", "ensemble/model/study.hpp"), "");
    EXPECT_EQ(breach("studies/app/run.cpp", "kernels/step.hpp"), "");
    EXPECT_EQ(breach("tests/test_wide.cpp", "kernels/step.hpp"), "");
    EXPECT_EQ(breach("tests/test_result_store.cpp", "hdf5.h"), "");
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
