# Installs Gnomon into an empty prefix, builds examples/find_package against it, and runs it.
# Run as cmake -DROOT=<checkout> -DBUILD=<build folder> -DWORK=<empty folder> -P install_test.cmake.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
if(EXISTS ${WORK}/prefix/include/gnomon/reference_rt/injected_faults.hpp)
  message(FATAL_ERROR "the installed headers let a caller put faults into the truth")
endif()
run(${CMAKE_COMMAND} -S ${ROOT}/examples/find_package -B ${WORK}/build -G Ninja
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)

run(${WORK}/build/texel_widths yard)
if(NOT output MATCHES "^yard: [1-9][0-9]* triangles.* 512 texels: 0\\.[0-9]+ m wide")
  message(FATAL_ERROR "texel_widths yard printed:\n${output}")
endif()
run(${WORK}/build/shadow_share sphere-plane)
if(NOT output MATCHES "^sphere-plane: [1-9][0-9]* of [1-9][0-9]* pixels")
  message(FATAL_ERROR "shadow_share sphere-plane printed:\n${output}")
endif()
run(${WORK}/prefix/bin/gnomon compare --builtin wall --set image.width=64 --set image.height=36
    --picture ${WORK}/picture.png)
if(NOT EXISTS ${WORK}/picture.png)
  message(FATAL_ERROR "the installed gnomon compare --picture wrote none")
endif()
# Without a source tree's scripts: these are the installed ones, wherever Python has its packages.
if(NOT EXISTS ${WORK}/prefix/share/gnomon/figures/make.py
   OR NOT EXISTS ${WORK}/prefix/share/gnomon/figures/gnomon/run.py)
  message(FATAL_ERROR "the scripts that draw figures were not installed")
endif()
execute_process(COMMAND ${WORK}/prefix/bin/gnomon figure bias-curve ${WORK}/none -o ${WORK}/f.svg
                RESULT_VARIABLE status ERROR_VARIABLE output)
if(NOT output MATCHES "^gnomon: .*(none/results.csv: no such file|apt-get install python3)")
  message(FATAL_ERROR "the installed gnomon figure ended with ${status}:\n${output}")
endif()
# Engines are found in the prefix, and one that is put there is driven by its name.
set(engines ${WORK}/prefix/share/gnomon/engines)
file(COPY ${ROOT}/examples/renderers/rays.py DESTINATION ${engines}/rays)
file(WRITE ${engines}/rays/renderer.toml
     "title = \"rays\"\ncommand = [\"/usr/bin/python3\", \"rays.py\"]\nneeds = [\"python3\"]\n")
run(${WORK}/prefix/bin/gnomon renderers --json)
foreach(engine rays three)
  if(NOT output MATCHES "\"folder\": *\"${engines}/${engine}\"")
    message(FATAL_ERROR "the installed gnomon renderers has no ${engines}/${engine}:\n${output}")
  endif()
endforeach()
run(${WORK}/prefix/bin/gnomon compare --builtin wall --set image.width=64 --set image.height=36
    --renderer rays)
if(NOT output MATCHES "false shadow +0 ")
  message(FATAL_ERROR "rays, driven by the installed gnomon, is not true:\n${output}")
endif()
if(NOT EXISTS ${WORK}/prefix/share/man/man1/gnomon.1)
  message(FATAL_ERROR "the manual page was not installed")
endif()
run(${WORK}/prefix/bin/gnomon --version)
if(NOT output MATCHES "^gnomon [0-9]+\\.[0-9]+\\.[0-9]+")
  message(FATAL_ERROR "the installed gnomon --version printed:\n${output}")
endif()
