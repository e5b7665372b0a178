# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules about environment variables: which ROS is used, and whom its nodes find."""

from collections.abc import Iterator
import re

from amr_description.doctor.findings import error, Finding, Rule, warning
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.environment import Environment, PROFILES
from amr_description.ros_arguments import DOMAIN, is_domain, OF_DOMAINS, RANGES
from amr_description.text import did_you_mean, quote, quote_all, shorten

DISTRIBUTION = 'jazzy'

_RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'
_LOCALHOST_ONLY = 'ROS_LOCALHOST_ONLY'
_PEERS = 'ROS_STATIC_PEERS'
_SERVER = 'ROS_DISCOVERY_SERVER'
_RMW = 'RMW_IMPLEMENTATION'
_LISTS = ('AMENT_PREFIX_PATH', 'PYTHONPATH', 'LD_LIBRARY_PATH')
_LOADED = ('PYTHONPATH', 'LD_LIBRARY_PATH')
_INSTALLED = re.compile(r'/opt/ros/([a-z]+)(?=[/:]|$)')
_PYTHON_FOLDER = re.compile(r'/python(3\.\d+)(?:/|$)')
_NEW_SHELL = 'open a new shell, and source there only'


def other_distribution(seen: Observations) -> Iterator[Finding]:
    """
    Distributions of ROS are not mixed in one shell.

    A line in ``~/.bashrc`` sources another ROS in every shell. Take it out, and open a new shell.
    """
    if (environment := seen.environment) is None:
        return
    found = _sourced(environment)
    others = sorted(name for name in found if name != DISTRIBUTION)
    named = environment.value('ROS_DISTRO').lower()
    if not others and named and named != DISTRIBUTION:
        yield warning(
            'other_distribution',
            f'ROS_DISTRO is {quote(named)}',
            f'this is {DISTRIBUTION}: tools that ask for the distribution get the wrong one',
            f'{_NEW_SHELL} {DISTRIBUTION}; see what sets it: grep -n ROS_DISTRO ~/.bashrc',
        )
    if others:
        where = ' and '.join(sorted({name for each in others for name in found[each]}))
        yield error(
            'other_distribution',
            f'/opt/ros/{others[0]} is sourced in this shell ({where}), and this is {DISTRIBUTION}',
            'modules, messages and libraries of both are mixed: imports fail, or nodes do not '
            'understand each other',
            f'{_NEW_SHELL} {DISTRIBUTION}; what sources it: grep -n /opt/ros/{others[0]} '
            '~/.bashrc ~/.profile',
        )


def mixed_installations(seen: Observations) -> Iterator[Finding]:
    """
    The rclpy of PyPI brings its own libraries, and takes none of ``/opt/ros``.

    Both are Jazzy, but compiled apart. Use one of them in a shell (docs/install.md#two-underlays).
    """
    environment = seen.environment
    if environment is None or not environment.is_from_wheels:
        return
    variables = [
        name for name in _LOADED if DISTRIBUTION in _INSTALLED.findall(environment.value(name))
    ]
    if variables:
        yield error(
            'mixed_installations',
            f'{" and ".join(variables)} name /opt/ros/{DISTRIBUTION}, and rclpy is that of PyPI',
            'its libraries are found before those of the wheels, which were compiled otherwise',
            f'unset {" ".join(variables)}; or {_NEW_SHELL} scripts/activate',
        )


def conda(seen: Observations) -> Iterator[Finding]:
    """
    Libraries of conda are not for programs outside of it.

    They are loaded by every program while its folders are in ``LD_LIBRARY_PATH`` or
    ``PYTHONPATH``.
    """
    if (environment := seen.environment) is None:
        return
    prefix = environment.value('CONDA_PREFIX')
    variables = [
        name
        for name in _LOADED
        if prefix and any(_is_below(each, prefix) for each in _entries(environment, name))
    ]
    if variables:
        yield error(
            'conda',
            f'{" and ".join(variables)} name folders of the conda environment {prefix}',
            'its libstdc++, OpenSSL and Python modules are loaded in place of those that ROS was '
            'compiled with',
            f'conda deactivate; unset {" ".join(variables)}',
        )


def python_path(seen: Observations) -> Iterator[Finding]:
    """
    Modules of one version of Python are not for another one.

    ``PYTHONPATH`` names those of another one, as of a workspace built on another system. Build it
    again.
    """
    if (environment := seen.environment) is None:
        return
    wrong = [
        entry
        for entry in _entries(environment, 'PYTHONPATH')
        if _PYTHON_FOLDER.search(entry)
        and environment.python_version not in _PYTHON_FOLDER.findall(entry)
        and not _INSTALLED.search(entry)
    ]
    if wrong:
        version = _PYTHON_FOLDER.findall(wrong[0])[-1]
        yield error(
            'python_path',
            f'PYTHONPATH names {quote(shorten(wrong[0]))}, which is of Python {version}; this is '
            f'Python {environment.python_version}',
            'its modules are found before those of this Python, and fail to load',
            'unset PYTHONPATH; or source the workspace again after it was built with this Python',
        )


