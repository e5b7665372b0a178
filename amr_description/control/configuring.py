# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The configuration of a controller, which may take its time on another thread."""

from contextlib import ExitStack
from typing import Any

from amr_description.control.interfaces import LifecycleState
from amr_description.control.loaded_controller import LoadedController
from amr_description.errors import ControllerError


class Configuring:
    """
    The configuration of one controller, under way.

    The owner begins it and finishes it (:class:`ControllerManager`); in between any one thread
    calls :meth:`run`, once, while the loop goes on: a long configure stops no robot.
    """

    def __init__(self, loaded: LoadedController) -> None:
        self.loaded = loaded
        self.failure: Exception | None = ControllerError('it was not configured')
        self.transition = ExitStack()
        """Open from the begin to the finish."""
        self.transition.enter_context(loaded.transition(LifecycleState.INACTIVE))

    def run(self, parameters: Any) -> None:
        """
        Call the controller's ``configure``; what it raises is kept for the finish.

        A controller that is being configured is touched by nobody else.
        """
        try:
            self.loaded.controller.configure(parameters)
        except Exception as error:  # a foreign controller may raise anything
            self.failure = error
        else:
            self.failure = None
