// Hostile job files: mutated, random, huge and deeply nested. Each must be read or refused with one
// line, without a crash.

#include "job_fixture.hpp"
#include "lane.hpp"
#include "scene/job/file.hpp"

#include <random>
#include <sstream>

namespace gnomon::scene::test {
namespace {

using testing::HasSubstr;

std::string repeated(const std::string& part, std::size_t count)
{
    std::string text;
    text.reserve(part.size() * count);
    for (std::size_t i = 0; i < count; ++i) {
        text += part;
    }
    return text;
}

std::string example_text()
{
    std::ifstream file{std::filesystem::path{GNOMON_ROOT "/examples"} / "job.toml"};
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Reads the text as a job file; returns whether it is one. Refusals must be one line naming the
/// file.
bool is_read(const std::string& text)
{
    const std::string message = refusal(text);
    if (message == "no error") {
        return true;
    }
    EXPECT_TRUE(message.starts_with("job.toml:") || message.starts_with("built-in \"") ||
                message.starts_with("scene."))
        << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message << "\nof the text:\n" << text;
    return false;
}

std::size_t below(std::mt19937_64& random, std::size_t bound)
{
    return random() % bound;
}

/// Changes, removes, duplicates or moves a few pieces.
std::string mutated(std::string text, std::mt19937_64& random)
{
    const std::string characters = "[]{}=.\"'#,\n-+0123456789eaux_ \\\t\x01\x80\xff";
    for (std::size_t edits = 1 + below(random, 4); edits > 0 && !text.empty(); --edits) {
        const std::size_t at = below(random, text.size());
        const std::size_t length = 1 + below(random, 12);
        switch (below(random, 4)) {
        case 0:
            text[at] = characters[below(random, characters.size())];
            break;
        case 1:
            text.erase(at, length);
            break;
        case 2:
            text.insert(at, text.substr(below(random, text.size()), length));
            break;
        default:
            text[at] = static_cast<char>(random() & 0xFFU);
        }
    }
    return text;
}

TEST(HostileJob, MutationsAreReadOrRefusedInOneLine)
{
    const std::string original = example_text();
    ASSERT_TRUE(is_read(original));
    int read = 0;
    const int mutations = tests::in_lane(1000, 3000);
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(mutations); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937_64 random{seed};
        read += is_read(mutated(original, random)) ? 1 : 0;
    }
    // Comments make up a third of the file, so that both kinds occur.
    EXPECT_GT(read, mutations / 20);
    EXPECT_LT(read, mutations - mutations / 20);
}

TEST(HostileJob, RandomBytesAreRefused)
{
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937_64 random{seed};
        std::string bytes(1 + below(random, 4096), '\0');
        std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random()); });
        EXPECT_FALSE(is_read(bytes));
    }
}

TEST(HostileJob, DeepNestingIsRefused)
{
    constexpr std::size_t deep = 500'000;
    const std::string too_deep = "nested more than 32 deep";
    EXPECT_THAT(refusal("a = " + repeated("[", deep)), HasSubstr(too_deep));
    EXPECT_THAT(refusal("a = " + repeated("{a=", deep)), HasSubstr(too_deep));
    EXPECT_THAT(refusal(repeated("a.", deep) + "a = 1"), HasSubstr(too_deep));
    EXPECT_THAT(refusal("[" + repeated("a . ", deep) + "a]"), HasSubstr(too_deep));
    // A quote before the closing three belongs to the text and opens no other.
    EXPECT_THAT(refusal("a = [\"\"\"b\"\"\"\", " + repeated("[", deep)), HasSubstr(too_deep));
    EXPECT_THAT(refusal("\n\n" + repeated("\"a=\".'b]'.", deep) + "a = 1"),
                HasSubstr("job.toml:3: " + too_deep));
}

TEST(HostileJob, DotsAndBracketsInTextsAndCommentsDoNotNest)
{
    const std::string texts = "# " + repeated("[a.", 100) + "\nscene.file = \"" +
                              repeated("[./", 100) + "a.obj\"\n" + "scene.no_cast = ['" +
                              repeated("[.", 100) + "', \"\"\"" + repeated("\\\"[.", 100) +
                              "\"\"\"\"\"]\n";
    EXPECT_TRUE(is_read(texts));
    EXPECT_TRUE(is_read("scene.file = \"a.obj\"\nsweep.\"bias.slope\" = [" +
                        repeated("0.5, 0.25, ", 200) + "]\n"));
}

TEST(HostileJob, HugeFilesAreRefusedBeforeTheyAreParsed)
{
    EXPECT_THAT(refusal(std::string(17U << 20U, '#')), HasSubstr("job.toml: longer than 16 MiB"));
    EXPECT_THAT(error_of([] { return read_job("/dev/zero"); }), HasSubstr("longer than 16 MiB"));
}

TEST(HostileJob, HugeKeysAndValuesAreCutInMessages)
{
    const std::string long_word(1'000'000, 'x');
    for (const std::string& text :
         {long_word + " = 1\n", "lookup.filter = \"" + long_word + "\"\n", "[" + long_word + "]\n",
          "bias.slope = [" + repeated("1, ", 300'000) + "]\n"}) {
        const std::string message = refusal(text);
        EXPECT_LT(message.size(), 400U);
        EXPECT_NE(message, "no error");
    }
}

TEST(HostileJob, HugeListsOfValuesAreRefused)
{
    EXPECT_THAT(refusal("[sweep]\n\"bias.slope\" = [" + repeated("0,", 100'001) + "]\n"),
                HasSubstr("100001 values; at most 100000"));
    const std::string range = " = {from = 0, to = 1, count = 60000}\n";
    EXPECT_THAT(refusal("[sweep]\n\"bias.slope\"" + range + "\"bias.constant\"" + range),
                HasSubstr("[sweep] bias.constant: more than 100000 values on all axes"));
}

} // namespace
} // namespace gnomon::scene::test
