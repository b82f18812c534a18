# Builds measured data of data/ into a library: TARGET gets a source file that defines what report/references.hpp declares.
function(livebed_embed_references target)
  set(folder ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
  foreach(name mao1986_livebed_depth mao1986_livebed_profiles)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/data/${name}.csv)
    file(READ ${folder}/data/${name}.csv ${name})
  endforeach()
  configure_file(${folder}/cmake/references.cpp.in ${CMAKE_BINARY_DIR}/references.cpp @ONLY)
  target_sources(${target} PRIVATE ${CMAKE_BINARY_DIR}/references.cpp)
endfunction()

# The same for what src/validate compares with: validate/references.hpp.
function(livebed_embed_validation target)
  set(folder ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
  foreach(name ghia1982_cavity_u ghia1982_cavity_v cylinder_laminar channel_dns_retau180 bfs_driver_seegmiller_cf
               bfs_driver_seegmiller_cp bfs_driver_seegmiller_profiles dem_chung_ooi_test4 sheetflow_revilbaudard2015_phi
               sheetflow_revilbaudard2015_u_stress sedfoam_kepsilon_livebed_depth)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/data/${name}.csv)
    file(READ ${folder}/data/${name}.csv ${name})
  endforeach()
  file(READ ${folder}/cases/mao/case.toml mao_case)
  file(READ ${folder}/cases/mao-mbs2d/case.toml mao_paper_case)
  configure_file(${folder}/cmake/validate_references.cpp.in ${CMAKE_BINARY_DIR}/validate_references.cpp @ONLY)
  target_sources(${target} PRIVATE ${CMAKE_BINARY_DIR}/validate_references.cpp)
endfunction()
