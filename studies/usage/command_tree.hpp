#pragma once
/// The command line as plain data, for what is written of it: the manual page and the completion.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stylobate {

/// An option, or (without names) a word that has its place.
struct UsageOption {
    std::vector<std::string> names;   ///< "-o", "--output"
    std::string value;                ///< what stands for its value: "KEY=VALUE"; empty: it takes none
    std::vector<std::string> choices; ///< the words that it may be; none: anything
    std::string range;                ///< of a number: "1 to 4096"
    std::string usual;                ///< the value where it is not given
    std::string text;                 ///< its meaning
    bool required = false;
    bool repeated = false; ///< may be given several times

    bool operator==(const UsageOption&) const = default;
};

struct UsageCommand {
    std::string name, text;
    std::vector<UsageOption> places; ///< in their order
    std::vector<UsageOption> options;
};

/// The program: its commands, and the options without a command. Hidden options are left out.
struct Usage {
    std::string text;
    std::vector<UsageOption> options;
    std::vector<UsageCommand> commands;
};

Usage usage_of(const CLI::App& app);

} // namespace stylobate
