# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The executables, and nothing else: ``ros2 run amr_description NAME`` runs ``nodes/NAME``.

Each is one module, or one folder with its parts, and has ``main(args: list[str] | None = None) ->
int``. ``pyproject.toml`` has an entry of it (``entry:nodes.NAME.main``), which
calls ``sys.exit(main())``. What several executables need is in :mod:`amr_description.ros`. Start
reading at ``talker``, then ``ros/runtime.py``.
"""
