"""Every cure can be followed, and every sentence is in the words of Python."""

import builtins
import functools
import math
import operator
import pathlib
import re

import numpy as np
import pytest

import kin
from kin import Coord

# A line that is refused, with the expression that it is about; what is written instead follows from the error.
LINES = [
    "r = 1.0 if x in [0.7, 1.0] else 2.0", "r = 1.0 if x not in (0.7, 1.0) else 2.0", "r = 1.0 if x in {0.7, k} else 2.0",
    "r = 1.0 if x in table else 2.0", "r = 1.0 if x not in table else 2.0", "r = 1.0 if x > 0 else 2.0",
    "r = 1.0 if x else 2.0", "r = 1.0 if not x else 2.0", "r = 1.0 if x + z else 2.0", "r = 1.0 if x and z else 2.0",
    "r = 1.0 if x > 0 and not z > 1 else 2.0", "r = 1.0 if 0 < x < 1 else 2.0", "r = 1.0 if 0 < x + z <= 2 or x > 3 else 2.0",
    "r = 1.0 if (x > 0 or z > 0) and x < 3 else 2.0", "r = max(x, z)", "r = min(x, z, 1.0)", "r = max([x, z])", "r = max(pair)",
    "r = np.max(pair)", "r = np.maximum(np.array([x, z]), 0.5)[0]", "r = np.array([x, z]).max()", "r = math.sin(x)", "r = math.pow(x, 2)",
    "r = math.atan2(x, z)", "r = math.hypot(x, z)", "r = kin.sin(math.sin(x))", "r = math.log1p(x)", "r = math.degrees(x)",
    "r = np.sign(np.array([x, z]))[0]", "r = math.fabs(x)", "r = math.asinh(x)", "r = float(math.exp(x))",
]  # fmt: skip
# The same, where no expression can stand there: the words say why.
NONE = {
    "r = math.gamma(x)": "it has no derivative here", "r = math.erf(x)": "it has no derivative here", "r = float(x)": "use it directly",
    "r = '%f' % x": "use it directly", "r = int(x)": "kin.trunc(x)", "r = sorted([x, z])[0]": "the order is unknown here",
    "r = complex(x)": "use it directly", "r = {0.7: 1.0}[x]": "kin.where(x == key, a, b)",
}  # fmt: skip


def traced(line):
    """A constraint with this line."""
    space = {"kin": kin, "np": np, "math": math, "functools": functools, "operator": operator, "table": [0.7, 1.0], "Coord": Coord}
    name = f"<{line}>"
    text = f"def f(x: Coord, z: Coord, k: float):\n    pair = [x, z]\n    {line}\n    return [z - x * k, r + x]\n"
    import linecache

    linecache.cache[name] = (len(text), None, text.splitlines(True), name)
    exec(compile(text, name, "exec"), space)
    return kin.constraint(space["f"])


def refused(line):
    with pytest.raises(kin.ConstraintError) as found:
        traced(line)
    return str(found.value).split(": ", 1)[1]


@pytest.mark.parametrize("line", LINES)
def test_a_cure_can_be_followed(line):
    """What the error says to write is written in place of the right side: the function is read then, and its value is that
    of the line with plain numbers."""
    text = refused(line)
    found = re.search(r"write (kin\..*?)( or np\..*)?$", text)
    assert found, text
    cure = found.group(1).replace(", a, b)", ", 1.0, 2.0)")
    mended = traced(f"r = {cure}")
    own = {"kin": kin, "np": np, "math": math, "table": [0.7, 1.0], **vars(builtins)}
    for x, z in ((0.7, 0.4), (0.6, 1.3), (0.0, 0.0)):
        m = kin.Mechanism("m")
        mine = m.terms(mended(m.length("x", x), m.length("z", z), 1.0), [x, z], [0.0, 0.0]).c[1] - x
        space = {**own, "x": x, "z": z, "k": 1.0, "pair": [x, z]}
        # Elsewhere the cure is a part of the line, or the first of two items.
        if x and "kin.sin(" not in line and not line.endswith("[0]"):
            exec(line, space)
            assert mine == pytest.approx(space["r"], rel=1e-14)


@pytest.mark.parametrize("line", NONE)
def test_where_there_is_no_cure_the_error_says_so(line):
    text = refused(line)
    assert NONE[line] in text
    assert not re.search(r"write kin\.(gamma|erf|float|complex|int|print)", text)


def test_an_assert_of_a_coordinate_is_a_branch_and_of_a_parameter_a_requirement():
    assert 'write kin.branch(x > 0, "why")' in refused("assert x > 0; r = 1.0")
    assert 'write kin.require(k > 0, "why")' in refused("assert k > 0; r = 1.0")
    assert traced('kin.branch(x > 0, "why"); r = 1.0').text and traced('kin.require(k > 0, "why"); r = 1.0').text


# Sentences that only rustc or a program in Rust meets.
TO_RUST = ("Registry::", "kin::text", "kin::loads", "Lanes::Best", "SpatialPose::", "Axis::new", "spatial::", "Law::constant")


def test_no_sentence_of_kin_has_names_of_rust_in_python():
    """All texts of errors in the sources, as Python shows them."""
    sources = pathlib.Path(__file__).parents[2] / "kin-core" / "src"
    looked_at = 0
    for path in sorted(sources.rglob("*.rs")):
        # `surface.rs` has the words of each reader, and chooses those of Python here.
        if "tests" in path.parts or path.name in ("tests.rs", "surface.rs"):
            continue
        source = path.read_text(encoding="utf-8").split("#[cfg(test)]")[0]
        source = re.sub(r"\\\n\s*", "", "\n".join(line for line in source.splitlines() if not line.lstrip().startswith("//")))
        for text in re.findall(r'"((?:[^"\\\n]|\\.)*`(?:[^"\\\n]|\\.)*)"', source):
            looked_at += 1
            for name in re.findall(r"`([^`]*)`", text):
                assert "::" not in name or any(one in name for one in TO_RUST), f"{path.name}: `{name}` in {text!r}"
    assert looked_at > 250


def test_errors_of_a_run_are_in_words_of_python():
    m = kin.Mechanism("m")
    x = m.length("x", 0.0)
    m.add("d", kin.drive(x, 0.0))
    system = m.build()
    with pytest.raises(kin.NeedsMemory) as found:
        system.run(np.linspace(0, 1, 1000), memory=10)
    assert "the option `memory` allows" in str(found.value) and "::" not in str(found.value)
    with pytest.raises(kin.InvalidTimes, match=r"`np.linspace\(0.0, 1.0, 101\)`"):
        system.run([])
    with pytest.raises(kin.DataError, match="unknown constraint `drove`. Did you mean `drive`.*, or give the text .* in `equations`"):
        kin.Mechanism.from_json(m.to_json().replace('"drive"', '"drove"'))


def test_docstrings_have_names_of_python():
    for module in (kin, kin.spatial, kin.loads):
        for name in module.__all__:
            doc = getattr(getattr(module, name), "__doc__", "") or ""
            assert not re.search(r"`[^`]*\w::\w[^`]*`", doc), f"{module.__name__}.{name}: {doc}"
