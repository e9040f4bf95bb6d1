"""Defines pictures and pages: each is one text without external links, which you can save as a file or show in a
notebook.
"""

from __future__ import annotations

import html
import os
from pathlib import Path
from typing import Union


class Picture:
    """A picture as SVG."""

    def __init__(self, svg: str) -> None:
        self.svg = svg

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the picture to a file and creates missing folders."""
        _write(path, self.svg)

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"<picture, {len(self.svg)} bytes of SVG>"


class Page:
    """A page as HTML, self-contained in one file."""

    def __init__(self, text: str) -> None:
        self.html = text

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the page to a file and creates missing folders."""
        _write(path, self.html)

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{html.escape(self.html)}" width="100%" height="640" style="border:0"></iframe>'

    def __repr__(self) -> str:
        return f"<page, {len(self.html)} bytes of HTML>"


def _write(path: Union[str, "os.PathLike[str]"], text: str) -> None:
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_text(text, encoding="utf-8")
