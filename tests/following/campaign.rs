//! Random mechanisms on coarse grids, each against its closed form: on its branch all the way, or
//! stopped at its toggle.

use kin::Error;
use kin::error::{FailureKind, RunFailure};
use kin::prelude::*;

use crate::engines::Engines;
use crate::models::FourBar;

/// How many planar ones a test run takes, and ten times as many as spatial ones;
/// `KIN_CAMPAIGN=10000` is the whole campaign, for a release build.
fn count() -> usize {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(200)
}

struct Random(fastrand::Rng);

impl Random {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    fn sign(&mut self) -> f64 {
        if self.0.bool() { 1.0 } else { -1.0 }
    }
}

/// The time of a toggle that ends a run, and the motion before it.
fn toggle(error: &Error) -> Option<(f64, Option<&Motion>)> {
    match error.failure()? {
        RunFailure { t, kind: FailureKind::Toggle { .. }, motion, .. } => {
            Some((*t, motion.as_ref()))
        }
        _ => None,
    }
}

/// A run of `turns` turns on a grid of `per_turn` times each, by both engines, must end where the
/// closed form says, and be right at each time: `end` is the time of the toggle, `error` how far q
/// is from the branch.
fn judge(
    system: &System,
    times: &[f64],
    end: Option<f64>,
    error: impl Fn(&Motion, usize) -> f64,
    name: &str,
) -> bool {
    let last = times[times.len() - 1];
    let result = system.run_both(times);
    let end_within = end.filter(|end| *end < last);
    let motion = match (result.as_ref().map_err(toggle), end_within) {
        (Ok(motion), None) => motion,
        (Err(Some((t, Some(motion)))), Some(end)) => {
            assert!((t - end).abs() < 1e-8, "{name}: toggle found at {t}, expected at {end}");
            motion
        }
        (Err(Some((_, None))), Some(end)) if end < times[1] => return true,
        (Ok(_), Some(end)) => panic!("{name}: a run beyond its toggle at {end}"),
        (Err(_), end) => panic!("{name}: toggle at {end:?}: {result:?}"),
    };
    assert_eq!(
        motion.len(),
        times.iter().filter(|t| end.is_none_or(|end| **t < end)).count(),
        "{name}"
    );
    for k in 0..motion.len() {
        let error = error(motion, k);
        // At the toggle itself q is known to the root of rounding.
        let near = end.map_or(1.0, |end| (end - motion.times()[k]).abs().sqrt().min(1.0));
        assert!(
            error < 1e-10 / near.max(1e-6),
            "{name}: t = {}, off by {error:e}",
            motion.times()[k]
        );
    }
    end.is_some()
}

#[test]
fn random_four_bars_stay_on_their_branch_or_stop_at_their_toggle() {
    let mut random = Random(fastrand::Rng::with_seed(20_240_607));
    let mut tried = 0;
    let mut toggles = 0;
    while tried < count() {
        let mut length = || random.within(0.3, 3.0);
        let driven = length();
        let next = length();
        let last = length();
        let ground = length();
        let bar = FourBar { driven, next, last, ground, by_coupler: random.0.bool() };
        let start = random.within(0.0, TAU);
        let side = random.sign();
        let sense = random.sign();
        let end = bar.toggle(start, sense).map(|angle| sense * (angle - start) / TAU);
        if bar.angles(start, side).is_none() || end.is_some_and(|end| end < 1e-3) {
            continue;
        }
        tried += 1;
        let per_turn = random.0.usize(7..40);
        let (system, _) = bar.system(Law::linear(start, sense * TAU), start, side).unwrap();
        let times = linspace(0.0, 2.0, 2 * per_turn + 1);
        let name = format!(
            "number {tried}, {bar:?} from {start} to {sense} on side {side}, {per_turn} a turn"
        );
        toggles += usize::from(judge(
            &system,
            &times,
            end,
            |motion, k| bar.error(motion.q(k), side),
            &name,
        ));
    }
    println!("{tried} four-bars, {toggles} of them end in a toggle");
    assert!(toggles > tried / 5 && toggles < tried * 4 / 5);
}

