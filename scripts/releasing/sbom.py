# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The bill of materials of a release, in CycloneDX 1.5: packages, and hashes of their files."""

from collections.abc import Iterable
from datetime import datetime, UTC
import json
import uuid

from environment.locks import canonical, Pin

_NAMESPACE = uuid.UUID('6ba7b811-9dad-11d1-80b4-00c04fd430c8')  # that of URLs, RFC 9562
_NAME = 'amr-description'


def text(version: str, pins: Iterable[Pin], epoch: int) -> str:
    """
    Return the JSON; the same release gives the same bytes.

    Args:
        version: that is released.
        pins: everything that users install, for any Python.
        epoch: the time of the commit, s.
    """
    components = [_component(pin) for pin in sorted(pins)]
    own = next(each['bom-ref'] for each in components if each['name'] == _NAME)
    contents = json.dumps(components, sort_keys=True)
    bill = {
        'bomFormat': 'CycloneDX',
        'specVersion': '1.5',
        'serialNumber': f'urn:uuid:{uuid.uuid5(_NAMESPACE, contents)}',
        'version': 1,
        'metadata': {
            'timestamp': datetime.fromtimestamp(epoch, UTC).isoformat(),
            'component': {
                'type': 'application',
                'bom-ref': 'release',
                'name': _NAME,
                'version': version,
                'licenses': [{'license': {'id': 'Apache-2.0'}}],
            },
        },
        'components': components,
        'dependencies': [
            {'ref': 'release', 'dependsOn': [own]},
            {'ref': own, 'dependsOn': [e['bom-ref'] for e in components if e['bom-ref'] != own]},
        ],
    }
    return json.dumps(bill, indent=2) + '\n'


def _component(pin: Pin) -> dict[str, object]:
    purl = f'pkg:pypi/{canonical(pin.name)}@{pin.version}'
    digests = [each.removeprefix('sha256:') for each in pin.hashes]
    return {
        'type': 'library',
        'bom-ref': purl,
        'name': canonical(pin.name),
        'version': pin.version,
        'purl': purl,
        'hashes': [{'alg': 'SHA-256', 'content': digest} for digest in digests],
    }
