#include "reports/gate/gate_rule_file.hpp"

#include "reports/gate/gate_rule_values.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/toml.hpp"
#include "scene/text.hpp"
#include "store/run/run_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace gnomon::reports {

namespace {

using analysis::GateRule;

constexpr std::uint64_t most_rule_bytes = std::uint64_t{1} << 20U;

/// Parses one rule file.
class RuleParser : private RuleValues {
public:
    using RuleValues::RuleValues;

    [[nodiscard]] std::vector<GateRule> read(const scene::TomlTable& file) const
    {
        std::vector<GateRule> rules;
        for (const TomlMember& member : file) {
            if (member.key != "rule") {
                fail(member, "is unknown: a rule file contains [[rule]] tables");
            }
            const auto* const tables = std::get_if<scene::TomlArray>(&member.node.value);
            if (tables == nullptr) {
                fail(member, "is not a list: write [[rule]]");
            }
            for (const scene::TomlNode& node : *tables) {
                add_rule(rules, member, node);
            }
        }
        if (rules.empty()) {
            throw scene::InputError(
                fmt::format("{}: contains no rule: add a [[rule]], or omit --rules", name()));
        }
        return rules;
    }

private:
    void add_rule(std::vector<GateRule>& rules, const TomlMember& list,
                  const scene::TomlNode& node) const
    {
        const auto* const table = std::get_if<scene::TomlTable>(&node.value);
        if (table == nullptr || table->empty()) {
            fail(list, "an element is empty or not a table: write [[rule]] with its keys below");
        }
        GateRule rule;
        bool has_direction = false;
        for (const TomlMember& member : *table) {
            has_direction = has_direction || member.key == "direction";
            read_member(rule, member);
        }
        const TomlMember& first = table->front();
        rule.place = fmt::format("{}:{}", name(), first.line);
        check_rule(rule, first);
        if (!has_direction) {
            rule.worse = analysis::find_gate_metric(rule.metric)->worse;
        }
        if (std::any_of(rules.begin(), rules.end(),
                        [&](const GateRule& other) { return other.id == rule.id; })) {
            fail(first, fmt::format("the id \"{}\" is used twice", rule.id));
        }
        rules.push_back(std::move(rule));
    }

    void read_member(GateRule& rule, const TomlMember& member) const
    {
        using Read = std::function<void(const RuleParser&, GateRule&, const TomlMember&)>;
        static const std::map<std::string, Read> keys{
            {"id", [](const auto& in, auto& to, const auto& key) { to.id = in.read_id(key); }},
            {"metric", [](const auto& in, auto& to, const auto& key) { in.read_metric(to, key); }},
            {"where", [](const auto& in, auto& to, const auto& key) { in.read_where(to, key); }},
            {"job", [](const auto& in, auto& to, const auto& key) { in.read_job_state(to, key); }},
            {"max", [](const auto& in, auto& to, const auto& key) { to.max = in.number(key); }},
            {"min", [](const auto& in, auto& to, const auto& key) { to.min = in.number(key); }},
            {"abs", [](const auto& in, auto& to, const auto& key) { to.abs = in.positive(key); }},
            {"rel", [](const auto& in, auto& to, const auto& key) { to.rel = in.positive(key); }},
            {"allow_pixels",
             [](const auto& in, auto& to, const auto& key) { to.allow_pixels = in.count(key); }},
            {"allow_share",
             [](const auto& in, auto& to, const auto& key) { to.allow_share = in.share(key); }},
            {"trade_off",
             [](const auto& in, auto& to, const auto& key) { to.trade_off = in.trade_off(key); }},
            {"direction",
             [](const auto& in, auto& to, const auto& key) { in.read_direction(to, key); }},
            {"severity",
             [](const auto& in, auto& to, const auto& key) { in.read_severity(to, key); }},
            {"optional",
             [](const auto& in, auto& to, const auto& key) { to.is_optional = in.flag(key); }}};
        const auto found = keys.find(member.key);
        if (found == keys.end()) {
            std::vector<std::string> names;
            for (const auto& [name, read] : keys) {
                names.push_back(name);
            }
            fail(member, fmt::format("is not a key of a rule; nearest: {}",
                                     scene::nearest_word(member.key, names)));
        }
        found->second(*this, rule, member);
    }

