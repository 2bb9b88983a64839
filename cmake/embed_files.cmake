# Writes OUTPUT, a C++ file that defines `const Embedded embedded_pages[]`, declared in live/pages.hpp: the name, text and size of
# each of FILES, apart by "|".
string(REPLACE "|" ";" files "${FILES}")
file(WRITE "${OUTPUT}" "// Made by cmake/embed_files.cmake.\n#include \"live/pages.hpp\"\n\nnamespace kreisel::core::live {\n\nconst Embedded embedded_pages[] = {\n")
foreach(file IN LISTS files)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  file(SIZE "${file}" size)
  file(APPEND "${OUTPUT}" "{\"${name}\", R\"__text__(${text})__text__\", ${size}},\n")
endforeach()
file(APPEND "${OUTPUT}" "{\"\", \"\", 0}};\n\n}  // namespace kreisel::core::live\n")
