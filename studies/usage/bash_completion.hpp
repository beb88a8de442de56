#pragma once
/// Completion of the command line by bash.

#include "studies/usage/command_tree.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// A key that `--set` can give a value.
struct SettableKey {
    std::string path;               ///< "contact.form"
    std::vector<std::string> words; ///< the values, where they are a list of words
};

/// Every key of the study file but tables, and but those in lists of tables, which `--set` gives as a whole.
std::vector<SettableKey> settable_keys();

/// A script for bash: commands, options, words that an option may be, files by their endings, and keys for `--set`.
std::string bash_completion(const Usage& usage, const std::vector<SettableKey>& keys);

} // namespace stylobate
