# Run at every build: writes OUT from version.cpp.in when the commit or the code that packs beds has changed since.
execute_process(COMMAND ${CMAKE_COMMAND} -E env GIT_OPTIONAL_LOCKS=0 git describe --always --dirty --abbrev=12 --exclude=*
                WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE LIVEBED_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(LIVEBED_COMMIT "unknown")
endif()
# How a bed comes out is decided by these files, the compiler and its options.
file(GLOB packing ${SOURCE}/src/base/*.?pp ${SOURCE}/src/case/*.?pp ${SOURCE}/src/grains/*.?pp
     ${SOURCE}/src/run/bed_*.?pp ${SOURCE}/src/run/simulation.?pp ${SOURCE}/CMakeLists.txt)
set(LIVEBED_PACKING "${LIVEBED_OPTIONS}")
foreach(file IN LISTS packing)
  file(SHA256 ${file} hash)
  string(APPEND LIVEBED_PACKING ${hash})
endforeach()
string(SHA256 LIVEBED_PACKING "${LIVEBED_PACKING}")
configure_file(${SOURCE}/cmake/version.cpp.in ${OUT} @ONLY)
