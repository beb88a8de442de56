#pragma once
/// Reads the [claim] section of a study file; `README.md` describes it. The rest of the file is an ordinary study.

#include "studies/evidence/claims/claim.hpp"

#include <filesystem>

namespace stylobate::claims {

/// @throws InputError with file, line and key: misspelt or missing keys, unknown words, axes and levels, a criterion
///         without what its kind needs
ClaimFile read_claims(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
ClaimFile parse_claims(const std::string& text, const std::string& name);

} // namespace stylobate::claims
