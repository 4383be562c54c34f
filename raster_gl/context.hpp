#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::raster_gl {

/// What the driver says of itself.
struct GlFacts {
    std::string renderer;
    std::string version;
    std::string vendor;
    std::string platform; ///< "EGL device 0" or "surfaceless"
    int max_texture_texels = 0;
    int max_viewport_px = 0;
    int subpixel_bits = 0;
    float max_anisotropy = 1;  ///< 1: the driver has none
    int max_depth_samples = 1; ///< of a texel of a depth texture
};

/// A headless OpenGL 4.5 core context, current on the thread that made it.
///
/// GL's debug output is turned into errors: `check` throws what the driver reported since the last
/// call. Destroy every GL object before the context.
class Context {
public:
    /// @param device  index from `list_devices`; empty tries every device (hardware first), then
    ///                Mesa's surfaceless platform.
    /// @throws scene::EnvironmentError  naming what failed and what to do: no driver, no room.
    explicit Context(std::optional<int> device = {});
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes it current on the calling thread. It must not be current on another.
    /// @throws scene::EnvironmentError  if EGL refuses.
    void make_current() const;

    [[nodiscard]] const GlFacts& facts() const;
    /// @throws scene::EnvironmentError  if GL reported an error, naming `doing` and GL's message.
    void check(std::string_view doing) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The context that the calling thread has when this is made, of whatever library, or none. It is
/// the thread's again when this ends.
class PreviousContext {
public:
    PreviousContext();
    ~PreviousContext();
    PreviousContext(const PreviousContext&) = delete;
    PreviousContext& operator=(const PreviousContext&) = delete;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::raster_gl
