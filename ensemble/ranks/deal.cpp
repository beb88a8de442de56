#include "ensemble/ranks/deal.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

/// First letter of a message.
enum Word : char {
    asks = 'a',   ///< for a portion
    dealt_ = 'd', ///< a portion; an empty one is the last
    gives = 'g',  ///< what has come of some number
    stops = 's',
    ready = 'r', ///< this rank needs nothing more
    ends = 'e',  ///< all ranks are ready; and whether the deal was stopped
};

constexpr std::uint64_t largest_portion = 256;
/// How long a thread without messages sleeps: what a portion may come late, against the cost of looking.
constexpr std::chrono::milliseconds between_looks{1};

std::string word(Word first, std::string_view rest = {})
{
    return std::string(1, first).append(rest);
}

} // namespace

std::uint64_t Deal::portion(std::uint64_t left, int ranks)
{
    return std::clamp<std::uint64_t>(left / (8 * static_cast<std::uint64_t>(ranks)), 1, largest_portion);
}

Deal::Deal(Ranks& ranks, Stock stock, std::size_t ahead, std::function<void(std::string_view)> take)
    : ranks_(ranks), stock_(std::move(stock)), ahead_(ahead), take_(std::move(take)), others_running_(ranks.size() - 1),
      thread_([this] { ranks_.leads() ? lead() : follow(); })
{
}

Deal::~Deal()
{
    {
        const std::lock_guard lock(mutex_);
        left_early_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

std::optional<std::uint64_t> Deal::next()
{
    std::unique_lock lock(mutex_);
    if (ranks_.leads()) {
        if (stopped_)
            return std::nullopt;
        std::optional<std::uint64_t> number = stock_.next();
        stock_.left -= number && stock_.left > 0;
        return number;
    }
    changed_.wait(lock, [this] { return !hand_.empty() || used_up_ || stopped_ || left_early_; });
    if (hand_.empty() || stopped_ || left_early_)
        return std::nullopt;
    const std::uint64_t number = hand_.front();
    hand_.pop_front();
    if (hand_.size() == ahead_)
        changed_.notify_all(); // the thread that asks
    return number;
}

void Deal::give(std::string content)
{
    const std::lock_guard lock(mutex_);
    given_.push_back(std::move(content));
}

void Deal::stop()
{
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    changed_.notify_all();
}

bool Deal::stopped() const
{
    const std::lock_guard lock(mutex_);
    return stopped_;
}

bool Deal::finish()
{
    {
        const std::lock_guard lock(mutex_);
        ready_ = true;
    }
    changed_.notify_all();
    thread_.join();
    if (error_)
        std::rethrow_exception(error_);
    return !stopped_;
}

/// A portion, as a message. @pre the lock is held
std::string Deal::dealt()
{
    std::vector<std::uint64_t> numbers;
    const std::uint64_t most = portion(stock_.left, ranks_.size());
    while (!stopped_ && numbers.size() < most) {
        const std::optional<std::uint64_t> number = stock_.next();
        if (!number)
            break;
        numbers.push_back(*number);
    }
    stock_.left -= std::min<std::uint64_t>(stock_.left, numbers.size());
    return word(dealt_, {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(std::uint64_t)});
}

void Deal::handle(const Ranks::Message& message)
{
    const std::string_view content = std::string_view(message.content).substr(1);
    switch (static_cast<Word>(message.content.front())) {
    case asks: {
        std::unique_lock lock(mutex_);
        std::string numbers = dealt();
        lock.unlock();
        ranks_.send(message.from, std::move(numbers));
        break;
    }
    case gives:
        try {
            take_(content);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!error_)
                error_ = std::current_exception();
            stopped_ = true;
        }
        break;
    case stops:
        stop();
        break;
    case ready:
        --others_running_;
        break;
    default:
        break;
    }
}

void Deal::pause(std::unique_lock<std::mutex>& lock)
{
    changed_.wait_for(lock, between_looks);
}

void Deal::lead()
{
    std::unique_lock lock(mutex_);
    while ((others_running_ > 0 || !ready_) && !left_early_) {
        lock.unlock();
        bool any = false;
        while (const std::optional<Ranks::Message> message = ranks_.receive()) {
            handle(*message);
            any = true;
        }
        lock.lock();
        if (!any)
            pause(lock);
    }
    if (left_early_)
        return;
    const std::string last = word(ends, stopped_ ? "s" : "");
    lock.unlock();
    for (int rank = 1; rank < ranks_.size(); ++rank)
        ranks_.send(rank, last);
    ranks_.await_sent();
}

void Deal::follow()
{
    bool asked = false, told_stop = false, told_ready = false;
    std::unique_lock lock(mutex_);
    while (!left_early_) {
        std::deque<std::string> given = std::exchange(given_, {});
        const bool ask = !asked && !used_up_ && !stopped_ && hand_.size() <= ahead_;
        const bool tell_stop = stopped_ && !told_stop, tell_ready = ready_ && !told_ready;
        lock.unlock();
        for (const std::string& content : given)
            ranks_.send(0, word(gives, content));
        if (ask)
            ranks_.send(0, word(asks));
        if (tell_stop)
            ranks_.send(0, word(stops));
        if (tell_ready)
            ranks_.send(0, word(ready));
        asked |= ask;
        told_stop |= tell_stop;
        told_ready |= tell_ready;
        bool any = false;
        while (const std::optional<Ranks::Message> message = ranks_.receive()) {
            any = true;
            const std::string_view content = std::string_view(message->content).substr(1);
            if (message->content.front() == ends) {
                const std::lock_guard relock(mutex_);
                stopped_ |= !content.empty();
                ranks_.await_sent();
                return;
            }
            std::vector<std::uint64_t> numbers(content.size() / sizeof(std::uint64_t));
            std::memcpy(numbers.data(), content.data(), content.size());
            asked = false;
            const std::lock_guard relock(mutex_);
            hand_.insert(hand_.end(), numbers.begin(), numbers.end());
            used_up_ = numbers.empty();
            changed_.notify_all();
        }
        lock.lock();
        if (!any && given_.empty())
            pause(lock);
    }
}

} // namespace stylobate
