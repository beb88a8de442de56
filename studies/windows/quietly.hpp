#pragma once
/// Work inside of other work.

#include "ensemble/model/observer.hpp"

namespace stylobate {

/// Passes on the wish to stop, not the progress of a small part.
class Quietly : public Observer {
public:
    explicit Quietly(Observer& outer) : outer_(outer) {}
    bool stop_requested() override { return outer_.stop_requested(); }

private:
    Observer& outer_;
};

} // namespace stylobate
