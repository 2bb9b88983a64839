# Writes OUTPUT, a C++ file that defines `const char* const NAME`, declared in HEADER, in namespace kreisel: the text of INPUT.
file(READ "${INPUT}" text)
file(WRITE "${OUTPUT}" "// Made from ${INPUT} by cmake/embed_text.cmake.\n#include \"${HEADER}\"\n\nnamespace kreisel {\n\nconst char* const ${NAME} = R\"__text__(${text})__text__\";\n\n}  // namespace kreisel\n")
