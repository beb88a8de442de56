#include "ensemble/model/outcome.hpp"

namespace stylobate {

const char* to_string(State state)
{
    switch (state) {
    case State::stood:
        return "stood";
    case State::rocked:
        return "rocked";
    case State::slid:
        return "slid";
    case State::collapsed:
        return "collapsed";
    case State::invalid:
        return "invalid";
    }
    return "unknown";
}

const char* to_string(InvalidReason reason)
{
    switch (reason) {
    case InvalidReason::none:
        return "none";
    case InvalidReason::not_finite:
        return "not_finite";
    case InvalidReason::energy:
        return "energy";
    }
    return "unknown";
}

} // namespace stylobate
