#pragma once
/// Processes that run one study together, on one machine or several: ranks, as MPI calls them.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// All ranks execute the same program on the same input and reach the collective calls in the same order. Rank 0
/// leads: it alone reads and writes files of results and talks to the user. One thread of a process calls at a time.
class Ranks {
public:
    struct Message {
        int from = 0;
        std::string content;
    };

    Ranks() = default;
    virtual ~Ranks() = default;
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    virtual int rank() const = 0; ///< from 0
    virtual int size() const = 0;
    virtual int local_rank() const = 0; ///< among the ranks of this machine, from 0
    virtual int local_size() const = 0; ///< how many this machine has
    virtual int sharing() const = 0;    ///< how many of them may use the same cores as this one, itself counted
    bool leads() const { return rank() == 0; }

    /// Sends without waiting. Messages from one rank to another arrive in their order.
    virtual void send(int to, std::string content) = 0;
    /// The next message that has arrived; nothing: none has.
    virtual std::optional<Message> receive() = 0;
    /// Waits until all that this rank has sent is under way, and its memory free.
    virtual void await_sent() = 0;

    /// Collective: the text of rank 0.
    virtual std::string of_first(const std::string& mine) = 0;
    /// Collective: the texts of all ranks, by their numbers.
    virtual std::vector<std::string> of_all(const std::string& mine) = 0;

    /// Ends all ranks at once, after an error of this one.
    virtual void abort(int status) = 0;
};

/// Collective. @param mine a text that is not empty, or nullopt if this rank has nothing to say
/// @return the first text, by rank; nullopt if no rank has one
inline std::optional<std::string> first_said(Ranks& ranks, const std::optional<std::string>& mine)
{
    for (std::string& text : ranks.of_all(mine.value_or("")))
        if (!text.empty())
            return std::move(text);
    return std::nullopt;
}

/// Collective, of all ranks that there are. @param ranks null: this process is alone
/// @return whether it is true on all of them
inline bool all_agree(Ranks* ranks, bool mine)
{
    return ranks ? !first_said(*ranks, mine ? std::nullopt : std::optional("no")) : mine;
}

} // namespace stylobate