def missing_prefix(seen: Observations) -> Iterator[Finding]:
    """
    Prefixes in which packages are looked for are there.

    A workspace was sourced, and then moved or deleted.
    """
    if seen.environment is None:
        return
    missing = seen.environment.missing_folders.get('AMENT_PREFIX_PATH', ())
    if missing:
        yield warning(
            'missing_prefix',
            f'AMENT_PREFIX_PATH names {quote_all(missing, 3)}, which '
            f'{"is" if len(missing) == 1 else "are"} not there',
            'packages of a workspace that was moved, deleted or built anew are not found',
            f'build it again with colcon build; or {_NEW_SHELL} what is there',
        )


def domain(seen: Observations) -> Iterator[Finding]:
    """
    A ROS domain is an integer from 0 to 232.

    Where ``ROS_DOMAIN_ID`` is not set, the domain is 0.
    """
    text = seen.environment.value(DOMAIN) if seen.environment else ''
    if text and not is_domain(text):
        yield error(
            'domain',
            f'{DOMAIN} is {quote(text)}',
            f'{OF_DOMAINS}; nodes do not start',
            f'export {DOMAIN}=0',
        )


def discovery_range(seen: Observations) -> Iterator[Finding]:
    """
    The range is one of four words, in capital letters, and OFF is not meant for robots.

    ``ROS_AUTOMATIC_DISCOVERY_RANGE`` is ``SUBNET``, ``LOCALHOST``, ``OFF`` or ``SYSTEM_DEFAULT``.
    With ``OFF`` nobody is found.
    """
    text = seen.environment.value(_RANGE) if seen.environment else ''
    if text and text not in RANGES:
        known = text.upper() if text.upper() in RANGES else 'SUBNET'
        yield error(
            'discovery_range',
            f'{_RANGE} is {quote(text)}',
            f'rcl knows {", ".join(RANGES)}, and takes any other word for LOCALHOST: nodes of '
            'other hosts are not found'
            + ('' if text.upper() in RANGES else did_you_mean(text.upper(), RANGES)),
            f'export {_RANGE}={known}',
        )
    elif text == 'OFF' and not seen.environment.value(_SERVER):  # type: ignore[union-attr]
        yield error(
            'discovery_range',
            f'{_RANGE} is OFF',
            'nodes of this shell find no other node, not even on this host',
            f'export {_RANGE}=LOCALHOST',
        )


def localhost_only(seen: Observations) -> Iterator[Finding]:
    """
    ``ROS_LOCALHOST_ONLY`` is deprecated since Iron, and wins over what took its place.

    It wins over the discovery range and over static peers.
    """
    if (environment := seen.environment) is None or environment.value(_LOCALHOST_ONLY) != '1':
        return
    contradicted = [
        f'{name}={environment.value(name)}'
        for name in (_RANGE, _PEERS)
        if environment.value(name) not in ('', 'LOCALHOST')
    ]
    if contradicted:
        yield error(
            'localhost_only',
            f'{_LOCALHOST_ONLY}=1 contradicts {" and ".join(contradicted)}, and wins',
            'nodes of other hosts are not found',
            f'unset {_LOCALHOST_ONLY}',
        )
    else:
        yield warning(
            'localhost_only',
            f'{_LOCALHOST_ONLY}=1 is set',
            'it is deprecated, and releases after Jazzy ignore it: nodes would reach the network',
            f'unset {_LOCALHOST_ONLY}; export {_RANGE}=LOCALHOST',
        )


def static_peers(seen: Observations) -> Iterator[Finding]:
    """
    Peers are addresses or names of hosts, separated by semicolons.

    Quote them: ``ROS_STATIC_PEERS='10.0.0.2;10.0.0.3'``.
    """
    text = seen.environment.value(_PEERS) if seen.environment else ''
    if re.search(r'[,\s]', text):
        wanted = ';'.join(filter(None, re.split(r'[;,\s]+', text)))
        yield error(
            'static_peers',
            f'{_PEERS} is {quote(text)}',
            'peers are separated by semicolons; this is taken for one name, which no host has',
            f"export {_PEERS}='{wanted}'",
        )


