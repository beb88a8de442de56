#include "studies/usage/usage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace stylobate {

namespace {

/// Text that troff is to print as it is.
std::string plain(const std::string& text)
{
    std::string out;
    for (const char letter : text) {
        if (letter == '\\')
            out += "\\e";
        else if (letter == '-')
            out += "\\-"; // else it may become another dash, which cannot be pasted into a shell
        else if (letter == '\'')
            out += "\\(aq";
        else if (letter == '.' && out.empty())
            out += "\\&.";
        else
            out += letter;
    }
    return out;
}

std::string bold(const std::string& text)
{
    return "\\fB" + plain(text) + "\\fR";
}

std::string slanted(const std::string& text)
{
    return "\\fI" + plain(text) + "\\fR";
}

std::string upper(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) { return std::toupper(letter); });
    return text;
}

/// A head is one line, which cannot be broken.
bool listed_in_head(const UsageOption& option)
{
    return !option.names.empty() && !option.choices.empty() &&
           fmt::format("{}", fmt::join(option.choices, "|")).size() < 45;
}

/// "-o, --output TEXT", "--simd auto|scalar"
std::string head_of(const UsageOption& option)
{
    std::string head;
    for (const std::string& name : option.names)
        head += (head.empty() ? "" : ", ") + bold(name);
    if (!option.value)
        return head;
    std::string value = slanted(*option.value);
    if (listed_in_head(option)) {
        value.clear();
        for (const std::string& word : option.choices)
            value += (value.empty() ? "" : "|") + bold(word);
    }
    return head + (head.empty() ? "" : " ") + value;
}

std::string text_of(const UsageOption& option)
{
    std::string text = plain(option.text);
    if (!option.choices.empty() && !listed_in_head(option) &&
        option.text.find(option.choices.back()) == std::string::npos)
        text += plain(fmt::format("; one of {}", fmt::join(option.choices, ", ")));
    if (option.range)
        text += plain("; " + *option.range);
    if (option.usual)
        text += plain(fmt::format(" (default: {})", *option.usual));
    return text;
}

class Page {
public:
    Page(const Usage& usage, const std::string& version) : usage_(usage)
    {
        out_ = ".\\\" Written by `stylobate --man` from the texts of `stylobate --help`.\n";
        out_ += fmt::format(".TH STYLOBATE 1 \"\" \"Stylobate {}\" \"User Commands\"\n", plain(version));
        out_ += ".nh\n.ad l\n";
        const std::size_t colon = usage.text.find(": ");
        const std::string does = colon == std::string::npos ? usage.text : usage.text.substr(colon + 2);
        section("Name");
        out_ += fmt::format("stylobate \\- {}\n", plain(does.substr(0, does.find_last_not_of('.') + 1)));
        section("Synopsis");
        for (const UsageCommand& command : usage.commands)
            out_ += synopsis(command) + (&command == &usage.commands.back() ? "\n" : "\n.br\n");
        for (const UsageOption& option : usage.options)
            out_ += ".br\n" + bold("stylobate") + " " + bold(option.names.back()) + "\n";
    }

    void commands()
    {
        section("Commands");
        for (const UsageCommand& command : usage_.commands) {
            out_ += fmt::format(".SS {}\n", plain(command.name));
            std::string text = command.text;
            text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
            out_ += fmt::format("{}\n.PP\n{}{}\n", synopsis(command), plain(text), text.back() == '.' ? "" : ".");
            for (const UsageOption& place : command.places)
                entry(head_of(place), text_of(place));
            std::string common;
            for (const UsageOption& option : command.options)
                if (is_common(option))
                    common += (common.empty() ? "" : ", ") + bold(option.names.back());
                else
                    entry(head_of(option), text_of(option));
            if (!common.empty())
                out_ += fmt::format(".PP\nCommon options: {}.\n", common);
        }
    }

    void common_options()
    {
        section("Common options");
        std::vector<UsageOption> described;
        for (const UsageCommand& command : usage_.commands)
            for (const UsageOption& option : command.options)
                if (is_common(option) && std::find(described.begin(), described.end(), option) == described.end()) {
                    entry(head_of(option), text_of(option));
                    described.push_back(option);
                }
        for (const UsageOption& option : usage_.options)
            if (std::find(described.begin(), described.end(), option) == described.end())
                entry(head_of(option), text_of(option));
    }

    void notes()
    {
        for (const UsageSection& notes : usage_notes()) {
            section(notes.title);
            for (const UsageNote& note : notes.notes)
                entry(bold(note.name), plain(note.text));
        }
        section("See also");
        out_ += "\\fBffmpeg\\fR(1)\n";
    }

    std::string text() const { return out_; }

private:
    void section(const std::string& title) { out_ += fmt::format(".SH {}\n", plain(upper(title))); }

    void entry(const std::string& head, const std::string& text) { out_ += fmt::format(".TP\n{}\n{}\n", head, text); }

    /// In four commands or more, with the same meaning.
    bool is_common(const UsageOption& option) const
    {
        return std::count_if(usage_.commands.begin(), usage_.commands.end(), [&](const UsageCommand& command) {
                   return std::find(command.options.begin(), command.options.end(), option) != command.options.end();
               }) >= 4;
    }

    static std::string synopsis(const UsageCommand& command)
    {
        std::string line = bold("stylobate " + command.name);
        for (const UsageOption& place : command.places) {
            const std::string word = slanted(*place.value) + (place.repeated ? "..." : "");
            line += place.required ? " " + word : " [" + word + "]";
        }
        return line + " [" + slanted("OPTION") + "...]";
    }

    const Usage& usage_;
    std::string out_;
};

} // namespace

std::string manual_page(const Usage& usage, const std::string& version)
{
    Page page(usage, version);
    page.commands();
    page.common_options();
    page.notes();
    return page.text();
}

} // namespace stylobate
