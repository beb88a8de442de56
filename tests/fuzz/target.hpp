#pragma once
/// What the fuzzer and the tests of malformed files need of a reader.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

namespace stylobate::fuzz {

using Random = std::mt19937_64;

enum class Verdict { refused, accepted };

/// What a reader must not do: a broken promise, in words.
class Finding : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

inline void promise(bool kept, const char* what)
{
    if (!kept)
        throw Finding(what);
}

/// A reader of files with what makes inputs for it.
struct Target {
    const char* name; ///< of its seeds: corpus/NAME, findings/NAME
    /// Reads one input. @throws anything where the reader fails otherwise than with an InputError, or is wrong
    Verdict (*judge)(std::string_view input);
    /// An input near another one.
    std::string (*mutated)(std::string_view input, Random& random);
    std::size_t most_bytes; ///< of an input
    int trials;             ///< inputs of the normal tests: a second or some of them
};
extern const Target record_target, study_target, results_target, campaign_target, table_target, hazard_target,
    decision_target;

/// Calls a reader. Only an InputError counts as a refusal.
template <class Read>
Verdict judged(const Read& read)
{
    try {
        read();
        return Verdict::accepted;
    } catch (const InputError& error) {
        if (std::string_view(error.what()).size() <= 10)
            throw Finding(std::string("a message is too short to help: ") + error.what());
        return Verdict::refused;
    }
}

/// A folder of this process (TMPDIR: scripts/fuzz.sh names one in memory), for readers that take files only.
inline const TemporaryFolder& folder()
{
    static const TemporaryFolder made;
    return made;
}

inline void write_file(const std::filesystem::path& path, std::string_view content)
{
    std::ofstream out(path, std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    if (!out.flush())
        throw std::runtime_error(path.string() + ": cannot be written");
}

inline std::string file_content(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A number below `n`, which is at least 1.
inline std::size_t below(Random& random, std::size_t n)
{
    return static_cast<std::size_t>(random() % n);
}

} // namespace stylobate::fuzz
