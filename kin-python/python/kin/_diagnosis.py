"""Diagnoses mechanisms."""

from __future__ import annotations

import html
import json
import os
from typing import Any, Union


class Diagnosis:
    """The diagnosis of a mechanism. `print` shows a report.

    The attributes are the fields of the file (`data`), such as `rank`, `mobility`, `dependencies` and `freedoms`, and
    results derived from them. `can_be_driven` is true if a run is possible. `is_exactly_constrained` is true if the
    mechanism has as many equations as coordinates, all independent. `count_misleads` is true if the count is right only
    because a redundant equation hides a missing equation. `redundancies` and `contradictions` are the two kinds of
    dependencies. `lasting_freedoms` are the freedoms that also exist at nearby poses.
    """

    def __init__(self, text: str, data: str, answers: str) -> None:
        self.text = text
        self.data: dict[str, Any] = json.loads(data)
        self._answers: dict[str, Any] = json.loads(answers)

    def __getattr__(self, name: str) -> Any:
        known = {**self.__dict__.get("data", {}), **self.__dict__.get("_answers", {})}
        if name in known:
            return known[name]
        raise AttributeError(f"a diagnosis has no `{name}`; it has {', '.join(known)}")

    def write_json(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the fields of the diagnosis to a JSON file."""
        with open(os.fspath(path), "w", encoding="utf-8") as file:
            json.dump(self.data, file, ensure_ascii=False, indent=2)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"

    def __reduce__(self) -> Any:
        return (Diagnosis, (self.text, json.dumps(self.data), json.dumps(self._answers)))
