#pragma once
/// A flow of control that stops in the midst of a function and is continued later, on a stack of its own.

#include <cstddef>
#include <memory>

namespace ptx {

/// x86-64 has its own change of stacks: `swapcontext`, which other processors use, calls the system for the mask of
/// signals at each change; with it a kernel of columns took 7 times as long. AddressSanitizer and ThreadSanitizer are
/// informed of each change.
class Fiber {
public:
    Fiber(); ///< of the calling thread itself, from which others are begun
    explicit Fiber(std::size_t stack_bytes);
    ~Fiber();
    Fiber(const Fiber&) = delete;
    Fiber& operator=(const Fiber&) = delete;

    /// The next change to this fiber calls `function`, which never returns: it ends with `change_to`, and is not
    /// continued. What the fiber did before is dropped, without destructors.
    void begin(void (*function)(void*), void* argument);

    /// From this fiber, which runs, to another; returns when another one changes to this. No exception may leave
    /// `function`.
    void change_to(Fiber& other);

    /// Whether something has been written at the very end of the stack.
    bool overrun() const;

private:
    struct Context;
    static void enter();
    void arrive();
    std::unique_ptr<Context> context_;
};

} // namespace ptx
