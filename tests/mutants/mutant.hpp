#pragma once
/// The switch of scripts/mutants.sh: which mistake is made. Only the sources of that script's copy include it.

#include <cstdlib>

namespace stylobate {

/// Whether the mistake of this number is made: that of the environment variable STYLOBATE_MUTANT; none without it.
inline bool mutant(int number)
{
    static const int chosen = [] {
        const char* text = std::getenv("STYLOBATE_MUTANT");
        return text ? std::atoi(text) : 0;
    }();
    return number == chosen;
}

} // namespace stylobate

// Replacements may have another type than the expressions; that is of no interest here.
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused"
