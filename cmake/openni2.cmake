# OpenNI2 loads the driver plug-ins that lie beside it, in OpenNI2/Drivers. So that ours are found
# without root and without environment variables, a folder of our own holds links to the system's
# library and drivers, and our plug-ins; what uses OpenNI2 is told to look there first.
find_path(OPENNI2_INCLUDE_DIR OpenNI.h PATH_SUFFIXES openni2 REQUIRED)
find_library(OPENNI2_LIBRARY OpenNI2 REQUIRED)
get_filename_component(openni2_folder ${OPENNI2_LIBRARY} DIRECTORY)

# Below lib/ of the devel space and of the installation.
set(DPD_OPENNI2_FOLDER ${PROJECT_NAME}/openni2)
set(DPD_OPENNI2_DEVEL_FOLDER ${CATKIN_DEVEL_PREFIX}/lib/${DPD_OPENNI2_FOLDER})

set(links ${PROJECT_BINARY_DIR}/openni2_links)
file(GLOB system_drivers ${openni2_folder}/OpenNI2/Drivers/lib*.so.0)
foreach(folder ${links} ${DPD_OPENNI2_DEVEL_FOLDER})
  file(MAKE_DIRECTORY ${folder}/OpenNI2/Drivers)
  file(CREATE_LINK ${openni2_folder}/libOpenNI2.so.0 ${folder}/libOpenNI2.so.0 SYMBOLIC)
  foreach(driver ${system_drivers})
    get_filename_component(name ${driver} NAME)
    file(CREATE_LINK ${driver} ${folder}/OpenNI2/Drivers/${name} SYMBOLIC)
  endforeach()
endforeach()
install(DIRECTORY ${links}/
  DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}/${DPD_OPENNI2_FOLDER})

# Links a library or a program with OpenNI2 in our folder.
function(dpd_use_openni2 target)
  target_include_directories(${target} SYSTEM PRIVATE ${OPENNI2_INCLUDE_DIR})
  # Not by target_link_libraries: tests use its old signature, everything else the new one.
  set_property(TARGET ${target} APPEND PROPERTY LINK_LIBRARIES ${OPENNI2_LIBRARY})
  set_target_properties(${target} PROPERTIES
    BUILD_RPATH ${DPD_OPENNI2_DEVEL_FOLDER}
    INSTALL_RPATH "$ORIGIN/${DPD_OPENNI2_FOLDER};${CMAKE_INSTALL_RPATH}")
endfunction()

# Puts a driver plug-in where OpenNI2 finds it.
function(dpd_openni2_driver target)
  set_target_properties(${target} PROPERTIES
    SUFFIX .so.0
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${DPD_OPENNI2_DEVEL_FOLDER}/OpenNI2/Drivers
    INSTALL_RPATH "$ORIGIN/../../../..")
  install(TARGETS ${target} LIBRARY
    DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}/${DPD_OPENNI2_FOLDER}/OpenNI2/Drivers)
endfunction()
