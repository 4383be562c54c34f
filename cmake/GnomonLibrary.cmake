# gnomon_compile_quickly(TARGET): the target's code takes little of any run, or of any sanitized test, so that
# optimising it costs more of the compiler's time than it saves: half of that in a sanitized build, where
# the checks are optimised, too.
function(gnomon_compile_quickly target)
  if(GNOMON_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  elseif(CMAKE_BUILD_TYPE STREQUAL Release)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# gnomon_library(NAME SOURCES … [LINK …] [PRIVATE_LINK …]): one library a folder, gnomon::NAME.
function(gnomon_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(gnomon_${name} STATIC ${ARG_SOURCES})
  add_library(gnomon::${name} ALIAS gnomon_${name})
  set_target_properties(gnomon_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(gnomon_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gnomon>)
  target_link_libraries(gnomon_${name}
    PUBLIC gnomon::options ${ARG_LINK}
    PRIVATE $<BUILD_INTERFACE:gnomon_warnings> ${ARG_PRIVATE_LINK})
endfunction()
