#pragma once
/// A study with rigid contacts in place of its own.

#include "ensemble/model/study.hpp"

#include <vector>

namespace stylobate {

inline Study rigid_of(Study study)
{
    ContactSpec rigid;
    rigid.form = ContactForm::rigid;
    rigid.normal_damping_ratio = rigid.tangential_damping_ratio = 0;
    rigid.friction = study.contact.friction;
    study.contact = rigid;
    std::erase_if(study.perturbations, [](const Perturbation& p) {
        return p.quantity == Quantity::normal_stiffness || p.quantity == Quantity::tangential_stiffness ||
               p.quantity == Quantity::damping_ratio;
    });
    study.outcome.follow = Follow::collapse;
    return study;
}

} // namespace stylobate
