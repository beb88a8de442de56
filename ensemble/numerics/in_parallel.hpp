#pragma once
/// Loops whose turns run side by side.

#include <tbb/parallel_for.h>

#include <atomic>

#ifdef __SANITIZE_THREAD__
#include <alloca.h>
#endif

namespace stylobate {

#ifdef __SANITIZE_THREAD__
template <class Function>
[[gnu::noinline]] void call(const Function& f)
{
    f();
}

/// Calls `f` with 256 KB of the stack left empty.
template <class Function>
[[gnu::noinline]] void far_below(const Function& f)
{
    void* const room = alloca(256 * 1024);
    asm volatile("" : : "r"(room) : "memory"); // so that it is made
    call(f);
}
#endif

/// Calls `f(i)` for `first` <= i < `last` on the threads of the surrounding arena, in any order. What was done before
/// the loop is seen in it, and what is done in it is seen after it.
///
/// That order is TBB's. Debian's TBB is not compiled with ThreadSanitizer, which therefore does not see it; there two
/// numbers say it again. They say nothing of the turns among each other, so that a race between these is reported.
/// What TBB keeps of the loop on the stack is read by its threads after their last turn, which the numbers do not say;
/// so nothing else has these places of the stack.
///
/// @throws what a turn throws
template <class Index, class Function, class Partitioner = tbb::auto_partitioner>
void in_parallel(Index first, Index last, const Function& f, const Partitioner& partitioner = {})
{
#ifdef __SANITIZE_THREAD__
    std::atomic<int> before = 0, after = 0;
    before.store(1, std::memory_order_release);
    const auto turn = [&](Index i) {
        before.load(std::memory_order_acquire);
        far_below([&] { f(i); });
        after.fetch_add(1, std::memory_order_release);
    };
    far_below([&] { tbb::parallel_for(first, last, turn, partitioner); });
    after.load(std::memory_order_acquire);
#else
    tbb::parallel_for(first, last, f, partitioner);
#endif
}

} // namespace stylobate
