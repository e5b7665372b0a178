# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
#
# rosidl_generate_interfaces() for messages that Python uses. What PyPI has of the original makes C++
# as well, which takes 2.7 times the processor time.

get_filename_component(_amr_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
set(_amr_python "${_amr_prefix}/bin/python")
# -I: a workspace may have a package of the same name.
execute_process(
  COMMAND "${CMAKE_COMMAND}" -E env _ROS_WHEELS_BOOTSTRAP_COMPLETE=1 "${_amr_python}" -I -c
  "import amr_description, os; print(os.path.dirname(amr_description.__file__), end='\\n')
import sys; print('lib/python%d.%d/site-packages' % sys.version_info[:2], end='')"
  OUTPUT_VARIABLE _amr_answer
  RESULT_VARIABLE _amr_result)
if(NOT _amr_result EQUAL 0)
  message(FATAL_ERROR "${_amr_python} does not find amr_description; run scripts/setup")
endif()
string(REPLACE "\n" ";" _amr_answer "${_amr_answer}")
list(GET _amr_answer 0 _amr_folder)
list(GET _amr_answer 1 AMR_PYTHON_INSTALL_DIR)
set(AMR_INTERFACE_BUILD "${_amr_python}" -P "${_amr_folder}/interface_build")

include("${CMAKE_CURRENT_LIST_DIR}/rosidl_generate_interfaces.cmake")
set(rosidl_default_generators_FOUND TRUE)
