#pragma once
// What the engine uses of TBB, in one thread: a page of the browser shares its work among workers, which share no
// memory (web/README.md).

namespace tbb {

struct simple_partitioner {
};
struct auto_partitioner {
};

template <class Index, class Function, class Partitioner = auto_partitioner>
void parallel_for(Index first, Index last, const Function& f, const Partitioner& = {})
{
    for (Index i = first; i < last; ++i)
        f(i);
}

} // namespace tbb
