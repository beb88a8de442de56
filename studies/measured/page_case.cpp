#include "studies/measured/page_case.hpp"

namespace stylobate::measured {

std::vector<PageCase> all_page_cases()
{
    return {};
}

} // namespace stylobate::measured
