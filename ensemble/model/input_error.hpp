#pragma once
/// The one exception for input that a user can correct.

#include <stdexcept>
#include <string>
#include <string_view>

namespace stylobate {

/// Bad input: the message has the place (file and line, if there is one), the value, the allowed range and the remedy.
/// The command line prints it as it is and exits with status 2.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;

    /// "file:line: text"; without the line where `line` is 0.
    InputError(std::string_view file, long line, std::string_view text) : std::runtime_error(join(file, line, text)) {}

private:
    static std::string join(std::string_view file, long line, std::string_view text)
    {
        std::string message(file);
        if (line > 0)
            message.append(":").append(std::to_string(line));
        return message.append(": ").append(text);
    }
};

} // namespace stylobate
