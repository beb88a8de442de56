#include "studies/usage/usage.hpp"

#include "io/keys/study_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

/// Files by the ending of their names; folders are offered with them.
struct FileWord {
    const char* command; ///< null: any
    const char* word;    ///< an option, or what stands for a word that has its place
    const char* endings; ///< "*": any file
};

constexpr FileWord file_words[] = {
    {"compare", "STUDY", "toml h5"}, {nullptr, "STUDY", "toml"},      {nullptr, "--study", "toml"},
    {nullptr, "RESULTS", "h5"},      {nullptr, "MEASURED", "h5 csv"}, {"report", "FILE", "h5"},
    {"risk", "FILE", "h5"},          {nullptr, "FILE", "*"},          {"report", "--output", "html"},
    {"new", "--output", "toml"},     {"export", "--output", "*"},     {"run", "--output", "h5"},
    {"replay", "--output", "h5"},    {"calibrate", "--output", "h5"}, {"diagnose", "--output", "h5"},
    {"compare", "--output", "h5"},   {"risk", "--output", "h5"},      {"risk", "--hazard", "csv xml"},
};

std::optional<std::string> endings_of(const std::string& command, const std::string& word)
{
    for (const FileWord& file : file_words)
        if (word == file.word && (file.command == nullptr || command == file.command))
            return file.endings;
    return std::nullopt;
}

/// What may stand in its place, as the shell's `words=...`, `endings=...` or `keys=...`.
std::string values_of(const UsageCommand& command, const UsageOption& option)
{
    const std::string word = option.names.empty() ? *option.value : option.names.back();
    if (!option.choices.empty())
        return fmt::format("words='{}'", fmt::join(option.choices, " "));
    if (const std::optional<std::string> endings = endings_of(command.name, word))
        return fmt::format("endings='{}'", *endings);
    if (word == "--set")
        return "keys=yes";
    return ":";
}

/// One line for each command: its options and, after `:`, those that take a value.
std::string option_cases(const Usage& usage)
{
    std::string text;
    const auto names = [](const std::vector<UsageOption>& options, bool with_value) {
        std::vector<std::string> all;
        for (const UsageOption& option : options)
            if (!with_value || option.value)
                all.insert(all.end(), option.names.begin(), option.names.end());
        return fmt::format("{}", fmt::join(all, " "));
    };
    text +=
        fmt::format("    '') options='{}' valued='{}' ;;\n", names(usage.options, false), names(usage.options, true));
    for (const UsageCommand& command : usage.commands)
        text += fmt::format("    {}) options='{}' valued='{}' ;;\n", command.name, names(command.options, false),
                            names(command.options, true));
    return text;
}

std::string value_cases(const Usage& usage)
{
    std::string text;
    for (const UsageCommand& command : usage.commands) {
        for (std::size_t i = 0; i < command.places.size(); ++i) {
            const bool last = i + 1 == command.places.size() && command.places[i].repeated;
            text += fmt::format("    '{} '{}) {} ;;\n", command.name, last ? "[0-9]*" : std::to_string(i),
                                values_of(command, command.places[i]));
        }
        for (const UsageOption& option : command.options)
            if (option.value)
                for (const std::string& name : option.names)
                    text += fmt::format("    '{} {}') {} ;;\n", command.name, name, values_of(command, option));
    }
    return text;
}

std::string key_cases(const std::vector<SettableKey>& keys)
{
    std::string text;
    for (const SettableKey& key : keys)
        if (!key.words.empty())
            text += fmt::format("    {}) words='{}' ;;\n", key.path, fmt::join(key.words, " "));
    return text;
}

/// The functions that use what stands before them. bash splits words at `=` and `:` too; they are put together again,
/// and of a reply only what bash has not split off is given.
constexpr const char* functions = R"sh(
_stylobate_files() # ENDINGS WORD
{
    local ending
    set -f # an ending may be *
    for ending in $1; do
        compgen -f -X "!*.$ending" -- "$2"
    done
    set +f
    compgen -d -- "$2"
}

