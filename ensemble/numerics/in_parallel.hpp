#pragma once
/// Loops whose turns run side by side.

#include <tbb/parallel_for.h>

#include <atomic>

namespace stylobate {

/// Calls `f(i)` for `first` <= i < `last` on the threads of the surrounding arena, in any order. What was done before
/// the loop is seen in it, and what is done in it is seen after it.
///
/// That order is TBB's. Debian's TBB is not compiled with ThreadSanitizer, which therefore does not see it; there two
/// numbers say it again. They say nothing of the turns among each other, so that a race between these is reported.
///
/// @throws what a turn throws
template <class Index, class Function, class Partitioner = tbb::auto_partitioner>
void in_parallel(Index first, Index last, const Function& f, const Partitioner& partitioner = {})
{
#ifdef __SANITIZE_THREAD__
    std::atomic<int> before = 0, after = 0;
    before.store(1, std::memory_order_release);
    tbb::parallel_for(
        first, last,
        [&](Index i) {
            before.load(std::memory_order_acquire);
            f(i);
            after.fetch_add(1, std::memory_order_release);
        },
        partitioner);
    after.load(std::memory_order_acquire);
#else
    tbb::parallel_for(first, last, f, partitioner);
#endif
}

} // namespace stylobate
