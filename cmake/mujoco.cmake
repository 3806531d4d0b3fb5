# finds the headers and the library in the mujoco wheel and makes the target mujoco::mujoco of them.

# the one version that the plugin may be compiled with, from the line that checks it at run time
file(STRINGS flaprig/native/library.py FLAPRIG_MUJOCO_LINE REGEX "^MUJOCO_VERSION = ")
if(NOT FLAPRIG_MUJOCO_LINE MATCHES "\"([0-9]+)\\.([0-9]+)\\.([0-9]+)\"")
  message(FATAL_ERROR "flaprig/native/library.py must hold the line MUJOCO_VERSION = \"x.y.z\".")
endif()
set(FLAPRIG_MUJOCO_VERSION "${CMAKE_MATCH_1}.${CMAKE_MATCH_2}.${CMAKE_MATCH_3}")
# mjVERSION_HEADER counts major * 1000000 + minor * 1000 + patch
math(EXPR FLAPRIG_MUJOCO_NUMBER
  "${CMAKE_MATCH_1} * 1000000 + ${CMAKE_MATCH_2} * 1000 + ${CMAKE_MATCH_3}")

# find_spec only looks: importing mujoco would take a second and need its own dependencies
execute_process(
  COMMAND "${Python_EXECUTABLE}" -c
    "from importlib.util import find_spec; s = find_spec('mujoco'); print(list(s.submodule_search_locations)[0] if s else '')"
  OUTPUT_VARIABLE FLAPRIG_MUJOCO_DIR OUTPUT_STRIP_TRAILING_WHITESPACE
  RESULT_VARIABLE FLAPRIG_MUJOCO_FAILED)
set(FLAPRIG_MUJOCO_HEADER "${FLAPRIG_MUJOCO_DIR}/include/mujoco/mujoco.h")
if(FLAPRIG_MUJOCO_FAILED OR NOT EXISTS "${FLAPRIG_MUJOCO_HEADER}")
  message(FATAL_ERROR "flaprig compiles its plugin against the mujoco wheel and ${Python_EXECUTABLE} "
    "has none: pip install mujoco==${FLAPRIG_MUJOCO_VERSION}")
endif()

file(STRINGS "${FLAPRIG_MUJOCO_HEADER}" FLAPRIG_FOUND REGEX "^#define mjVERSION_HEADER ")
string(REGEX REPLACE "[^0-9]" "" FLAPRIG_FOUND "${FLAPRIG_FOUND}")
if(NOT FLAPRIG_FOUND EQUAL FLAPRIG_MUJOCO_NUMBER)
  message(FATAL_ERROR "flaprig compiles its plugin against mujoco ${FLAPRIG_MUJOCO_VERSION} only "
    "(mjVERSION_HEADER ${FLAPRIG_MUJOCO_NUMBER}) and found mjVERSION_HEADER ${FLAPRIG_FOUND} in "
    "${FLAPRIG_MUJOCO_DIR}: pip install mujoco==${FLAPRIG_MUJOCO_VERSION}")
endif()

set(FLAPRIG_MUJOCO_LIBRARY
  "${FLAPRIG_MUJOCO_DIR}/${CMAKE_SHARED_LIBRARY_PREFIX}mujoco.so.${FLAPRIG_MUJOCO_VERSION}")
if(APPLE)
  set(FLAPRIG_MUJOCO_LIBRARY "${FLAPRIG_MUJOCO_DIR}/libmujoco.${FLAPRIG_MUJOCO_VERSION}.dylib")
endif()
if(NOT EXISTS "${FLAPRIG_MUJOCO_LIBRARY}")
  message(FATAL_ERROR "the mujoco wheel in ${FLAPRIG_MUJOCO_DIR} lacks ${FLAPRIG_MUJOCO_LIBRARY}.")
endif()
add_library(mujoco::mujoco SHARED IMPORTED)
set_target_properties(mujoco::mujoco PROPERTIES
  IMPORTED_LOCATION "${FLAPRIG_MUJOCO_LIBRARY}"
  INTERFACE_INCLUDE_DIRECTORIES "${FLAPRIG_MUJOCO_DIR}/include")
message(STATUS "flaprig: mujoco ${FLAPRIG_MUJOCO_VERSION} in ${FLAPRIG_MUJOCO_DIR}")
