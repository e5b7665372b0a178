# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The meaning of the keys of ``teleop_twist_keyboard``, and how long a command holds.

Pure: keys and times (s) are arguments.
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

# s; auto-repeat has 10 Hz or more (usually 25 to 33 Hz), a finger is slower than this.
_REPEAT_GAP = 0.15
# s that a command holds after the last auto-repeat; tolerates the jitter of ssh.
_RELEASE_TIMEOUT = 0.25


@dataclass(frozen=True, slots=True)
class Velocity:
    """Velocity along x, y, z (m/s) and about z (rad/s) of the robot's base."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    yaw: float = 0.0


class Teleop:
    """
    What keys change: speeds and direction.

    Args:
        speed: linear speed, m/s.
        turn: angular speed, rad/s.
    """

    def __init__(self, speed: float, turn: float) -> None:
        self.speed = speed
        self.turn = turn
        self._direction = _AT_REST
        self._speed_keys = 0

    def press(self, key: str) -> str:
        """Handle a key; return the text to print, or ''."""
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
        """Reset the direction, as any unassigned key does."""
        self._direction = _AT_REST

    @property
    def is_moving(self) -> bool:
        """Whether the last key was one that moves the robot."""
        return self._direction != _AT_REST

    @property
    def speeds(self) -> str:
        """The line with the speeds."""
        return f'currently:\tspeed {self.speed}\tturn {self.turn} '

    @property
    def velocity(self) -> Velocity:
        """The command that results from the keys so far."""
        x, y, z, yaw = self._direction
        return Velocity(x * self.speed, y * self.speed, z * self.speed, yaw * self.turn)


class KeyHold:
    """
    Decides when to repeat a command, and when its key has been released.

    An ordinary terminal does not report releases. A held key comes once, again after 0.25 to
    0.66 s, and then 10 to 33 times per second. So a command holds for ``key_timeout`` after a
    press, long enough for the first repetition, and for 0.25 s once the key repeats. The same
    limits apply if releases are reported: they get lost when the terminal loses the focus, or the
    network its connection.

    Args:
        period: time between two repetitions of the command, s; 0: it is not repeated.
        key_timeout: how long a single press holds, s; 0: until the next key.
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
        Note a key press.

        Args:
            key: that was pressed.
            now: time, s.
            moving: whether the command moves the robot now.
            name: of the key, as its release will be reported.
        """
        if key not in SPEEDS:
            self._driving = name
        repeats = key == self._key and now - self._pressed < _REPEAT_GAP
        timeout = min(_RELEASE_TIMEOUT, self._key_timeout) if repeats else self._key_timeout
        self._key, self._pressed = key, now
        self._repeat_at = now + self._period if moving and self._period else None
        self._release_at = now + timeout if moving and self._key_timeout else None

    def release(self, name: str) -> bool:
        """Note the release of a key; return whether it is the key that moves the robot."""
        if self._release_at is None or name != self._driving:
            return False
        self._repeat_at = self._release_at = None
        return True

    def wait(self, now: float) -> float | None:
        """Return the time until a repetition or release is due, s; None: only a key is awaited."""
        times = [time for time in (self._repeat_at, self._release_at) if time is not None]
        return max(0.0, min(times) - now) if times else None

    def is_released(self, now: float) -> bool:
        """Return whether the key counts as released; True only once."""
        if self._release_at is None or now < self._release_at:
            return False
        self._repeat_at = self._release_at = None
        return True

    def is_repeat_due(self, now: float) -> bool:
        """Return whether the command is to be repeated; True once per period."""
        if self._repeat_at is None or now < self._repeat_at:
            return False
        self._repeat_at = now + self._period
        return True
