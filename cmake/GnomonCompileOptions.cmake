# The compile options of every target.
add_library(gnomon_options INTERFACE)
add_library(gnomon::options ALIAS gnomon_options)
set_target_properties(gnomon_options PROPERTIES EXPORT_NAME options)
target_compile_features(gnomon_options INTERFACE cxx_std_20)

# IEEE operations define the pixel ray, the bias and the predicates (docs/truth.md). Contraction would turn a*b + c into
# fma(a, b, c) on some machines.
target_compile_options(gnomon_options INTERFACE -ffp-contract=off)

add_library(gnomon_warnings INTERFACE)
target_compile_options(gnomon_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wcast-align
  -Wno-missing-field-initializers # designated initialisers leave the defaults on purpose
  -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion -Wformat=2)
if(CMAKE_UNITY_BUILD)
  # A local may shadow another file's constant, and joined sources count as included.
  target_compile_options(gnomon_warnings INTERFACE -Wno-shadow -Wno-subobject-linkage)
endif()
if(GNOMON_WARNINGS_AS_ERRORS)
  target_compile_options(gnomon_warnings INTERFACE -Werror)
  if(CMAKE_UNITY_BUILD AND CMAKE_BUILD_TYPE STREQUAL Release AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # g++ 12 reports these falsely in joined files. Other builds keep them as errors.
    foreach(warning maybe-uninitialized restrict array-bounds stringop-overflow stringop-overread free-nonheap-object
                    nonnull null-dereference)
      target_compile_options(gnomon_warnings INTERFACE -Wno-error=${warning})
    endforeach()
  endif()
endif()

# Every program links this, tests included.
add_library(gnomon_program INTERFACE)

if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT GNOMON_FOR_TIDY)
  # g++ collects garbage at 128 MiB. Joined files need a gigabyte, and spent a seventh of their time on it.
  add_compile_options("SHELL:--param ggc-min-heapsize=2000000")
endif()
find_program(GNOMON_MOLD mold DOC "A faster linker; empty for the compiler's default")
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
    # These checks take four tenths of the compiler's time. AddressSanitizer also stops at null pointers.
    add_compile_options(-fno-sanitize=null,alignment,object-size,vptr,pointer-overflow,nonnull-attribute,returns-nonnull-attribute)
    # Checks as calls compile faster than inline checks.
    add_compile_options("SHELL:--param asan-instrumentation-with-call-threshold=0")
  endif()
  # Stops at an empty optional or an index beyond a span.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
