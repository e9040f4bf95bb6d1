"""The lecture's two-link manipulator in twelve lines: m, rad, s."""

import numpy as np

import kin

m = kin.Mechanism("two-link manipulator")
link2, link3 = m.link("link 2", 0.2), m.link("link 3", 0.35)
m.add("O", kin.revolute(m.ground, link2, (0, 0), link2.start))
m.add("A", kin.revolute(link2, link3, link2.end, link3.start))
m.add("motor 2", kin.drive_angle(link2, kin.Law.linear(np.pi / 6, 0.5)))
m.add("motor 3", kin.drive_angle(link3, kin.Law.linear(np.pi / 12, 0.75)))
motion = m.build().run(np.linspace(0.0, 24.0, 2401))
end = motion.point(link3, link3.end)
print(motion.summary)
print(f"end effector: at most {end.speed.max():.4f} m/s")
