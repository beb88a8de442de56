#pragma once
/// The exception for errors that a user can correct.

#include <stdexcept>

namespace stylobate::api {

/// Bad input: a study, a record, a results file or an option that cannot be used. The message is the one that the
/// command line prints: where (file and line, if there is one), what, the allowed range, and what to do.
///
/// Everything in this library may throw it. Errors that are not due to input are of another
/// type derived from std::exception, such as std::system_error for a full disk.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Stopped by the caller before there was a result: `replay` with a function that returned false.
class Stopped : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace stylobate::api
