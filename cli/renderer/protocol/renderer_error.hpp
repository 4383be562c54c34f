#pragma once

#include "scene/error.hpp"

namespace gnomon::cli {

/// A renderer died, hung, or broke a rule of docs/renderer_protocol.md; `what()` names the
/// renderer, the request and what came, and ends with the renderer's last words.
class RendererFailure : public scene::EnvironmentError {
public:
    using EnvironmentError::EnvironmentError;
};

/// A renderer cannot do what it was asked for, as it says by key. It goes on.
class RendererRefusal : public scene::InputError {
public:
    using InputError::InputError;
};

} // namespace gnomon::cli
