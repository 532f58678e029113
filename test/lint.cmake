# Lint of the package and the format of the sources, as tests; skipped where the tool is not installed.
find_program(CATKIN_LINT catkin_lint)
find_program(CLANG_FORMAT clang-format)

if(CATKIN_LINT)
  # Left out: the core is a project of its own, into which the linter does not look (it installs the
  # headers); scripts for a checkout and benchmarks are not installed; the libraries' include paths
  # are for this package alone; the folder with links to OpenNI2's drivers is made by CMake.
  add_test(NAME lint_catkin COMMAND ${CATKIN_LINT} -W1 --strict --offline
    --ignore subproject --ignore uninstalled_include_path --ignore unused_include_path
    --ignore uninstalled_script --ignore uninstalled_target --ignore external_interface_path
    --ignore external_directory --ignore missing_directory
    ${PROJECT_SOURCE_DIR})
endif()

if(CLANG_FORMAT)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/bench/*.cpp
    ${PROJECT_SOURCE_DIR}/include/*.h
    ${PROJECT_SOURCE_DIR}/src/*.cpp ${PROJECT_SOURCE_DIR}/src/*.h
    ${PROJECT_SOURCE_DIR}/test/*.cpp ${PROJECT_SOURCE_DIR}/test/*.h)
  add_test(NAME lint_format COMMAND ${CLANG_FORMAT} --dry-run --Werror ${sources})
endif()
