# Builds the script that shows a run in ParaView into TARGET (io/paraview.cpp).
function(livebed_embed_paraview target)
  set(file ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../python/paraview-state.py)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} state)
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/paraview.cpp.in ${CMAKE_BINARY_DIR}/paraview_script.cpp @ONLY)
  target_sources(${target} PRIVATE ${CMAKE_BINARY_DIR}/paraview_script.cpp)
endfunction()
