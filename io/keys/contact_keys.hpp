#pragma once
/// The keys of [contact].

#include "ensemble/model/study.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/words.hpp"

namespace stylobate::contact_keys {

inline const NumberKey normal_stiffness("normal_stiffness_n_m2", &ContactSpec::normal_stiffness_n_m2,
                                        normal_stiffness_range,
                                        "K_N, the force per overlap area for the whole depth; a dry bed of marble has "
                                        "1e9 to 1e10 N/m3 times the depth",
                                        {.needed = true, .used = {compliant()}, .example = "3e9"});
inline const NumberKey tangential_stiffness("tangential_stiffness_n_m", &ContactSpec::tangential_stiffness_n_m,
                                            tangential_stiffness_range, "K_T, the force per tangential displacement",
                                            {.absent = "K_N times the width of the widest drum",
                                             .used = {compliant()}});
inline const NumberKey normal_damping_ratio("normal_damping_ratio", &ContactSpec::normal_damping_ratio,
                                            damping_ratio_range, "normal dashpot as a fraction of the critical damping",
                                            {.used = {compliant()}});
inline const NumberKey
    normal_damping("normal_damping_n_s_m", &ContactSpec::normal_damping_n_s_m, damping_range,
                   "coefficient C_N of the normal dashpot, instead of its ratio",
                   {.absent = "from the ratio", .used = {compliant()}, .excludes = {"normal_damping_ratio"}});
inline const NumberKey tangential_damping_ratio("tangential_damping_ratio", &ContactSpec::tangential_damping_ratio,
                                                damping_ratio_range,
                                                "tangential dashpot as a fraction of the critical damping",
                                                {.used = {compliant()}});
inline const NumberKey
    tangential_damping("tangential_damping_n_s_m", &ContactSpec::tangential_damping_n_s_m, damping_range,
                       "coefficient C_T of the tangential dashpot, instead of its ratio",
                       {.absent = "from the ratio", .used = {compliant()}, .excludes = {"tangential_damping_ratio"}});
inline const WordKey<DampingAt> damping("damping", &ContactSpec::damping, damping_at_names,
                                        "where the normal dashpot acts: at the centroid of the overlap (the paper's "
                                        "model), or at the ends of the contact",
                                        {.used = {compliant()}});
inline const WordKey<DampingPer> damping_per("damping_per", &ContactSpec::damping_per, damping_per_names,
                                             "whether the dashpot's coefficient is that of each contact, or grows with "
                                             "the length of the contact",
                                             {.used = {compliant()}});
inline const WordKey<ContactForm> form("form", &ContactSpec::form, contact_form_names,
                                       "how the overlap becomes a force: by its area (the paper's model), by the "
                                       "penetration of two corners, by points along the face; or not at all, as of "
                                       "rigid blocks");
inline const NumberKey friction("friction", &ContactSpec::friction, friction_range,
                                "coefficient of friction mu; stone on stone has about 0.4 to 0.8",
                                {.needed = true, .example = "0.68"});

inline const NumberKey restitution("restitution", &ContactSpec::restitution, restitution_range,
                                   "what an impact gives back: a part of the velocity or of the impulse",
                                   {.used = {with_rigid_contacts()}});
inline const WordKey<RestitutionLaw> restitution_law(
    "restitution_law", &ContactSpec::restitution_law, restitution_law_names,
    "whether an end that meets its face parts again with the part of its closing velocity (Newton), or every end "
    "gives back the part of the impulse with which the impact compresses it (Poisson)",
    {.used = {with_rigid_contacts()}});

inline const TableKey table("contact", "the joints between blocks",
                            {&normal_stiffness, &tangential_stiffness, &normal_damping_ratio, &normal_damping,
                             &tangential_damping_ratio, &tangential_damping, &damping, &damping_per, &form, &friction,
                             &restitution, &restitution_law});

} // namespace stylobate::contact_keys
