# Run at every build: writes OUT from version.cpp.in when the commit has changed since.
execute_process(COMMAND ${CMAKE_COMMAND} -E env GIT_OPTIONAL_LOCKS=0 git describe --always --dirty --abbrev=12 --exclude=*
                WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE LIVEBED_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(LIVEBED_COMMIT "unknown")
endif()
configure_file(${SOURCE}/cmake/version.cpp.in ${OUT} @ONLY)
