//! Ten families of mechanisms under six kinds of laws, wherever they stand and however large they
//! are.

use kin::prelude::*;

#[law]
fn bump(x: f64, base: f64, height: f64, at: f64, width: f64) -> f64 {
    base + height * (-((x - at) / width).powi(2)).exp()
}

#[law]
fn pulses(x: f64, base: f64, height: f64, omega: f64) -> f64 {
    base + height * (omega * x).sin().powi(4)
}

pub struct Random(fastrand::Rng);

#[allow(dead_code)]
impl Random {
    /// The numbers of the mechanism of that number.
    pub fn of(number: usize) -> Self {
        Random(fastrand::Rng::with_seed(0x5eed ^ number as u64))
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    pub fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.0.usize(0..all.len())]
    }

    fn lengths<const N: usize>(&mut self, low: f64, high: f64) -> [f64; N] {
        [0; N].map(|_| self.within(low, high))
    }

    /// A law over one second: one way, out and back once or many times, or both ways.
    fn law(&mut self, low: f64, high: f64) -> Law {
        let unbounded = high - low > 100.0;
        let start = if unbounded { self.within(0.0, TAU) } else { self.within(low, high) };
        let far =
            if unbounded { self.within(0.5, 5.0) } else { self.within(0.2, 1.0) * (high - low) };
        match self.0.usize(0..6) {
            0 if unbounded => Law::linear(start, self.one_of(&[TAU, -TAU])),
            0 | 1 => bump(start, far, self.within(0.3, 0.7), self.within(0.05, 0.2)),
            2 => pulses(start, far, PI * self.one_of(&[9.0, 10.0, 18.0])),
            3 => Law::constant(start) + Law::sine(far, TAU * self.one_of(&[1.0, 2.0, 9.0]), 0.0),
            4 => Law::constant(start) + Law::sine(far, 3.0, 0.3),
            _ => {
                let begin = self.within(0.0, 0.2);
                let length = self.within(0.05, 0.4);
                let out = Law::cycloidal(far, length);
                let back = Law::constant(start + far) - Law::cycloidal(far, length);
                Law::sequence(begin, [(length, Law::constant(start) + out), (length, back)])
            }
        }
    }
}

pub const FAMILIES: [&str; 10] = [
    "slider-crank with near-equal links",
    "slider-crank",
    "near-parallelogram",
    "four-bar by its coupler",
    "six-bar",
    "two loops",
    "geared five-bar",
    "by distance",
    "cam",
    "RSSR",
];

/// Where a mechanism stands, how large it is and when it moves: at its place, or at the origin with
/// what rounding made of its points there.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub scale: f64,
    pub place: f64,
    pub is_moved: bool,
    /// When its law begins, and over how much time.
    pub begin: f64,
    pub span: f64,
}

impl Default for Frame {
    fn default() -> Self {
        Frame { scale: 1.0, place: 0.0, is_moved: true, begin: 0.0, span: 1.0 }
    }
}

impl Frame {
    pub fn length(self, x: f64) -> f64 {
        self.scale * x
    }

    /// A law over one second, over this time.
    fn in_time(self, law: Law) -> Law {
        let is_usual = self.begin == 0.0 && self.span == 1.0;
        if is_usual { law } else { law.compose(&Law::ramp(self.span.recip()).shifted(self.begin)) }
    }

    /// A coordinate of a point of the ground.
    pub fn at(self, x: f64) -> f64 {
        let moved = self.scale * x + self.place;
        if self.is_moved { moved } else { moved - self.place }
    }

    fn point(self, x: f64, y: f64) -> Vec2 {
        vec2(self.at(x), self.at(y))
    }

    fn point_in_space(self, p: Vec3) -> Vec3 {
        vec3(self.at(p.x), self.at(p.y), self.at(p.z))
    }

    fn vector(self, x: f64, y: f64) -> Vec2 {
        vec2(self.length(x), self.length(y))
    }
}

