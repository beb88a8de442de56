#include "studies/verification/case.hpp"
namespace stylobate::verification {
Cases frame_cases() { return {}; }
}
