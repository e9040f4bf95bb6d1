"""Each public method of Rust has one of the same name in Python, or stands here with what Python has in its place: both are read
from the source and from the package, so that neither can grow past the other unseen."""

import re
from pathlib import Path

import pytest

import kin

ROOT = Path(__file__).resolve().parents[2]
CORE = ROOT / "kin-core" / "src"

# Types of Rust, and their classes here where these have another name.
TYPES = {
    "BodyWrench": "", "Balance": "", "Compiled": "", "Diagnosis": "", "Dimension": "", "Drive": "", "Extremes": "",
    "Forces": "", "Friction": "", "Law": "", "Link": "", "Load": "", "Mechanism": "", "Motion": "", "PlanarBody": "",
    "PointMotion": "Point", "Proof": "", "Quantity": "", "Reaction": "", "RotationMotion": "Rotation", "Samples": "",
    "Sensitivities": "", "Series": "Quantity", "Solid": "", "SpatialBody": "", "SpatialLink": "", "System": "", "Tolerance": "",
}  # fmt: skip

# What Python has in the place of a method, by type and method.
INSTEAD = {
    "Compiled": {"summary": "str"},
    "Diagnosis": {"read_json": "json.load"},
    "Dimension": {
        "distributed": "`m.dimension(…, distribution=…)`", "powi": "`**`", "sin_cos": "`kin.sin`, `kin.cos`",
        "tolerance": "`m.dimension(…, tolerance=…)`", "unit": "`m.dimension(…, unit)`", "within": "`m.dimension(…, range=…)`",
    },
    "Forces": {
        "balance": "an attribute", "constraints": "system.constraints", "data": "columns", "energy": "an attribute",
        "magnitudes": "`on(body).magnitude`", "motion": "an attribute", "write_csv_to": "write_csv", "write_json": "to_pandas",
    },
    "Law": {
        "breaks": "`motion.breaks`", "by_parameter": "sensitivities", "description": "repr", "fixed_numbers": "of Rust's trait",
        "fourth": "of Rust's trait", "is_periodic": "of Rust's trait", "is_smooth": "of Rust's trait", "jet": "at",
        "parameters": "`system.parameters`", "parts": "of Rust's trait", "quintic_spline_from_csv": "np.loadtxt",
        "refusal": "an exception", "set_parameter": "`system.set`", "sharpest_break": "of Rust's trait",
        "spline_from_csv": "np.loadtxt", "text": "of Rust's trait",
    },
    "Link": {"body": "a link is a body"},
    "Load": {"and": "`load + load`"},
    "Mechanism": {
        "add_data": "from_json", "add_load_data": "from_json", "coordinate_named": "`m[name]`", "data": "to_json",
        "dimension_named": "`m[name]`", "expression": "an expression of dimensions",
        "from_data": "from_json", "law": "`kin.Law`", "marker": "local", "planar_named": "`m[name]`", "spatial_named": "`m[name]`",
        "write_json_for": "write_json",
    },
    "Motion": {
        "add_marker": "point", "add_output": "arrays of one's own", "add_point": "point", "add_rotation": "rotation",
        "coordinate": "`motion[name]`", "data": "to_json", "from_data": "from_json", "has_jerk": "`qddd`", "headers": "to_pandas",
        "is_empty": "`len(motion)`", "len": "`len(motion)`", "marker": "point", "named": "`motion[name]`",
        "outputs": "arrays of one's own", "planar_named": "`m[name]`", "q_rows": "q", "qd_rows": "qd", "qdd_rows": "qdd",
        "qddd_rows": "qddd", "spatial_named": "`m[name]`", "unit_words": "units", "write_csv_to": "to_pandas",
    },
    "PointMotion": {"components": "r, v, a"},
    "Proof": {"error": "`steps`"},
    "RotationMotion": {"components": "omega, alpha", "in_body": "omega_in_body"},
    "Samples": {"sampling": "count, seed"},
    "Sensitivities": {"by": "of", "compiled": "of"},
    "Series": {
        "chain": "NumPy", "number": "NumPy", "plus": "NumPy", "powi": "NumPy", "recip": "NumPy", "sqr": "NumPy",
        "unit_words": "`motion.units`", "values": "value",
    },
    "Solid": {"and": "`solid + solid`"},
    "System": {
        "check_columns": "`kin.sweep`", "constraint_names": "constraints", "coordinate_names": "names",
        "coordinate_units": "units", 
        "equation_names": "equations", "follower_given": "follower(given=…)",
        "link_length": "parameters", "load_names": "loads",
        "n_coordinates": "`len(system.names)`", "n_equations": "`len(system.equations)`",
        "solve_at": "position(t, q)", "solver": "keywords of each call",
        "sweep": "`kin.sweep`", "tolerance_of": "tolerance(motion, what, of)", "unit_words": "units",
    },
    "Tolerance": {"share": "`contributions`", "share_of_variance": "`contributions`"},
}  # fmt: skip


