#include "ensemble/estimators/search/search_places.hpp"

#include <cmath>

namespace stylobate {

std::vector<SearchPlace> first_places(std::size_t dimensions)
{
    if (dimensions == 1)
        return {{0.5}, {0}, {1}, {0.25}, {0.75}};
    double ratio = 1.5; // x^(d + 1) = x + 1
    for (int i = 0; i < 60; ++i)
        ratio = std::pow(1 + ratio, 1.0 / (static_cast<double>(dimensions) + 1));
    std::vector<SearchPlace> places;
    for (std::size_t i = 0; i < 4 * dimensions; ++i) {
        SearchPlace place;
        for (std::size_t k = 0; k < dimensions; ++k)
            place.push_back(
                std::fmod(0.5 + static_cast<double>(i) * std::pow(1 / ratio, static_cast<double>(k) + 1), 1.0));
        places.push_back(std::move(place));
    }
    return places;
}

std::vector<SearchPlace> candidate_places(std::size_t dimensions)
{
    const std::size_t side = dimensions == 1 ? 201 : dimensions == 2 ? 41 : 17;
    std::size_t all = 1;
    for (std::size_t k = 0; k < dimensions; ++k)
        all *= side;
    std::vector<SearchPlace> places;
    for (std::size_t i = 0; i < all; ++i) {
        SearchPlace place;
        for (std::size_t k = 0, rest = i; k < dimensions; ++k, rest /= side)
            place.push_back(static_cast<double>(rest % side) / static_cast<double>(side - 1));
        places.push_back(std::move(place));
    }
    return places;
}

} // namespace stylobate
