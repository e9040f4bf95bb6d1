//! The same motion on a coarse and on a fine grid: ten families of mechanisms under six kinds of laws.

use kin::Error;
use kin::prelude::*;

use crate::engines::Engines;

/// How many pairs a test run takes; `KIN_CAMPAIGN=1000` is the whole campaign, for a release build.
fn count() -> usize {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(60)
}

/// Steps of the fine grid, a multiple of those of the coarse ones.
fn fine() -> usize {
    if count() < 1000 { 360 } else { 1980 }
}

/// Of each so many motions on the fine grid one is proved.
const PROVED: usize = 10;

#[law]
fn bump(x: f64, base: f64, height: f64, at: f64, width: f64) -> f64 {
    base + height * (-((x - at) / width).powi(2)).exp()
}

#[law]
fn pulses(x: f64, base: f64, height: f64, omega: f64) -> f64 {
    base + height * (omega * x).sin().powi(4)
}

struct Random(fastrand::Rng);

impl Random {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.0.usize(0..all.len())]
    }

    fn lengths<const N: usize>(&mut self, low: f64, high: f64) -> [f64; N] {
        [0; N].map(|_| self.within(low, high))
    }

    /// A law over one second: one way, out and back once or many times, or both ways.
    fn law(&mut self, low: f64, high: f64) -> Law {
        let unbounded = high - low > 100.0;
        let start = if unbounded { self.within(0.0, TAU) } else { self.within(low, high) };
        let far = if unbounded { self.within(0.5, 5.0) } else { self.within(0.2, 1.0) * (high - low) };
        match self.0.usize(0..6) {
            0 if unbounded => Law::linear(start, self.one_of(&[TAU, -TAU])),
            0 | 1 => bump(start, far, self.within(0.3, 0.7), self.within(0.05, 0.2)),
            2 => pulses(start, far, PI * self.one_of(&[9.0, 10.0, 18.0])),
            3 => Law::constant(start) + Law::sine(far, TAU * self.one_of(&[1.0, 2.0, 9.0]), 0.0),
            4 => Law::constant(start) + Law::sine(far, 3.0, 0.3),
            _ => {
                let (begin, length) = (self.within(0.0, 0.2), self.within(0.05, 0.4));
                let (out, back) =
                    (Law::cycloidal(far, length), Law::constant(start + far) - Law::cycloidal(far, length));
                Law::sequence(begin, [(length, Law::constant(start) + out), (length, back)])
            }
        }
    }
}

