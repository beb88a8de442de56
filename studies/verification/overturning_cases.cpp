#include "studies/verification/case.hpp"
namespace stylobate::verification {
Cases overturning_cases() { return {}; }
}
