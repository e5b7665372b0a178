# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Bags: recordings of topics as rosbag2 writes them, in MCAP files. No ROS here: bytes and times.

Messages are read and written as they are on the wire, never decoded. Times are integer
nanoseconds.

====================== ============================================================================
``storage.py``         a topic and a message of a bag
``folder_names.py``    the name of a bag that was given none
``qos_text.py``        QoS profiles as YAML, as it is in bags and in files of overrides
``metadata.py``        ``metadata.yaml``
``yaml_text.py``       YAML of bags, also what nobody can have meant
``schemas.py``         the text of a message type with all that it contains, for those who read it
``type_hashes.py``     the hashes of message types
``mcap_writer.py``     ``BagWriter``: a folder of MCAP files
``mcap_options.py``    how they are written: presets, and files of options
``reader.py``          ``BagReader``: messages in the order of their times, from whatever is there
``mcap_file.py``       an MCAP file, also one that was cut off
``sqlite_file.py``     a file of the older storage of rosbag2, to read
``compression.py``     files and messages that rosbag2 has compressed
``run_description.py`` of what a run of the simulator consists that was recorded
``info_text.py``       what ``ros2 bag info`` prints
``topic_filter.py``    which topics are recorded
``topic_selection.py`` which topics are meant by the flags of a command line
``recording.py``       several bags as one recording, and what was latched at a time of it
``rewriting.py``       new bags of the messages of others
``playback.py``        when each message is due; ``Playback``
``playback_clock.py``  the time of a recording while it is played
``ros/``               what records and what plays, as ROS nodes
====================== ============================================================================
"""
