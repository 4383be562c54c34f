#pragma once

#include "cpp/json.hpp"
#include "cpp/request_validator.hpp"
#include "cpp/scene.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace engine {

/// A key of the job's [engine] table, as docs/renderer_protocol.md has it.
Json number_key(std::string_view name, double least, double most, double initial,
                std::string_view unit, std::string_view help);
Json integer_key(std::string_view name, int least, int most, int initial, std::string_view unit,
                 std::string_view help);
Json boolean_key(std::string_view name, bool initial, std::string_view help);
Json choice_key(std::string_view name, const std::vector<std::string>& values,
                std::string_view initial, std::string_view help);

/// Who draws: the members of the answer to `hello`.
struct Identity {
    std::string name;
    std::string version;
    std::string device; ///< is cut after 124 bytes
    Json keys;          ///< an array
};

/// Raw floats that go to a file of the frame's folder. Rows count from the top.
struct Floats {
    std::string
        name;      ///< of `[files]`, docs/evaluate.md#raw-floats; or "map": the shadow map's depths
    int width = 0; ///< [px], of the map [texels]
    int height = 0;
    int count = 1; ///< numbers a pixel
    std::vector<float> values;
};

/// What was drawn: `position` (NaN where nothing is seen) and `shadow` at least.
struct Drawn {
    std::vector<Floats> files;
    Json tables; ///< `case` of the answer, but for `map`
};

/// An engine that is driven. What cannot be done is a Refusal; any other exception is an answer,
/// too.
class Engine {
public:
    virtual ~Engine() = default;
    [[nodiscard]] virtual Identity identity() = 0;
    /// Takes the scene in place of the one before.
    virtual void open(const Scene& scene) = 0;
    /// Draws the scene that is open.
    /// @param draw  The request's `draw`, with every key of the engine.
    [[nodiscard]] virtual Drawn draw(const Json& draw) = 0;

protected:
    Engine() = default;
    Engine(const Engine&) = default;
    Engine& operator=(const Engine&) = default;
};

/// Takes standard output for the protocol's answers: what libraries write there goes to standard
/// error from now on. To be called once, before a library has a chance to write.
/// @return  Where answers are written.
int take_standard_output();

/// Answers requests of standard input until `close` or its end.
/// @param answers  What take_standard_output() returned.
/// @throws std::runtime_error  on a line that is no request.
void serve(Engine& engine, int answers);

} // namespace engine
