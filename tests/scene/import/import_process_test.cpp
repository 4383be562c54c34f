#include "scene/error.hpp"
#include "scene/import/mesh.hpp"
#include "scene/import/names.hpp"
#include "scene/import/process.hpp"
#include "scene/import/stream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <limits>

namespace gnomon::scene {
namespace {

using ::testing::HasSubstr;

/// The error message when the child runs `work`.
std::string failure_of(const std::function<void(int, ImportAllowance&)>& work,
                       const ImportLimits& limits = {})
{
    try {
        (void)run_in_child("file.obj", limits, work);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no failure";
}

TEST(RunInChild, ReturnsWhatTheChildWrote)
{
    const SealedBytes result = run_in_child("file.obj", {}, [](int output, ImportAllowance&) {
        ImportWriter writer{output};
        writer.put_array(std::span<const char>{std::string_view{"abc"}});
        writer.put(std::uint64_t{7});
        writer.flush();
    });
    ImportReader reader{result.bytes()};
    EXPECT_EQ(reader.take_text(3), "abc");
    EXPECT_EQ(reader.take<std::uint64_t>(), 7U);
    EXPECT_EQ(reader.bytes_left(), 0U);
}

TEST(RunInChild, PassesArraysLargerThanABlock)
{
    constexpr std::size_t count = 700'001;
    const SealedBytes result = run_in_child("file.obj", {}, [](int output, ImportAllowance&) {
        std::vector<std::uint32_t> numbers(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            numbers[i] = i;
        }
        ImportWriter writer{output};
        writer.put_array(std::span<const std::uint32_t>{numbers});
        writer.flush();
    });
    const auto numbers = ImportReader{result.bytes()}.take_array<std::uint32_t>(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        ASSERT_EQ(numbers[i], i);
    }
}

TEST(RunInChild, KeepsTheChildFromTheParentsFiles)
{
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const int inherited = ends[1];
    const SealedBytes result = run_in_child("file.obj", {}, [&](int output, ImportAllowance&) {
        ImportWriter writer{output};
        writer.put(std::int64_t{::write(inherited, "x", 1)});
        writer.flush();
    });
    EXPECT_EQ(ImportReader{result.bytes()}.take<std::int64_t>(), -1);
    ::close(ends[0]);
    ::close(ends[1]);
}

TEST(RunInChild, SaysHowTheChildFailed)
{
    EXPECT_THAT(failure_of([](int, ImportAllowance&) { (void)::raise(SIGSEGV); }),
                HasSubstr("file.obj: the importer crashed (signal 11)"));
    EXPECT_THAT(failure_of([](int, ImportAllowance&) { std::abort(); }), HasSubstr("signal 6"));
    EXPECT_THAT(failure_of([](int, ImportAllowance&) { throw 1; }), HasSubstr("no message"));
}

TEST(RunInChild, KillsAChildThatWaitsForTooLong)
{
    const ImportLimits limits{.time = std::chrono::seconds{1}};
    EXPECT_THAT(failure_of([](int, ImportAllowance&) { (void)::sleep(60); }, limits),
                HasSubstr("took longer than 1 s"));
}

TEST(RunInChild, ReplacesAChildThatHung)
{
    // The children share this count of their starts.
    void* page =
        ::mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(page, MAP_FAILED);
    auto& starts = *static_cast<volatile int*>(page);
    const auto hang_at_first = [&](int output, ImportAllowance&) {
        ImportWriter writer{output};
        writer.put(std::int64_t{starts});
        writer.flush();
        starts = starts + 1;
        if (starts == 1) {
            (void)::sleep(60);
        }
    };
    const ImportLimits limits{.time = std::chrono::seconds{1}};
    const SealedBytes result = run_in_child("file.obj", limits, hang_at_first);
    ImportReader reader{result.bytes()};
    EXPECT_EQ(reader.take<std::int64_t>(), 1);
    EXPECT_EQ(reader.bytes_left(), 0U);
    EXPECT_EQ(starts, 2);
    ::munmap(page, sizeof(int));
}

TEST(RunInChild, StopsAChildThatComputesForTooLong)
{
    const auto spin = [](int, ImportAllowance&) {
        // One second instead of the allowance's, so that the test is quick.
        const rlimit limit{1, 2};
        ::setrlimit(RLIMIT_CPU, &limit);
        for (volatile bool forever = true; forever;) {
        }
    };
    EXPECT_THAT(failure_of(spin), HasSubstr("worked for longer"));
}

TEST(RunInChild, GivesAFileOfAFewBytesLessThanTenSecondsByTheClock)
{
    const auto left_s = [](std::uint64_t opened_bytes) {
        const SealedBytes result =
            run_in_child("file.obj", {}, [&](int output, ImportAllowance& allowance) {
                allowance.add_file(opened_bytes);
                ImportWriter writer{output};
                writer.put(std::uint64_t{::alarm(0)});
                writer.flush();
            });
        return ImportReader{result.bytes()}.take<std::uint64_t>();
    };
    // A second may have begun before the clock is asked.
    EXPECT_THAT(left_s(100), ::testing::AnyOf(7U, 8U));
    EXPECT_THAT(left_s(100'000'000), ::testing::AnyOf(32U, 33U));
}

TEST(RunInChild, StopsAChildThatWritesTooMuch)
{
    const ImportLimits limits{.memory_bytes = 1 << 20};
    const auto flood = [](int output, ImportAllowance&) {
        const std::array<char, 4096> page{};
        while (::write(output, page.data(), page.size()) > 0) {
        }
    };
    EXPECT_THAT(failure_of(flood, limits), HasSubstr("takes more than 1 MiB"));
}

#ifndef __SANITIZE_ADDRESS__
TEST(RunInChild, BoundsTheChildsMemoryByTheSizeOfItsFiles)
{
    const auto can_take = [](std::uint64_t opened_bytes, std::size_t wanted_bytes) {
        const SealedBytes result =
            run_in_child("file.obj", {}, [&](int output, ImportAllowance& allowance) {
                allowance.add_file(opened_bytes);
                void* memory = std::malloc(wanted_bytes);
                ImportWriter writer{output};
                writer.put(std::uint64_t{memory != nullptr});
                writer.flush();
                std::free(memory);
            });
        return ImportReader{result.bytes()}.take<std::uint64_t>() == 1;
    };
    EXPECT_TRUE(can_take(0, 900'000'000));
    EXPECT_FALSE(can_take(0, 1'100'000'000));
    EXPECT_TRUE(can_take(4'000'000, 1'900'000'000));
    EXPECT_FALSE(can_take(1'000'000'000'000, 9'000'000'000)); // ImportLimits: 8 GiB
}
#endif

TEST(ImportReader, RefusesLengthsThatReachBeyondTheEnd)
{
    const std::array<std::uint64_t, 4> words{};
    for (const std::uint64_t count :
         {std::uint64_t{5}, std::uint64_t{1} << 61U, std::numeric_limits<std::uint64_t>::max()}) {
        ImportReader reader{std::as_bytes(std::span{words})};
        EXPECT_THROW((void)reader.take_array<std::uint64_t>(count), CorruptStream) << count;
    }
    ImportReader reader{std::as_bytes(std::span{words})};
    EXPECT_THROW((void)reader.take<ImportHeader>(), CorruptStream);
    EXPECT_EQ(reader.take_array<std::uint64_t>(4).size(), 4U);
}

TEST(UniqueNames, NumbersRepetitionsAroundNamesThatAreTaken)
{
    UniqueNames names;
    EXPECT_EQ(names.make("a"), "a");
    EXPECT_EQ(names.make("a.2"), "a.2");
    EXPECT_EQ(names.make("a"), "a.3");
    EXPECT_EQ(names.make("a"), "a.4");
}

TEST(Printable, MakesOneLineOfValidUtf8)
{
    EXPECT_EQ(printable("M\u00e4rz \u65e5"), "M\u00e4rz \u65e5");
    EXPECT_EQ(printable("a\nb\tc\x7f"), "a b c");
    EXPECT_EQ(printable("\xff\xc3"), "??");      // no lead byte; cut off
    EXPECT_EQ(printable("\xc0\x80"), "??");      // overlong
    EXPECT_EQ(printable("\xed\xa0\x80"), "???"); // a surrogate
}

/// Twice the area of each triangle on the xy plane.
std::vector<float> twice_areas(const std::vector<Vec3f>& vertices)
{
    std::vector<std::uint32_t> polygon;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        polygon.push_back(i);
    }
    std::vector<TriangleIndices> triangles;
    triangulate(vertices, polygon, triangles);
    std::vector<float> areas;
    for (const auto& [a, b, c] : triangles) {
        const Vec3f ab = vertices[b] - vertices[a];
        const Vec3f ac = vertices[c] - vertices[a];
        areas.push_back(ab.x * ac.y - ab.y * ac.x);
    }
    return areas;
}

TEST(Triangulate, FansConvexPolygonsFromTheirFirstCorner)
{
    const std::vector<Vec3f> vertices{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}};
    std::vector<TriangleIndices> triangles;
    triangulate(vertices, std::array<std::uint32_t, 5>{0, 1, 2, 3, 4}, triangles);
    EXPECT_THAT(triangles,
                ::testing::ElementsAre(TriangleIndices{0, 1, 2}, TriangleIndices{0, 2, 3},
                                       TriangleIndices{0, 3, 4}));
}

TEST(Triangulate, CoversConcavePolygonsOnceWithCornersInLine)
{
    // A T of area 4, whose arms meet its stem on one line.
    const std::vector<Vec3f> tee{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0},
                                 {2, 2, 0}, {1, 2, 0}, {1, 1, 0}, {0, 1, 0}};
    float sum = 0;
    for (const float area : twice_areas(tee)) {
        EXPECT_GE(area, 0.0F);
        sum += area;
    }
    EXPECT_EQ(sum, 8.0F); // exact: small integers
}

TEST(Triangulate, KeepsAFlatCornerAsACornerOfATriangle)
{
    // (1, 0) lies on an edge. Skipping it would leave a crack to a neighbour that uses it.
    EXPECT_THAT(twice_areas({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}),
                ::testing::ElementsAre(2.0F, 2.0F));
}

TEST(Triangulate, GivesEveryPolygonItsNumberOfTriangles)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(twice_areas({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(),
              2U); // crosses itself
    EXPECT_EQ(twice_areas({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).size(), 2U);
    EXPECT_EQ(twice_areas({{0, 0, 0}, {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}}).size(), 2U);
}

} // namespace
} // namespace gnomon::scene
