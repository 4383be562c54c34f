# cmake -DSHADERS="a;b" -DLAYER=raster_gl -DHEADER=raster_gl/program.hpp -DFUNCTION=shader_source -DOUTPUT=file.cpp
# -P EmbedShaders.cmake: writes the FUNCTION that HEADER declares, which returns the text of a GLSL file by name.
set(body "// NOLINTBEGIN(readability-function-size): generated\n\n")
string(APPEND body "#include \"${HEADER}\"\n\n#include <stdexcept>\n#include <string>\n\n")
string(APPEND body "namespace gnomon::${LAYER} {\n\n")
string(APPEND body "std::string_view ${FUNCTION}(std::string_view name)\n{\n")
foreach(path IN LISTS SHADERS)
  file(READ ${path} source)
  get_filename_component(name ${path} NAME)
  string(APPEND body "    if (name == \"${name}\") {\n        return R\"glsl(${source})glsl\";\n    }\n")
endforeach()
string(APPEND body "    throw std::invalid_argument(\"${FUNCTION}: no text \" + std::string{name});\n}\n\n")
string(APPEND body "} // namespace gnomon::${LAYER}\n\n// NOLINTEND(readability-function-size)\n")
file(WRITE ${OUTPUT} "${body}")
