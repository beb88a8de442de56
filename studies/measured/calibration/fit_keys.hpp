#pragma once
/// What a calibration fits: numbers of a study, each in a range, with the contact forms that are asked for.

#include "ensemble/model/study.hpp"

#include <string>
#include <vector>

namespace stylobate {

inline constexpr const char* friction_key = "contact.friction";

/// A number of the study file that is fitted, and its range.
struct FitKey {
    std::string key; ///< "contact.friction"
    double from = 0;
    double to = 0;
    bool logarithmic = true; ///< equal steps for equal ratios; needs from > 0
    /// What nudging itself adds to the error (the nudging force, the smoothing, starts from noisy states), as a part of
    /// the value, 1 sigma; of friction 0.01. Measured on 20 simulated campaigns of known parameters: friction came out
    /// 0.6 % too low in the median, K_N 5 %, in one of ten 20 %.
    double method_deviation = 0.1;
    bool asked = false; ///< by the user: the friction is then searched for too, as an effective value
};

/// K_N, K_T, both dashpots and friction, with ranges about the study's values.
std::vector<FitKey> contact_keys(const Study& study);

/// A key of the study file with the range FROM:TO in the text "KEY=FROM:TO"; of "KEY" alone a fifth to five times the
/// study's value. @throws InputError if the study has no such number, or the range is none
FitKey fit_key(const Study& study, const std::string& text);

/// The contact's keys without those of `hold`, and those of `fit` ("KEY" or "KEY=FROM:TO"), which replace them where
/// they are the same.
/// @throws InputError as `fit_key`, if what is to be held is not fitted, and if nothing is left
std::vector<FitKey> fitted_keys(const Study& study, const std::vector<std::string>& fit,
                                const std::vector<std::string>& hold);

/// The contact forms of words such as "area", each once; "all" is every one. Empty: none was named.
/// @throws InputError for any other word
std::vector<ContactForm> fitted_forms(const std::vector<std::string>& words);

/// @throws InputError if the range is empty, or has a number that a study file may not have
void check_range(const Study& study, const FitKey& key);

/// The study with other values. @throws InputError for a key or value that a study file may not have
Study with_values(const Study& study, const std::vector<std::string>& keys, const std::vector<double>& values);

/// The number that a study has for a key, defaults included. @throws InputError if there is none
double number_in(const Study& study, const std::string& key);

} // namespace stylobate
