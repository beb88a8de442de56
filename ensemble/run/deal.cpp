#include "ensemble/run/deal.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

/// First letter of a message.
enum class Word : char {
    ask = 'a',     ///< for a portion
    portion = 'p', ///< the numbers; none: the last one has been dealt
    give = 'g',    ///< what has come of some number
    stop = 's',    ///< to all ranks, by way of rank 0
    ready = 'r',   ///< this rank needs nothing more
    end = 'e',     ///< all ranks are ready
};

constexpr std::uint64_t largest_portion = 256;
/// How long a thread without messages sleeps: what a portion may come late, against the cost of looking.
constexpr std::chrono::milliseconds between_looks{1};

std::string text_of(Word first, std::string_view rest = {})
{
    return std::string(1, static_cast<char>(first)).append(rest);
}

Word word_of(const Ranks::Message& message)
{
    return static_cast<Word>(message.content.front());
}

std::string_view content_of(const Ranks::Message& message)
{
    return std::string_view(message.content).substr(1);
}

} // namespace

std::uint64_t Deal::portion(std::uint64_t left, int ranks)
{
    return std::clamp<std::uint64_t>(left / (8 * static_cast<std::uint64_t>(ranks)), 1, largest_portion);
}

Deal::Deal(Ranks& ranks, Stock stock, std::size_t ahead, std::function<void(std::string_view)> take)
    : ranks_(ranks), stock_(std::move(stock)), ahead_(ahead), take_(std::move(take)),
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

/// A portion, as a message.
std::string Deal::dealt()
{
    const std::lock_guard lock(mutex_);
    std::vector<std::uint64_t> numbers;
    const std::uint64_t most = portion(stock_.left, ranks_.size());
    while (!stopped_ && numbers.size() < most) {
        const std::optional<std::uint64_t> number = stock_.next();
        if (!number)
            break;
        numbers.push_back(*number);
    }
    stock_.left -= std::min<std::uint64_t>(stock_.left, numbers.size());
    return text_of(Word::portion,
                   {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(std::uint64_t)});
}

void Deal::take(std::string_view content)
{
    if (error_) // nothing of what comes now is kept
        return;
    try {
        take_(content);
    } catch (...) {
        error_ = std::current_exception();
        stop();
    }
}

void Deal::lead()
{
    int running = ranks_.size() - 1;
    bool told_stop = false;
    std::unique_lock lock(mutex_);
    while ((running > 0 || !ready_) && !left_early_) {
        const bool tell_stop = stopped_ && !told_stop;
        lock.unlock();
        if (tell_stop)
            tell_all(text_of(Word::stop));
        told_stop |= tell_stop;
        bool any = false;
        for (; const std::optional<Ranks::Message> message = ranks_.receive(); any = true) {
            const Word word = word_of(*message);
            if (word == Word::ask)
                ranks_.send(message->from, dealt());
            else if (word == Word::give)
                take(content_of(*message));
            else if (word == Word::stop)
                stop();
            else if (word == Word::ready)
                --running;
        }
        lock.lock();
        if (!any)
            changed_.wait_for(lock, between_looks);
    }
    const bool tell_stop = stopped_ && !told_stop;
    lock.unlock();
    if (left_early_)
        return;
    if (tell_stop)
        tell_all(text_of(Word::stop));
    tell_all(text_of(Word::end));
    ranks_.await_sent();
}

void Deal::tell_all(const std::string& content)
{
    for (int rank = 1; rank < ranks_.size(); ++rank)
        ranks_.send(rank, content);
}

void Deal::follow()
{
    bool asked = false, told_stop = false, told_ready = false;
    std::unique_lock lock(mutex_);
    while (!left_early_) {
        const std::deque<std::string> given = std::exchange(given_, {});
        const bool ask = !asked && !used_up_ && !stopped_ && hand_.size() <= ahead_;
        const bool tell_stop = stopped_ && !told_stop, tell_ready = ready_ && !told_ready;
        lock.unlock();
        for (const std::string& content : given)
            ranks_.send(0, text_of(Word::give, content));
        if (ask)
            ranks_.send(0, text_of(Word::ask));
        if (tell_stop)
            ranks_.send(0, text_of(Word::stop));
        if (tell_ready)
            ranks_.send(0, text_of(Word::ready));
        asked |= ask;
        told_stop |= tell_stop;
        told_ready |= tell_ready;
        bool any = false;
        for (; const std::optional<Ranks::Message> message = ranks_.receive(); any = true) {
            const Word word = word_of(*message);
            if (word == Word::end)
                return ranks_.await_sent();
            if (word == Word::stop)
                stop();
            if (word == Word::portion) {
                asked = false;
                pick_up(content_of(*message));
            }
        }
        lock.lock();
        if (!any && given_.empty())
            changed_.wait_for(lock, between_looks);
    }
}

void Deal::pick_up(std::string_view portion)
{
    std::vector<std::uint64_t> numbers(portion.size() / sizeof(std::uint64_t));
    if (!numbers.empty())
        std::memcpy(numbers.data(), portion.data(), portion.size());
    const std::lock_guard lock(mutex_);
    hand_.insert(hand_.end(), numbers.begin(), numbers.end());
    used_up_ = numbers.empty();
    changed_.notify_all();
}

} // namespace stylobate
