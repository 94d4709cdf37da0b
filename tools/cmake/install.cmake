# What `cmake --install` puts where: the libraries, the public headers, and what find_package and pkg-config look for.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(ISOLOD_INSTALLED isolod)
if(TARGET isolod_io)
  list(APPEND ISOLOD_INSTALLED isolod_io)
endif()
set(ISOLOD_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/isolod)
install(TARGETS ${ISOLOD_INSTALLED} EXPORT isolod
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/isolod DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT isolod NAMESPACE isolod:: FILE isolod-targets.cmake DESTINATION ${ISOLOD_CMAKE_DIR})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/isolod-config.cmake.in
  ${PROJECT_BINARY_DIR}/isolod-config.cmake INSTALL_DESTINATION ${ISOLOD_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/isolod-config-version.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/isolod-config.cmake ${PROJECT_BINARY_DIR}/isolod-config-version.cmake
  DESTINATION ${ISOLOD_CMAKE_DIR})

# The prefix is told from where the .pc file lies, so that the whole tree may move.
file(RELATIVE_PATH ISOLOD_PC_TO_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
set(ISOLOD_PC_CFLAGS "")
if(BUILD_SHARED_LIBS)
  set(ISOLOD_PC_CFLAGS -DISOLOD_SHARED)
endif()
foreach(file isolod isolod-io)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${file}.pc.in ${PROJECT_BINARY_DIR}/${file}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${file}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()
