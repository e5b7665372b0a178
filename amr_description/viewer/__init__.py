# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The browser page's server; knows no ROS, and is the only package that imports websockets.

=============  ================================================================================
``server``     :class:`Server`: one port for the page and its WebSocket; the one to start from
``backend``    what the server asks of whoever knows the robots: :class:`Backend`
``protocol``   what pages are told; with ``requests`` and ``states`` it mirrors
               ``web/src/protocol.ts``
``requests``   what pages tell, read with distrust
``states``     the binary frames
``pages``      the pages that are connected, and what a slow one is spared
``web``        plain HTTP: the files of the page, meshes, headers
``files``      … found by name in one folder
``access``     who may talk to the server
``driving``    who drives, and until when
``client``     a page without a browser, for measurements and tests
=============  ================================================================================

``static/`` is the built page; its sources are in ``web/`` at the top.
"""
