# gnomon_compile_quickly(TARGET): compiles with -O1, for code that takes little of any run. Not for libraries: the linker may
# keep this version of an inline function that another library has as well.
function(gnomon_compile_quickly target)
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# Precompiled headers for all targets with these compile options. A file must include what it uses all the same: the
# presets alone and tidy do without them.
file(CONFIGURE OUTPUT shared_headers.cpp CONTENT "")
add_library(gnomon_shared_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/shared_headers.cpp)
set_target_properties(gnomon_shared_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_link_libraries(gnomon_shared_headers PRIVATE gnomon::options gnomon_warnings fmt::fmt nlohmann_json::nlohmann_json)
target_precompile_headers(gnomon_shared_headers PRIVATE
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <numeric> <optional> <set> <span>
  <sstream> <string> <string_view> <unordered_map> <utility> <variant> <vector> <fmt/format.h> <nlohmann/json.hpp>)
function(gnomon_share_headers target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(${target} PRIVATE fmt::fmt)
  target_precompile_headers(${target} REUSE_FROM gnomon_shared_headers)
endfunction()

# gnomon_library(NAME [OWN_OPTIONS] SOURCES … [LINK …] [PRIVATE_LINK …]): the library of a folder, gnomon::NAME.
# OWN_OPTIONS: its compile options differ from those of the shared headers.
function(gnomon_library name)
  cmake_parse_arguments(ARG "OWN_OPTIONS" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(gnomon_${name} STATIC ${ARG_SOURCES})
  add_library(gnomon::${name} ALIAS gnomon_${name})
  set_target_properties(gnomon_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(gnomon_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gnomon>)
  target_link_libraries(gnomon_${name}
    PUBLIC gnomon::options ${ARG_LINK}
    PRIVATE $<BUILD_INTERFACE:gnomon_warnings> ${ARG_PRIVATE_LINK})
  if(NOT ARG_OWN_OPTIONS)
    gnomon_share_headers(gnomon_${name})
  endif()
endfunction()
