# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Sources of the empty node and the empty library of a package in C++."""

NODE = """\
#include <cstdio>

int main(int argc, char ** argv)
{{
  (void) argc;
  (void) argv;

  printf("hello world {name} package\\n");
  return 0;
}}
"""
HEADER = """\
#ifndef {NAME}__{LIBRARY}_HPP_
#define {NAME}__{LIBRARY}_HPP_

#include "{name}/visibility_control.h"

namespace {name}
{{

class {class_name}
{{
public:
  {class_name}();

  virtual ~{class_name}();
}};

}}  // namespace {name}

#endif  // {NAME}__{LIBRARY}_HPP_
"""
LIBRARY = """\
#include "{name}/{library}.hpp"

namespace {name}
{{

{class_name}::{class_name}()
{{
}}

{class_name}::~{class_name}()
{{
}}

}}  // namespace {name}
"""
VISIBILITY = """\
#ifndef {NAME}__VISIBILITY_CONTROL_H_
#define {NAME}__VISIBILITY_CONTROL_H_

// {NAME}_PUBLIC: seen by what links to the library. {NAME}_LOCAL: only inside of it.
#if defined _WIN32 || defined __CYGWIN__
  #ifdef {NAME}_BUILDING_LIBRARY
    #define {NAME}_PUBLIC __declspec(dllexport)
  #else
    #define {NAME}_PUBLIC __declspec(dllimport)
  #endif
  #define {NAME}_LOCAL
#else
  #define {NAME}_PUBLIC __attribute__ ((visibility("default")))
  #define {NAME}_LOCAL __attribute__ ((visibility("hidden")))
#endif
#define {NAME}_PUBLIC_TYPE {NAME}_PUBLIC

#endif  // {NAME}__VISIBILITY_CONTROL_H_
"""


def class_name(library: str) -> str:
    """Return the name of the class of a library: ``my_library`` -> ``MyLibrary``."""
    return ''.join(library.replace('_', ' ').title().split())
