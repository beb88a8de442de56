#pragma once
// See parallel_for.h.

namespace tbb {

struct task_arena {
    explicit task_arena(int) {}
    template <class Function>
    void execute(const Function& f)
    {
        f();
    }
};

} // namespace tbb
