#include "unit_sweep.hpp"

#include "store/units/unit_file.hpp"

#include <fmt/format.h>

namespace gnomon::store {

namespace fs = std::filesystem;

std::string unit_name(std::uint32_t number)
{
    return fmt::format("{:016x}", number);
}

ExampleRun UnitSweep::run() const
{
    return {units, 3, static_cast<std::uint32_t>(units)};
}

fs::path UnitSweep::compute(const fs::path& folder, std::uint32_t number) const
{
    const ExampleRun example = run();
    const fs::path work = folder / fmt::format(".{}", number);
    fs::create_directories(work);
    {
        RunStore store{work, RunStore::Access::write};
        std::vector<analysis::Configuration> own = example.configurations_of(number - 1);
        std::vector<std::uint64_t> ordinals;
        for (analysis::Configuration& configuration : own) {
            configuration.scene_hash = scene;
            ordinals.push_back(configuration.ordinal);
        }
        RunDescription description = example.description(number);
        description.environment.gnomon = gnomon;
        description.environment.gl_renderer = gl_renderer;
        description.notes = {{"wall", {"kind", 1, "a wall"}, 3}};
        store.plan(description, own);
        if (fails) {
            store.record_failure(ordinals, "no memory");
        } else {
            example.record(store, number);
        }
    }
    fs::path file = unit_path(folder, unit_name(number));
    publish_unit(work, {plan, unit_name(number)}, file);
    fs::remove_all(work);
    return file;
}

std::vector<fs::path> UnitSweep::compute_all(const fs::path& folder) const
{
    std::vector<fs::path> files;
    for (std::uint32_t number = 1; number <= units; ++number) {
        files.push_back(compute(folder, number));
    }
    return files;
}

std::string UnitSweep::whole_csv(const fs::path& folder) const
{
    ExampleRun{units, 3}.compute(folder / "whole");
    return csv_texts(folder / "whole");
}

} // namespace gnomon::store
