#pragma once
/// Ranks that are threads of one process: for tests of what processes do together, without MPI.

#include "ensemble/run/ranks.hpp"

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace stylobate::test {

class ThreadRanks {
public:
    explicit ThreadRanks(int size) : boxes_(static_cast<std::size_t>(size)), texts_(boxes_.size()) {}

    /// Calls f with each rank, in a thread of its own, and waits for all of them.
    void run(const std::function<void(Ranks&)>& f)
    {
        std::vector<std::thread> threads;
        for (std::size_t rank = 0; rank < boxes_.size(); ++rank)
            threads.emplace_back([this, &f, rank] {
                Rank own(*this, static_cast<int>(rank));
                f(own);
            });
        for (std::thread& thread : threads)
            thread.join();
    }

private:
    class Rank : public Ranks {
    public:
        Rank(ThreadRanks& all, int rank) : all_(all), rank_(rank) {}
        int rank() const override { return rank_; }
        int size() const override { return static_cast<int>(all_.boxes_.size()); }
        int local_rank() const override { return rank_; }
        int local_size() const override { return size(); }
        int sharing() const override { return size(); }

        void send(int to, std::string content) override
        {
            const std::lock_guard lock(all_.mutex_);
            all_.boxes_[static_cast<std::size_t>(to)].push_back({rank_, std::move(content)});
        }
        std::optional<Message> receive() override
        {
            const std::lock_guard lock(all_.mutex_);
            std::deque<Message>& box = all_.boxes_[static_cast<std::size_t>(rank_)];
            if (box.empty())
                return std::nullopt;
            Message message = std::move(box.front());
            box.pop_front();
            return message;
        }
        void await_sent() override {}

        std::string of_first(const std::string& mine) override { return of_all(mine).front(); }
        std::vector<std::string> of_all(const std::string& mine) override
        {
            std::unique_lock lock(all_.mutex_);
            all_.texts_[static_cast<std::size_t>(rank_)] = mine;
            if (++all_.arrived_ == all_.texts_.size()) {
                all_.arrived_ = 0;
                all_.said_ = all_.texts_;
                ++all_.calls_;
                all_.changed_.notify_all();
            } else {
                all_.changed_.wait(lock, [this, call = all_.calls_] { return all_.calls_ != call; });
            }
            return all_.said_; // until all have come to the next call
        }
        void abort(int) override { throw std::logic_error("a rank was aborted"); }

    private:
        ThreadRanks& all_;
        const int rank_;
    };

    std::mutex mutex_; ///< guards what follows
    std::condition_variable changed_;
    std::vector<std::deque<Ranks::Message>> boxes_; ///< by receiver
    std::vector<std::string> texts_, said_;
    std::size_t arrived_ = 0, calls_ = 0;
};

} // namespace stylobate::test