/// A crank about z and a rocker about any axis, with a rod between them that has a ball at either
/// end; or the rod is driven, as a cylinder.
struct Rssr {
    crank: f64,
    rod: f64,
    rocker: f64,
    centre: Vec3,
    axes: Mat3,
}

impl Rssr {
    fn random(random: &mut Random) -> Self {
        let mut vector =
            || vec3(random.within(-1.0, 1.0), random.within(-1.0, 1.0), random.within(-1.0, 1.0));
        let axis = vector().normalize();
        let centre = vector() * 3.0;
        let other = vector();
        let e1 = other.cross(axis).normalize();
        let axes = Mat3::from_columns([e1, axis.cross(e1), axis]);
        Rssr {
            crank: random.within(0.2, 2.0),
            rod: random.within(0.5, 5.0),
            rocker: random.within(0.3, 3.0),
            centre,
            axes,
        }
    }

    /// A cos ψ + B sin ψ = K
    fn equation(&self, theta: f64, rod: f64) -> [f64; 3] {
        let d = vec3(self.crank * theta.cos(), self.crank * theta.sin(), 0.0) - self.centre;
        let along = self.axes.transpose() * d;
        let k = (d.norm_squared() + self.rocker * self.rocker - rod * rod) / (2.0 * self.rocker);
        [along.x, along.y, k]
    }

    /// How far the two solutions are from one another, as the square of half the sine of their
    /// distance; none where that is below zero.
    fn room(&self, theta: f64, rod: f64) -> f64 {
        let [a, b, k] = self.equation(theta, rod);
        1.0 - k * k / (a * a + b * b)
    }

    fn psi(&self, theta: f64, rod: f64, side: f64) -> f64 {
        let [a, b, k] = self.equation(theta, rod);
        b.atan2(a) + side * (k / a.hypot(b)).acos()
    }

    fn system(
        &self,
        theta: Law,
        rod: Law,
        start: (f64, f64),
    ) -> kin::Result<(System, SpatialBody)> {
        let mut m = Mechanism::new("RSSR");
        let about = |angle: f64| EulerParameters::from_axis_angle(Vec3::z(), angle);
        let crank =
            m.spatial("crank", SpatialPose { r: vec3(0.0, 0.0, 0.0), p: about(start.0) })?;
        let rocker = m.spatial(
            "rocker",
            SpatialPose {
                r: self.centre,
                p: EulerParameters::from_rotation(self.axes).product(about(start.1)),
            },
        )?;
        let zero = vec3(0.0, 0.0, 0.0);
        let axis = self.axes * Vec3::z();
        m.add("bearing", spatial::revolute(crank, Ground, zero, zero, Vec3::z(), Vec3::z()))?;
        m.add("pivot", spatial::revolute(rocker, Ground, zero, self.centre, Vec3::z(), axis))?;
        m.add("motor", spatial::drive_turn(crank, Ground, Vec3::z(), Vec3::z(), theta))?;
        m.add(
            "rod",
            spatial::drive_distance(
                crank,
                rocker,
                vec3(self.crank, 0.0, 0.0),
                vec3(self.rocker, 0.0, 0.0),
                rod,
            ),
        )?;
        Ok((m.build()?, rocker))
    }
}

/// The first zero of a function that begins above zero, on a fine grid and then by halving.
fn first_zero(end: f64, f: impl Fn(f64) -> f64) -> Option<f64> {
    const POINTS: usize = 20_000;
    let at = |k: usize| end * k as f64 / POINTS as f64;
    let k = (1..=POINTS).find(|k| f(at(*k)) < 0.0)?;
    let mut low = at(k - 1);
    let mut high = at(k);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { high = middle } else { low = middle }
    }
    Some(low)
}

