#include "studies/measured/page_case.hpp"

namespace stylobate::measured {

std::vector<PageCase> all_page_cases()
{
    return {{"rock_shake_table", "rock_shake_table", rock_shake_table}};
}

} // namespace stylobate::measured
