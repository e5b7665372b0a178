# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The executables: ROS nodes, and programs that talk to them.

One executable is one module with ``main(args: list[str] | None = None) -> int``; ``setup.py``
makes a ``console_scripts`` entry of it (``entry:nodes.<module>.main``), which calls
``sys.exit(main())``. A module without ``main`` is a part of the executables beside it. Start at
``talker``, then read ``runtime``.
"""
