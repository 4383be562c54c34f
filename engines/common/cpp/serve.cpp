#include "cpp/serve.hpp"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace engine {
namespace {

/// Writes numbers as NumPy's .npy: float32, little-endian, with shape (height, width, count), or
/// (height, width) for one number a pixel.
/// @param values  `count` numbers a pixel; the rows come in the file's order.
void write_npy(const std::filesystem::path& file, const std::vector<float>& values, int width,
               int height, int count)
{
    static_assert(std::endian::native == std::endian::little);
    const std::string per_pixel = count == 1 ? "" : ", " + std::to_string(count);
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                         std::to_string(height) + ", " + std::to_string(width) + per_pixel + "), }";
    constexpr std::size_t begin =
        10; // offset of the header, behind magic number, version and length
    header.append((64 - (begin + header.size() + 1) % 64) % 64, ' ');
    header += '\n';
    std::ofstream stream{file, std::ios::binary};
    stream.write("\x93NUMPY\x01\x00", 8);
    const auto size = static_cast<unsigned>(header.size());
    stream.put(static_cast<char>(size % 256)).put(static_cast<char>(size / 256));
    stream << header;
    stream.write(reinterpret_cast<const char*>(values.data()),
                 static_cast<std::streamsize>(values.size() * sizeof(float)));
    if (!stream.flush()) {
        throw std::runtime_error{file.string() + " cannot be written"};
    }
}

Json key(std::string_view name, std::string_view type, Json initial, std::string_view help)
{
    return {{"name", name}, {"type", type}, {"default", std::move(initial)}, {"help", help}};
}

Json answer_hello(Engine& engine)
{
    const Identity identity = engine.identity();
    constexpr std::size_t most_bytes = 124;
    return {{"protocol", 1},
            {"name", identity.name},
            {"version", identity.version},
            {"device", identity.device.substr(0, most_bytes)},
            {"keys", identity.keys}};
}

Json parse(const std::string& line)
{
    try {
        return Json::parse(line);
    } catch (const Json::parse_error& problem) {
        throw std::runtime_error{std::string{"a request is not JSON: "}.append(problem.what())};
    }
}

/// Answers requests. A scene is open after an `open` that succeeded.
class Answers {
public:
    explicit Answers(Engine& engine) : engine_{engine} {}

    Json answer(const Json& request)
    {
        if (request.contains("hello")) {
            return answer_hello(engine_);
        }
        if (request.contains("open")) {
            return open(request.at("open"));
        }
        if (request.contains("draw")) {
            return draw(request);
        }
        throw Refusal{"unknown request; known are hello, open, draw and close"};
    }

private:
    Json open(const Json& order)
    {
        is_open_ = false;
        engine_.open(read_scene(order));
        is_open_ = true;
        return {{"ok", true}};
    }

    Json draw(const Json& request)
    {
        if (!is_open_) {
            throw Refusal{"no scene is open: send open before draw"};
        }
        const auto began = std::chrono::steady_clock::now();
        Drawn drawn = engine_.draw(request.at("draw"));
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
        Json answer{{"ok", true}, {"seconds", spent.count()}, {"files", Json::object()}};
        answer["case"] = std::move(drawn.tables);
        const std::filesystem::path frame = request.at("frame").get<std::string>();
        for (const Floats& floats : drawn.files) {
            const std::string name = floats.name + ".npy";
            write_npy(frame.parent_path() / name, floats.values, floats.width, floats.height,
                      floats.count);
            if (floats.name == "map") {
                answer["case"]["map"] = {{"file", name}};
            } else {
                answer["files"][floats.name] = name;
            }
        }
        return answer;
    }

    Engine& engine_;
    bool is_open_ = false;
};

void write_line(int file, std::string line)
{
    line += '\n';
    for (std::size_t done = 0; done < line.size();) {
        const ssize_t written = write(file, line.data() + done, line.size() - done);
        if (written < 0 && errno != EINTR) {
            throw std::system_error{errno, std::generic_category(), "an answer cannot be written"};
        }
        done += written < 0 ? 0 : static_cast<std::size_t>(written);
    }
}

} // namespace

Json number_key(std::string_view name, double least, double most, double initial,
                std::string_view unit, std::string_view help)
{
    Json made = key(name, "number", initial, help);
    made["range"] = {least, most};
    made["unit"] = unit;
    return made;
}

Json integer_key(std::string_view name, int least, int most, int initial, std::string_view unit,
                 std::string_view help)
{
    Json made = key(name, "integer", initial, help);
    made["range"] = {least, most};
    made["unit"] = unit;
    return made;
}

Json boolean_key(std::string_view name, bool initial, std::string_view help)
{
    return key(name, "boolean", initial, help);
}

Json choice_key(std::string_view name, const std::vector<std::string>& values,
                std::string_view initial, std::string_view help)
{
    Json made = key(name, "choice", initial, help);
    made["values"] = values;
    return made;
}

int take_standard_output()
{
    const int answers = dup(STDOUT_FILENO);
    if (answers < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        throw std::system_error{errno, std::generic_category(), "standard output cannot be taken"};
    }
    return answers;
}

void serve(Engine& engine, int answers)
{
    Answers answering{engine};
    for (std::string line; std::getline(std::cin, line);) {
        const Json request = parse(line);
        if (request.contains("close")) {
            return;
        }
        Json answer{{"id", request.at("id")}};
        try {
            answer.update(answering.answer(request));
        } catch (const Refusal& refusal) {
            answer["error"] = refusal.reasons();
        } catch (const std::exception& problem) {
            answer["error"] = problem.what();
        }
        write_line(answers, answer.dump());
    }
}

std::vector<Floats> mask_of_pictures(const std::vector<float>& shadowed,
                                     const std::vector<float>& unshadowed, const Scene& scene)
{
    constexpr float least_light = 1e-6F;
    Floats shadow{"shadow", scene.width, scene.height, 1, {}};
    Floats valid{"valid", scene.width, scene.height, 1, {}};
    for (std::size_t i = 0; i < shadowed.size(); i += 4) {
        const bool is_told = unshadowed[i] > least_light; // false for NaN, where nothing is seen
        shadow.values.push_back(is_told ? std::clamp(shadowed[i] / unshadowed[i], 0.0F, 1.0F) : 0);
        valid.values.push_back(is_told ? 1.0F : 0.0F);
    }
    return {std::move(shadow), std::move(valid)};
}

} // namespace engine
