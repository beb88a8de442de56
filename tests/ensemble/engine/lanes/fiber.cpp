#include "tests/ensemble/engine/lanes/fiber.hpp"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PTX_ADDRESS_SANITIZER
#endif
#if __has_feature(thread_sanitizer)
#define PTX_THREAD_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define PTX_ADDRESS_SANITIZER
#endif
#if defined(__SANITIZE_THREAD__)
#define PTX_THREAD_SANITIZER
#endif

#if defined(PTX_ADDRESS_SANITIZER)
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif
#if defined(PTX_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#endif

#if defined(__x86_64__) && !defined(PTX_UCONTEXT) // which may be defined to compare the two
// Keeps the registers that a function must keep on the old stack, and takes them from the new one. (A file of its own:
// where the compiler saw what is called, it could keep other registers across the call.)
extern "C" void stylobate_ptx_swap_stacks(void** from, void* to);
asm(R"(
.text
.globl stylobate_ptx_swap_stacks
.type stylobate_ptx_swap_stacks, @function
stylobate_ptx_swap_stacks:
    pushq %rbp
    pushq %rbx
    pushq %r12
    pushq %r13
    pushq %r14
    pushq %r15
    movq %rsp, (%rdi)
    movq %rsi, %rsp
    popq %r15
    popq %r14
    popq %r13
    popq %r12
    popq %rbx
    popq %rbp
    ret
.size stylobate_ptx_swap_stacks, . - stylobate_ptx_swap_stacks
)");
#else
#include <ucontext.h>
#define PTX_UCONTEXT_USED
#endif

namespace ptx {

namespace {

constexpr std::uint64_t end_mark = 0x5a17ed5a17ed5a17;

thread_local Fiber* leaving = nullptr;
thread_local Fiber* arriving = nullptr;

} // namespace

struct Fiber::Context {
    std::vector<char> stack;
    void (*function)(void*) = nullptr;
    void* argument = nullptr;
#if defined(PTX_UCONTEXT_USED)
    ucontext_t place{};
#else
    void* place = nullptr; ///< the end of its stack, where its registers are
#endif
#if defined(PTX_ADDRESS_SANITIZER)
    void* fake_stack = nullptr;
    const void* bottom = nullptr; ///< of the thread's own stack: learned when it is left for the first time
    std::size_t bytes = 0;
#endif
#if defined(PTX_THREAD_SANITIZER)
    void* thread = nullptr;
#endif
};

Fiber::Fiber() : context_(std::make_unique<Context>())
{
#if defined(PTX_THREAD_SANITIZER)
    context_->thread = __tsan_get_current_fiber();
#endif
}

Fiber::Fiber(std::size_t stack_bytes) : context_(std::make_unique<Context>())
{
    context_->stack.resize(stack_bytes);
#if defined(PTX_ADDRESS_SANITIZER)
    context_->bottom = context_->stack.data();
    context_->bytes = stack_bytes;
#endif
#if defined(PTX_THREAD_SANITIZER)
    context_->thread = __tsan_create_fiber(0);
#endif
}

Fiber::~Fiber()
{
    std::vector<char>& stack = context_->stack;
    if (stack.empty())
        return;
#if defined(PTX_ADDRESS_SANITIZER)
    __asan_unpoison_memory_region(stack.data(), stack.size());
#endif
#if defined(PTX_THREAD_SANITIZER)
    __tsan_destroy_fiber(context_->thread);
#endif
}

void Fiber::begin(void (*function)(void*), void* argument)
{
    Context& c = *context_;
    c.function = function;
    c.argument = argument;
#if defined(PTX_ADDRESS_SANITIZER)
    // functions that were dropped have left marks between their variables
    __asan_unpoison_memory_region(c.stack.data(), c.stack.size());
    c.fake_stack = nullptr;
#endif
#if defined(PTX_THREAD_SANITIZER)
    __tsan_destroy_fiber(c.thread);
    c.thread = __tsan_create_fiber(0);
#endif
    std::memcpy(c.stack.data(), &end_mark, sizeof end_mark);
#if defined(PTX_UCONTEXT_USED)
    getcontext(&c.place);
    c.place.uc_stack.ss_sp = c.stack.data();
    c.place.uc_stack.ss_size = c.stack.size();
    c.place.uc_link = nullptr;
    makecontext(&c.place, &Fiber::enter, 0);
#else
    // as if `enter` had been called by nobody: the address to return to lies at a multiple of 16, less 8
    const auto top = reinterpret_cast<std::uintptr_t>(c.stack.data() + c.stack.size()) / 16 * 16;
    void** place = reinterpret_cast<void**>(top);
    *--place = nullptr;
    *--place = reinterpret_cast<void*>(&Fiber::enter);
    for (int saved = 0; saved < 6; ++saved)
        *--place = nullptr;
    c.place = place;
#endif
}

void Fiber::change_to(Fiber& other)
{
    leaving = this;
    arriving = &other;
#if defined(PTX_ADDRESS_SANITIZER)
    __sanitizer_start_switch_fiber(&context_->fake_stack, other.context_->bottom, other.context_->bytes);
#endif
#if defined(PTX_THREAD_SANITIZER)
    __tsan_switch_to_fiber(other.context_->thread, 0);
#endif
#if defined(PTX_UCONTEXT_USED)
    swapcontext(&context_->place, &other.context_->place);
#else
    stylobate_ptx_swap_stacks(&context_->place, other.context_->place);
#endif
    arrive();
}

void Fiber::arrive()
{
#if defined(PTX_ADDRESS_SANITIZER)
    __sanitizer_finish_switch_fiber(context_->fake_stack, &leaving->context_->bottom, &leaving->context_->bytes);
#endif
}

void Fiber::enter()
{
    Fiber& self = *arriving;
    self.arrive();
    self.context_->function(self.context_->argument);
    std::abort(); // it has returned: to nobody
}

bool Fiber::overrun() const
{
    return !context_->stack.empty() && std::memcmp(context_->stack.data(), &end_mark, sizeof end_mark) != 0;
}

} // namespace ptx
