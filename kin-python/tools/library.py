"""Writes the joints of the package from the list of the library, docs/library.md, which is itself made from the code.

`python tools/library.py` writes `python/kin/library.py`, `python/kin/spatial.py` and `python/kin/_library_names.py`;
with `--check` it says whether they are what it would write.
"""

import re
import sys
import textwrap
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
PAGE = HERE.parent / "docs" / "library.md"
TYPES = {
    "Planar": "PlanarLike",
    "Spatial": "SpatialLike",
    "Coord": "CoordinateLike",
    "f64": "NumberLike",
    "Vec2": "Vec2Like",
    "Vec3": "Vec3Like",
    "EulerParameters": "EulerLike",
    "Axis": "AxisLike",
    "Law": "LawLike",
    "[Coord; N]": "Sequence[CoordinateLike]",
    "[f64; N]": "Sequence[NumberLike]",
}
HEAD = '''"""{title}

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from typing import Sequence

from ._dimension import NumberLike
from ._handles import CoordinateLike, PlanarLike, SpatialLike
from ._joint import AxisLike, EulerLike, Joint, LawLike, Vec2Like, Vec3Like, joint
'''


def plain(text):
    """Markdown as text."""
    return re.sub(r"\s+", " ", text.replace("\\|", "|").replace("**", "").replace("*", "")).strip()


def functions():
    """Section, name, arguments, equation and description of each function of the page."""
    section, equations = "", {}
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            section = "spatial" if "spatial::" in line else "library" if "prelude" in line else ""
            equations = {}
        cells = re.split(r"(?<!\\)\|", line)
        if section and len(cells) > 4 and "`" in cells[2]:
            equations[re.search(r"`(\w+)`", cells[2]).group(1)] = plain(cells[3])
        found = re.match(r"\* \*\*`(\w+)`\*\* `\((.*?)\)`: (.*)", line)
        if section and found:
            name, arguments, text = found.groups()
            pairs = [re.match(r"(\w+): (.*)", one).groups() for one in re.split(r", (?=\w+: )", arguments)]
            yield section, name, pairs, equations[name], plain(text)


def written(name, pairs, equation, text):
    """One function."""
    arguments = ", ".join(f"{argument}: {TYPES[kind]}" for argument, kind in pairs)
    signature = f"def {name}({arguments}) -> Joint:"
    if len(signature) > 110:
        lines = "".join(f"    {argument}: {TYPES[kind]},\n" for argument, kind in pairs)
        signature = f"def {name}(\n{lines}) -> Joint:"
    body = "\n\n".join(
        textwrap.fill(part, 108, initial_indent="    ", subsequent_indent="    ") for part in (equation, text)
    )
    given = ", ".join(f'("{argument}", "{kind}", {argument})' for argument, kind in pairs)
    call = textwrap.fill(f"return joint(\"{name}\", [{given}])", 108, initial_indent="    ", subsequent_indent="        ")
    return f'\n\n{signature}\n    """{body.strip()}\n    """\n{call}\n'


def files():
    """Every file with its text."""
    all_functions = list(functions())
    titles = {
        "library": "Joints, couplings and drivers of planar bodies and coordinates.",
        "spatial": "Joints, couplings and drivers of spatial bodies.",
    }
    made = {}
    for section, title in titles.items():
        own = [rest for known, *rest in all_functions if known == section]
        names = "".join(f'    "{name}",\n' for name in sorted(name for name, *_ in own))
        made[f"{section}.py"] = (
            HEAD.format(title=title) + "".join(written(*one) for one in own) + f"\n\n__all__ = [\n{names}]\n"
        )
    names = "".join(f'        "{name}",\n' for name in sorted({name for _, name, *_ in all_functions}))
    made["_library_names.py"] = (
        '"""Names of the joints of the library. Made by `python tools/library.py`; do not edit."""\n\n'
        f"LIBRARY = frozenset(\n    [\n{names}    ]\n)\n"
    )
    return made


if __name__ == "__main__":
    for name, text in files().items():
        path = HERE / "python" / "kin" / name
        if "--check" in sys.argv:
            if not path.exists() or path.read_text(encoding="utf-8") != text:
                sys.exit(f"{name} is not what docs/library.md says: run python tools/library.py")
        else:
            path.write_text(text, encoding="utf-8")
