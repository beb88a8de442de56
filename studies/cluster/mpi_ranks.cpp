/// Ranks by MPI; part of the program alone, so that the libraries do without MPI.

#include "studies/cluster/mpi_ranks.hpp"

#include "ensemble/model/input_error.hpp"

#ifdef STYLOBATE_MPI
#include <algorithm>
#include <deque>
#include <stdexcept>
#include <utility>

#include <mpi.h>
#if defined(__linux__)
#include <sched.h>
#endif
#endif

namespace stylobate {

#ifdef STYLOBATE_MPI

namespace {

/// A message of MPI has a length of at most 2^31 - 1; longer texts go in parts.
constexpr std::size_t largest_part = std::size_t{1} << 30;

/// The machine, and the cores of it that this process may use, as a text to compare.
std::string own_cores()
{
    char name[MPI_MAX_PROCESSOR_NAME];
    int length = 0;
    MPI_Get_processor_name(name, &length);
    std::string text(name, static_cast<std::size_t>(length));
#if defined(__linux__)
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        for (int core = 0; core < CPU_SETSIZE; ++core)
            if (CPU_ISSET(core, &set))
                text += ' ' + std::to_string(core);
#endif
    return text;
}

class MpiRanks : public Ranks {
public:
    MpiRanks()
    {
        int given = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given);
        if (given < MPI_THREAD_SERIALIZED)
            throw std::runtime_error("--mpi: this MPI has no MPI_THREAD_SERIALIZED");
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
        MPI_Comm machine{};
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
        MPI_Comm_rank(machine, &local_rank_);
        MPI_Comm_size(machine, &local_size_);
        MPI_Comm_free(&machine);
        const std::string cores = own_cores();
        const std::vector<std::string> all = of_all(cores);
        sharing_ = static_cast<int>(std::count(all.begin(), all.end(), cores));
    }
    ~MpiRanks() override { MPI_Finalize(); }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    int local_rank() const override { return local_rank_; }
    int local_size() const override { return local_size_; }
    int sharing() const override { return sharing_; }

    void send(int to, std::string content) override
    {
        forget_sent();
        sent_.push_back({std::move(content), MPI_Request{}});
        Sent& sent = sent_.back();
        MPI_Isend(sent.content.data(), static_cast<int>(sent.content.size()), MPI_BYTE, to, 0, MPI_COMM_WORLD,
                  &sent.request);
    }

    std::optional<Message> receive() override
    {
        forget_sent();
        int there = 0;
        MPI_Message message{};
        MPI_Status status;
        MPI_Improbe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &there, &message, &status);
        if (!there)
            return std::nullopt;
        int size = 0;
        MPI_Get_count(&status, MPI_BYTE, &size);
        std::string content(static_cast<std::size_t>(size), '\0');
        MPI_Mrecv(content.data(), size, MPI_BYTE, &message, MPI_STATUS_IGNORE);
        return Message{status.MPI_SOURCE, std::move(content)};
    }

    void await_sent() override
    {
        for (Sent& sent : sent_)
            MPI_Wait(&sent.request, MPI_STATUS_IGNORE);
        sent_.clear();
    }

    std::string of_first(const std::string& mine) override { return of(0, mine); }

    std::vector<std::string> of_all(const std::string& mine) override
    {
        std::vector<std::string> all;
        for (int rank = 0; rank < size_; ++rank)
            all.push_back(of(rank, mine));
        return all;
    }

    void abort(int status) override { MPI_Abort(MPI_COMM_WORLD, status); }

private:
    struct Sent {
        std::string content;
        MPI_Request request;
    };

    /// The text of a rank, for all.
    std::string of(int rank, const std::string& mine)
    {
        std::uint64_t size = mine.size();
        MPI_Bcast(&size, 1, MPI_UINT64_T, rank, MPI_COMM_WORLD);
        std::string text = rank == rank_ ? mine : std::string(size, '\0');
        for (std::size_t begin = 0; begin < size; begin += largest_part)
            MPI_Bcast(text.data() + begin, static_cast<int>(std::min<std::size_t>(largest_part, size - begin)),
                      MPI_BYTE, rank, MPI_COMM_WORLD);
        return text;
    }

    /// What has been sent needs no memory any more.
    void forget_sent()
    {
        while (!sent_.empty()) {
            int done = 0;
            MPI_Test(&sent_.front().request, &done, MPI_STATUS_IGNORE);
            if (!done)
                return;
            sent_.pop_front();
        }
    }

    int rank_ = 0, size_ = 1, local_rank_ = 0, local_size_ = 1, sharing_ = 1;
    std::deque<Sent> sent_;
};

} // namespace

std::unique_ptr<Ranks> mpi_ranks()
{
    return std::make_unique<MpiRanks>();
}

std::optional<std::string> mpi_library()
{
    char text[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    MPI_Get_library_version(text, &length);
    std::string all(text, static_cast<std::size_t>(length));
    return all.substr(0, all.find_first_of(",\n"));
}

#else

std::unique_ptr<Ranks> mpi_ranks()
{
    throw InputError("--mpi: this program was built without MPI. Install it (Debian: libopenmpi-dev), configure again "
                     "with cmake -DSTYLOBATE_MPI=ON, and build; or run shards (--shard).");
}

std::optional<std::string> mpi_library()
{
    return std::nullopt;
}

#endif

} // namespace stylobate
