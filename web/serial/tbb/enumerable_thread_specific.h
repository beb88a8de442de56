#pragma once
// See parallel_for.h.

#include <functional>
#include <optional>

namespace tbb {

template <class T>
class enumerable_thread_specific {
public:
    template <class Make>
    explicit enumerable_thread_specific(const Make& make) : make_(make)
    {
    }
    T& local()
    {
        if (!only_)
            only_.emplace(make_());
        return *only_;
    }

private:
    std::function<T()> make_;
    std::optional<T> only_;
};

} // namespace tbb
