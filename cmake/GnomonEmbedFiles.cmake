# gnomon_embed_files(OUTPUT LAYER HEADER TYPE FUNCTION FILE…): generates a source whose FUNCTION, declared in HEADER, returns
# the names and texts of files as a span of TYPE. Sets the variable OUTPUT to its path.
function(gnomon_embed_files output layer header type function)
  set(embedded ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/EmbedFiles.cmake)
  add_custom_command(
    OUTPUT ${embedded}
    COMMAND ${CMAKE_COMMAND} "-DFILES=${ARGN}" -DLAYER=${layer} -DHEADER=${header} -DTYPE=${type}
            -DFUNCTION=${function} -DOUTPUT=${embedded} -P ${script}
    DEPENDS ${ARGN} ${script}
    VERBATIM)
  add_custom_target(gnomon_${function} DEPENDS ${embedded})
  add_dependencies(gnomon_generated_sources gnomon_${function})
  set(${output} ${embedded} PARENT_SCOPE)
endfunction()