def methods_of_rust():
    """Public methods that are not hidden, by type."""
    found = {}
    for path in sorted(CORE.rglob("*.rs")):
        own, hidden = None, False
        for line in path.read_text(encoding="utf-8").splitlines():
            begins = re.match(r"impl(?:<[^>]*>)? (\w+)(?:<[^>]*>)? \{", line)
            method = re.match(r"    pub (?:const )?fn (\w+)", line)
            if begins:
                own = begins[1]
            elif line == "}":
                own = None
            elif method:
                if own and not hidden:
                    found.setdefault(own, set()).add(method[1])
                hidden = False
            hidden = hidden or "#[doc(hidden)]" in line
    return found


METHODS = methods_of_rust()


@pytest.mark.parametrize("name", TYPES)
def test_methods_have_the_names_of_rust(name):
    here = getattr(kin, TYPES[name] or name)
    own = set(dir(here)) | set(getattr(here, "__dataclass_fields__", {})) | answers(here)
    theirs, instead = METHODS[name], set(INSTEAD.get(name, {}))
    assert len(theirs) > 0
    assert theirs - own - instead == set(), "neither in Python nor told what is there in its place"
    assert instead - theirs == set(), "Rust has no such method any more"
    assert instead & own == set(), "Python has it now"


def answers(here):
    """A diagnosis finds its fields when it is asked for them."""
    if here is not kin.Diagnosis:
        return set()
    m = kin.Mechanism("wheel")
    wheel = m.planar("wheel")
    m.add("axle", kin.revolute(wheel, m.ground, (0, 0), (0, 0)))
    found = m.diagnose(0.0)
    assert not found.can_be_driven and not found.is_exactly_constrained and not found.count_misleads
    assert len(found.lasting_freedoms) == 1 and found.redundancies == found.contradictions == []
    return set(found.data) | set(found._answers)


def test_every_error_of_rust_is_a_class():
    variants = set()
    for name, head in (("mod.rs", "pub enum Error {"), ("failure.rs", "pub enum FailureKind {")):
        page = (CORE / "outcome" / "error" / name).read_text(encoding="utf-8")
        body = page[page.index(head) :].split("\n}\n")[0]
        variants |= set(re.findall(r"^    ([A-Z]\w+)(?: \{|\(|,)", body, re.M))
    # The kinds of `Run` are classes of their own.
    variants.remove("Run")
    assert len(variants) > 30
    named = {"Data": "DataError", "Table": "TableError", "File": "FileError", "Dimension": "DimensionError"}
    missing = {name for name in variants if not hasattr(kin, named.get(name, name))}
    assert missing == set()


def test_every_option_of_a_run_is_a_keyword():
    page = (CORE / "solve" / "options.rs").read_text(encoding="utf-8")
    body = page[page.index("pub struct SolverOptions {") :].split("\n}\n")[0]
    fields = set(re.findall(r"^    pub (\w+):", body, re.M))
    m = kin.Mechanism("wheel")
    wheel = m.planar("wheel")
    m.add("axle", kin.revolute(wheel, m.ground, (0, 0), (0, 0)))
    m.add("motor", kin.drive_angle(wheel, kin.Law.ramp(1.0)))
    with pytest.raises(TypeError, match="there is no option `speed`") as refused:
        m.build().run([0.0], speed=1)
    known = set(re.findall(r"\w+", str(refused.value).split("Use one of ")[1]))
    # The stop rule has a keyword for each of its kinds; `assemblies` and `forces` have keywords of their calls.
    assert fields - known == {"stop", "search", "assemblies", "sharing"}
    assert known - fields == {"tolerance", "residual_only", "other_branch_at"}
