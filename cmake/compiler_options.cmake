if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
# Installed programs find the libraries that were installed with them, wherever that was.
set(CMAKE_INSTALL_RPATH "$ORIGIN:$ORIGIN/..")

# Strict warnings for the project's own code; what it includes from elsewhere is SYSTEM.
function(dpd_target_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
endfunction()

# A part of the package that needs no more than the core: a static library by the part's name.
function(dpd_add_core_part part)
  add_library(${PROJECT_NAME}_${part} STATIC ${ARGN})
  dpd_target_options(${PROJECT_NAME}_${part})
  target_include_directories(${PROJECT_NAME}_${part} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${PROJECT_NAME}_${part} PUBLIC ${PROJECT_NAME}_core)
endfunction()
