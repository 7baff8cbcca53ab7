# find_package(etalon CONFIG) for outside projects; proved by tests/install.

include(CMakePackageConfigHelpers)

# The whole public tree: "core/mesh/mesh.h" is include/etalon/core/mesh/mesh.h; tables that headers include (.inc) go with them.
foreach(folder core raster gpu validation)
  if(EXISTS "${PROJECT_SOURCE_DIR}/${folder}" AND (NOT folder STREQUAL gpu OR ETALON_GPU))
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/etalon" FILES_MATCHING PATTERN "*.h" PATTERN "*.inc")
  endif()
endforeach()

set(ETALON_CONFIG_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/etalon")
install(EXPORT etalon NAMESPACE etalon:: FILE etalonTargets.cmake DESTINATION "${ETALON_CONFIG_DIR}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/etalonConfig.cmake.in" "${PROJECT_BINARY_DIR}/etalonConfig.cmake"
                              INSTALL_DESTINATION "${ETALON_CONFIG_DIR}")
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/etalonConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/etalonConfig.cmake" "${PROJECT_BINARY_DIR}/etalonConfigVersion.cmake" DESTINATION "${ETALON_CONFIG_DIR}")
install(FILES LICENSE README.md CHANGELOG.md docs/contract.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
