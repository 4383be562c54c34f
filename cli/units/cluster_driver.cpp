#include "cli/units/cluster_driver.hpp"

#include "cli/system/process.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <system_error>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;
using store::Json;
using Kind = ClusterEvent::Kind;

constexpr GuardedProcess::Seconds writing_time{30};
constexpr GuardedProcess::Seconds listening_time{0.2};
/// For stopping workers and ending the process.
constexpr GuardedProcess::Seconds driver_ending_time{20};

std::vector<std::string> command_of(const Cluster& cluster, const ClusterOrder& order)
{
    std::error_code none;
    std::vector<std::string> command{
        "/usr/bin/python3",
        "-B",
        (data_folder(GNOMON_CLUSTERS_FROM_PROGRAM, GNOMON_CLUSTERS_IN_SOURCE) / cluster.driver)
            .string(),
        cluster.name,
        fs::absolute(order.plan).string(),
        fs::absolute(order.folder).string(),
        fs::read_symlink("/proc/self/exe", none).string(),
        "--threads",
        fmt::format("{}", order.threads)};
    if (!order.scenes.empty()) {
        command.insert(command.end(), {"--scenes", fs::absolute(order.scenes).string()});
    }
    if (order.allows_mixed) {
        command.emplace_back("--allow-mixed");
    }
    if (order.retries_failed) {
        command.emplace_back("--retry-failed");
    }
    return command;
}

/// N of "local:N"; 0 for other names.
int local_workers(std::string_view name)
{
    constexpr std::string_view prefix = "local:";
    constexpr int most_workers = 1'024;
    int count = 0;
    if (name.starts_with(prefix)) {
        const char* const end = name.data() + name.size();
        const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, count);
        count = error == std::errc{} && stop == end && count <= most_workers ? count : 0;
    }
    return count > 0 ? count : 0;
}

std::string text_in(const Json& event, const char* key)
{
    const auto found = event.find(key);
    return found != event.end() && found->is_string() ? scene::one_line(found->get<std::string>())
                                                      : std::string{};
}

std::string gl_in(const Json& event)
{
    const auto environment = event.find("environment");
    return environment != event.end() && environment->is_object()
               ? text_in(*environment, "gl_renderer")
               : std::string{};
}

} // namespace

Cluster read_cluster(const std::string& name)
{
    constexpr std::string_view dask = "dask://";
    if (local_workers(name) > 0) {
        return {name, "dask_driver.py", true};
    }
    if (name.starts_with(dask) && name.size() > dask.size()) {
        return {name, "dask_driver.py", false};
    }
    if (name == "slurm" || name.starts_with("slurm:")) {
        return {name, "slurm_driver.py", true};
    }
    throw scene::InputError(scene::one_line(
        fmt::format("--on {}: must be local:N, for N workers on this machine, dask://HOST:PORT, "
                    "slurm, or slurm:OPTIONS with sbatch's own",
                    name)));
}

ClusterDriver::ClusterDriver(const Cluster& cluster, const ClusterOrder& order,
                             const std::vector<const store::PlannedUnit*>& units)
    : cluster_{cluster},
      process_{command_of(cluster, order),
               make_temporary_folder(temporary_folder(), "gnomon-cluster")}
{
    for (const store::PlannedUnit* unit : units) {
        require_write(store::json_text(Json{{"unit", unit->id}, {"seconds", unit->seconds}}, -1));
    }
    require_write("");
}

void ClusterDriver::require_write(const std::string& line)
{
    if (!process_.write_line(line, writing_time)) {
        throw scene::EnvironmentError(
            scene::one_line(fmt::format("--on {}: its driver {} does not read its input: {}",
                                        cluster_.name, cluster_.driver, process_.last_errors())));
    }
}

ClusterEvent ClusterDriver::next()
{
    const AwaitedLine line = process_.read_line(listening_time);
    if (line.end == AwaitedLine::End::timeout) {
        return {};
    }
    if (line.end != AwaitedLine::End::line) {
        const auto status = process_.wait(driver_ending_time);
        if (status == 0) {
            return {Kind::ended, {}, {}};
        }
        throw scene::EnvironmentError(scene::one_line(
            fmt::format("--on {}: its driver {} ended with {}: {}", cluster_.name, cluster_.driver,
                        status.value_or(-1), process_.last_errors())));
    }
    const Json event = Json::parse(line.text, nullptr, false);
    if (!event.is_object()) {
        return {}; // printed by a library
    }
    if (event.contains("error")) {
        throw scene::EnvironmentError(
            fmt::format("--on {}: {}", cluster_.name, text_in(event, "error")));
    }
    if (event.contains("failed")) {
        return {Kind::failed, text_in(event, "failed"), text_in(event, "message")};
    }
    if (event.contains("unit")) {
        return {Kind::unit, text_in(event, "unit"), text_in(event, "worker")};
    }
    return {event.contains("worker") ? Kind::worker : Kind::none, text_in(event, "worker"),
            gl_in(event)};
}

void ClusterDriver::stop()
{
    process_.close_input();
    (void)process_.wait(driver_ending_time); // then the guard kills it
}

} // namespace gnomon::cli