    void check_rule(const GateRule& rule, const TomlMember& first) const
    {
        if (rule.id.empty() || rule.metric.empty()) {
            fail(first, "the rule has no id or no metric");
        }
        if (!rule.max && !rule.min && !rule.judges_change()) {
            fail(first, fmt::format("rule \"{}\" has no limit: give it max, min, abs, rel, "
                                    "allow_pixels or allow_share",
                                    rule.id));
        }
        const bool counts = analysis::find_gate_metric(rule.metric)->is_pixel_count;
        if (rule.trade_off && !rule.judges_change()) {
            fail(first, fmt::format("rule \"{}\" has a trade_off, which needs abs, rel, "
                                    "allow_pixels or allow_share",
                                    rule.id));
        }
        if (rule.trade_off && !counts && std::isfinite(*rule.trade_off)) {
            fail(first, fmt::format("rule \"{}\" trades pixels, but {} does not count pixels: use "
                                    "trade_off = inf",
                                    rule.id, rule.metric));
        }
        if ((rule.allow_pixels || rule.allow_share) && !counts) {
            fail(first, fmt::format("rule \"{}\" allows pixels, but {} does not count pixels: use "
                                    "abs or rel",
                                    rule.id, rule.metric));
        }
        check_filter(rule, first);
        if (rule.max && rule.min && *rule.max < *rule.min) {
            fail(first, fmt::format("rule \"{}\" has a max below its min", rule.id));
        }
    }

    void check_filter(const GateRule& rule, const TomlMember& first) const
    {
        const bool is_each = rule.each_object || rule.each_band;
        const bool is_of_new_pixels = rule.metric == analysis::new_pixels_metric;
        if ((is_each || !rule.pixels.takes_all()) && !is_of_new_pixels &&
            !analysis::is_of_pixels(rule.metric)) {
            fail(first,
                 fmt::format("rule \"{}\" names an object, cause, label or zeta_band, but {} "
                             "is not counted by them",
                             rule.id, rule.metric));
        }
        if (!analysis::can_count(rule.metric, rule.pixels)) {
            fail(first, fmt::format("rule \"{}\": no pixel of {} has that cause and label: see "
                                    "docs/causes.md",
                                    rule.id, rule.metric));
        }
        if (is_each && is_of_new_pixels) {
            fail(first, fmt::format("rule \"{}\": \"*\" cannot be used with {}: name one", rule.id,
                                    rule.metric));
        }
        if (is_each && !rule.judges_change()) {
            fail(first, fmt::format("rule \"{}\": \"*\" compares with the baseline: give abs, rel, "
                                    "allow_pixels or allow_share",
                                    rule.id));
        }
    }

    [[nodiscard]] std::string read_id(const TomlMember& member) const
    {
        const std::string& id = text(member);
        if (id.empty() || id.size() > longest_id || scene::one_line(id) != id) {
            fail_value(member, fmt::format("a string of 1 to {} bytes on one line", longest_id));
        }
        return id;
    }

    void read_metric(GateRule& rule, const TomlMember& member) const
    {
        rule.metric = text(member);
        if (const auto point = analysis::curve_point_metric(rule.metric)) {
            rule.metric = point->name();
        }
        if (analysis::find_gate_metric(rule.metric) == nullptr) {
            std::vector<std::string> names;
            for (const analysis::GateMetric& metric : analysis::gate_metrics()) {
                names.emplace_back(metric.name);
            }
            fail_value(member, fmt::format("a metric; nearest: \"{}\"",
                                           scene::nearest_word(rule.metric, names)));
        }
    }

    /// Reads `where = {shadow_map.resolution = 512}`; TOML parses a dotted key as nested tables.
    void read_where(GateRule& rule, const TomlMember& member, const std::string& prefix = {}) const
    {
        const auto* const table = std::get_if<scene::TomlTable>(&member.node.value);
        if (table == nullptr || table->empty()) {
            fail_value(member, "a table of settings and values");
        }
        for (const TomlMember& setting : *table) {
            const std::string name = prefix + setting.key;
            if (std::holds_alternative<scene::TomlTable>(setting.node.value)) {
                read_where(rule, setting, name + '.');
            } else if (!read_pixel_filter(rule, name, setting)) {
                check_setting(name, setting);
                rule.where[name] = setting_text(setting);
            }
        }
    }

    void check_setting(const std::string& name, const TomlMember& setting) const
    {
        std::vector<std::string> names{"case", "object", "cause", "label", "zeta_band"};
        for (const store::JobColumn& column : store::job_columns()) {
            names.push_back(column.name);
        }
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            fail(setting, fmt::format("{} is not a key of a job; nearest: {}",
                                      scene::one_line(name.substr(0, longest_id)),
                                      scene::nearest_word(name, names)));
        }
    }

    /// @return  Whether the setting is a pixel filter.
    bool read_pixel_filter(GateRule& rule, const std::string& name, const TomlMember& setting) const
    {
        if (name == "object") {
            rule.each_object = text(setting) == "*";
            if (!rule.each_object) {
                rule.pixels.object = text(setting);
            }
        } else if (name == "cause") {
            rule.pixels.cause = named_code<analysis::Cause>(setting, analysis::cause_names);
        } else if (name == "label") {
            rule.pixels.label = named_code<analysis::Label>(setting, analysis::label_names);
        } else if (name == "zeta_band") {
            read_bands(rule, setting);
        } else {
            return false;
        }
        return true;
    }

