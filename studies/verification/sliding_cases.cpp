#include "studies/verification/case.hpp"
namespace stylobate::verification {
Cases sliding_cases() { return {}; }
}
