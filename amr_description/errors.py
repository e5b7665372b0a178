# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Every error that this package raises on purpose.

::

    AmrError
    ├── DescriptionError     a URDF, or one of its <ros2_control> blocks, cannot be used
    │   └── MeshError        a mesh file that it names cannot be used
    ├── ParameterError       a parameter, or a parameter file, cannot be used
    ├── CallbackError        callbacks of a node raise again and again: it is broken
    ├── LimitError           a program has taken more time than it may
    ├── ResourceError        a package, its executable, or the file of a URI is not found
    ├── ControlError         ros2_control refuses or fails
    │   ├── InterfaceError   an interface is unknown, unavailable or claimed
    │   ├── ControllerError  a controller is unknown, in the wrong state, or failed
    │   └── HardwareError    a hardware component failed
    │       ├── HardwareDeactivationError  its write() asks for deactivation
    │       └── HardwareStartError  it did not reach its initial state, which is required
    ├── NoAnswerError        a service did not answer in time
    ├── SimulationError      the simulated world cannot do what was asked
    │   └── RequestError     a request to the simulator is refused; carries its result code
    │       └── SpawnError   an entity cannot be spawned
    ├── TransformException   a transform cannot be looked up; the names are tf2's
    │   ├── LookupException         a frame is unknown, or its tree has a loop
    │   ├── ConnectivityException   the frames are in different trees
    │   ├── ExtrapolationException  the transform is not known at that time
    │   └── InvalidArgumentException  a name or a transform cannot be used
    ├── MessageFilterError   a message filter cannot do what was asked; an AssertionError, too
    ├── PointCloudError      points, fields and cloud do not fit; an AssertionError, too
    ├── MapError             a map cannot be read, written or made
    │   ├── MapMetadataError   … its .yaml file
    │   └── MapDataError       … its image
    ├── NavigationError      a goal cannot be planned, or not be driven to; has Nav2's error code
    ├── TrialsError          trials cannot be run as they are asked for
    ├── CalibrationError     the measured drive does not determine the parameters
    ├── InterfaceBuildError  an interface package cannot be built
    │   └── CompilerError    … because there is no C and C++ compiler that works (exit code 3)
    ├── BagError             a recording cannot be read, written or made
    ├── ViewerError          the browser page's server cannot do what was asked
    │   ├── PartlyDoneError  a request of a page was done in part; carries what tries the rest
    │   └── ProtocolError    a message of a page is malformed
    ├── BringupError         a stack is malformed, or one of its steps failed
    └── UsageError           a command line cannot be understood (exit code 2, as argparse)

The text of an error is one line that says what was asked, what was found and how to fix it. A
program that ends because of an error prints that line, without a traceback, and exits with
``exit_code``.
"""

from collections.abc import Mapping


class AmrError(Exception):
    """Base of all errors raised on purpose; ``str(error)`` is one line for the user."""

    exit_code = 1
    is_located = False
    """Whether the text ends with the place in the user's code."""


class DescriptionError(AmrError):
    """The robot description (URDF) cannot be used."""


class MeshError(DescriptionError):
    """A mesh file cannot be used."""


class ParameterError(AmrError):
    """A parameter or a parameter file cannot be used."""


class CallbackError(AmrError):
    """Callbacks of a node raise again and again: it is broken."""


class LimitError(AmrError):
    """A program has taken more time than it may."""


class ResourceError(AmrError):
    """A package, an executable of it, or the file that a URI names is not found."""


class ControlError(AmrError):
    """ros2_control refuses a request, or a part of it failed."""


class InterfaceError(ControlError):
    """A command or state interface is unknown, unavailable or claimed by another controller."""


class ControllerError(ControlError):
    """A controller is unknown, in the wrong state, or failed in a transition or an update."""


class HardwareError(ControlError):
    """A hardware component failed in a transition, a read or a write."""


class HardwareDeactivationError(HardwareError):
    """``write`` of a hardware component asks to be deactivated instead of failing."""


class HardwareStartError(HardwareError):
    """A hardware component did not reach its initial state, which the parameters require."""


class NoAnswerError(AmrError):
    """A service did not answer in time."""


class SimulationError(AmrError):
    """The simulated world cannot do what was asked."""


class RequestError(SimulationError):
    """
    A request to the simulator is refused.

    ``code`` is the ``result`` number of the service of ``simulation_interfaces`` that says why.
    """

    def __init__(self, message: str, code: int) -> None:
        super().__init__(message)
        self.code = code


class SpawnError(RequestError):
    """An entity cannot be spawned; ``code`` as in ``simulation_interfaces/srv/SpawnEntity``."""


class RenderingError(SimulationError):
    """A renderer of camera pictures does not work on this machine."""


class TransformException(AmrError):  # noqa: N818 - these are called so in tf2
    """A transform between two frames cannot be looked up."""


class LookupException(TransformException):
    """A frame is unknown, or the frames above it form a loop."""


class ConnectivityException(TransformException):
    """The two frames are in different trees."""


class ExtrapolationException(TransformException):
    """A transform is known, but not at that time."""


class InvalidArgumentException(TransformException):
    """The name of a frame, or a transform, cannot be used."""


class TimeoutException(TransformException):
    """A transform was not known in time, or who knows it has not answered."""


class TypeException(TransformException):
    """Nothing says how a type is transformed or converted."""


class NotImplementedException(TransformException):
    """A buffer does not have this."""


class MessageFilterError(AmrError, AssertionError):
    """A message filter cannot do what was asked: in message_filters an AssertionError."""


class PointCloudError(AmrError, AssertionError):
    """Points, fields and cloud do not fit together: in sensor_msgs_py an AssertionError."""


class MapError(AmrError):
    """A map cannot be read, written or made."""


class MapMetadataError(MapError):
    """The ``.yaml`` file of a map cannot be used."""


class MapDataError(MapError):
    """The image of a map cannot be used."""


class NavigationError(AmrError):
    """
    A goal cannot be planned, or not be driven to.

    ``error_code`` is that of the action of nav2_msgs that has failed: of ComputePathToPose from
    200, of FollowPath from 100.
    """

    def __init__(self, error_code: int, text: str) -> None:
        super().__init__(text)
        self.error_code = error_code


class TrialsError(AmrError):
    """Trials cannot be run as they are asked for."""


class CalibrationError(AmrError):
    """The measured drive does not determine the parameters."""


class InterfaceBuildError(AmrError):
    """An interface package cannot be built."""


class CompilerError(InterfaceBuildError):
    """There is no C and C++ compiler that works."""

    exit_code = 3


class BagError(AmrError):
    """A recording of topics, or a file that belongs to one, cannot be used."""


class ViewerError(AmrError):
    """The browser page's server cannot do what was asked."""


class PartlyDoneError(ViewerError):
    """
    A request of a page was done in part.

    Args:
        text: What was done, and why the rest was not.
        again: The fields of the request that tries the rest again, without its ``id``.
    """

    def __init__(self, text: str, again: Mapping[str, object]) -> None:
        super().__init__(text)
        self.again = again


class ProtocolError(ViewerError):
    """A message of a page is malformed."""


class BringupError(AmrError):
    """A stack is malformed, or one of its steps failed."""


class UsageError(AmrError):
    """A command line cannot be understood."""

    exit_code = 2
