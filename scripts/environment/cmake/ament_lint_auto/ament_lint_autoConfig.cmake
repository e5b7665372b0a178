# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
#
# ament_lint_auto as far as PyPI goes: the CMakeLists.txt that `ros2 pkg create` writes asks for it
# where BUILD_TESTING is on, which is the default.

# Find the test dependencies of package.xml. PyPI has the linters of Python only, which packages of
# Python call by themselves: what is not found is named, and is no error.
macro(ament_lint_auto_find_test_dependencies)
  set(_amr_lint_missing "")
  if(NOT _AMENT_PACKAGE_NAME)
    ament_package_xml()
  endif()
  foreach(_amr_lint_package ${${PROJECT_NAME}_TEST_DEPENDS})
    find_package(${_amr_lint_package} QUIET)
    if(NOT ${_amr_lint_package}_FOUND)
      list(APPEND _amr_lint_missing ${_amr_lint_package})
    endif()
  endforeach()
  if(_amr_lint_missing)
    list(JOIN _amr_lint_missing ", " _amr_lint_missing)
    message(STATUS "Not here, and so not tested with: ${_amr_lint_missing}")
  endif()
endmacro()

set(ament_lint_auto_FOUND TRUE)
