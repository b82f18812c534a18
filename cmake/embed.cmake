# Writes OUT: page.js and page.css of the folder FROM as arrays of bytes (both are ASCII, and too long for literals).
set(text "#include \"report/page.hpp\"\n\nnamespace livebed::report {\n\n")
foreach(part js css)
  file(READ ${FROM}/page.${part} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(APPEND text "static const char ${part}[] = {${bytes}};\n")
endforeach()
string(APPEND text "const std::string_view page_script{js, sizeof js};\nconst std::string_view page_style{css, sizeof css};\n\n"
                   "}  // namespace livebed::report\n")
file(WRITE ${OUT} "${text}")
