# `cmake --install` and CPack. The tree can be moved as a whole: the program finds its library by a
# relative RPATH, and its plugins in lib/exphoton/plugins beside its own folder
# (core/plugins/search.cpp).
#
#   bin/exphoton                     lib/libexphoton.so        lib/exphoton/plugins/<kind>/<name>.so
#   include/exphoton/core/...        lib/cmake/exphoton/       share/exphoton/scenes/
#   share/doc/exphoton/              share/man/man1/           completions of bash and zsh
if(EXPHOTON_STATIC OR NOT TARGET exphoton)
  return()
endif()
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # the tests are no part of an installation

set_target_properties(exphoton PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
set_target_properties(exphoton_core PROPERTIES INSTALL_RPATH "$ORIGIN")
install(TARGETS exphoton RUNTIME DESTINATION bin)
install(TARGETS exphoton_core LIBRARY DESTINATION lib)
foreach(target ${plugin_targets})
  # plugin_<kind>_<name>; kinds have no underscore
  string(REGEX REPLACE "^plugin_([a-z]+)_.*" "\\1" kind ${target})
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/../../..")
  install(TARGETS ${target} LIBRARY DESTINATION lib/exphoton/plugins/${kind})
endforeach()

# Headers for plugin authors, under the names by which sources include them.
install(DIRECTORY core DESTINATION include/exphoton FILES_MATCHING PATTERN "*.h" PATTERN "*.inl"
  PATTERN app EXCLUDE)
install(FILES core/plugins/plugin.map DESTINATION share/exphoton)

set(EXPHOTON_PLUGIN_OPTIONS -ffp-contract=off -fno-math-errno)
set(EXPHOTON_PLUGIN_DEFINITIONS)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND EXPHOTON_PLUGIN_OPTIONS -fno-gnu-unique)
endif()
if(EXPHOTON_NATIVE)
  list(APPEND EXPHOTON_PLUGIN_OPTIONS -march=native)
endif()
if(EXPHOTON_DOUBLE)
  list(APPEND EXPHOTON_PLUGIN_DEFINITIONS EXPHOTON_DOUBLE)
endif()
include(CMakePackageConfigHelpers)
configure_package_config_file(core/app/install/exphotonConfig.cmake.in
  ${CMAKE_BINARY_DIR}/install/exphotonConfig.cmake INSTALL_DESTINATION lib/cmake/exphoton)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/install/exphotonConfigVersion.cmake
  COMPATIBILITY ExactVersion)
install(FILES ${CMAKE_BINARY_DIR}/install/exphotonConfig.cmake
  ${CMAKE_BINARY_DIR}/install/exphotonConfigVersion.cmake DESTINATION lib/cmake/exphoton)

install(DIRECTORY scenes DESTINATION share/exphoton)
install(DIRECTORY docs/ DESTINATION share/doc/exphoton PATTERN "*.sh" EXCLUDE)
install(FILES README.md DESTINATION share/doc/exphoton RENAME OVERVIEW.md)
install(FILES LICENSE DESTINATION share/doc/exphoton RENAME copyright)
configure_file(core/app/install/exphoton.1.in ${CMAKE_BINARY_DIR}/install/exphoton.1 @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/install/exphoton.1 DESTINATION share/man/man1)
install(FILES core/app/install/exphoton.bash DESTINATION share/bash-completion/completions
  RENAME exphoton)
install(FILES core/app/install/exphoton.zsh DESTINATION share/zsh/vendor-completions
  RENAME _exphoton)

# cpack -G DEB makes exphoton_VERSION_ARCHITECTURE.deb.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME exphoton)
set(CPACK_PACKAGE_CONTACT "The exphoton authors <exphoton@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Renderer with extended photon mapping for pbrt scenes")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
include(CPack)
