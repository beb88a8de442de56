#pragma once
/// A study: the structure, its contacts, the shaking, the random quantities, and the question.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::api {

/// A study with every key checked and every default filled in. A copy is cheap.
///
/// The format is that of the study files of the command line (TOML; the unit is a part of each key; `stylobate` is
/// installed with a folder of studies that are ready to run).
class Study {
public:
    /// @param settings "KEY=VALUE" with any key of the file, as `--set` of the command line: "contact.friction=0.7"
    /// @throws InputError naming file, line, key, value, the allowed range and what to do
    static Study from_file(const std::filesystem::path& file, const std::vector<std::string>& settings = {});

    /// Reads a study from text. Files that it names are looked for from the working folder.
    static Study from_text(const std::string& toml, const std::vector<std::string>& settings = {});

    /// Sets one key, "KEY=VALUE": "surface.pga_m_s2.count=4". The whole study is checked again.
    /// @throws InputError as `from_file`; the study is then as it was before
    void set(const std::string& setting);

    /// The canonical text: every key with its default, in one order. Two studies are the same if their texts are.
    std::string text() const;
    /// Structure, contacts, excitation and what is drawn: a name and a few words each, as the pages of `stylobate
    /// report` have it.
    std::vector<std::pair<std::string, std::string>> summary() const;
    /// "single", "surface", "fragility", "sensitivity" or "rare"
    std::string kind() const;
    std::uint64_t seed() const;
    /// Realizations of the whole study, those of all cells or motions; of an adaptive surface or a study of rare events
    /// the most that it can take.
    std::uint64_t realizations() const;

    Study(const Study&) = default;
    Study& operator=(const Study&) = default;

private:
    struct Data;
    friend struct Inside;
    explicit Study(std::shared_ptr<const Data> data);
    std::shared_ptr<const Data> data_;
};

} // namespace stylobate::api
