# Plants one include at a time and expects certificate_independence.cmake to name it.
# Run as cmake -DCHECK=<certificate_independence.cmake> -DWORK=<empty folder> -P this file.
cmake_minimum_required(VERSION 3.25)

# expect(FILE INCLUDE PATTERN): PATTERN is what the check says of FILE, or PASSES.
function(expect file include pattern)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/reference_rt/certificate/certificate.hpp "#include \"scene/settings/job.hpp\"\n")
  file(WRITE ${WORK}/reference_rt/${file} "${include}\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CHECK}
                  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}") # CMake wraps its messages
  if(pattern STREQUAL PASSES)
    if(NOT status EQUAL 0)
      message(SEND_ERROR "${file}, ${include}: should pass, but: ${output}")
    endif()
  elseif(status EQUAL 0 OR NOT output MATCHES "${pattern}")
    message(SEND_ERROR "${file}, ${include}: expected '${pattern}', got: ${output}")
  endif()
endfunction()

expect(certificate/pixel.cpp "#include \"reference_rt/certificate/rational_geometry.hpp\"" PASSES)
expect(truth.cpp "#include \"reference_rt/exact/contact.hpp\"" PASSES)
expect(certificate/certificate.cpp "#include \"reference_rt/exact/contact.hpp\""
       "certificate/certificate.cpp: the certificate may not include reference_rt/exact/contact.hpp")
expect(certificate/rational_geometry.cpp "  #  include <reference_rt/exact/predicates.hpp>"
       "certificate/rational_geometry.cpp: the certificate may not include reference_rt/exact/predicates.hpp")
expect(truth.cpp "#include \"reference_rt/certificate/rational_geometry.hpp\""
       "truth.cpp: only the certificate may include reference_rt/certificate/rational_geometry.hpp")

file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CHECK} RESULT_VARIABLE status
                OUTPUT_QUIET ERROR_QUIET)
if(status EQUAL 0)
  message(SEND_ERROR "a folder without the certificate must not pass")
endif()
