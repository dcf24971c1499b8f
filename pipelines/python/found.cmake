# Whether the Python module is built: where pybind11 is found. Debian's own Python is asked first, as the module goes to
# its folder; another one is named by -DPython_EXECUTABLE.
if(EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the module is built for")
endif()
set(PYBIND11_FINDPYTHON ON)
find_package(Python QUIET COMPONENTS Interpreter Development.Module)
if(Python_Development.Module_FOUND)
  find_package(pybind11 2.10 CONFIG QUIET)
endif()
option(BRAINSHIFT_PYTHON "Build the Python module" ${pybind11_FOUND})

# A shared library holds code for any address. Hidden names keep its calls as direct as the program's.
if(BRAINSHIFT_PYTHON)
  find_package(Python REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 CONFIG REQUIRED)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  set(CMAKE_CXX_VISIBILITY_PRESET hidden)
  set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
endif()