fn slider_crank(
    [crank, rod, offset]: [f64; 3],
    law: Law,
    up: bool,
    frame: Frame,
) -> kin::Result<System> {
    let mut m = Mechanism::new("slider-crank");
    let c = m.link("crank", frame.length(crank))?;
    let r = m.link("rod", frame.length(rod))?;
    let start = law.at(frame.begin);
    m.add("O", revolute(Ground, c, frame.point(0.0, 0.0), c.start()))?;
    m.add("A", revolute(c, r, c.end(), r.start()))?;
    m.add("slide", point_on_line(r, Ground, r.end(), frame.point(0.0, offset), vec2(1.0, 0.0)))?;
    m.add("motor", drive_angle(c, law))?;
    m.prefer(c.theta(), start);
    let tilt = ((offset - crank * start.sin()) / rod).clamp(-1.0, 1.0).asin();
    let phi = if up { tilt } else { PI - tilt };
    let x = crank * start.cos();
    let y = crank * start.sin();
    let u = x + 0.5 * rod * phi.cos();
    let v = y + 0.5 * rod * phi.sin();
    m.set_initial(&[frame.at(0.5 * x), frame.at(0.5 * y), start, frame.at(u), frame.at(v), phi])?;
    m.build()
}

/// A four-bar, and what it carries: nothing, a second one that is its mirror image, or a dyad on
/// its coupler.
fn four_bar(
    [a, b, c, d]: [f64; 4],
    law: Law,
    by_coupler: bool,
    carried: Option<Option<[f64; 4]>>,
    frame: Frame,
) -> kin::Result<System> {
    let mut m = Mechanism::new("four-bar");
    let (p, q, r) = {
        let link = |m: &mut Mechanism, name: &str, length: f64| m.link(name, frame.length(length));
        (link(&mut m, "crank", a)?, link(&mut m, "coupler", b)?, link(&mut m, "rocker", c)?)
    };
    m.add("O", revolute(Ground, p, frame.point(0.0, 0.0), p.start()))?;
    m.add("A", revolute(p, q, p.end(), q.start()))?;
    m.add("B", revolute(q, r, q.end(), r.end()))?;
    m.add("C", revolute(r, Ground, r.start(), frame.point(d, 0.0)))?;
    m.prefer(r.theta(), 1.0);
    match carried {
        None => {}
        Some(None) => {
            let q = m.link("coupler 2", frame.length(b))?;
            let r = m.link("rocker 2", frame.length(c))?;
            m.add("A2", revolute(p, q, p.end(), q.start()))?;
            m.add("B2", revolute(q, r, q.end(), r.end()))?;
            m.add("C2", revolute(r, Ground, r.start(), frame.point(d, 0.0)))?;
            m.prefer(r.theta(), -1.0);
        }
        Some(Some([bar, output, above, beside])) => {
            let u = m.link("bar", frame.length(bar))?;
            let v = m.link("output", frame.length(output))?;
            m.add("D", revolute(q, u, frame.vector(0.0, above), u.start()))?;
            m.add("E", revolute(u, v, u.end(), v.end()))?;
            m.add("F", revolute(v, Ground, v.start(), frame.point(beside, -0.5)))?;
        }
    }
    m.add("motor", drive_angle(if by_coupler { q } else { p }, law))?;
    m.build()
}

fn five_bar(
    [a, b]: [f64; 2],
    [c, d]: [f64; 2],
    ground: f64,
    (ratio, phase): (f64, f64),
    law: Law,
    frame: Frame,
) -> kin::Result<System> {
    let mut m = Mechanism::new("geared five-bar");
    let mut link = |name: &str, length: f64| m.link(name, frame.length(length));
    let p = link("crank 1", a)?;
    let q = link("crank 2", b)?;
    let u = link("bar 1", c)?;
    let v = link("bar 2", d)?;
    m.add("O", revolute(Ground, p, frame.point(0.0, 0.0), p.start()))?;
    m.add("Q", revolute(Ground, q, frame.point(ground, 0.0), q.start()))?;
    m.add("A", revolute(p, u, p.end(), u.start()))?;
    m.add("B", revolute(q, v, q.end(), v.start()))?;
    m.add("P", revolute(u, v, u.end(), v.end()))?;
    m.add("gears", coupling(p.theta(), q.theta(), ratio, -1.0, phase))?;
    m.add("motor", drive_angle(p, law))?;
    m.build()
}

