# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT

# find_package(vantage 0.1 COMPONENTS io sim mission)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vantage)

install(DIRECTORY include/vantage DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(TARGETS ${vantage_targets} EXPORT vantage INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT vantage NAMESPACE vantage:: FILE vantageTargets.cmake DESTINATION ${config_dir})

configure_package_config_file(cmake/vantageConfig.cmake.in vantageConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(vantageConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/vantageConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/vantageConfigVersion.cmake
        DESTINATION ${config_dir})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
