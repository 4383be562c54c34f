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
