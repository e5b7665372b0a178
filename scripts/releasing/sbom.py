# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The bill of materials of a release, in CycloneDX 1.5: each package and its hash."""

from collections.abc import Mapping
from datetime import datetime, UTC
import json
import uuid

from releasing.locks import canonical

_NAMESPACE = uuid.UUID('6ba7b811-9dad-11d1-80b4-00c04fd430c8')  # that of URLs, RFC 9562
_NAME = 'amr-description'


def text(version: str, pins: Mapping[str, str], hashes: Mapping[str, str], epoch: int) -> str:
    """
    Return the JSON; the same release gives the same bytes.

    Args:
        version: that is released.
        pins: name → version of everything that users install.
        hashes: name → SHA-256 of the file of each.
        epoch: the time of the commit, s.
    """
    components = [_component(name, pins[name], hashes[name]) for name in sorted(pins)]
    own = {canonical(each['name']): each['bom-ref'] for each in components}.get(_NAME)
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
            {'ref': 'release', 'dependsOn': [own] if own else []},
            {'ref': own, 'dependsOn': [e['bom-ref'] for e in components if e['bom-ref'] != own]},
        ][: 2 if own else 1],
    }
    return json.dumps(bill, indent=2) + '\n'


def _component(name: str, version: str, digest: str) -> dict[str, object]:
    purl = f'pkg:pypi/{canonical(name)}@{version}'
    return {
        'type': 'library',
        'bom-ref': purl,
        'name': canonical(name),
        'version': version,
        'purl': purl,
        'hashes': [{'alg': 'SHA-256', 'content': digest}],
    }
