# `make install`: the program with its cases, completions, man page and Python reader (component "livebed"); the
# libraries with a CMake package (component "livebed-dev").  `make package` puts each into a Debian package.
include(CMakePackageConfigHelpers)

# Completions and man page are printed by the program itself.  The home is not that of who builds.
set(printed ${CMAKE_BINARY_DIR}/printed)
set(print ${CMAKE_COMMAND} -E env --unset=XDG_CACHE_HOME --unset=LIVEBED_THREADS --unset=LIVEBED_KERNELS HOME=~
          $<TARGET_FILE:livebed>)
add_custom_command(OUTPUT ${printed}/livebed.1 ${printed}/livebed.bash ${printed}/_livebed ${printed}/livebed.fish
  COMMAND ${CMAKE_COMMAND} -E make_directory ${printed}
  COMMAND ${print} man >${printed}/livebed.1
  COMMAND ${print} completion bash >${printed}/livebed.bash
  COMMAND ${print} completion zsh >${printed}/_livebed
  COMMAND ${print} completion fish >${printed}/livebed.fish
  DEPENDS livebed COMMENT "Printing man page and completions")
add_custom_target(livebed_printed ALL DEPENDS ${printed}/livebed.1)

# Debian's zsh looks into vendor-completions for packages, and into site-functions below /usr/local.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(zsh_folder vendor-completions)
else()
  set(zsh_folder site-functions)
endif()
set(share ${CMAKE_INSTALL_DATADIR})
set(doc ${CMAKE_INSTALL_DOCDIR})

install(TARGETS livebed COMPONENT livebed)
install(FILES ${printed}/livebed.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT livebed)
install(FILES ${printed}/livebed.bash DESTINATION ${share}/bash-completion/completions RENAME livebed COMPONENT livebed)
install(FILES ${printed}/_livebed DESTINATION ${share}/zsh/${zsh_folder} COMPONENT livebed)
install(FILES ${printed}/livebed.fish DESTINATION ${share}/fish/vendor_completions.d COMPONENT livebed)
install(DIRECTORY cases DESTINATION ${share}/livebed COMPONENT livebed)
install(FILES python/livebed.py DESTINATION lib/python3/dist-packages COMPONENT livebed)
install(FILES python/example.py DESTINATION ${doc}/examples COMPONENT livebed)
install(FILES README.md CHANGELOG.md DESTINATION ${doc} COMPONENT livebed)
install(FILES LICENSE DESTINATION ${doc} RENAME copyright COMPONENT livebed)
install(DIRECTORY docs DESTINATION ${doc} COMPONENT livebed FILES_MATCHING PATTERN "*.md" PATTERN "*.png"
        PATTERN validation EXCLUDE)

set(libraries base flow grains coupling case io run report)
list(TRANSFORM libraries PREPEND livebed_ OUTPUT_VARIABLE targets)
install(TARGETS ${targets} livebed_arch EXPORT livebed-targets ARCHIVE COMPONENT livebed-dev)
foreach(library ${libraries})
  install(DIRECTORY src/${library} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/livebed COMPONENT livebed-dev
          FILES_MATCHING PATTERN "*.hpp")
endforeach()
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/livebed)
install(EXPORT livebed-targets NAMESPACE livebed:: DESTINATION ${package} COMPONENT livebed-dev)
configure_package_config_file(cmake/livebed-config.cmake.in ${CMAKE_BINARY_DIR}/livebed-config.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/livebed-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/livebed-config.cmake ${CMAKE_BINARY_DIR}/livebed-config-version.cmake
        DESTINATION ${package} COMPONENT livebed-dev)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/livebed-dev RENAME copyright COMPONENT livebed-dev)

# The Debian packages.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The Livebed authors")
# Who builds the packages is their maintainer, as Debian's own tools have it: DEBFULLNAME and DEBEMAIL, or user and host.
set(maintainer "$ENV{DEBFULLNAME}")
set(address "$ENV{DEBEMAIL}")
if(NOT maintainer)
  set(maintainer "The Livebed authors")
endif()
if(NOT address)
  cmake_host_system_information(RESULT host QUERY FQDN)
  execute_process(COMMAND id -un OUTPUT_VARIABLE user OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(address "${user}@${host}")
endif()
set(CPACK_PACKAGE_CONTACT "${maintainer} <${address}>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL livebed livebed-dev)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIVEBED_PACKAGE_NAME livebed)
set(CPACK_DEBIAN_LIVEBED_PACKAGE_SECTION science)
set(CPACK_DEBIAN_LIVEBED_PACKAGE_RECOMMENDS python3-numpy)
set(CPACK_DEBIAN_LIVEBED_PACKAGE_SUGGESTS "paraview, python3-matplotlib")
set(CPACK_COMPONENT_LIVEBED_DESCRIPTION "scour of a sand bed under a pipeline, grain by grain
 A turbulent current on a grid (RANS) and a bed of discrete grains push each
 other; out come the hole under the pipe, its depth in time, forces and fluxes.")
set(CPACK_DEBIAN_LIVEBED-DEV_PACKAGE_NAME livebed-dev)
set(CPACK_DEBIAN_LIVEBED-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIVEBED-DEV_PACKAGE_DEPENDS
    "libfmt-dev, libtomlplusplus-dev, nlohmann-json3-dev, zlib1g-dev, libhdf5-dev")
set(CPACK_COMPONENT_LIVEBED-DEV_DESCRIPTION "libraries of Livebed for CFD-DEM programs
 Flow past a cut pipe, grains in contact and their exchange as libraries with
 a CMake package: find_package(livebed) gives livebed::flow and its like.")
include(CPack)
