#include "gl_case.hpp"

#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/program.hpp"
#include "scene/error.hpp"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <algorithm>

namespace gnomon::raster_gl {
namespace {

TEST(Context, KnowsItsDriver)
{
    GNOMON_REQUIRE_GL();
    const GlFacts& facts = tests::shared_context()->facts();
    EXPECT_FALSE(facts.renderer.empty());
    EXPECT_FALSE(facts.version.empty());
    EXPECT_GE(facts.subpixel_bits, 4);          // OpenGL 4.5, table 23.54
    EXPECT_GE(facts.max_texture_texels, 16384); // likewise
}

TEST(Context, TurnsGlErrorsIntoExceptionsOnce)
{
    GNOMON_REQUIRE_GL();
    const Context& context = *tests::shared_context();
    EXPECT_NO_THROW(context.check("idle"));
    glEnable(0xFFFF);
    try {
        context.check("enabling nonsense");
        FAIL() << "no exception";
    } catch (const scene::EnvironmentError& error) {
        EXPECT_NE(std::string{error.what()}.find("enabling nonsense"), std::string::npos);
        EXPECT_EQ(std::string{error.what()}.find('\n'), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(context.check("afterwards"));
}

TEST(Context, RefusesADeviceThatDoesNotExist)
{
    GNOMON_REQUIRE_GL();
    EXPECT_THROW(Context{999}, scene::InputError);
    EXPECT_THROW(Context{-1}, scene::InputError);
}

TEST(DepthFormats, GlRequiresD16D24AndD32f)
{
    GNOMON_REQUIRE_GL();
    for (const FormatSupport& format : query_depth_formats(*tests::shared_context())) {
        if (format.name != "d32") { // optional in GL
            EXPECT_TRUE(format.supported) << format.name << " gives " << format.instead;
        }
    }
}

TEST(Program, RejectsAnUnknownShader)
{
    EXPECT_THROW((void)shader_source("none.frag"), std::invalid_argument);
}

TEST(Program, ReportsABadDefinitionInOneLine)
{
    GNOMON_REQUIRE_GL();
    try {
        (void)make_program({"fullscreen.vert", "map_depths.frag", {{"main", "("}}, nullptr});
        FAIL() << "it compiled";
    } catch (const scene::EnvironmentError& error) {
        EXPECT_EQ(std::string{error.what()}.find('\n'), std::string::npos);
    }
    // Mesa also reports it as debug output, which must not reach the next test; NVIDIA's driver
    // does not.
    try {
        tests::shared_context()->check("compiling");
        EXPECT_FALSE(tests::is_mesa());
    } catch (const scene::EnvironmentError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("compiling"));
    }
}

TEST(Context, ReportsWhatGlReportsOnce)
{
    GNOMON_REQUIRE_GL();
    glEnable(GL_TEXTURE_2D_ARRAY); // no such capability
    EXPECT_THROW(tests::shared_context()->check("enabling"), scene::EnvironmentError);
    EXPECT_NO_THROW(tests::shared_context()->check("nothing"));
}

} // namespace
} // namespace gnomon::raster_gl
