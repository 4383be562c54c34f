"""What there is to choose from."""

import json
from typing import Any

from gnomon import _gnomon


def methods() -> list[dict[str, Any]]:
    """The shadow methods, their filters and bias terms: a list of dict, as `gnomon methods --json` prints them."""
    return json.loads(_gnomon.methods_json())
