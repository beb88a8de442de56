#include "ensemble/planar/device/host_device.hpp"

#include "ensemble/planar/device/slot_tasks.hpp"

#include <cstdlib>
#include <cstring>
#include <new>

namespace stylobate {

namespace {

struct Here {};

class HostDevice : public Device {
public:
    std::string name() const override { return "the processor"; }
    int best_slots(const SlotMemory&, std::size_t) const override { return 64; }

    void* allocate(std::size_t bytes) override
    {
        void* const memory = std::calloc(bytes, 1);
        if (memory == nullptr)
            throw std::bad_alloc();
        return memory;
    }
    void release(void* memory) noexcept override { std::free(memory); }
    void* allocate_host(std::size_t bytes) override { return allocate(bytes); }
    void release_host(void* memory) noexcept override { std::free(memory); }
    void upload(void* to, const void* from, std::size_t bytes) override { std::memcpy(to, from, bytes); }
    void download(void* to, const void* from, std::size_t bytes) override { std::memcpy(to, from, bytes); }

    void advance(const SlotMemory& memory, int chunks, int count) override
    {
        with_model<Here>(memory, chunks, [count](const auto& task) { loop(task, count); });
    }
    void run(const MoveColumns& task, int count) override { loop(task, count); }
    void run(const MoveSingleColumns& task, int count) override { loop(task, count); }
    void run(const MarkSlots& task, int count) override { loop(task, count); }
    void run(const MultiplyAdds& task, int count) override { loop(task, count); }

private:
    template <class Task>
    static void loop(const Task& task, int count)
    {
        for (int i = 0; i < count; ++i)
            task(i);
    }
};

} // namespace

std::shared_ptr<Device> host_device()
{
    return std::make_shared<HostDevice>();
}

} // namespace stylobate
