# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is wrong with a machine, its environment and a ROS graph, and what mends it.

Observations are plain data. A rule is a function from them to findings; it stays silent where it
is not sure, as a healthy stack has none. Whoever collects (``host/``, ``ros/``) reads, subscribes
and asks, and changes nothing; rules never do.

===================  =============================================================================
``findings.py``      severity, what was seen, why it matters, what mends it
``observations/``    what was seen, a module for each section
``rules/``           a module for each family of rules
``table.py``         all rules in their order, and how they are applied
``report.py``        findings as text and as JSON
``host/``            reads this machine: processes, memory, network, environment; no ROS
``ros/``             asks and listens to the ROS graph
===================  =============================================================================
"""
