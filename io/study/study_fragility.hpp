#pragma once
/// The [fragility] of a study file.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"
#include "io/records/record.hpp"

#include <filesystem>

namespace stylobate {

/// @param keys       the table [fragility]
/// @param study      the table [study], for the number of structures
/// @param excitation as read; a "record" one needs records here, any other a number of motions
/// @throws InputError naming the key
FragilitySpec read_fragility(const KeyReader& keys, const KeyReader& study, const ExcitationSpec& excitation,
                             std::uint64_t structures);

/// Fills in the records of a folder: every horizontal component of every file that its pattern names, by name. Files
/// without accelerations and vertical components are listed in `FragilitySpec::left_out`.
/// @param beside  a relative folder is looked for here first, then in the working folder
/// @param pga as of `read_records`
/// @throws InputError if the folder cannot be read, if no file is named by the pattern, for a file that is damaged, and
///         if no horizontal component is left
void list_records(const KeyReader& keys, const std::filesystem::path& beside, PgaRange pga, FragilitySpec& fragility);

} // namespace stylobate
