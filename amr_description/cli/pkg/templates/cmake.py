# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``CMakeLists.txt`` of packages of ``ament_cmake`` and ``cmake``, and what the latter needs."""

from amr_description.cli.pkg.new_package import NewPackage

_HEAD = """\
cmake_minimum_required(VERSION 3.8)
project({name}{version})

if(CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Wall -Wextra -Wpedantic)
endif()
"""
_NO_DEPENDENCIES = """\
# further dependencies are found like this:
# find_package(<dependency> REQUIRED)
"""
_INCLUDE = """\
target_include_directories({target} PUBLIC
  $<BUILD_INTERFACE:${{CMAKE_CURRENT_SOURCE_DIR}}/include>
  $<INSTALL_INTERFACE:include/${{PROJECT_NAME}}>)
"""
_FEATURES = (
    'target_compile_features({target} PUBLIC c_std_99 cxx_std_17)  # Require C99 and C++17\n'
)
_LIBRARY_FILES = """
# exported symbols have another mark while the library itself is built
target_compile_definitions({target} PRIVATE "{NAME}_BUILDING_LIBRARY")

install(
  DIRECTORY include/
  DESTINATION include/${{PROJECT_NAME}}
)
install(
  TARGETS {target}
  EXPORT export_${{PROJECT_NAME}}
  ARCHIVE DESTINATION lib
  LIBRARY DESTINATION lib
  RUNTIME DESTINATION bin
)
"""
_NODE_FILES = """
install(TARGETS {target}
  DESTINATION lib/${{PROJECT_NAME}})
"""
_TESTING = """
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
  # this skips the linter for copyrights: comment it out once all source files have one
  set(ament_cmake_copyright_FOUND TRUE)
  # this skips cpplint, which needs a git repository, and copyrights
  set(ament_cmake_cpplint_FOUND TRUE)
  ament_lint_auto_find_test_dependencies()
endif()
"""
_EXPORTS = """
ament_export_include_directories(
  "include/${{PROJECT_NAME}}"
)
ament_export_libraries(
  {library}
)
ament_export_targets(
  export_${{PROJECT_NAME}}
)
"""
_CONFIGURED = """
include(CMakePackageConfigHelpers)
configure_package_config_file(${PROJECT_NAME}Config.cmake.in
  "${PROJECT_BINARY_DIR}/${PROJECT_NAME}Config.cmake"
  INSTALL_DESTINATION share/${PROJECT_NAME}/cmake)
configure_file(${PROJECT_NAME}ConfigVersion.cmake.in
  "${PROJECT_BINARY_DIR}/${PROJECT_NAME}ConfigVersion.cmake" @ONLY)
install(FILES
  "${PROJECT_BINARY_DIR}/${PROJECT_NAME}Config.cmake"
  "${PROJECT_BINARY_DIR}/${PROJECT_NAME}ConfigVersion.cmake"
  DESTINATION share/${PROJECT_NAME}/cmake)
"""
_EXPORTED = """\
install(EXPORT export_${PROJECT_NAME}
  NAMESPACE ${PROJECT_NAME}::
  DESTINATION share/${PROJECT_NAME}/cmake)
"""
CONFIG_VERSION = """\
set(PACKAGE_VERSION "@PROJECT_VERSION@")

# the version that find_package() asks for
if(PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
else()
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  if(PACKAGE_VERSION VERSION_EQUAL PACKAGE_FIND_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
  endif()
endif()
"""


def ament_cmake_lists(package: NewPackage) -> str:
    """Return ``CMakeLists.txt`` of a package of ``ament_cmake``."""
    found = ['ament_cmake', *(['ament_cmake_ros'] if package.library else [])]
    return ''.join(
        [
            _HEAD.format(name=package.name, version=''),
            '\n# find dependencies\n',
            *(f'find_package({name} REQUIRED)\n' for name in (*found, *package.dependencies)),
            '' if package.dependencies else _NO_DEPENDENCIES,
            _targets(package, is_ament=True),
            _TESTING,
            _EXPORTS.format(library=package.library) if package.library else '',
            '\nament_package()\n',
        ]
    )


def cmake_lists(package: NewPackage) -> str:
    """Return ``CMakeLists.txt`` of a package of plain CMake."""
    found = ''.join(f'find_package({name} REQUIRED)\n' for name in package.dependencies)
    return ''.join(
        [
            _HEAD.format(name=package.name, version=' VERSION 0.0.0'),
            f'\n# find dependencies\n{found}' if found else '',
            _targets(package, is_ament=False),
            _CONFIGURED,
            _EXPORTED if package.library else '',
        ]
    )


def config(package: NewPackage) -> str:
    """Return ``<name>Config.cmake.in`` of a package of plain CMake."""
    name = package.name
    text = f'# find_package({name}) reads this.\n@PACKAGE_INIT@\n'
    if package.library:
        text += f'\ninclude("${{CMAKE_CURRENT_LIST_DIR}}/export_{name}.cmake")\n'
        text += f'set({name}_LIBRARIES {name}::{package.library})\n'
    return text


def _targets(package: NewPackage, is_ament: bool) -> str:
    """Return the rules of the library and the node."""
    library, node = package.library, package.node
    text = ''
    if library:
        kind = '' if is_ament else ' SHARED'
        text += f'\nadd_library({library}{kind} src/{library}.cpp)\n'
        text += f'add_library({package.name}::{library} ALIAS {library})\n'
        text += (_FEATURES + _INCLUDE).format(target=library)
        text += _linked(library, package.dependencies, is_ament)
        text += _LIBRARY_FILES.format(target=library, NAME=package.name.upper())
    if node:
        text += f'\nadd_executable({node} src/{node}.cpp)\n' + _INCLUDE.format(target=node)
        if library:
            text += f'target_link_libraries({node} {library})\n'
        else:
            text += _FEATURES.format(target=node)
            text += _linked(node, package.dependencies, is_ament)
        text += _NODE_FILES.format(target=node)
    return text


def _linked(target: str, dependencies: tuple[str, ...], is_ament: bool) -> str:
    """Return the rule that links a target to what the package depends on."""
    if not dependencies:
        return ''
    if is_ament:
        names = ''.join(f'  "{name}"\n' for name in dependencies)
        return f'ament_target_dependencies(\n  {target}\n{names})\n'
    return ''.join(
        f'target_link_libraries({target} ${{{name}_LIBRARIES}})\n' for name in dependencies
    )
