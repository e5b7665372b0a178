# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
#
# ament_cmake_auto as far as packages of descriptions, launch files and plain libraries use it.

find_package(ament_cmake REQUIRED)

# ament_auto_find_build_dependencies([REQUIRED name ...]): find what package.xml says is needed to
# build. As in the original, only those that are named have to be there.
macro(ament_auto_find_build_dependencies)
  cmake_parse_arguments(_ARG_AUTO "" "" "REQUIRED" ${ARGN})
  if(NOT _AMENT_PACKAGE_NAME)
    ament_package_xml()
  endif()
  foreach(_amr_auto_name
      ${${PROJECT_NAME}_BUILD_DEPENDS} ${${PROJECT_NAME}_BUILDTOOL_DEPENDS} ${_ARG_AUTO_REQUIRED})
    if(NOT ${_amr_auto_name}_FOUND)
      if(_amr_auto_name IN_LIST _ARG_AUTO_REQUIRED)
        find_package(${_amr_auto_name} REQUIRED)
      else()
        find_package(${_amr_auto_name} QUIET)
      endif()
    endif()
    if(${_amr_auto_name}_FOUND AND NOT _amr_auto_name MATCHES "^ament_cmake")
      list(APPEND ${PROJECT_NAME}_FOUND_BUILD_DEPENDS ${_amr_auto_name})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES ${PROJECT_NAME}_FOUND_BUILD_DEPENDS)
endmacro()

# Headers and libraries of this package and of what was found, for one of its targets.
function(_amr_auto_link target)
  if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/include")
    target_include_directories(${target} PUBLIC
      "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>" "$<INSTALL_INTERFACE:include>")
  endif()
  if(NOT "${${PROJECT_NAME}_LIBRARIES}" STREQUAL "")
    target_link_libraries(${target} ${${PROJECT_NAME}_LIBRARIES})
  endif()
  if(NOT "${${PROJECT_NAME}_FOUND_BUILD_DEPENDS}" STREQUAL "")
    ament_target_dependencies(${target} ${${PROJECT_NAME}_FOUND_BUILD_DEPENDS})
  endif()
endfunction()

# The sources of a target: those that are named, and those of each DIRECTORY.
macro(_amr_auto_sources)
  cmake_parse_arguments(_ARG_AUTO "" "DIRECTORY" "" ${ARGN})
  set(_amr_auto_files ${_ARG_AUTO_UNPARSED_ARGUMENTS})
  if(_ARG_AUTO_DIRECTORY)
    file(GLOB _amr_auto_found RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" CONFIGURE_DEPENDS
      "${_ARG_AUTO_DIRECTORY}/*.c" "${_ARG_AUTO_DIRECTORY}/*.cc"
      "${_ARG_AUTO_DIRECTORY}/*.cpp" "${_ARG_AUTO_DIRECTORY}/*.cxx")
    list(APPEND _amr_auto_files ${_amr_auto_found})
  endif()
endmacro()

macro(ament_auto_add_library target)
  _amr_auto_sources(${ARGN})
  add_library(${target} ${_amr_auto_files})
  _amr_auto_link(${target})
  list(APPEND ${PROJECT_NAME}_LIBRARIES ${target})
endmacro()

macro(ament_auto_add_executable target)
  _amr_auto_sources(${ARGN})
  add_executable(${target} ${_amr_auto_files})
  _amr_auto_link(${target})
  list(APPEND ${PROJECT_NAME}_EXECUTABLES ${target})
endmacro()

# ament_auto_package([INSTALL_TO_PATH] [INSTALL_TO_SHARE folder ...] [arguments of ament_package]):
# install all of it, and end.
macro(ament_auto_package)
  cmake_parse_arguments(_ARG_AUTO "INSTALL_TO_PATH" "" "INSTALL_TO_SHARE" ${ARGN})
  ament_export_dependencies(${${PROJECT_NAME}_FOUND_BUILD_DEPENDS})
  if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/include")
    install(DIRECTORY include/ DESTINATION include)
    ament_export_include_directories(include)
  endif()
  if(NOT "${${PROJECT_NAME}_LIBRARIES}" STREQUAL "")
    install(TARGETS ${${PROJECT_NAME}_LIBRARIES}
      ARCHIVE DESTINATION lib LIBRARY DESTINATION lib RUNTIME DESTINATION bin)
    ament_export_libraries(${${PROJECT_NAME}_LIBRARIES})
  endif()
  if(NOT "${${PROJECT_NAME}_EXECUTABLES}" STREQUAL "")
    if(_ARG_AUTO_INSTALL_TO_PATH)
      install(TARGETS ${${PROJECT_NAME}_EXECUTABLES} DESTINATION bin)
    else()
      install(TARGETS ${${PROJECT_NAME}_EXECUTABLES} DESTINATION lib/${PROJECT_NAME})
    endif()
  endif()
  foreach(_amr_auto_folder ${_ARG_AUTO_INSTALL_TO_SHARE})
    install(DIRECTORY "${_amr_auto_folder}" DESTINATION share/${PROJECT_NAME})
  endforeach()
  ament_package(${_ARG_AUTO_UNPARSED_ARGUMENTS})
endmacro()

set(ament_cmake_auto_FOUND TRUE)
