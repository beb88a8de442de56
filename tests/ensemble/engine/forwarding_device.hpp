#pragma once
/// A device that has another one do all: tests override what they count, delay or break.

#include "ensemble/planar/device/host_device.hpp"
#include "ensemble/planar/device/slot_tasks.hpp"

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>

namespace stylobate::test {

class ForwardingDevice : public Device {
public:
    std::string name() const override { return inner_->name(); }
    int best_slots(const SlotMemory&, std::size_t) const override { return 4; }
    void* allocate(std::size_t bytes) override { return inner_->allocate(bytes); }
    void release(void* memory) noexcept override { inner_->release(memory); }
    void* allocate_host(std::size_t bytes) override { return inner_->allocate_host(bytes); }
    void release_host(void* memory) noexcept override { inner_->release_host(memory); }
    void upload(void* to, const void* from, std::size_t bytes) override
    {
        uploaded_ += bytes;
        inner_->upload(to, from, bytes);
    }
    void download(void* to, const void* from, std::size_t bytes) override { inner_->download(to, from, bytes); }
    void advance(const SlotMemory& memory, int chunks, int count) override
    {
        ++launches_;
        inner_->advance(memory, chunks, count);
    }
    void run(const MoveColumns& task, int count) override { inner_->run(task, count); }
    void run(const MoveSingleColumns& task, int count) override { inner_->run(task, count); }
    void run(const MarkSlots& task, int count) override { inner_->run(task, count); }
    void run(const MultiplyAdds& task, int count) override { inner_->run(task, count); }

    int launches() const { return launches_; }
    std::size_t uploaded() const { return uploaded_; }

private:
    std::shared_ptr<Device> inner_ = host_device();
    std::atomic<int> launches_ = 0;
    std::size_t uploaded_ = 0;
};

} // namespace stylobate::test
