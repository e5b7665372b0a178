# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
#
# rosidl_generate_interfaces() for packages that Python uses: the interfaces are built by
# cmake_target.py, which is named by the list AMR_INTERFACE_BUILD.

find_package(ament_cmake REQUIRED)
find_package(ament_cmake_python REQUIRED)
# The one that wheels of messages come with: found later, it would take the place of this one.
find_package(rosidl_cmake QUIET)

macro(rosidl_generate_interfaces target)
  cmake_parse_arguments(_amr
    "ADD_LINTER_TESTS;SKIP_INSTALL;SKIP_GROUP_MEMBERSHIP_CHECK" "LIBRARY_NAME" "DEPENDENCIES"
    ${ARGN})
  if(NOT _amr_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rosidl_generate_interfaces() called without any interface files")
  endif()
  if(_${PROJECT_NAME}_AMENT_PACKAGE)
    message(FATAL_ERROR "rosidl_generate_interfaces() must be called before ament_package()")
  endif()
  if(NOT _AMENT_PACKAGE_NAME)
    ament_package_xml()
  endif()
  if(NOT _amr_SKIP_GROUP_MEMBERSHIP_CHECK AND NOT _amr_SKIP_INSTALL
      AND NOT "rosidl_interface_packages" IN_LIST ${_AMENT_PACKAGE_NAME}_MEMBER_OF_GROUPS)
    message(FATAL_ERROR "Packages installing interfaces must include "
      "'<member_of_group>rosidl_interface_packages</member_of_group>' in their package.xml")
  endif()

  set(_amr_build "${CMAKE_CURRENT_BINARY_DIR}/rosidl_generate_interfaces/${target}")
  set(_amr_request "name=${PROJECT_NAME}\nsource=${CMAKE_CURRENT_SOURCE_DIR}\n")
  string(APPEND _amr_request "build=${_amr_build}\ninstall=${CMAKE_INSTALL_PREFIX}\n")
  set(_amr_index "")
  foreach(_amr_file ${_amr_UNPARSED_ARGUMENTS})
    if(IS_ABSOLUTE "${_amr_file}" AND NOT "${_amr_file}" MATCHES ":")
      message(FATAL_ERROR "rosidl_generate_interfaces() the passed absolute file '${_amr_file}' "
        "must be represented as an absolute base path separated by a colon from the relative path "
        "to the interface file")
    endif()
    string(REGEX REPLACE ":([^:]*)$" "/\\1" _amr_path "${_amr_file}")
    get_filename_component(_amr_path "${_amr_path}" ABSOLUTE)
    if(NOT EXISTS "${_amr_path}")
      message(FATAL_ERROR "rosidl_generate_interfaces() the passed file '${_amr_file}' doesn't "
        "exist relative to the CMAKE_CURRENT_SOURCE_DIR '${CMAKE_CURRENT_SOURCE_DIR}'")
    endif()
    string(APPEND _amr_request "interface=${_amr_file}\n")
    string(REGEX REPLACE "^.*:" "" _amr_path "${_amr_file}")
    string(REGEX REPLACE "[.][a-z]+$" ".idl" _amr_idl "${_amr_path}")
    list(APPEND _amr_index "${_amr_path}" "${_amr_idl}")
  endforeach()
  foreach(_amr_name ${_amr_DEPENDENCIES})
    if(NOT ${_amr_name}_FOUND)
      message(FATAL_ERROR "rosidl_generate_interfaces() the passed dependency '${_amr_name}' has "
        "not been found before using find_package()")
    endif()
    string(APPEND _amr_request "dependency=${_amr_name}\n")
  endforeach()
  file(WRITE "${_amr_build}/request" "${_amr_request}")

  add_custom_target(${target} ALL
    COMMAND "${CMAKE_COMMAND}" -E env _ROS_WHEELS_BOOTSTRAP_COMPLETE=1
    ${AMR_INTERFACE_BUILD} "${_amr_build}/request"
    COMMENT "Building the interfaces of ${PROJECT_NAME}"
    VERBATIM)

  if(NOT _amr_SKIP_INSTALL)
    list(REMOVE_DUPLICATES _amr_index)
    list(SORT _amr_index)
    string(REPLACE ";" "\n" _amr_index "${_amr_index}")
    ament_index_register_resource("rosidl_interfaces" CONTENT "${_amr_index}")
    ament_export_dependencies(${_amr_DEPENDENCIES})
    set(PYTHON_INSTALL_DIR "${AMR_PYTHON_INSTALL_DIR}")
    # That of ament_cmake_python, which registers once: ament_python_install_package() may be called
    # too, and for a package of this name.
    _ament_cmake_python_register_environment_hook()
    ament_environment_hooks("${ament_cmake_package_templates_ENVIRONMENT_HOOK_LIBRARY_PATH}")
    foreach(_amr_folder lib include share/${PROJECT_NAME})
      install(DIRECTORY "${_amr_build}/stage/${_amr_folder}/" DESTINATION "${_amr_folder}"
        PATTERN "package.xml" EXCLUDE PATTERN "cmake" EXCLUDE)
    endforeach()
    install(DIRECTORY "${_amr_build}/stage/python/" DESTINATION "${AMR_PYTHON_INSTALL_DIR}")
  endif()
endmacro()

macro(_amr_no_cpp)
  message(FATAL_ERROR "C++ that uses messages of its own package (${PROJECT_NAME}) is not built "
    "here: this ROS is that of Python; put the messages into a package of their own")
endmacro()

macro(rosidl_get_typesupport_target)
  _amr_no_cpp()
endmacro()

macro(rosidl_target_interfaces)
  _amr_no_cpp()
endmacro()
