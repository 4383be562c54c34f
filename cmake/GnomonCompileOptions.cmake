# One INTERFACE target that carries what every target is compiled with.
add_library(gnomon_options INTERFACE)
add_library(gnomon::options ALIAS gnomon_options)
set_target_properties(gnomon_options PROPERTIES EXPORT_NAME options)
target_compile_features(gnomon_options INTERFACE cxx_std_20)

# Contraction would make fma(a, b, c) of a*b + c on some machines: the pixel ray, the bias and the
# predicates are defined by their IEEE operations (docs/truth.md).
target_compile_options(gnomon_options INTERFACE -ffp-contract=off)

add_library(gnomon_warnings INTERFACE)
target_compile_options(gnomon_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wcast-align
  -Wno-missing-field-initializers # designated initialisers leave the defaults on purpose
  -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion -Wformat=2)
if(CMAKE_UNITY_BUILD)
  # A local may be named like another file's constant, and what a source includes counts as a header.
  target_compile_options(gnomon_warnings INTERFACE -Wno-shadow -Wno-subobject-linkage)
endif()
if(GNOMON_WARNINGS_AS_ERRORS)
  target_compile_options(gnomon_warnings INTERFACE -Werror)
endif()

# What every program is linked with, tests included.
add_library(gnomon_program INTERFACE)

if(GNOMON_SANITIZE)
  target_sources(gnomon_program INTERFACE ${PROJECT_SOURCE_DIR}/tests/house/keep_libraries.cpp)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # An empty optional or an index past a span's end stops the program too.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
