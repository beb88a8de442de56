#pragma once
/// The numbers of a round, dealt out to the ranks while they run them, so that an uneven load costs little.
///
/// Rank 0 deals. Every rank has a few numbers ahead and asks for more before they are used up; a portion is an eighth
/// of a rank's share of what is left (guided self-scheduling: Polychronopoulos and Kuck 1987), so that the ranks end
/// together. A thread of each rank sends and receives, so that those that compute hardly ever wait for another process.

#include "ensemble/run/ranks.hpp"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace stylobate {

class Deal {
public:
    /// What rank 0 has to deal; of no meaning on the others.
    struct Stock {
        std::function<std::optional<std::uint64_t>()> next;
        std::uint64_t left = 0; ///< how many `next` will give
    };

    /// All ranks make one at the same time.
    /// @param ahead numbers that this rank keeps in hand
    /// @param take  takes, on rank 0, what another rank gave; called by the deal's own thread
    Deal(Ranks& ranks, Stock stock, std::size_t ahead, std::function<void(std::string_view)> take);
    /// Without `finish`, after an error: this rank leaves without a message to the others.
    ~Deal();
    Deal(const Deal&) = delete;
    Deal& operator=(const Deal&) = delete;

    /// The next number; waits for it. Nothing: all are dealt, or the deal was stopped.
    std::optional<std::uint64_t> next();
    /// Gives rank 0 what has come of a number. @pre this is another rank
    void give(std::string content);
    /// Deals no more, to any rank; what ranks have in hand falls.
    void stop();
    bool stopped() const;
    /// Waits until every rank has come here, and rank 0 has taken what was given.
    /// @return whether all numbers were dealt   @throws what `take` threw
    bool finish();

    /// How many a rank gets at once. @param left that are not dealt yet
    static std::uint64_t portion(std::uint64_t left, int ranks);

private:
    void lead();
    std::string dealt();
    void take(std::string_view content);
    void tell_all(const std::string& content);
    void follow();
    void pick_up(std::string_view portion);

    Ranks& ranks_;
    Stock stock_;
    const std::size_t ahead_;
    const std::function<void(std::string_view)> take_;
    mutable std::mutex mutex_; ///< guards what follows
    std::condition_variable changed_;
    std::deque<std::uint64_t> hand_;
    std::deque<std::string> given_;
    bool stopped_ = false, used_up_ = false, ready_ = false, left_early_ = false;
    std::exception_ptr error_; ///< of the thread below, for `finish`
    std::thread thread_;       ///< sends and receives
};

} // namespace stylobate
