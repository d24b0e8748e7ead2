# The install tree: headers, two archives, a CMake package and a pkg-config file.
include(CMakePackageConfigHelpers)

set(package "${CMAKE_INSTALL_LIBDIR}/cmake/polycube")

install(DIRECTORY include/polycube DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        PATTERN openmesh.hpp EXCLUDE PATTERN cgal.hpp EXCLUDE PATTERN cgal EXCLUDE)
install(FILES "${POLYCUBE_CORE_ARCHIVE}" DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(TARGETS polycube EXPORT polycube ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT polycube NAMESPACE polycube:: FILE polycube-targets.cmake DESTINATION "${package}")
if(POLYCUBE_WITH_OPENMESH)
  install(FILES include/polycube/openmesh.hpp DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/polycube")
  install(TARGETS polycube_openmesh EXPORT polycube-openmesh)
  install(EXPORT polycube-openmesh NAMESPACE polycube:: FILE polycube-openmesh-targets.cmake DESTINATION "${package}")
endif()
if(POLYCUBE_WITH_CGAL)
  install(FILES include/polycube/cgal.hpp DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/polycube")
  install(DIRECTORY include/polycube/cgal DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/polycube")
  install(TARGETS polycube_cgal EXPORT polycube-cgal)
  install(EXPORT polycube-cgal NAMESPACE polycube:: FILE polycube-cgal-targets.cmake DESTINATION "${package}")
endif()

configure_package_config_file(cmake/polycube-config.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/polycube-config.cmake"
                              INSTALL_DESTINATION "${package}" PATH_VARS CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/polycube-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/polycube-config.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/polycube-config-version.cmake" DESTINATION "${package}")

configure_file(cmake/polycube.pc.in polycube.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/polycube.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

# What cpack makes of it: an archive to unpack anywhere, and a package for Debian and its kin.
set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_CONTACT "The Polycube authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Coarse block structures, quad and hex meshes from polycubes, for C++")
set(CPACK_RESOURCE_FILE_LICENSE "${root}/LICENSE-MIT")
set(CPACK_DEBIAN_PACKAGE_NAME libpolycube-dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libc6-dev, libstdc++-dev")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libopenmesh-dev, libcgal-dev")
include(CPack)
