#pragma once

#include "cpp/json.hpp"

#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace engine {

/// What cannot be done: a sentence, or one for each key.
class Refusal : public std::runtime_error {
public:
    explicit Refusal(Json reasons) : runtime_error{"refused"}, reasons_(std::move(reasons)) {}
    [[nodiscard]] const Json& reasons() const noexcept { return reasons_; }

private:
    Json reasons_;
};

/// What one `draw` says in [shadow_map], [lookup], [bias] and [method]: each key is done, may say
/// only what is so, or is refused by name. Used from `allow` to `finish`.
class RequestValidator {
public:
    /// @param draw         The request's `draw`; it must outlive this.
    /// @param engine_name  Begins the sentences about unknown keys.
    RequestValidator(const Json& draw, std::string engine_name);

    /// The key may say one of these, and nothing else.
    /// @param key  With its table: "shadow_map.layout".
    /// @param why  Begins the sentence of the refusal.
    void allow(std::string_view key, const std::vector<Json>& values, std::string_view why);
    /// The key is done, whatever it says.
    void accept(std::string_view key);
    /// The key is refused.
    void refuse(std::string_view key, std::string_view why);
    /// Refuses all that nothing above has taken. Keys of the bias that say 0 or "off" ask for
    /// nothing.
    /// @throws Refusal  if a key has been refused.
    void finish();

private:
    [[nodiscard]] const Json* said(std::string_view key) const;

    const Json& draw_;
    std::string engine_name_;
    std::set<std::string, std::less<>> taken_;
    Json problems_ = Json::object();
};

} // namespace engine