#[test]
fn random_spatial_four_bars_stay_on_their_branch_or_stop_at_their_toggle() {
    let mut random = Random(fastrand::Rng::with_seed(7));
    let mut tried = 0;
    let mut toggles = 0;
    while tried < count() / 10 {
        let bar = Rssr::random(&mut random);
        let start = random.within(0.0, TAU);
        let side = random.sign();
        let speed = random.sign();
        let room = bar.room(start, bar.rod);
        if room.is_nan() || room <= 1e-3 {
            continue;
        }
        tried += 1;
        let by_rod = tried % 3 == 0;
        let (turn, slide) = if by_rod { (0.0, 0.8 * speed) } else { (TAU * speed, 0.0) };
        let end = if by_rod { 0.9 * bar.rod } else { 2.0 };
        let at = |t: f64| (start + turn * t, bar.rod + slide * t);
        let stop = first_zero(end, |t| bar.room(at(t).0, at(t).1));
        let psi = bar.psi(start, bar.rod, side);
        let (system, rocker) = bar
            .system(Law::linear(start, turn), Law::linear(bar.rod, slide), (start, psi))
            .unwrap();
        let tip = vec3(bar.rocker, 0.0, 0.0);
        let error = |motion: &Motion, k: usize| {
            let (theta, rod) = at(motion.times()[k]);
            let psi = bar.psi(theta, rod, side);
            let expected = bar.centre + bar.axes * (vec3(psi.cos(), psi.sin(), 0.0) * bar.rocker);
            let q = &motion.q(k)[7..14];
            let p = EulerParameters::new(q[3], q[4], q[5], q[6]);
            (vec3(q[0], q[1], q[2]) + p.rotation() * tip - expected).norm()
        };
        let points = random.0.usize(15..80);
        let name =
            format!("number {tried}, {start} {side} {speed}, {points} points, by rod: {by_rod}");
        let _ = rocker;
        toggles += usize::from(judge(&system, &linspace(0.0, end, points), stop, error, &name));
    }
    println!("{tried} spatial four-bars, {toggles} of them end in a toggle");
    assert!(toggles > tried / 5);
}

/// A Stewart platform whose legs swing far, each in its own time; it has up to forty assemblies,
/// and toggles.
fn stewart(random: &mut Random) -> kin::Result<System> {
    let corner = |k: usize, size: f64, spread: f64| {
        let angle = TAU * (k / 2) as f64 / 3.0 + if k.is_multiple_of(2) { -spread } else { spread };
        vec3(size * angle.cos(), size * angle.sin(), 0.0)
    };
    let mut m = Mechanism::new("Stewart platform");
    let platform = m.spatial("platform", SpatialPose::at(vec3(0.0, 0.0, 1.0)))?;
    for k in 0..6 {
        let p = corner(k, 0.5, PI / 4.0);
        let b = corner(k, 1.0, PI / 12.0);
        let length = (p + vec3(0.0, 0.0, 1.0) - b).norm();
        let phase = random.within(0.0, TAU);
        let law = Law::sine(random.within(0.05, 0.2), random.within(0.5, 1.5), phase);
        let offset = Law::constant(length - law.at(0.0));
        m.add(&format!("leg {k}"), spatial::drive_distance(platform, Ground, p, b, law + offset))?;
    }
    m.build()
}

/// Where there is no closed form, a grid that is fifty times finer, by a program: the same motion,
/// or the same toggle.
#[test]
fn random_stewart_platforms_move_alike_on_coarse_and_fine_grids() {
    let mut random = Random(fastrand::Rng::with_seed(3));
    let all = count() / 20;
    let mut toggles = 0;
    for number in 0..all {
        let system = stewart(&mut random).unwrap();
        let points = random.0.usize(8..20);
        let coarse = system.run_both(linspace(0.0, 8.0, points + 1));
        let fine = system.run_compiled(linspace(0.0, 8.0, 50 * points + 1));
        let ends = [&coarse, &fine].map(|run| run.as_ref().map_err(toggle));
        let (coarse, fine) = match ends {
            [Ok(coarse), Ok(fine)] => (coarse, fine),
            [Err(Some((t, Some(one)))), Err(Some((other, Some(two))))] => {
                assert!((t - other).abs() < 1e-9, "{number}: {t} {other}");
                toggles += 1;
                (one, two)
            }
            _ => panic!("{number}, {points} points: {coarse:?} {fine:?}"),
        };
        for k in 0..coarse.len() {
            let error = coarse
                .q(k)
                .iter()
                .zip(fine.q(50 * k))
                .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            assert!(error < 1e-9, "{number}, {points} points, {k}: {error:e}");
        }
    }
    println!("{all} Stewart platforms, {toggles} of them end in a toggle");
    assert!(toggles < all);
}
