#include "studies/evidence/measured/parts/page_case.hpp"

namespace stylobate::measured {

std::vector<PageCase> all_page_cases()
{
    return {{"ceh2016", "published", ceh2016},
            {"planar_impact", "planar_impact", planar_impact},
            {"rock_shake_table", "rock_shake_table", rock_shake_table}};
}

} // namespace stylobate::measured
