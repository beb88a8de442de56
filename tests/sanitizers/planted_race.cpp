/// A race that ThreadSanitizer has to report: turns of a loop add to one number. The list of what it leaves out
/// (tests/tsan_suppressions.txt) must not hide it. The argument says where the race is: in the loop's own function, or
/// in one that it calls.

#include "ensemble/numerics/in_parallel.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>

namespace {

double sum = 0;

[[gnu::noinline]] void add(int turn)
{
    for (int k = 0; k < 20000; ++k) // long enough for a second thread to come
        sum += std::sin(k * 1e-3 * turn);
}

} // namespace

int main(int argc, char** argv)
{
    if (argc > 1 && std::strcmp(argv[1], "called") == 0)
        stylobate::in_parallel(0, 1000, [](int turn) { add(turn); });
    else
        stylobate::in_parallel(0, 1000, [](int turn) {
            for (int k = 0; k < 20000; ++k)
                sum += std::sin(k * 1e-3 * turn);
        });
    std::printf("%g\n", sum);
}
