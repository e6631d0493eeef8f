# The option CAIRN_PYTHON, and the interpreter that the Python package is built for.

# Debian's NumPy and pytest belong to Debian's interpreter; another may stand before it in PATH. A virtual environment is a
# choice, and so is -DPython_EXECUTABLE.
if(NOT DEFINED Python_EXECUTABLE AND NOT DEFINED ENV{VIRTUAL_ENV} AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()

# With the tests it is built where it can be. Sanitizers would have to be in the interpreter too.
set(cairn_python_default OFF)
if(PROJECT_IS_TOP_LEVEL AND CAIRN_TESTS AND NOT CAIRN_SANITIZE)
  find_package(Python COMPONENTS Interpreter Development.Module QUIET)  # first: pybind11 goes by it
  find_package(pybind11 2.10 CONFIG QUIET)
  if(Python_FOUND AND pybind11_FOUND)
    set(cairn_python_default ON)
  endif()
endif()
option(CAIRN_PYTHON "Build the Python package (pybind11)" ${cairn_python_default})

if(CAIRN_PYTHON)
  find_package(Python COMPONENTS Interpreter Development.Module REQUIRED)
  find_package(pybind11 2.10 CONFIG REQUIRED)
endif()
