# Writes OUTPUT, a C++ file that defines `const char* const NAME`, declared in HEADER, in namespace kreisel::core: the text of INPUT.
file(READ "${INPUT}" text)
file(WRITE "${OUTPUT}" "// Made from ${INPUT} by cmake/embed_text.cmake.\n#include \"${HEADER}\"\n\nnamespace kreisel::core {\n\nconst char* const ${NAME} = R\"__text__(${text})__text__\";\n\n}  // namespace kreisel::core\n")
