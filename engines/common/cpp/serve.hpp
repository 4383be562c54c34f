#pragma once

#include "cpp/json.hpp"
#include "cpp/request_validator.hpp"
#include "cpp/scene.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace engine {
/// Describes a key of the job's [engine] table (docs/renderer_protocol.md).
Json number_key(std::string_view name, double least, double most, double initial,
                std::string_view unit, std::string_view help);
Json integer_key(std::string_view name, int least, int most, int initial, std::string_view unit,
                 std::string_view help);
Json boolean_key(std::string_view name, bool initial, std::string_view help);
Json choice_key(std::string_view name, const std::vector<std::string>& values,
                std::string_view initial, std::string_view help);

/// The engine's part of the answer to `hello`.
struct Identity {
    std::string name;
    std::string version;
    std::string device; ///< cut after 124 bytes
    Json keys;          ///< an array
};

/// Raw floats for a file in the frame's folder, with the top row first.
struct Floats {
    std::string name; ///< in `[files]` (docs/evaluate.md#raw-floats), or "map" for the map's depths
    int width = 0;    ///< [px]; of the map [texels]
    int height = 0;
    int count = 1; ///< numbers a pixel
    std::vector<float> values;
};

/// A drawn frame, with at least `position` (NaN for background) and `shadow`.
struct Drawn {
    std::vector<Floats> files;
    Json tables; ///< `case` of the answer, without `map`
};

/// An engine driven by Gnomon. It throws `Refusal` for requests that it cannot do. Any other
/// exception becomes an error answer, too.
class Engine {
public:
    virtual ~Engine() = default;
    [[nodiscard]] virtual Identity identity() = 0;
    /// Replaces the scene.
    virtual void open(const Scene& scene) = 0;
    /// Draws the open scene.
    /// @param draw  of the request, with every key of the engine.
    [[nodiscard]] virtual Drawn draw(const Json& draw) = 0;

protected:
    Engine() = default;
    Engine(const Engine&) = default;
    Engine& operator=(const Engine&) = default;
};

/// Reserves standard output for answers: what libraries write there goes to standard error. Call it
/// once, before any library writes.
/// @return  The file descriptor for answers.
int take_standard_output();

/// Answers requests from standard input until `close` or its end.
/// @param answers  from take_standard_output().
/// @throws std::runtime_error  on a line that is not a request.
void serve(Engine& engine, int answers);

/// The source of the mask: the engine's shader, or two pictures of the engine.
enum class Mask { shader, picture };

/// Computes the mask from two pictures of white surfaces under the scene's light: the quotient of
/// the picture with shadows and the one without. `valid` is 0 where the latter is too dark.
/// @param shadowed, unshadowed  four linear numbers a pixel, top row first; a surface that faces
/// the
///                              light has about 1.
/// @return  `shadow` in [0, 1], and `valid`.
[[nodiscard]] std::vector<Floats> mask_of_pictures(const std::vector<float>& shadowed,
                                                   const std::vector<float>& unshadowed,
                                                   const Scene& scene);

} // namespace engine