def silent_peers(seen: Observations) -> Iterator[Finding]:
    """
    Of hosts that are named as peers, nodes are found.

    Nothing runs there, it is in another domain, or a firewall drops what it sends
    (docs/two_machines.md#when-nothing-is-seen).
    """
    if seen.environment is None or seen.machine is None or any(static_peers(seen)):
        return
    own = {address for each in seen.machine.interfaces for address in each.addresses}
    own |= {'localhost', '127.0.0.1'}
    peers = [each for each in seen.environment.value(_PEERS).split(';') if each]
    others = [each for each in peers if each not in own]
    if not others or not _is_of_this_host(seen):
        return
    firewall = seen.machine.firewall
    ports = {
        'ufw': f'sudo ufw allow proto udp from {others[0]}',
        'firewalld': f'sudo firewall-cmd --zone=trusted --add-source={others[0]}',
    }
    yield warning(
        'silent_peers',
        f'{_PEERS} names {", ".join(others)}, and no node of another host is found'
        + (f'; {firewall} is active here' if firewall else ''),
        'nothing runs there, in this domain, or its answers do not reach this host',
        ports[firewall]
        if firewall in ports
        else f'see whether it answers: ping -c 1 {others[0]}; and name this host there, too',
    )


def discovery_server(seen: Observations) -> Iterator[Finding]:
    """
    With ``ROS_DISCOVERY_SERVER`` nodes are found through that server alone.

    It does not run.
    """
    if seen.environment is None or not seen.environment.unheard_servers:
        return
    yield error(
        'discovery_server',
        f'{_SERVER} names {quote_all(seen.environment.unheard_servers)}, where nobody listens',
        'nodes of this shell find no other node',
        f'start it: fastdds discovery --server-id 0; or unset {_SERVER}',
    )


def rmw_implementation(seen: Observations) -> Iterator[Finding]:
    """
    The middleware that is chosen is installed.

    Here it is ``rmw_fastrtps_cpp``. One that is not installed ends every program of ROS as it
    starts (exit code 102).
    """
    if (environment := seen.environment) is None or not environment.rmw_implementations:
        return
    text, known = environment.value(_RMW), sorted(environment.rmw_implementations)
    if text and text not in known:
        yield error(
            'rmw_implementation',
            f'{_RMW} is {quote(text)}; here {"is" if len(known) == 1 else "are"} '
            f'{", ".join(known)}{did_you_mean(text, known)}',
            'no node starts: its library cannot be loaded',
            f'unset {_RMW}' if len(known) == 1 else f'export {_RMW}={known[0]}',
        )


def profiles_file(seen: Observations) -> Iterator[Finding]:
    """
    A profile of Fast DDS can be read.

    Fast DDS ignores one that is not there or is no XML, and says so in one line of many.
    """
    for name in PROFILES if seen.environment else ():
        fault = seen.environment.file_faults.get(name)  # type: ignore[union-attr]
        if fault:
            yield error(
                'profiles_file',
                f'{name}={seen.environment.value(name)} {fault}',  # type: ignore[union-attr]
                'Fast DDS goes on without it: transports, peers and interfaces are not those that '
                'it sets',
                f'unset {name}; or mend the file',
            )


def security(seen: Observations) -> Iterator[Finding]:
    """
    Where security is enforced there is a keystore.

    ``ROS_SECURITY_STRATEGY=Enforce`` has nodes refuse to start without keys.
    """
    if (environment := seen.environment) is None:
        return
    fault = environment.file_faults.get('ROS_SECURITY_KEYSTORE')
    if fault:
        yield error(
            'security',
            'ROS_SECURITY_ENABLE=true and ROS_SECURITY_STRATEGY=Enforce, and '
            f'ROS_SECURITY_KEYSTORE {fault}',
            'no node starts',
            'unset ROS_SECURITY_ENABLE',
        )


RULES: tuple[Rule, ...] = (
    other_distribution,
    mixed_installations,
    conda,
    python_path,
    missing_prefix,
    security,
    domain,
    rmw_implementation,
    discovery_range,
    localhost_only,
    static_peers,
    silent_peers,
    discovery_server,
    profiles_file,
)


def _is_of_this_host(seen: Observations) -> bool:
    """Return whether the graph was observed, and shows no node of another host."""
    if seen.graph is None:
        return seen.processes is not None and seen.processes.is_alone is True
    return not any(each.host for each in seen.graph.nodes)


def _sourced(environment: Environment) -> dict[str, list[str]]:
    """Return the distributions below ``/opt/ros`` → the variables that name them."""
    found: dict[str, list[str]] = {}
    for name in _LISTS:
        for each in dict.fromkeys(_INSTALLED.findall(environment.value(name))):
            found.setdefault(each, []).append(name)
    return found


def _entries(environment: Environment, name: str) -> list[str]:
    return [each for each in environment.value(name).split(':') if each]


def _is_below(path: str, folder: str) -> bool:
    return path == folder or path.startswith(f'{folder.rstrip("/")}/')
