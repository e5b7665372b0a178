# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Why a program failed, in one line, where its output says so: what came first, not last."""

from collections.abc import Sequence
import re

_INDEX = '`.venv/bin/python -m pip config list` shows the index'
_CAUSES = (
    (
        r'(?:\[Errno 28\] )?No space left on device(?:: \S+)?',
        '{found}; 700 MB are needed where the checkout is; TMPDIR names where files lie meanwhile',
    ),
    (r'\[Errno (?:13|30)\] (?:Permission denied|Read-only file system)(?:: .+)?', '{found}'),
    (
        r'CERTIFICATE_VERIFY_FAILED',
        'the certificate of {host} is not trusted here ({found}): install ca-certificates, or have'
        ' PIP_CERT name the file of those that your proxy goes by',
    ),
    (
        r'Temporary failure in name resolution|Name or service not known|Network is unreachable'
        r'|No route to host|Connection refused|Connection reset by peer|[Rr]ead timed out'
        r'|Tunnel connection failed: [^\'")]+',
        'cannot reach {host}: {found}; PIP_INDEX_URL names another index, HTTPS_PROXY a proxy',
    ),
    (
        r'DO NOT MATCH THE HASHES',
        f'a file of the index is not the one that the lock file has the hash of; {_INDEX}',
    ),
    (
        r'(?<=Could not find a version that satisfies the requirement )\S+',
        f'the index has no {{found}} for this Python and platform; {_INDEX}',
    ),
    (r'[45]\d\d (?:Client|Server) Error: .+', '{found}'),
)
_HOST = re.compile(r'(?:host=|Host: |https?://)[\'"]?([A-Za-z0-9.-]+)')


def first_cause(lines: Sequence[str]) -> str:
    """Return why a program failed, and what would do; '' if its lines do not say."""
    for line in lines:
        for pattern, text in _CAUSES:
            if found := re.search(pattern, line):
                hosts = [host[1] for each in lines if (host := _HOST.search(each))]
                host = hosts[0] if hosts else 'the index of pip'
                return text.format(found=found[0].strip(), host=host)
    return ''
