#pragma once

#include "scene/error.hpp"

namespace gnomon::store {

/// There is no file where the baseline should be (exit code 3).
class BaselineMissing : public scene::InputError {
public:
    using InputError::InputError;
};

} // namespace gnomon::store