    template <typename Code, typename Names>
    [[nodiscard]] Code named_code(const TomlMember& setting, const Names& names) const
    {
        const auto found = std::find(names.begin() + 1, names.end(), text(setting));
        if (found == names.end()) {
            fail_value(setting, fmt::format("a {}; nearest: \"{}\"", setting.key,
                                            scene::nearest_word(text(setting),
                                                                {names.begin() + 1, names.end()})));
        }
        return static_cast<Code>(found - names.begin());
    }

    /// `zeta_band = [4, 16]`, or "*".
    void read_bands(GateRule& rule, const TomlMember& setting) const
    {
        constexpr const char* wanted =
            "\"*\", or two distances in metres that are powers of two "
            "from 2^-10 to 2^50, with or without a sign, 0 or inf, as in "
            "[4, 16]";
        if (const auto* words = std::get_if<std::string>(&setting.node.value)) {
            if (*words != "*") {
                fail_value(setting, wanted);
            }
            rule.each_band = true;
            return;
        }
        const auto* const ends = std::get_if<scene::TomlArray>(&setting.node.value);
        const auto lower =
            ends != nullptr && ends->size() == 2 ? distance((*ends)[0]) : std::nullopt;
        const auto upper = lower ? distance((*ends)[1]) : std::nullopt;
        for (int index = analysis::LightDistanceBand::lowest;
             index <= analysis::LightDistanceBand::highest; ++index) {
            const analysis::LightDistanceBand band{index};
            if (lower && band.lower_m() == *lower) {
                rule.pixels.bands = analysis::LightDistanceBands{band, band};
            }
            if (rule.pixels.bands && upper && band.upper_m() == *upper) {
                rule.pixels.bands->last = band;
                return;
            }
        }
        fail_value(setting, wanted);
    }

    [[nodiscard]] static std::optional<double> distance(const scene::TomlNode& node)
    {
        if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
            return static_cast<double>(*integer);
        }
        const auto* const real = std::get_if<double>(&node.value);
        return real == nullptr ? std::nullopt : std::optional{*real};
    }

    [[nodiscard]] std::string vector_text(const TomlMember& setting,
                                          const scene::TomlArray& list) const
    {
        if (list.size() != 3) {
            fail_value(setting, "a number, a string or a vector of three numbers");
        }
        std::vector<std::string> parts;
        for (const scene::TomlNode& part : list) {
            parts.push_back(fmt::format("{}", number({setting.key, part, setting.line})));
        }
        return fmt::format("[{}]", fmt::join(parts, ", "));
    }

    /// The value as results.csv writes it.
    [[nodiscard]] std::string setting_text(const TomlMember& setting) const
    {
        const auto& value = setting.node.value;
        if (const auto* list = std::get_if<scene::TomlArray>(&value)) {
            return vector_text(setting, *list);
        }
        if (const auto* words = std::get_if<std::string>(&value)) {
            return *words;
        }
        if (const auto* flag = std::get_if<bool>(&value)) {
            return *flag ? "true" : "false";
        }
        return fmt::format("{}", number(setting));
    }

    void read_job_state(GateRule& rule, const TomlMember& member) const
    {
        const std::string& name = text(member);
        if (name != "any" && name != "unchanged" && name != "changed") {
            fail_value(member, "\"any\", \"unchanged\" or \"changed\"");
        }
        rule.job = name == "any"         ? analysis::JobState::any
                   : name == "unchanged" ? analysis::JobState::unchanged
                                         : analysis::JobState::changed;
    }

    void read_direction(GateRule& rule, const TomlMember& member) const
    {
        const std::string& name = text(member);
        if (name != "up" && name != "down" && name != "both") {
            fail_value(member, "\"up\", \"down\" or \"both\"");
        }
        rule.worse = name == "up"     ? analysis::Worse::up
                     : name == "down" ? analysis::Worse::down
                                      : analysis::Worse::both;
    }

    void read_severity(GateRule& rule, const TomlMember& member) const
    {
        const std::string& name = text(member);
        if (name != "fail" && name != "warn") {
            fail_value(member, "\"fail\" or \"warn\"");
        }
        rule.severity = name == "fail" ? analysis::Severity::fail : analysis::Severity::warn;
    }
};

} // namespace

std::vector<GateRule> read_gate_rules(const std::filesystem::path& file)
{
    return parse_gate_rules(
        scene::read_text_file(file, scene::one_line(file.string()), "rule file", most_rule_bytes),
        scene::one_line(file.string()));
}

std::vector<GateRule> parse_gate_rules(std::string_view text, const std::string& name)
{
    return RuleParser{name}.read(scene::parse_toml(text, name));
}

} // namespace gnomon::reports
