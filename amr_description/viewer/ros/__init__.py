# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The backend of the page's server for the robots of a ROS graph, or of a bag.

======================  ========================================================================
``backend.py``          :class:`GraphBackend`: what pages ask, and what they are sent
``threads.py``          what the server's thread may use of the graph, as types
``ros_side.py``         what it has done on the ROS thread, and is told from there
``graph_monitor.py``    watches the graph, and connects to its robots and simulators
``robot.py``            the connection to one robot: description, commands; a simulator's world
``stopping.py``         holds a robot at rest: its lock, zeros for the commands of others
``command_topic.py``    the command in force, and how often others command
``pushing.py``          pushes the robots of a simulator
``joint_commands.py``   joints that pages move by controllers
``action_goals.py``     goals of actions: sent, followed to their end, cancelled
``goals.py``            goals and initial poses that pages give, by topics and the action
``entity_topics.py``    with what simulators have spawned their entities
``spawned_robots.py``   description and transforms of robots that nobody else describes
``setting_up.py``       the controllers of robots that pages have spawned
``robot_topics.py``     what moves: transforms, joints, odometry, commands, wheels
``states.py``           … assembled into the binary states
``topic_feeds.py``      the topics that pages show, subscribed while they do
``sensors.py``          … of sensors
``navigation_samples.py`` … maps and paths as samples
``sensor_samples.py``   … converted for the page
``marks.py``            … what markers, poses, polygons and points draw
``marker_store.py``     … those of markers, as messages add and delete them
``marker_feed.py``      the markers of a topic: what all messages have drawn
``source.py``           what publishes on a topic, and a subscription that hears all of it
``newest_feed.py``      a topic of which pages are shown the newest message
``message_feed.py``     … of any type: the latest message, whole
``field_feed.py``       … some numbers of each message, for plots
``topic_rate.py``       how many messages a second come
``introspection.py``    the graph itself, while a page shows it:
``topic_list.py``       … nodes, topics and rates, services
``transform_list.py``   … the TF tree with rates and ages
``log_lines.py``        … /rosout; its last warnings are kept
``health.py``           … the findings of the doctor
``forms.py``            what forms of messages have: fields, defaults, constants
``publications.py``     … what pages publish by them
``calls.py``            … services that they call, goals that they send
``parameters.py``       parameters of any node, listed and set
``markers.py``          MarkerArray and /diagnostics, converted for the page
``service_clients.py``  services of simulators and controller managers
``world_change.py``     another world around the robots that are there
``page_recorder.py``    what is recorded at a page's wish
``bag_backend.py``      :class:`BagBackend`: a bag in place of the graph, without any node
``recorded.py``         … what it says of robots, and where everything was when
``bag_samples.py``      … its messages as samples, and numbers of all of them
======================  ========================================================================

Subscriptions, publishers and clients are created and destroyed on the ROS thread, and used on the
server's thread as far as ``threads.py`` lets it.
"""
