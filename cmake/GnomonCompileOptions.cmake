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
  if(CMAKE_UNITY_BUILD AND CMAKE_BUILD_TYPE STREQUAL Release AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # g++ 12 sees these falsely where it inlines variants and strings of joined files; other builds hold them.
    foreach(warning maybe-uninitialized restrict array-bounds stringop-overflow stringop-overread free-nonheap-object
                    nonnull null-dereference)
      target_compile_options(gnomon_warnings INTERFACE -Wno-error=${warning})
    endforeach()
  endif()
endif()

# What every program is linked with, tests included.
add_library(gnomon_program INTERFACE)

if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT GNOMON_FOR_TIDY)
  # g++ collects its garbage when it holds 128 MiB. Joined files hold a gigabyte, and a seventh of their time went into that.
  add_compile_options("SHELL:--param ggc-min-heapsize=2000000")
endif()
find_program(GNOMON_MOLD mold DOC "A faster linker; empty takes the compiler's own")
mark_as_advanced(GNOMON_MOLD)
if(GNOMON_MOLD AND NOT GNOMON_FOR_TIDY)
  add_link_options(-fuse-ld=mold)
endif()

if(GNOMON_SANITIZE)
  target_sources(gnomon_program INTERFACE ${PROJECT_SOURCE_DIR}/tests/repo/keep_libraries.cpp)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  if(NOT GNOMON_SANITIZE_ALL)
    # These checks take four tenths of the compiler's time. AddressSanitizer stops at a null pointer, too.
    add_compile_options(-fno-sanitize=null,alignment,object-size,vptr,pointer-overflow,nonnull-attribute,returns-nonnull-attribute)
    # Checks as calls: less to compile than checks in line.
    add_compile_options("SHELL:--param asan-instrumentation-with-call-threshold=0")
  endif()
  # An empty optional or an index past a span's end stops the program too.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
