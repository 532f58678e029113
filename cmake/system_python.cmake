# Debian's ROS lives in Debian's Python. Where another one (pyenv, conda) stands first on PATH, CMake
# would take that and stop with "No module named 'ament_package'".
if(EXISTS "/usr/bin/python3" AND NOT DEFINED PYTHON_EXECUTABLE)
  set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that has the ROS packages")
endif()
if(DEFINED PYTHON_EXECUTABLE AND NOT DEFINED Python3_EXECUTABLE)
  set(Python3_EXECUTABLE ${PYTHON_EXECUTABLE} CACHE FILEPATH "Python that has the ROS packages")
endif()
