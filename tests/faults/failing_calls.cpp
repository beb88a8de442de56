/// Loaded before the C library (LD_PRELOAD): the n-th call of one kind that concerns files fails.
///
///   STYLOBATE_FAIL_CALL    write, fsync, rename, truncate, open (for writing) or lock
///   STYLOBATE_FAIL_AT      which call, from 1; 0: none, they are counted only
///   STYLOBATE_FAIL_ERRNO   its errno
///   STYLOBATE_FAIL_STAYS   1: all later ones fail too
///   STYLOBATE_FAIL_COUNT   file to which the number of calls is written at the end
///
///   STYLOBATE_CLOCK_JUMP_S  the clock of the day is off by so many seconds at every second call
///
/// Calls on terminals, pipes and sockets are let through: they are no files.

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdarg>

namespace {

const char* setting(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

struct Plan {
    const char* call = setting("STYLOBATE_FAIL_CALL");
    long at = std::atol(setting("STYLOBATE_FAIL_AT"));
    int error = std::atoi(setting("STYLOBATE_FAIL_ERRNO"));
    bool stays = std::atoi(setting("STYLOBATE_FAIL_STAYS")) != 0;
    const char* count_to = setting("STYLOBATE_FAIL_COUNT");
    long clock_jump_s = std::atol(setting("STYLOBATE_CLOCK_JUMP_S"));
    std::atomic<long> looks{0}; ///< at the clock of the day
    std::atomic<long> calls{0};

    ~Plan()
    {
        if (*count_to == 0)
            return;
        if (std::FILE* const file = std::fopen(count_to, "w")) {
            std::fprintf(file, "%ld\n", calls.load());
            std::fclose(file);
        }
    }
};

Plan& plan()
{
    static Plan one;
    return one;
}

bool is_file(int descriptor)
{
    struct stat of = {};
    return fstat(descriptor, &of) == 0 && S_ISREG(of.st_mode);
}

/// Counts a call; whether it is to fail, with errno set.
bool fails(const char* call)
{
    Plan& p = plan();
    if (std::strcmp(call, p.call) != 0)
        return false;
    const long n = ++p.calls;
    if (p.at == 0 || (p.stays ? n < p.at : n != p.at))
        return false;
    errno = p.error;
    return true;
}

template <class Function>
Function* next(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace

#pragma GCC visibility push(default)
extern "C" {

ssize_t write(int d, const void* from, size_t bytes)
{
    return is_file(d) && fails("write") ? -1 : next<decltype(write)>("write")(d, from, bytes);
}
ssize_t pwrite(int d, const void* from, size_t bytes, off_t at)
{
    return is_file(d) && fails("write") ? -1 : next<decltype(pwrite)>("pwrite")(d, from, bytes, at);
}
ssize_t pwrite64(int d, const void* from, size_t bytes, off64_t at)
{
    return is_file(d) && fails("write") ? -1 : next<decltype(pwrite64)>("pwrite64")(d, from, bytes, at);
}
int fsync(int d)
{
    return fails("fsync") ? -1 : next<decltype(fsync)>("fsync")(d);
}
int fdatasync(int d)
{
    return fails("fsync") ? -1 : next<decltype(fdatasync)>("fdatasync")(d);
}
int rename(const char* from, const char* to)
{
    return fails("rename") ? -1 : next<decltype(rename)>("rename")(from, to);
}
int ftruncate(int d, off_t length)
{
    return fails("truncate") ? -1 : next<decltype(ftruncate)>("ftruncate")(d, length);
}
int ftruncate64(int d, off64_t length)
{
    return fails("truncate") ? -1 : next<decltype(ftruncate64)>("ftruncate64")(d, length);
}
int fcntl(int d, int command, ...)
{
    std::va_list more;
    va_start(more, command);
    void* const argument = va_arg(more, void*); // whatever it is, it is as wide as a register
    va_end(more);
    const bool locks = command == F_SETLK || command == F_SETLKW || command == F_OFD_SETLK || command == F_OFD_SETLKW;
    return locks && fails("lock") ? -1 : next<int(int, int, ...)>("fcntl")(d, command, argument);
}
int fcntl64(int d, int command, ...)
{
    std::va_list more;
    va_start(more, command);
    void* const argument = va_arg(more, void*);
    va_end(more);
    return fcntl(d, command, argument);
}
int clock_gettime(clockid_t clock, timespec* now) noexcept
{
    const int status = next<int(clockid_t, timespec*)>("clock_gettime")(clock, now);
    if (clock == CLOCK_REALTIME && plan().looks++ % 2 != 0)
        now->tv_sec += plan().clock_jump_s;
    return status;
}
int open(const char* path, int flags, ...)
{
    std::va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return (flags & O_ACCMODE) != O_RDONLY && fails("open") ? -1 : next<decltype(open)>("open")(path, flags, mode);
}
int open64(const char* path, int flags, ...)
{
    std::va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return (flags & O_ACCMODE) != O_RDONLY && fails("open") ? -1 : next<decltype(open64)>("open64")(path, flags, mode);
}
}
#pragma GCC visibility pop
