#include "studies/verification/case.hpp"
namespace stylobate::verification {
Cases sensitivity_cases() { return {}; }
}
