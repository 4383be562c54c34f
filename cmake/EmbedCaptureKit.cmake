# cmake -DFILES="a;b" -DOUTPUT=file.cpp -P EmbedCaptureKit.cmake: the files that `gnomon capture-kit`
# writes, as string literals.
set(body "// NOLINTBEGIN: generated\n#include \"cli/evaluate/capture_kit_command.hpp\"\n\n")
string(APPEND body "namespace gnomon::cli {\n\n")
string(APPEND body "std::span<const KitFile> capture_kit_files()\n{\n    static const KitFile files[] = {\n")
foreach(path IN LISTS FILES)
  file(READ ${path} source)
  get_filename_component(name ${path} NAME)
  string(APPEND body "        {\"${name}\", R\"kit~(${source})kit~\"},\n")
endforeach()
string(APPEND body "    };\n    return files;\n}\n\n} // namespace gnomon::cli\n// NOLINTEND\n")
file(WRITE ${OUTPUT} "${body}")
