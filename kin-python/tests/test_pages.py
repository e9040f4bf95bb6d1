"""Pages with traces, forces and charts, and calls that come too early."""

import pytest

import kin


def arm():
    m = kin.Mechanism("arm")
    link = m.link("link", 0.5)
    m.mass(link, 2.0, (0, 0), 0.05)
    m.gravity((0, -9.81))
    m.add("pin", kin.revolute(link, m.ground, link.start, (0, 0)))
    m.add("motor", kin.drive_angle(link, kin.Law.ramp(1.0)))
    return m, link, m.build()


def test_a_page_has_traces_forces_and_charts():
    _, link, system = arm()
    motion = system.run([0.0, 0.5, 1.0])
    bare = system.page(motion).html
    page = system.page(
        motion,
        title="An arm & its load",
        traces={"tip": (link, link.end), "middle": link},
        forces=system.forces(motion),
        charts={
            "Turn": "link.theta",
            "Places": {"x": link.x, "rise": motion[link.y]},
            "Height": lambda motion: motion[link.y],
        },
    ).html
    assert len(page) > len(bare)
    for word in ("An arm &amp; its load", "tip", "middle", "Turn", "Places", "rise", "Height", "motor"):
        assert word in page, word
    assert "Height" not in bare


def test_a_chart_has_a_number_for_each_time():
    _, link, system = arm()
    motion = system.run([0.0, 0.5, 1.0])
    other = system.run([0.0, 1.0])
    with pytest.raises(ValueError, match="chart 'Turn': 'Turn' has 2 numbers, the motion 3 times"):
        system.page(motion, charts={"Turn": other[link.theta]})
    with pytest.raises(TypeError, match="`traces` takes a body"):
        system.page(motion, traces={"tip": "link"})


@pytest.mark.parametrize("name", ["run", "position", "forces", "extremes", "assemblies", "page"])
def test_calls_of_a_mechanism_before_it_is_built_name_the_system(name):
    m, _, _ = arm()
    with pytest.raises(AttributeError, match=r"the system that `m.build\(\)` returns"):
        getattr(m, name)
    assert not hasattr(m, name)


@pytest.mark.parametrize("name", ["q", "point", "to_pandas", "events"])
def test_calls_of_a_system_before_it_is_run_name_the_motion(name):
    m, _, system = arm()
    with pytest.raises(AttributeError, match=r"the motion that `system.run\(times\)` returns"):
        getattr(system, name)
    with pytest.raises(AttributeError, match=r"the motion that `m.build\(\).run\(times\)` returns"):
        getattr(m, name)
    with pytest.raises(AttributeError, match="^a mechanism has no attribute `nothing`$"):
        m.nothing
