#pragma once

#include "cpp/serve.hpp"
#include "view.hpp"

#include <vector>

namespace engine::qt_adapter {

/// Qt Quick 3D, as README.md of this folder describes it.
class QtEngine : public Engine {
public:
    explicit QtEngine(Mask mask) : mask_{mask} {}

    Identity identity() override;
    void open(const Scene& scene) override;
    Drawn draw(const Json& draw) override;

private:
    /// The picture with white surfaces, or position and -V from the adapter's material.
    [[nodiscard]] std::vector<float> seen(const Json& draw, bool is_picture, bool casts);

    Mask mask_;
    View view_;
    Scene scene_;
};

} // namespace engine::qt_adapter
