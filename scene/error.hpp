#pragma once

#include <stdexcept>
#include <string>

namespace gnomon::scene {

/// A job, scene file or argument is bad, missing or unreadable (exit code 2).
///
/// `what()` is one line: what is wrong, where (file:line, key or object), and the remedy.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The environment failed: GL, EGL, Embree, or an output file (exit code 4).
///
/// `what()` is one line: the failed call, its code, and the remedy.
class EnvironmentError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace gnomon::scene
