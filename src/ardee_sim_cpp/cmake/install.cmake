# SPDX-License-Identifier: MIT
# Installs the library for find_package(ardee_sim): headers, archives, targets, version.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/ardee_sim)
install(TARGETS ardee_sim ardee_options ${ardee_modules} EXPORT ardee_sim
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/ardee_sim DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN *.h)
install(EXPORT ardee_sim NAMESPACE ardee_sim:: FILE ardee_simTargets.cmake DESTINATION ${config_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/ardee_simConfigVersion.cmake
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/ardee_simConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/ardee_simConfigVersion.cmake DESTINATION ${config_folder})
