# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A third party's controller with a service and an action, which name their converters.

The service doubles the switch: it says whether it is up. A goal counts updates to a number.
"""

from dataclasses import dataclass

from amr_description.control.contracts import Action, ActionPort, Controller, Service, ServicePort

HERE = __name__


def read_switch(message):
    return message.data


def fill_switch(sample, message):
    message.success, message.message = sample


def read_count(message):
    return message.command.position


def fill_count(sample, message):
    message.position = float(sample)


@dataclass(frozen=True)
class Nothing:
    """No parameters."""


class Counter(Controller):
    """Counts updates for each goal; the last one counts."""

    parameters_type = Nothing
    newest = None

    def configure(self, parameters):
        Counter.newest = self
        self.goal = None
        self.count = 0
        self.service = Service(
            ServicePort(
                '~/switch', 'std_srvs/srv/SetBool', f'{HERE}:read_switch', f'{HERE}:fill_switch'
            ),
            self.answer,
        )
        self.action = Action(
            ActionPort(
                '~/count',
                'control_msgs/action/GripperCommand',
                f'{HERE}:read_count',
                f'{HERE}:fill_count',
                f'{HERE}:fill_count',
                rate=100.0,
            ),
            lambda request, time: '' if request >= 0 else f'cannot count to {request:g}',
        )

    def services(self):
        return (self.service,)

    def actions(self):
        return (self.action,)

    def answer(self, request):
        if not request:
            raise ValueError('no switching off')
        return True, f'at {self.count}'

    def activate(self, commands, states, time):
        self.goal = None

    def update(self, time, period):
        for goal in self.action.drain():
            if self.goal is not None:
                self.goal.cancel(-1.0)
            self.goal, self.count = goal, 0
        if self.goal is None:
            return
        self.count += 1
        self.goal.send_feedback(self.count)
        if self.goal.is_cancel_requested:
            self.goal.cancel(self.count)
        elif self.count >= self.goal.request:
            self.goal.succeed(self.count)
        if not self.goal.is_live:
            self.goal = None