_stylobate()
{
    local line=() i
    for ((i = 1; i <= COMP_CWORD; ++i)); do
        if ((${#line[@]} > 0)) && [[ ${COMP_WORDS[i]} == [=:]* || ${COMP_WORDS[i - 1]} == *[=:] ]]; then
            line[-1]+=${COMP_WORDS[i]}
        else
            line+=("${COMP_WORDS[i]}")
        fi
    done
    COMPREPLY=()
    local word=${line[-1]} before=() command='' place=-1 option='' options valued
    ((${#line[@]} == 1)) || before=("${line[@]:0:${#line[@]}-1}")
    for i in "${before[@]}"; do
        if [[ -n $option ]]; then
            option=
        elif [[ -z $command && $i != -* ]]; then
            command=$i place=0
        elif [[ $i == -* ]]; then
            _stylobate_options "$command"
            [[ $i == *=* || " $valued " != *" $i "* ]] || option=$i
        else
            ((++place))
        fi
    done
    _stylobate_options "$command"

    local value=$word words='' endings='' keys=
    if [[ -z $option && $word == --*=* ]]; then # --option=VALUE
        option=${word%%=*} value=${word#*=}
    fi
    if [[ -n $option ]]; then
        _stylobate_values "$command $option"
    elif [[ $word == -* ]]; then
        words=$options
    elif [[ -z $command ]]; then
        words=$_stylobate_commands
    else
        _stylobate_values "$command $place"
    fi
    if [[ -n $keys && $value == *=* ]]; then # KEY=VALUE
        _stylobate_key "${value%%=*}"
        value=${value#*=}
    elif [[ -n $keys ]]; then
        words=$_stylobate_keys
        compopt -o nospace 2>/dev/null
    fi
    if [[ -n $endings ]]; then
        compopt -o filenames 2>/dev/null # escapes blanks, and sets / after a folder
        mapfile -t COMPREPLY < <(_stylobate_files "$endings" "$value")
    else
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$value")
    fi
    local part=$value
    [[ $COMP_WORDBREAKS == *:* ]] && part=${part##*:} # bash has split it off, and adds to the rest alone
    ((${#part} == ${#value})) || COMPREPLY=("${COMPREPLY[@]#"${value%"$part"}"}")
    [[ $COMP_WORDBREAKS == *=* || $word == "$value" ]] || COMPREPLY=("${COMPREPLY[@]/#/"${word%"$value"}"}")
}

complete -F _stylobate stylobate
)sh";

} // namespace

std::vector<SettableKey> settable_keys()
{
    std::vector<SettableKey> keys;
    std::string list; // of tables, whose keys come after it
    for_each_key([&](const std::string& path, const TomlKey& key) {
        if (!list.empty() && path.starts_with(list))
            return;
        if (key.type == KeyType::tables || key.type == KeyType::named)
            list = path + ".";
        const bool plain = key.keys.empty() && key.type != KeyType::table && key.type != KeyType::tables;
        if (!plain)
            return;
        SettableKey settable{path, key.words};
        if (key.type == KeyType::boolean)
            settable.words = {"true", "false"};
        keys.push_back(std::move(settable));
    });
    return keys;
}

std::string bash_completion(const Usage& usage, const std::vector<SettableKey>& keys)
{
    std::vector<std::string> commands, paths;
    for (const UsageCommand& command : usage.commands)
        commands.push_back(command.name);
    for (const SettableKey& key : keys)
        paths.push_back(key.path + "=");
    std::string text = "# Completion of stylobate in bash, written by `stylobate --bash-completion`.\n\n";
    text += fmt::format("_stylobate_commands='{}'\n", fmt::join(commands, " "));
    text += fmt::format("_stylobate_keys='{}'\n", fmt::join(paths, " "));
    text += fmt::format("\n_stylobate_options() # COMMAND: sets options, and valued: those that take a value\n{{\n"
                        "    case $1 in\n{}    esac\n}}\n",
                        option_cases(usage));
    text += fmt::format("\n_stylobate_values() # COMMAND OPTION, COMMAND PLACE: sets words, endings or keys\n{{\n"
                        "    case $1 in\n{}    esac\n}}\n",
                        value_cases(usage));
    text += fmt::format("\n_stylobate_key() # KEY of --set: sets words\n{{\n    case $1 in\n{}    esac\n}}\n",
                        key_cases(keys));
    return text + functions;
}

} // namespace stylobate