const FAMILIES: [&str; 10] = [
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

fn slider_crank(rod: f64, offset: f64, crank: f64, law: Law, up: bool) -> kin::Result<System> {
    let mut m = Mechanism::new("slider-crank");
    let (c, r) = (m.link("crank", crank)?, m.link("rod", rod)?);
    let start = law.at(0.0);
    m.add("O", revolute(Ground, c, vec2(0.0, 0.0), c.start()))?;
    m.add("A", revolute(c, r, c.end(), r.start()))?;
    m.add("slide", point_on_line(r, Ground, r.end(), vec2(0.0, offset), vec2(1.0, 0.0)))?;
    m.add("motor", drive_angle(c, law))?;
    m.prefer(c.theta(), start);
    let tilt = ((offset - crank * start.sin()) / rod).clamp(-1.0, 1.0).asin();
    let phi = if up { tilt } else { PI - tilt };
    let (x, y) = (crank * start.cos(), crank * start.sin());
    m.set_initial(&[0.5 * x, 0.5 * y, start, x + 0.5 * rod * phi.cos(), y + 0.5 * rod * phi.sin(), phi])?;
    m.build()
}

/// A four-bar, and what it carries: nothing, a second one that is its mirror image, or a dyad on its coupler.
fn four_bar(
    [a, b, c, d]: [f64; 4],
    law: Law,
    by_coupler: bool,
    carried: Option<Option<[f64; 4]>>,
) -> kin::Result<System> {
    let mut m = Mechanism::new("four-bar");
    let (p, q, r) = (m.link("crank", a)?, m.link("coupler", b)?, m.link("rocker", c)?);
    m.add("O", revolute(Ground, p, vec2(0.0, 0.0), p.start()))?;
    m.add("A", revolute(p, q, p.end(), q.start()))?;
    m.add("B", revolute(q, r, q.end(), r.end()))?;
    m.add("C", revolute(r, Ground, r.start(), vec2(d, 0.0)))?;
    m.prefer(r.theta(), 1.0);
    match carried {
        None => {}
        Some(None) => {
            let (q, r) = (m.link("coupler 2", b)?, m.link("rocker 2", c)?);
            m.add("A2", revolute(p, q, p.end(), q.start()))?;
            m.add("B2", revolute(q, r, q.end(), r.end()))?;
            m.add("C2", revolute(r, Ground, r.start(), vec2(d, 0.0)))?;
            m.prefer(r.theta(), -1.0);
        }
        Some(Some([bar, output, above, beside])) => {
            let (u, v) = (m.link("bar", bar)?, m.link("output", output)?);
            m.add("D", revolute(q, u, vec2(0.0, above), u.start()))?;
            m.add("E", revolute(u, v, u.end(), v.end()))?;
            m.add("F", revolute(v, Ground, v.start(), vec2(beside, -0.5)))?;
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
) -> kin::Result<System> {
    let mut m = Mechanism::new("geared five-bar");
    let (p, q, u, v) =
        (m.link("crank 1", a)?, m.link("crank 2", b)?, m.link("bar 1", c)?, m.link("bar 2", d)?);
    m.add("O", revolute(Ground, p, vec2(0.0, 0.0), p.start()))?;
    m.add("Q", revolute(Ground, q, vec2(ground, 0.0), q.start()))?;
    m.add("A", revolute(p, u, p.end(), u.start()))?;
    m.add("B", revolute(q, v, q.end(), v.start()))?;
    m.add("P", revolute(u, v, u.end(), v.end()))?;
    m.add("gears", coupling(p.theta(), q.theta(), ratio, -1.0, phase))?;
    m.add("motor", drive_angle(p, law))?;
    m.build()
}

fn cylinder([b, c]: [f64; 2], law: Law) -> kin::Result<System> {
    let mut m = Mechanism::new("cylinder");
    let (p, q, r) = (m.link("boom", 1.0)?, m.link("bar", b)?, m.link("arm", c)?);
    m.add("O", revolute(Ground, p, vec2(0.0, 0.0), p.start()))?;
    m.add("cylinder", drive_distance(p, Ground, p.end(), vec2(2.0, 0.0), law))?;
    m.add("A", revolute(p, q, p.end(), q.start()))?;
    m.add("B", revolute(q, r, q.end(), r.end()))?;
    m.add("C", revolute(r, Ground, r.start(), vec2(2.0, 0.3)))?;
    m.prefer(p.theta(), 1.0);
    m.build()
}

fn cam(rise: f64, offset: f64, kink: bool, law: Law) -> kin::Result<System> {
    let mut m = Mechanism::new("cam");
    let (c, f) = (m.planar("cam", pose(0.0, 0.0, 0.0))?, m.planar("follower", pose(offset, 1.0, 0.0))?);
    let profile = if kink {
        let steep = 0.3 * rise;
        Law::sequence(-PI, [(PI, Law::linear(1.0, steep)), (PI, Law::linear(1.0 + steep * PI, -steep))])
    } else {
        Law::fourier(1.0, 1.0, &[(rise, 0.3 * rise), (0.2 * rise, 0.0)])
    };
    m.add("O", revolute(Ground, c, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    m.add("guide", prismatic(f, Ground, vec2(0.0, 0.0), vec2(offset, 0.0), vec2(1.0, 0.0), 0.0))?;
    m.add("contact", cam_knife_edge(c, f, vec2(0.0, 0.0), profile))?;
    m.add("motor", drive_angle(c, law))?;
    m.build()
}

fn rssr([crank, rod, rocker]: [f64; 3], centre: Vec3, axis: Vec3, law: Law) -> kin::Result<System> {
    let mut m = Mechanism::new("RSSR");
    let (zero, z) = (vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0));
    let (c, r) = (m.spatial("crank", SpatialPose::at(zero))?, m.spatial("rocker", SpatialPose::at(centre))?);
    m.add("O", spatial::revolute(c, Ground, zero, zero, z, z))?;
    m.add("Q", spatial::revolute(r, Ground, zero, centre, z, axis))?;
    m.add("rod", spatial::distance(c, r, vec3(crank, 0.0, 0.0), vec3(rocker, 0.0, 0.0), rod))?;
    m.add("motor", spatial::drive_turn(c, Ground, z, z, law))?;
    m.build()
}

fn system(family: usize, random: &mut Random) -> kin::Result<System> {
    let law = if family == 7 { random.law(1.05, 2.9) } else { random.law(-1e9, 1e9) };
    let up = random.0.bool();
    match family {
        0 => {
            let excess = random.one_of(&[1e-1, 1e-3, 1e-6, 1e-9, -1e-3]);
            slider_crank(1.0 + excess, random.one_of(&[0.0, 0.0, 1e-6, 0.1]), 1.0, law, up)
        }
        1 => {
            slider_crank(random.within(0.3, 2.0), random.within(-0.5, 0.5), random.within(0.3, 2.0), law, up)
        }
        2 => four_bar(
            [1.0, 2.0 + random.one_of(&[1e-3, 1e-4, 1e-6, -1e-6, 1e-9, -1e-9]), 1.0, 2.0],
            law,
            false,
            None,
        ),
        3 => four_bar(random.lengths(0.3, 2.0), law, true, None),
        4 => {
            let (bars, [a, b]) = (random.lengths::<3>(1.0, 3.0), random.lengths(0.5, 3.0));
            let dyad = [a, b, random.within(-1.0, 1.0), random.within(-2.0, 4.0)];
            four_bar([random.within(0.3, 1.0), bars[0], bars[1], bars[2]], law, false, Some(Some(dyad)))
        }
        5 => four_bar(random.lengths(0.3, 2.0), law, false, Some(None)),
        6 => {
            let gears = (random.one_of(&[1.0, -1.0, 2.0, -0.5]), random.within(-1.0, 1.0));
            five_bar(random.lengths(0.3, 1.0), random.lengths(0.8, 2.5), random.within(0.5, 2.0), gears, law)
        }
        7 => cylinder(random.lengths(0.5, 2.0), law),
        8 => cam(random.within(0.01, 0.6), random.one_of(&[0.0, 0.2, -0.4]), up, law),
        _ => {
            let [x, y, z] = random.lengths(-2.0, 2.0);
            let axis = Vec3::from(random.lengths::<3>(-1.0, 1.0)).normalize();
            rssr(
                [random.within(0.2, 1.5), random.within(0.5, 4.0), random.within(0.3, 2.0)],
                vec3(x, y, z),
                axis,
                law,
            )
        }
    }
}

/// The findings about a pair.
#[derive(Default, Debug)]
struct Tally {
    moved: usize,
    toggles: usize,
    proved: usize,
    refused: Vec<String>,
}

/// Both grids must give the same motion, or end in the same toggle; the fine one by a program.
fn compare(system: &System, steps: usize, name: &str, tally: &mut Tally) {
    let each = fine() / steps;
    let fine_times = linspace(0.0, 1.0, steps * each + 1);
    let coarse_times: Vec<f64> = fine_times.iter().step_by(each).copied().collect();
    let (coarse, fine) = (system.run_both(&coarse_times), system.run_compiled(&fine_times));
    let error = |coarse: &Motion, fine: &Motion| {
        let off = |k: usize| {
            coarse.q(k).iter().zip(fine.q(k * each)).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
        };
        (0..coarse.len()).map(off).fold(0.0, f64::max)
    };
    match (&coarse, &fine) {
        (Ok(coarse), Ok(fine)) => {
            assert!(error(coarse, fine) < 1e-6, "{name}: apart by {:e}", error(coarse, fine));
            tally.moved += 1;
            if tally.moved.is_multiple_of(PROVED) {
                tally.proved += usize::from(system.prove(fine).is_ok_and(|proof| proof.is_complete()));
            }
        }
        (Err(Error::Toggle { t, .. }), Err(Error::Toggle { t: expected, .. })) => {
            assert!((t - expected).abs() < 1e-6, "{name}: {t} {expected}");
            tally.toggles += 1;
        }
        (Err(error), Ok(_)) => {
            let finer: Vec<f64> = linspace(0.0, 1.0, 2 * steps + 1).to_vec();
            assert!(error.to_string().contains("t = ") && system.run_both(&finer).is_ok(), "{name}: {error}");
            tally.refused.push(format!("{name}: {error}"));
        }
        (Ok(_), Err(error)) => panic!("{name}: passed in silence: {error}"),
        (Err(coarse), Err(fine)) => panic!("{name}: ends that differ: {coarse} {fine}"),
    }
}

#[test]
fn pairs_of_coarse_and_fine_grids_give_the_same_motion_or_the_same_end() {
    let (mut tally, mut tried, mut number) = (Tally::default(), 0, 0);
    let mut of_family = [0; FAMILIES.len()];
    while tried < count() {
        let (family, mut random) =
            (number % FAMILIES.len(), Random(fastrand::Rng::with_seed(0x5eed ^ number as u64)));
        number += 1;
        let Ok(mut system) = system(family, &mut random) else { continue };
        // Parts that do not go together are no motion.
        let Ok(first) = system.position(0.0) else { continue };
        if system.set_initial(&first.q).is_err() {
            continue;
        }
        tried += 1;
        of_family[family] += 1;
        let steps = random.one_of(&[1, 3, 5, 9, 10, 36]);
        compare(
            &system,
            steps,
            &format!("number {}, {} in {steps} steps", number - 1, FAMILIES[family]),
            &mut tally,
        );
    }
    println!(
        "{tried} pairs: {} motions, {} toggles, refused: {:#?}",
        tally.moved, tally.toggles, tally.refused
    );
    assert!(tally.refused.len() <= 2 * tried / 1000, "{:#?}", tally.refused);
    assert!(
        tally.moved > tried / 5
            && tally.toggles > tried / 10
            && of_family.iter().all(|pairs| *pairs >= tried / 40)
    );
    // Of a few the share says nothing.
    let asked = tally.moved / PROVED;
    assert!(asked < 8 || 2 * tally.proved >= asked, "{} of {asked} proved", tally.proved);
}
