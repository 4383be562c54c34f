#pragma once

#include "cpp/json.hpp"

#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace engine {

/// A refusal of the request: a sentence, or one for each key.
class Refusal : public std::runtime_error {
public:
    explicit Refusal(Json reasons) : runtime_error{"refused"}, reasons_(std::move(reasons)) {}
    [[nodiscard]] const Json& reasons() const noexcept { return reasons_; }

private:
    Json reasons_;
};

/// Checks the tables [shadow_map], [lookup], [bias] and [method] of a `draw` request. Call `allow`,
/// `accept` and `refuse` for the keys that the engine knows, then `finish`.
class RequestValidator {
public:
    /// @param draw         of the request; must outlive the validator.
    /// @param engine_name  starts the sentences about unknown keys.
    RequestValidator(const Json& draw, std::string engine_name);

    /// Refuses a key whose value is not among `values`.
    /// @param key  with its table: "shadow_map.layout".
    /// @param why  starts the sentence of the refusal.
    void allow(std::string_view key, const std::vector<Json>& values, std::string_view why);
    /// Accepts any value of the key.
    void accept(std::string_view key);
    void refuse(std::string_view key, std::string_view why);
    /// Refuses all other keys, except biases of 0 or "off".
    /// @throws Refusal  if any key was refused.
    void finish();

private:
    [[nodiscard]] const Json* said(std::string_view key) const;

    const Json& draw_;
    std::string engine_name_;
    std::set<std::string, std::less<>> taken_;
    Json problems_ = Json::object();
};

} // namespace engine
