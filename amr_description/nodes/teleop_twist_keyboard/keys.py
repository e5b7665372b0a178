# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the keys of ``teleop_twist_keyboard`` mean, and how long a command holds.

This module imports no rclpy and knows no terminal and no clock: keys and times (s) come in.
"""

from dataclasses import dataclass

HELP = """
This node takes keypresses from the keyboard and publishes them
as Twist/TwistStamped messages. It works best with a US keyboard layout.
---------------------------
Moving around:
   u    i    o
   j    k    l
   m    ,    .

For Holonomic mode (strafing), hold down the shift key:
---------------------------
   U    I    O
   J    K    L
   M    <    >

t : up (+z)
b : down (-z)

anything else : stop

q/z : increase/decrease max speeds by 10%
w/x : increase/decrease only linear speed by 10%
e/c : increase/decrease only angular speed by 10%

CTRL-C to quit
"""

# Direction along x, y, z (forward, left, up) and about z (counter-clockwise), each -1, 0 or 1.
MOVES: dict[str, tuple[int, int, int, int]] = {
    'i': (1, 0, 0, 0),
    'o': (1, 0, 0, -1),
    'j': (0, 0, 0, 1),
    'l': (0, 0, 0, -1),
    'u': (1, 0, 0, 1),
    ',': (-1, 0, 0, 0),
    '.': (-1, 0, 0, 1),
    'm': (-1, 0, 0, -1),
    'O': (1, -1, 0, 0),
    'I': (1, 0, 0, 0),
    'J': (0, 1, 0, 0),
    'L': (0, -1, 0, 0),
    'U': (1, 1, 0, 0),
    '<': (-1, 0, 0, 0),
    '>': (-1, -1, 0, 0),
    'M': (-1, 1, 0, 0),
    't': (0, 0, 1, 0),
    'b': (0, 0, -1, 0),
}

# Factors on the linear and the angular speed.
SPEEDS: dict[str, tuple[float, float]] = {
    'q': (1.1, 1.1),
    'z': (0.9, 0.9),
    'w': (1.1, 1.0),
    'x': (0.9, 1.0),
    'e': (1.0, 1.1),
    'c': (1.0, 0.9),
}

_AT_REST = (0, 0, 0, 0)
_HELP_EVERY = 15  # speed keys

# Auto-repeat comes at 10 Hz or faster (usually 25 to 33 Hz), a finger is slower than this, s.
_REPEAT_GAP = 0.15
# How long a command holds after the last auto-repeat, s: long enough for a hiccup of ssh.
_RELEASE_TIMEOUT = 0.25


@dataclass(frozen=True, slots=True)
class Velocity:
    """Along x, y, z (m/s) and about z (rad/s) of the robot's base."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    yaw: float = 0.0


class Teleop:
    """
    The state that keys change: speeds and direction.

    :param speed: Linear speed of a full move, m/s.
    :param turn: Angular speed of a full turn, rad/s.
    """

    def __init__(self, speed: float, turn: float) -> None:
        self.speed = speed
        self.turn = turn
        self._direction = _AT_REST
        self._speed_keys = 0

    def press(self, key: str) -> str:
        """Take one key; return what to print, '' for nothing."""
        if key not in SPEEDS:
            self._direction = MOVES.get(key, _AT_REST)
            return ''
        linear, angular = SPEEDS[key]
        self.speed *= linear
        self.turn *= angular
        self._speed_keys += 1
        repeat_help = self._speed_keys % _HELP_EVERY == 0
        return f'{self.speeds}\n{HELP}' if repeat_help else self.speeds

    def stop(self) -> None:
        """Forget the direction, as any key without a meaning does."""
        self._direction = _AT_REST

    @property
    def is_moving(self) -> bool:
        """Whether the last key asks for a move."""
        return self._direction != _AT_REST

    @property
    def speeds(self) -> str:
        """The line that tells the speeds."""
        return f'currently:\tspeed {self.speed}\tturn {self.turn} '

    @property
    def velocity(self) -> Velocity:
        """The command of the keys pressed so far."""
        x, y, z, yaw = self._direction
        return Velocity(x * self.speed, y * self.speed, z * self.speed, yaw * self.turn)


class Hold:
    """
    When to repeat a command, and when the key has been let go.

    An ordinary terminal tells no release of a key. A key that is held down comes once, after 0.25
    to 0.66 s again, and then 10 to 33 times a second. So a command holds for ``key_timeout`` after
    a press, long enough to reach the first repetition; and for 0.25 s once the key repeats. The
    times hold as well where releases are told: a terminal that loses the focus, or the network,
    tells none.

    :param period: Time between two repetitions of the command, s; 0: it is not repeated.
    :param key_timeout: How long a single press holds, s; 0: until the next key.
    """

    def __init__(self, period: float, key_timeout: float) -> None:
        self._period = period
        self._key_timeout = key_timeout
        self._key = self._driving = ''
        self._pressed = 0.0
        self._repeat_at: float | None = None
        self._release_at: float | None = None

    def press(self, key: str, now: float, *, moving: bool, name: str = '') -> None:
        """
        Take the time of a key press; ``moving`` as the command is after it.

        ``name``: what the release of this key will be told with.
        """
        if key not in SPEEDS:
            self._driving = name
        repeats = key == self._key and now - self._pressed < _REPEAT_GAP
        timeout = min(_RELEASE_TIMEOUT, self._key_timeout) if repeats else self._key_timeout
        self._key, self._pressed = key, now
        self._repeat_at = now + self._period if moving and self._period else None
        self._release_at = now + timeout if moving and self._key_timeout else None

    def release(self, name: str) -> bool:
        """Take the release of a key; tell whether it is the one that drives."""
        if self._release_at is None or name != self._driving:
            return False
        self._repeat_at = self._release_at = None
        return True

    def wait(self, now: float) -> float | None:
        """Return how long (s) nothing is to be done unless a key comes; None: for ever."""
        times = [time for time in (self._repeat_at, self._release_at) if time is not None]
        return max(0.0, min(times) - now) if times else None

    def is_released(self, now: float) -> bool:
        """Tell, once, that the key has been let go."""
        if self._release_at is None or now < self._release_at:
            return False
        self._repeat_at = self._release_at = None
        return True

    def is_repeat_due(self, now: float) -> bool:
        """Tell that the command is to be sent again, once a period."""
        if self._repeat_at is None or now < self._repeat_at:
            return False
        self._repeat_at = now + self._period
        return True
