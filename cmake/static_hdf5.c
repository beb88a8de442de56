// Debian's static HDF5 is compiled for programs: it reads `stdout` and `stderr` where a program has them, which a
// module of Python cannot link. The linker replaces both names by these of the module (-Wl,--wrap).
#include <stdio.h>

extern FILE* __real_stdout;
extern FILE* __real_stderr;

__attribute__((visibility("hidden"))) FILE* __wrap_stdout;
__attribute__((visibility("hidden"))) FILE* __wrap_stderr;

__attribute__((constructor(101))) static void set_streams(void)
{
    __wrap_stdout = __real_stdout;
    __wrap_stderr = __real_stderr;
}
