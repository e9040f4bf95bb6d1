"""What is wrong with a mechanism, or that nothing is."""

from __future__ import annotations

import html
import json
from typing import Any


class Diagnosis:
    """A verdict: `print` shows it in words; its fields are those of the file (`data`), such as `rank`, `mobility`,
    `dependencies`, `freedoms`."""

    def __init__(self, text: str, data: str) -> None:
        self.text = text
        self.data: dict[str, Any] = json.loads(data)

    def __getattr__(self, name: str) -> Any:
        data = self.__dict__.get("data", {})
        if name in data:
            return data[name]
        raise AttributeError(f"a diagnosis has no `{name}`; it has {', '.join(data)}")

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"

    def __reduce__(self) -> Any:
        return (Diagnosis, (self.text, json.dumps(self.data)))
