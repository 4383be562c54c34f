# Installs the libraries with their headers, the program, and the files of find_package(gnomon).
include(CMakePackageConfigHelpers)

set(gnomon_layers scene methods renderers raster_gl reference_rt analysis store reports api)
set(gnomon_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)

list(TRANSFORM gnomon_layers PREPEND gnomon_ OUTPUT_VARIABLE gnomon_layer_targets)
install(TARGETS gnomon_options ${gnomon_layer_targets}
        EXPORT gnomon-targets)
# Other headers of reference_rt are private: they have Embree's types, and the faults that tests inject.
foreach(header certificate/certificate.hpp light/light_queries.hpp points/point_truth.hpp reference.hpp reference_scene.hpp rounded/rounded_truth.hpp truth.hpp)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES reference_rt/${header}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon/reference_rt/${folder})
endforeach()
foreach(layer scene methods renderers raster_gl analysis store reports api)
  install(DIRECTORY ${layer} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon
          FILES_MATCHING PATTERN "*.hpp" PATTERN shaders EXCLUDE)
endforeach()

# The whole library for C++ and for C: <gnomon/gnomon.hpp>, <gnomon/gnomon.h>.
install(FILES api/gnomon.hpp api/gnomon.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon)

install(TARGETS gnomon RUNTIME)
install(FILES ${PROJECT_BINARY_DIR}/gnomon.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
install(DIRECTORY reports/figures/ DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon/figures
        FILES_MATCHING PATTERN "*.py" PATTERN "figures.json")
install(DIRECTORY clusters/ DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon/clusters
        FILES_MATCHING PATTERN "*.py")
if(EXISTS ${PROJECT_SOURCE_DIR}/engines)
  install(DIRECTORY engines/ DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon/engines
          USE_SOURCE_PERMISSIONS PATTERN node_modules EXCLUDE PATTERN build EXCLUDE
          PATTERN "__pycache__" EXCLUDE)
endif()
install(FILES LICENSE CHANGELOG.md CITATION.cff TYPE DOC)

install(EXPORT gnomon-targets NAMESPACE gnomon:: DESTINATION ${gnomon_package_dir})
configure_package_config_file(
  cmake/gnomon-config.cmake.in ${CMAKE_BINARY_DIR}/gnomon-config.cmake
  INSTALL_DESTINATION ${gnomon_package_dir})
# Before 1.0 a new minor version may change an interface.
write_basic_package_version_file(
  ${CMAKE_BINARY_DIR}/gnomon-config-version.cmake COMPATIBILITY SameMinorVersion)
# The package uses the list of dependencies that built it.
install(
  FILES ${CMAKE_BINARY_DIR}/gnomon-config.cmake ${CMAKE_BINARY_DIR}/gnomon-config-version.cmake
        cmake/GnomonDependencies.cmake cmake/GnomonEmbree.cmake
  DESTINATION ${gnomon_package_dir})
