#include "studies/verification/case.hpp"
namespace stylobate::verification {
Cases initiation_cases() { return {}; }
}
