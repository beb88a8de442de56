#pragma once
/// The past shaking of a site, inferred from several structures that have been through it.

#include "stylobate/answer.hpp"

#include <filesystem>
#include <vector>

namespace stylobate::api {

/// `rows`: what is excluded by each structure and by all together: structure (its file, or "together"), events, and
/// with their 95 % intervals the peak ground acceleration from which shaking is excluded by the likelihood, by the
/// profile likelihood and by the posterior (infinite: none), and the one below which it is too weak (0: none):
/// by_likelihood_m_s2, by_profile_m_s2, by_posterior_m_s2, weaker_m_s2.
///
/// The table "likelihood": structure, events, pga_m_s2 and likelihood with its interval.
class Past : public Answer {
    friend struct Inside;
    using Answer::Answer;
};

/// Computes the past as `stylobate past` does.
/// @param files results of survival studies, of two structures or more
/// @throws InputError if they are of other kinds or not of the same shaking, or if no past explains all of them
Past past(const std::vector<std::filesystem::path>& files);

} // namespace stylobate::api
