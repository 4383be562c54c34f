# Plants one violation at a time and expects layer_check.cmake to name it.
# Run as cmake -DCHECK=<layer_check.cmake> -DWORK=<empty folder> -P layer_check_test.cmake.
cmake_minimum_required(VERSION 3.25)

# expect(NAME FILE CONTENT PATTERN): PATTERN is what the check says of FILE, or PASSES.
function(expect name file content pattern)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/scene/settings/job.hpp "#pragma once\n\n#include <string>\n")
  file(WRITE ${WORK}/${file} "${content}")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CHECK}
    RESULT_VARIABLE status
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}") # CMake wraps its messages
  if(pattern STREQUAL PASSES)
    if(NOT status EQUAL 0)
      message(SEND_ERROR "${name}: should pass, but: ${output}")
    endif()
  elseif(status EQUAL 0 OR NOT output MATCHES "${pattern}")
    message(SEND_ERROR "${name}: expected '${pattern}', got status ${status}: ${output}")
  endif()
endfunction()

set(pragma "#pragma once\n")
expect("a layer includes the ground floor" raster_gl/lookup.hpp
       "${pragma}#include \"raster_gl/context.hpp\"\n#include \"scene/settings/job.hpp\"\n" PASSES)
expect("the program meets everybody" cli/main.cpp
       "#include \"raster_gl/lookup.hpp\"\n#include \"reports/table.hpp\"\n" PASSES)
expect("a library belongs to its layer" reference_rt/traversal/embree.hpp
       "${pragma}#include <embree3/rtcore.h>\n" PASSES)
expect("the truth must not know the measurement" reference_rt/truth.cpp
       "#include \"raster_gl/lookup.hpp\"\n" "truth.cpp: reference_rt may not include raster_gl")
expect("the measurement must not know the truth" raster_gl/lookup.cpp
       "#include \"reference_rt/truth.hpp\"\n" "raster_gl may not include reference_rt")
expect("the measurement reads how a map decides" raster_gl/lookup.cpp
       "#include \"methods/depth/filters.hpp\"\n" PASSES)
expect("analysis reads how a map decides" analysis/metrics/metrics.cpp
       "#include \"methods/depth/filters.hpp\"\n" PASSES)
expect("the truth must not know how a map decides" reference_rt/truth.cpp
       "#include \"methods/depth/filters.hpp\"\n" "reference_rt may not include methods")
expect("a method describes, and measures nothing" methods/depth/filters.cpp
       "#include \"raster_gl/lookup.hpp\"\n" "methods may not include raster_gl")
expect("a method calls no GL" methods/depth/filters.cpp
       "#include <epoxy/gl.h>\n" "only raster_gl may include <epoxy/gl.h>")
expect("the ground floor knows nobody" scene/settings/job.cpp
       "#include \"analysis/metrics/metrics.hpp\"\n" "scene may not include analysis")
expect("analysis knows no renderer" analysis/metrics/metrics.cpp
       "  #  include \"raster_gl/lookup.hpp\"\n" "analysis may not include raster_gl")
expect("what is kept does not know what people read" store/csv/csv_text.cpp
       "#include \"reports/text/text.hpp\"\n" "store may not include reports")
expect("reports know no runner" reports/table.cpp
       "#include \"cli/compare.hpp\"\n" "reports may not include cli")
expect("a folder that is no layer" scene/settings/job.cpp
       "#include \"helpers/text.hpp\"\n" "does not start with a layer's folder")
expect("a header without its folder" scene/settings/job.cpp
       "#include \"job.hpp\"\n" "does not start with a layer's folder")
expect("angle brackets do not hide a layer" reference_rt/truth.cpp
       "#include <raster_gl/lookup.hpp>\n" "own headers are included with quotes")
expect("analysis calls no GL" analysis/metrics/metrics.cpp
       "#include <epoxy/gl.h>\n" "only raster_gl may include <epoxy/gl.h>")
expect("reports call no Embree" reports/table.cpp
       "#include <embree4/rtcore.h>\n" "only reference_rt may include <embree4/rtcore.h>")
expect("a header without a guard" tests/scene/brute_force.hpp
       "#include <string>\n" "brute_force.hpp: a header starts with #pragma once")
expect("a header with a using directive" scene/vec.hpp
       "${pragma}  using namespace std\;\n" "vec.hpp: a header has no using namespace")

file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CHECK} RESULT_VARIABLE status
                OUTPUT_QUIET ERROR_QUIET)
if(status EQUAL 0)
  message(SEND_ERROR "a folder without sources must not pass")
endif()
