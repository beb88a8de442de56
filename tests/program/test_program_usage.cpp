/// What is written from the program's description of its commands: the manual page, the completion of bash, the end of
/// the help text. The help texts of CLI11, groff and bash are the judges.

#include "tests/program/program.hpp"

#include <regex>
#include <set>
#include <sstream>

namespace stylobate {

namespace {

class Usage : public ::testing::Test {
protected:
    void SetUp() override
    {
        folder_ = fs::temp_directory_path() / ("stylobate_usage_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string printed(const std::vector<std::string>& arguments) const
    {
        const Ended ended = run_program({arguments}, folder_);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        return ended.out;
    }

    /// What a shell prints, on both streams.
    std::string shell(const std::string& command, int* status = nullptr) const
    {
        const fs::path out = folder_ / "shell.txt";
        const int ended = std::system(
            ("cd '" + folder_.string() + "' && { " + command + "\n} >'" + out.string() + "' 2>&1 </dev/null").c_str());
        if (status != nullptr)
            *status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
        return read_bytes(out);
    }

    /// The replies of bash to Tab after `line`, with bash's own splitting of the line: of a bash that has no
    /// terminal, by `complete -p` and the function that it names.
    std::set<std::string> replies(const std::string& line) const
    {
        // bash splits at blanks and at the characters of COMP_WORDBREAKS, which are words themselves
        std::vector<std::string> words{""};
        for (const char letter : line) {
            if (letter == ' ')
                words.emplace_back();
            else if (letter == '=' || letter == ':') {
                if (!words.back().empty())
                    words.emplace_back();
                words.back() += letter;
                words.emplace_back();
            } else
                words.back() += letter;
        }
        // "a =" and "a = " differ in whether the last word is the sign or is empty
        if (words.size() > 1 && words.back().empty() && line.back() != ' ')
            words.pop_back();
        std::string list;
        for (const std::string& word : words)
            list += " '" + word + "'";
        write_bytes(folder_ / "complete.bash", "source completion.bash\n"
                                               "COMP_WORDBREAKS=$' \\t\\n\"\\'><=;|&(:'\n"
                                               "COMP_WORDS=(" +
                                                   list +
                                                   ")\n"
                                                   "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMP_LINE='" +
                                                   line +
                                                   "' COMP_POINT=${#COMP_LINE}\n"
                                                   "[[ $(complete -p stylobate) =~ -F\\ ([a-z_]+) ]] || exit 1\n"
                                                   "\"${BASH_REMATCH[1]}\" stylobate \"${COMP_WORDS[-1]}\" ''\n"
                                                   "for reply in \"${COMPREPLY[@]}\"; do echo \"$reply\"; done\n");
        int status = 0;
        std::istringstream lines(shell("bash --norc --noprofile complete.bash", &status));
        EXPECT_EQ(status, 0) << line << "\n" << lines.str();
        std::set<std::string> all;
        for (std::string reply; std::getline(lines, reply);)
            EXPECT_TRUE(all.insert(reply).second) << line << ": twice " << reply;
        return all;
    }

    void with_completion() const { write_bytes(folder_ / "completion.bash", printed({"--bash-completion"})); }

    fs::path folder_;
};

using Words = std::set<std::string>;

/// The commands that the help text lists.
std::vector<std::string> commands_of(const std::string& help)
{
    std::vector<std::string> commands;
    std::istringstream lines(help.substr(help.find("Subcommands:\n") + 13));
    for (std::string line; std::getline(lines, line) && line.starts_with("  ");)
        commands.push_back(line.substr(2, line.find(' ', 2) - 2));
    return commands;
}

/// The long options that a help text describes.
Words options_of(const std::string& help)
{
    Words options;
    const std::regex option(R"((?:^|\n)  (?:-[a-z],)?(--[a-z-]+))");
    for (std::sregex_iterator at(help.begin(), help.end(), option), end; at != end; ++at)
        options.insert((*at)[1]);
    return options;
}

/// Of a manual page as it is shown: the lines under a heading of this indentation, up to the next one.
std::string part_of(const std::string& page, const std::string& heading)
{
    const std::size_t begin = page.find("\n" + heading + "\n");
    EXPECT_NE(begin, std::string::npos) << heading;
    std::string part;
    std::istringstream lines(page.substr(begin + heading.size() + 2));
    const std::size_t indent = heading.find_first_not_of(' ');
    for (std::string line; std::getline(lines, line);) {
        const std::size_t first = line.find_first_not_of(' ');
        if (first != std::string::npos && first <= indent)
            break;
        part += line + "\n";
    }
    return part;
}

} // namespace

TEST_F(Usage, ManualPageHasWhatTheHelpTextsHaveAndGroffFindsNothing)
{
    if (std::system("command -v groff >/dev/null && groff -man -Tutf8 /dev/null >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "groff is not installed";
    write_bytes(folder_ / "stylobate.1", printed({"--man"}));
    EXPECT_EQ(shell("groff -ww -man -Tutf8 -z -rLL=80n stylobate.1"), "");
    const std::string page = shell("LC_ALL=C groff -man -Tascii -P-cbou -rLL=100n stylobate.1");

    const std::string help = printed({"--help"});
    const std::vector<std::string> commands = commands_of(help);
    ASSERT_GE(commands.size(), 10U) << help;
    const std::string common = part_of(page, "COMMON OPTIONS");
    for (const std::string& command : commands) {
        const std::string part = part_of(page, "   " + command);
        const Words options = options_of(printed({command, "--help"}));
        EXPECT_TRUE(options.contains("--help")) << command;
        for (const std::string& option : options) {
            EXPECT_TRUE(std::regex_search(part, std::regex(option + "\\b"))) << command << " " << option << "\n"
                                                                             << part;
            const bool described = std::regex_search(part, std::regex("\n +(-[a-z], )?" + option + "\\b"));
            EXPECT_TRUE(described || std::regex_search(common, std::regex(" (-[a-z], )?" + option + "\\b")))
                << command << " " << option;
        }
    }
    // what both end with
    for (const char* text : {"130", "STYLOBATE_FFMPEG", "STYLOBATE_LIBRSVG", "TMPDIR", "/usr/share/stylobate/inputs"}) {
        EXPECT_NE(page.find(text), std::string::npos) << text;
        EXPECT_NE(help.find(text), std::string::npos) << text;
    }
}

TEST_F(Usage, BashCompletesCommandsOptionsAndWords)
{
    with_completion();
    const std::vector<std::string> commands = commands_of(printed({"--help"}));
    EXPECT_EQ(replies("stylobate "), Words(commands.begin(), commands.end()));
    EXPECT_EQ(replies("stylobate rep"), (Words{"replay", "report"}));
    EXPECT_EQ(replies("stylobate --v"), (Words{"--version"}));
    for (const std::string& command : commands) {
        Words options;
        for (const std::string& option : replies("stylobate " + command + " --"))
            options.insert(option);
        EXPECT_EQ(options, options_of(printed({command, "--help"}))) << command;
    }
    EXPECT_EQ(replies("stylobate run --simd "), (Words{"auto", "scalar", "avx2", "avx512", "neon"}));
    EXPECT_EQ(replies("stylobate run --simd=avx"), (Words{"avx2", "avx512"}));
    EXPECT_EQ(replies("stylobate run --backend c"), (Words{"cpu", "cuda"}));
    EXPECT_EQ(replies("stylobate info --backend c"), (Words{"cpu"}));
    EXPECT_EQ(replies("stylobate new fra"), (Words{"fragility"}));
    EXPECT_EQ(replies("stylobate run --threads "), Words{});
    EXPECT_EQ(replies("stylobate nothing "), Words{});
}

TEST_F(Usage, BashCompletesFilesByTheirEndings)
{
    with_completion();
    for (const char* name : {"a column.toml", "column.h5", "table.csv", "quake.AT2"})
        write_bytes(folder_ / name, "");
    fs::create_directory(folder_ / "more");
    EXPECT_EQ(replies("stylobate run "), (Words{"a column.toml", "more"}));
    EXPECT_EQ(replies("stylobate run a.toml -o "), (Words{"column.h5", "more"}));
    EXPECT_EQ(replies("stylobate report "), (Words{"column.h5", "more"}));
    EXPECT_EQ(replies("stylobate report --title x c"), (Words{"column.h5"}));
    EXPECT_EQ(replies("stylobate diagnose "), (Words{"column.h5", "table.csv", "more"}));
    EXPECT_EQ(replies("stylobate diagnose --study="), (Words{"a column.toml", "more"}));
    EXPECT_EQ(replies("stylobate record q"), (Words{"quake.AT2"}));
    EXPECT_EQ(replies("stylobate record quake.AT2 q"), (Words{"quake.AT2"})); // it takes several
    EXPECT_EQ(replies("stylobate run a.toml c"), Words{});                    // it takes one
}

TEST_F(Usage, BashCompletesKeysForSetAndTheirValues)
{
    with_completion();
    EXPECT_EQ(replies("stylobate run a.toml --set contact.fr"), (Words{"contact.friction="}));
    EXPECT_EQ(replies("stylobate run a.toml --set contact.form="), (Words{"area", "two_corner", "points", "rigid"}));
    EXPECT_EQ(replies("stylobate run a.toml --set contact.form=ri"), (Words{"rigid"}));
    EXPECT_EQ(replies("stylobate run a.toml --set study.kind=r"), (Words{"rare"}));
    EXPECT_EQ(replies("stylobate run a.toml --set contact.friction=0"), Words{});
    // every key of the reference but those in lists of tables, which a setting gives as a whole
    std::istringstream page(printed({"schema", "--markdown"}));
    const std::regex heading(R"(^#+ `\[(.*)\]`)"), row(R"(^\| `([A-Za-z0-9_]+)` \| ([^|]*) \|)");
    Words keys;
    std::set<std::string> lists;
    std::string table;
    for (std::string line; std::getline(page, line);) {
        std::smatch found;
        if (std::regex_search(line, found, heading))
            table = found[1];
        if (!std::regex_search(line, found, row))
            continue;
        const std::string path = table + "." + found[1].str();
        const bool in_list =
            std::any_of(lists.begin(), lists.end(), [&](const std::string& list) { return table.starts_with(list); });
        if (found[2].str().starts_with("list of tables") || found[2].str().starts_with("table under a name"))
            lists.insert(path);
        else if (!found[2].str().starts_with("table") && !in_list)
            keys.insert(path + "=");
    }
    const Words completed = replies("stylobate run a.toml --set ");
    EXPECT_GT(completed.size(), 150U);
    for (const std::string& key : keys) {
        if (!key.starts_with("perturbation.")) { // any quantity; its keys are listed once, without its name
            EXPECT_TRUE(completed.contains(key)) << key;
        }
    }
    for (const std::string& list : lists)
        for (const std::string& key : completed)
            EXPECT_FALSE(key.starts_with(list + ".")) << key;
}

} // namespace stylobate
