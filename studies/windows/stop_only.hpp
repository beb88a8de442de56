#pragma once
/// The observer of a part of larger work.

#include "ensemble/model/observer.hpp"

namespace stylobate {

/// Passes on requests to stop, but no progress.
class StopOnly : public Observer {
public:
    explicit StopOnly(Observer& outer) : outer_(outer) {}
    bool stop_requested() override { return outer_.stop_requested(); }

private:
    Observer& outer_;
};

} // namespace stylobate
