#include "api/memory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace gnomon::cli {
namespace {

/// A folder used as the file system's root.
class Machine {
public:
    Machine()
    {
        std::string name = (std::filesystem::temp_directory_path() / "gnomon-root-XXXXXX").string();
        root = mkdtemp(name.data());
    }
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;
    ~Machine() { std::filesystem::remove_all(root); }

    Machine& with(const std::string& path, const std::string& text)
    {
        std::filesystem::create_directories((root / path).parent_path());
        std::ofstream{root / path} << text;
        return *this;
    }

    std::filesystem::path root;
};

TEST(ControlGroup, LeavesItsLimitLessWhatIsUsedAndCannotBeDropped)
{
    Machine machine;
    machine.with("proc/self/cgroup", "0::/user/job\n")
        .with("sys/fs/cgroup/user/job/memory.max", "1000\n")
        .with("sys/fs/cgroup/user/job/memory.current", "700\n")
        .with("sys/fs/cgroup/user/job/memory.stat", "anon 500\ninactive_file 150\n");
    EXPECT_EQ(api::control_group_memory_bytes(machine.root), 450U);
}

TEST(ControlGroup, TheTightestGroupOnTheWayToTheRootCounts)
{
    Machine machine;
    machine.with("proc/self/cgroup", "0::/user/job\n")
        .with("sys/fs/cgroup/user/job/memory.max", "max\n")
        .with("sys/fs/cgroup/user/job/memory.current", "10\n")
        .with("sys/fs/cgroup/user/memory.max", "300\n")
        .with("sys/fs/cgroup/user/memory.current", "400\n");
    EXPECT_EQ(api::control_group_memory_bytes(machine.root), 0U);
}

TEST(ControlGroup, AContainersMountIsItsGroupWhateverTheHostCallsIt)
{
    Machine machine;
    machine.with("proc/self/cgroup", "4:cpu:/x\n5:memory:/docker/12ab\n0::/\n")
        .with("sys/fs/cgroup/memory/memory.limit_in_bytes", "4096\n")
        .with("sys/fs/cgroup/memory/memory.usage_in_bytes", "96\n");
    EXPECT_EQ(api::control_group_memory_bytes(machine.root), 4000U);
}

TEST(ControlGroup, WithoutALimitThereIsNoAnswer)
{
    Machine machine;
    EXPECT_FALSE(api::control_group_memory_bytes(machine.root));
    machine.with("proc/self/cgroup", "5:memory:/\n")
        .with("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n")
        .with("sys/fs/cgroup/memory/memory.usage_in_bytes", "96\n");
    EXPECT_FALSE(api::control_group_memory_bytes(machine.root));
}

} // namespace
} // namespace gnomon::cli