fn cylinder([b, c]: [f64; 2], law: Law, frame: Frame) -> kin::Result<System> {
    let mut m = Mechanism::new("cylinder");
    let (p, q, r) = {
        let mut link = |name: &str, length: f64| m.link(name, frame.length(length));
        (link("boom", 1.0)?, link("bar", b)?, link("arm", c)?)
    };
    m.add("O", revolute(Ground, p, frame.point(0.0, 0.0), p.start()))?;
    m.add(
        "cylinder",
        drive_distance(p, Ground, p.end(), frame.point(2.0, 0.0), law * frame.scale),
    )?;
    m.add("A", revolute(p, q, p.end(), q.start()))?;
    m.add("B", revolute(q, r, q.end(), r.end()))?;
    m.add("C", revolute(r, Ground, r.start(), frame.point(2.0, 0.3)))?;
    m.prefer(p.theta(), 1.0);
    m.build()
}

fn cam([rise, offset]: [f64; 2], kink: bool, law: Law, frame: Frame) -> kin::Result<System> {
    let mut m = Mechanism::new("cam");
    let (c, f) = {
        let beside = pose(frame.at(offset), frame.at(1.0), 0.0);
        (m.planar("cam", pose(frame.at(0.0), frame.at(0.0), 0.0))?, m.planar("follower", beside)?)
    };
    let profile = if kink {
        let steep = 0.3 * rise;
        Law::sequence(
            -PI,
            [(PI, Law::linear(1.0, steep)), (PI, Law::linear(1.0 + steep * PI, -steep))],
        )
    } else {
        Law::fourier(1.0, 1.0, &[(rise, 0.3 * rise), (0.2 * rise, 0.0)])
    };
    m.add("O", revolute(Ground, c, frame.point(0.0, 0.0), vec2(0.0, 0.0)))?;
    m.add(
        "guide",
        prismatic(f, Ground, vec2(0.0, 0.0), frame.point(offset, 0.0), vec2(1.0, 0.0), 0.0),
    )?;
    m.add("contact", cam_knife_edge(c, f, vec2(0.0, 0.0), profile * frame.scale))?;
    m.add("motor", drive_angle(c, law))?;
    m.build()
}

