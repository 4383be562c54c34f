# cmake -DFILES="a;b" -DLAYER=cli -DHEADER=cli/kit.hpp -DTYPE=KitFile -DFUNCTION=kit_files -DOUTPUT=file.cpp
# -P EmbedFiles.cmake: writes the FUNCTION that HEADER declares, which returns the names and texts of files.
set(body "// NOLINTBEGIN: generated\n#include \"${HEADER}\"\n\n")
string(APPEND body "namespace gnomon::${LAYER} {\n\n")
string(APPEND body "std::span<const ${TYPE}> ${FUNCTION}()\n{\n    static const ${TYPE} files[] = {\n")
foreach(path IN LISTS FILES)
  file(READ ${path} source)
  get_filename_component(name ${path} NAME)
  string(APPEND body "        {\"${name}\", R\"file~(${source})file~\"},\n")
endforeach()
string(APPEND body "    };\n    return files;\n}\n\n} // namespace gnomon::${LAYER}\n// NOLINTEND\n")
file(WRITE ${OUTPUT} "${body}")
