# What `cmake --install` lays out, in two components: the command with its rules, examples and pages, and the libraries with
# their headers for `find_package(gramap)`. `cpack` makes a Debian package of each.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS gramap_command RUNTIME COMPONENT command)
install(DIRECTORY rules/ DESTINATION ${CMAKE_INSTALL_DATADIR}/gramap/rules COMPONENT command)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/gramap COMPONENT command USE_SOURCE_PERMISSIONS
  PATTERN make-office EXCLUDE PATTERN demo EXCLUDE)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
install(FILES cmake/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
# Where each shell looks for completions.
set(GRAMAP_DOCUMENTS ${CMAKE_BINARY_DIR}/documents)
install(DIRECTORY ${GRAMAP_DOCUMENTS}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES ${GRAMAP_DOCUMENTS}/completions/gramap COMPONENT command
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${GRAMAP_DOCUMENTS}/completions/_gramap COMPONENT command DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${GRAMAP_DOCUMENTS}/completions/gramap.fish COMPONENT command
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# The headers name no library but Eigen; the two that do are gramap's own business.
set(GRAMAP_CONFIG ${CMAKE_INSTALL_LIBDIR}/cmake/gramap)
foreach(part geometry grammar perception floor)
  set_target_properties(gramap_${part} PROPERTIES EXPORT_NAME ${part})
  install(TARGETS gramap_${part} EXPORT gramap ARCHIVE COMPONENT libraries)
  install(DIRECTORY ${part} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gramap COMPONENT libraries
    FILES_MATCHING PATTERN *.h PATTERN raster_cv.h EXCLUDE PATTERN gltf_extras.h EXCLUDE PATTERN viewer EXCLUDE)
endforeach()
install(EXPORT gramap NAMESPACE gramap:: FILE gramap-targets.cmake DESTINATION ${GRAMAP_CONFIG} COMPONENT libraries)
configure_package_config_file(cmake/gramap-config.cmake.in ${CMAKE_BINARY_DIR}/generated/gramap-config.cmake
  INSTALL_DESTINATION ${GRAMAP_CONFIG})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/gramap-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/generated/gramap-config.cmake ${CMAKE_BINARY_DIR}/generated/gramap-config-version.cmake
  cmake/FindOpenCV.cmake DESTINATION ${GRAMAP_CONFIG} COMPONENT libraries)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gramap)
set(CPACK_PACKAGE_CONTACT "The gramap project")
set(CPACK_PACKAGE_HOMEPAGE_URL "")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL command libraries)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME gramap)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_COMMAND_DESCRIPTION
  "A grammar says what a building can look like, scans say what was seen; gramap finds\nthe most probable complete floor and writes it as glTF.")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME libgramap-dev)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_DEPENDS "libeigen3-dev, libgmp-dev, libmpfr-dev, libtbb-dev, zlib1g-dev, libopencv-core-dev, \
libopencv-imgproc-dev, libopencv-ml-dev, liboctomap-dev, libtinygltf-dev")
set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "Libraries and headers of gramap, for find_package(gramap).")
include(CPack)
