# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The server of the browser page, without ROS; the only package that imports websockets.

==================== ==============================================================================
``server.py``       :class:`Server`: one port for the page and its WebSocket; start reading here
``backend.py``      :class:`Backend`: what the server needs to know about the robots; its
                    :class:`Handlers`: from a request of a page to its code
``pages.py``        the connected pages, and what each is sent
``sessions.py``     what becomes of their messages
``drive_lock.py``   which page drives which robot, and until when
``stop_latch.py``   which robots STOP holds, and whether they stand still
``emergency_stops.py`` … held by the backend, until they are released
``pushes.py``       which page pushes which link, and until when
``protocol.py``     messages to pages; ``web/src/protocol.ts`` is written from them
``encoding.py``     … as text frames
``introspection.py`` … about the ROS graph itself
``forms.py``        … about services that are called, goals that are sent
``marks.py``        … about what is drawn
``navigation.py``   … about who navigates, and the goals of pages
``bags.py``         … about a bag that is shown, and one that is recorded
``requests.py``     messages from pages, validated
``states.py``       the binary frames: everything that moves
``real_time.py``    how fast simulated time goes
``samples.py``      … and what came by a topic
``tracks.py``       what was when, in a recording
``pictures.py``     pictures of cameras, made small
``clouds.py``       point clouds, thinned
``http.py``         plain HTTP: the files of the page, meshes, security headers
``access.py``       which requests are answered: Host, Origin, token
``graph.py``        names and types of a ROS graph -> robots and simulators
``entities.py``     which entity of a world a robot is
``description.py``   a robot description for the page: joints, meshes, findings
``joint_groups.py`` the joints that controllers let a page move, and to where
``client.py``       a page without a browser, for measurements and tests
``ros/``            the backend for the ROS graph
==================== ==============================================================================

The built page is in ``static/``; its sources are in ``web/`` at the top.
"""
