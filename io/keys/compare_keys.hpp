#pragma once
/// The keys of [variants] and [optimise], which `stylobate compare` reads beside the study itself. Both hold tables
/// under names of the user's.

#include "ensemble/model/study.hpp"
#include "io/keys/kind_keys.hpp"

namespace stylobate {

namespace variants_keys {

inline const TableKey any("NAME",
                          "a variant: KEY = VALUE for any key of the study, in quotes where it has dots, as in "
                          "{ \"contact.friction\" = 0.4 }",
                          {}, {.absent = "no variant"}, KeyType::named);
inline const TableKey table("variants",
                            "studies that `stylobate compare` compares with this one: each is this one with other "
                            "values of some keys; `run` runs this one alone",
                            {&any}, {.absent = "no variants"});

} // namespace variants_keys

namespace optimise_keys {

inline const Range any_number{-1e30, 1e30};

inline const TextKey minimise("minimise", "the limit state whose probability is to be smallest",
                              {.absent = "\"collapse\""});
inline const TextKey hazard("hazard",
                            "of a fragility study by stripes: a file with the hazard curve of the site, beside the "
                            "study file, or a power law such as \"k0=1e-4,k=2.5,measure=pga_g\", as `stylobate risk` "
                            "takes it; the annual frequency of the limit state is then to be smallest",
                            {.absent = "the probability is to be smallest"});
inline const WholeKey budget("budget", 20000, {1, most_realizations, "Realizations of the whole search."},
                             "realizations of the whole search; each point runs those of the study");
inline const NumberKey from("from", any_number, "smallest value");
inline const NumberKey to("to", any_number, "largest value");
inline const WordKey<Spacing> spacing("spacing", Spacing::linear, spacing_names,
                                      "equal steps are equal differences, or equal ratios");
inline const TableKey any("KEY", "a number of the study to choose, in quotes where it has dots; one to three of them",
                          {&from, &to, &spacing}, {.absent = "nothing to choose"}, KeyType::named);
inline const TableKey table("optimise", "numbers of the study that `stylobate compare --search` chooses",
                            {&minimise, &hazard, &budget, &any}, {.absent = "no search"});

} // namespace optimise_keys
} // namespace stylobate
