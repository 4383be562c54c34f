add_custom_target(gnomon_generated_sources) # clang-tidy needs these built

# gnomon_embed_shaders(OUTPUT LAYER HEADER FUNCTION FILE…): generates a source whose FUNCTION, declared in HEADER, returns the
# text of a GLSL file by name. Sets the variable OUTPUT to its path.
function(gnomon_embed_shaders output layer header function)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE paths)
  set(embedded ${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/EmbedShaders.cmake)
  add_custom_command(
    OUTPUT ${embedded}
    COMMAND ${CMAKE_COMMAND} "-DSHADERS=${paths}" -DLAYER=${layer} -DHEADER=${header} -DFUNCTION=${function}
            -DOUTPUT=${embedded} -P ${script}
    DEPENDS ${paths} ${script}
    VERBATIM)
  add_custom_target(gnomon_${layer}_shaders DEPENDS ${embedded})
  add_dependencies(gnomon_generated_sources gnomon_${layer}_shaders)
  set(${output} ${embedded} PARENT_SCOPE)
endfunction()
