# Bundles web/ into one script and one style sheet and builds both into TARGET (report/page.hpp).
function(livebed_embed_page target)
  find_program(ESBUILD esbuild)
  if(NOT ESBUILD)
    message(FATAL_ERROR "esbuild is missing: it bundles web/.  Debian has it as the package esbuild "
                        "(tools/install-dependencies build).")
  endif()
  set(web ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../web)
  set(embed ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embed.cmake)
  file(GLOB sources CONFIGURE_DEPENDS ${web}/*.js ${web}/*.css)
  add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/page.cpp
    COMMAND ${ESBUILD} ${web}/main.js --bundle --minify --target=es2022 --log-level=warning --outfile=${CMAKE_BINARY_DIR}/page.js
    COMMAND ${CMAKE_COMMAND} -DFROM=${CMAKE_BINARY_DIR} -DOUT=${CMAKE_BINARY_DIR}/page.cpp -P ${embed}
    DEPENDS ${sources} ${embed}
    BYPRODUCTS ${CMAKE_BINARY_DIR}/page.js ${CMAKE_BINARY_DIR}/page.css
    COMMENT "Bundling the page" VERBATIM)
  target_sources(${target} PRIVATE ${CMAKE_BINARY_DIR}/page.cpp)
endfunction()