fn rssr(
    lengths: [f64; 3],
    [centre, axis]: [Vec3; 2],
    law: Law,
    frame: Frame,
) -> kin::Result<System> {
    let mut m = Mechanism::new("RSSR");
    let [crank, rod, rocker] = lengths.map(|length| frame.length(length));
    let zero = vec3(0.0, 0.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    let origin = frame.point_in_space(zero);
    let centre = frame.point_in_space(centre);
    let c = m.spatial("crank", SpatialPose::at(origin))?;
    let r = m.spatial("rocker", SpatialPose::at(centre))?;
    m.add("O", spatial::revolute(c, Ground, zero, origin, z, z))?;
    m.add("Q", spatial::revolute(r, Ground, zero, centre, z, axis))?;
    m.add("rod", spatial::distance(c, r, vec3(crank, 0.0, 0.0), vec3(rocker, 0.0, 0.0), rod))?;
    m.add("motor", spatial::drive_turn(c, Ground, z, z, law))?;
    m.build()
}

/// Crank, rod and offset.
fn near_equal_slider_crank(random: &mut Random) -> [f64; 3] {
    let excess = random.one_of(&[1e-1, 1e-3, 1e-6, 1e-9, -1e-3]);
    [1.0, 1.0 + excess, random.one_of(&[0.0, 0.0, 1e-6, 0.1])]
}

/// Crank, coupler, rocker and ground.
fn parallelogram_but_for_its_coupler(random: &mut Random) -> [f64; 4] {
    [1.0, 2.0 + random.one_of(&[1e-3, 1e-4, 1e-6, -1e-6, 1e-9, -1e-9]), 1.0, 2.0]
}

/// The law that drives a mechanism, and the side on which it begins.
fn drawn(family: usize, random: &mut Random) -> (Law, bool) {
    let law = if family == 7 { random.law(1.05, 2.9) } else { random.law(-1e9, 1e9) };
    (law, random.0.bool())
}

/// By how much the lengths of that mechanism, in units of its size, are off those at which all
/// links come to lie in line: less than this change decides whether it has a toggle, a change point
/// or neither.
#[allow(dead_code)]
pub fn margin(family: usize, random: &mut Random) -> f64 {
    drawn(family, random);
    match family {
        0 => {
            let [crank, rod, offset] = near_equal_slider_crank(random);
            (rod - crank - offset).abs().min((rod - crank + offset).abs())
        }
        2 => {
            let [_, coupler, _, ground] = parallelogram_but_for_its_coupler(random);
            (coupler - ground).abs()
        }
        _ => f64::INFINITY,
    }
}

pub fn system(family: usize, random: &mut Random, frame: Frame) -> kin::Result<System> {
    let (law, up) = drawn(family, random);
    let law = frame.in_time(law);
    match family {
        0 => slider_crank(near_equal_slider_crank(random), law, up, frame),
        1 => {
            let [rod, offset, crank] =
                [random.within(0.3, 2.0), random.within(-0.5, 0.5), random.within(0.3, 2.0)];
            slider_crank([crank, rod, offset], law, up, frame)
        }
        2 => four_bar(parallelogram_but_for_its_coupler(random), law, false, None, frame),
        3 => four_bar(random.lengths(0.3, 2.0), law, true, None, frame),
        4 => {
            let bars = random.lengths::<3>(1.0, 3.0);
            let [a, b] = random.lengths(0.5, 3.0);
            let dyad = [a, b, random.within(-1.0, 1.0), random.within(-2.0, 4.0)];
            let lengths = [random.within(0.3, 1.0), bars[0], bars[1], bars[2]];
            four_bar(lengths, law, false, Some(Some(dyad)), frame)
        }
        5 => four_bar(random.lengths(0.3, 2.0), law, false, Some(None), frame),
        6 => {
            let gears = (random.one_of(&[1.0, -1.0, 2.0, -0.5]), random.within(-1.0, 1.0));
            five_bar(
                random.lengths(0.3, 1.0),
                random.lengths(0.8, 2.5),
                random.within(0.5, 2.0),
                gears,
                law,
                frame,
            )
        }
        7 => cylinder(random.lengths(0.5, 2.0), law, frame),
        8 => {
            let sizes = [random.within(0.01, 0.6), random.one_of(&[0.0, 0.2, -0.4])];
            cam(sizes, up, law, frame)
        }
        _ => {
            let [x, y, z] = random.lengths(-2.0, 2.0);
            let axis = Vec3::from(random.lengths::<3>(-1.0, 1.0)).normalize();
            rssr(
                [random.within(0.2, 1.5), random.within(0.5, 4.0), random.within(0.3, 2.0)],
                [vec3(x, y, z), axis],
                law,
                frame,
            )
        }
    }
}

/// A parallelogram but for its coupler, which is off by 1e-12 to 1e-6, and by how much.
#[allow(dead_code)]
pub fn near_parallelogram(random: &mut Random, frame: Frame) -> kin::Result<(System, f64)> {
    let law = random.law(-1e9, 1e9);
    let off = random.one_of(&[1.0, -1.0]) * 10.0_f64.powf(random.within(-12.0, -6.0));
    Ok((off_by(off, law, frame)?, off))
}

/// A parallelogram but for its coupler, which is off by so much.
#[allow(dead_code)]
pub fn parallelogram_off_by(random: &mut Random, off: f64, frame: Frame) -> kin::Result<System> {
    let law = random.law(-1e9, 1e9);
    off_by(off, law, frame)
}

fn off_by(off: f64, law: Law, frame: Frame) -> kin::Result<System> {
    let law = frame.in_time(law);
    four_bar([1.0, 2.0 + off, 1.0, 2.0], law, false, None, frame)
}
