//! States of bodies and bare coordinates: evaluated once an iterate, each in one place where all
//! constraints read it.

use crate::model::coordinates::{Target, Trig};
use crate::model::layout::Place;
use crate::model::state::{
    COORD_STATE, CoordState, Offsets, PLANAR_STATE, PlanarState, SPATIAL_STATE, SpatialState,
};

/// Where states stand, which coordinates make them up, and who reads which.
#[derive(Clone, Debug, Default)]
pub(crate) struct StatePlan {
    /// First coordinate of each body, and where its state begins.
    planar: Vec<[u32; 2]>,
    spatial: Vec<[u32; 2]>,
    coords: Vec<Coord>,
    /// The states where all coordinates are zero; those of the ground are there for good.
    origin: Vec<f64>,
    /// Of every argument of every constraint, where its state and where its rates begin.
    arguments: Vec<Offsets>,
    /// Where the ground's rates begin: after those of all coordinates.
    ground: u32,
}

/// A bare coordinate.
#[derive(Clone, Copy, Debug)]
struct Coord {
    coordinate: u32,
    begin: u32,
    /// Used where some constraint reads its sine or cosine.
    trig: Trig,
}

/// Where coordinates stand, while arguments are planned.
pub(super) struct Planned {
    /// Where the state of the body that begins with a coordinate begins.
    bodies: Vec<Option<u32>>,
    /// Which one of the bare coordinates a coordinate is.
    coords: Vec<Option<u32>>,
    /// The coordinate behind each column of the constraint in hand; `None` on the ground.
    pub columns: Vec<Option<usize>>,
}

impl Planned {
    /// An empty plan of n coordinates.
    pub(super) fn new(n: usize) -> Self {
        Planned { bodies: vec![None; n], coords: vec![None; n], columns: Vec::new() }
    }
}

impl StatePlan {
    /// A plan for n coordinates.
    pub(super) fn new(n: usize) -> Self {
        StatePlan { ground: n as u32, ..StatePlan::default() }
    }

    /// Plans for one more argument.
    pub(super) fn argument(&mut self, target: &Target, place: Place, planned: &mut Planned) {
        let argument = match place {
            Place::Own { first, .. } => {
                Offsets::new(self.own(target, first, planned), first as u32)
            }
            Place::Ground(value) => Offsets::new(self.fixed(target, value), self.ground),
        };
        self.arguments.push(argument);
        planned.columns.extend((0..target.columns()).map(|k| match place {
            Place::Own { first, .. } => Some(first + k),
            Place::Ground(_) => None,
        }));
    }

    /// Where the state of an argument begins whose coordinates begin there.
    fn own(&mut self, target: &Target, first: usize, planned: &mut Planned) -> u32 {
        let next = self.origin.len() as u32;
        match target {
            Target::Planar(_) => *planned.bodies[first].get_or_insert_with(|| {
                self.origin.extend(PlanarState::ground().to_array());
                self.planar.push([first as u32, next]);
                next
            }),
            Target::Spatial(_) => *planned.bodies[first].get_or_insert_with(|| {
                self.origin.extend([0.0; SPATIAL_STATE]);
                self.spatial.push([first as u32, next]);
                next
            }),
            Target::Coord(_, trig) => {
                let number = *planned.coords[first].get_or_insert_with(|| {
                    self.origin.extend(CoordState::new(0.0, Trig::Used).to_array());
                    self.coords.push(Coord {
                        coordinate: first as u32,
                        begin: next,
                        trig: Trig::Unused,
                    });
                    self.coords.len() as u32 - 1
                });
                let coord = &mut self.coords[number as usize];
                if *trig == Trig::Used {
                    coord.trig = Trig::Used;
                }
                coord.begin
            }
        }
    }

    /// Where the state of an argument begins that is the ground, or a coordinate of it with that
    /// value.
    fn fixed(&mut self, target: &Target, value: f64) -> u32 {
        let next = self.origin.len() as u32;
        match target {
            Target::Planar(_) => self.origin.extend(PlanarState::ground().to_array()),
            Target::Spatial(_) => self.origin.extend(SpatialState::ground().to_array()),
            Target::Coord(..) => self.origin.extend(CoordState::new(value, Trig::Used).to_array()),
        }
        next
    }

    /// Of every argument planned so far, where its state and where its rates begin.
    pub(crate) fn arguments(&self) -> &[Offsets] {
        &self.arguments
    }

    /// The states where all coordinates are zero; those of the ground are there for good.
    pub(super) fn origin(&self) -> &[f64] {
        &self.origin
    }

    /// No rates at all, with room for those of all coordinates.
    pub(super) fn no_rates(&self) -> Vec<f64> {
        vec![0.0; self.ground as usize + SPATIAL_STATE]
    }

    /// The states at coordinates q.
    pub(super) fn set_states(&self, q: &[f64], states: &mut [f64]) {
        for &[first, begin] in &self.planar {
            let &[x, y, theta] = from(q, first);
            let state = from_mut::<_, PLANAR_STATE>(states, begin);
            let [_, _, known, sin, cos] = *state;
            // An angle that has not moved, as a driven one in Newton's last step, keeps its sine
            // and cosine.
            let (sin, cos) = if known == theta { (sin, cos) } else { theta.sin_cos() };
            *state = [x, y, theta, sin, cos];
        }
        for &[first, begin] in &self.spatial {
            *from_mut::<_, SPATIAL_STATE>(states, begin) = *from(q, first);
        }
        for &Coord { coordinate, begin, trig } in &self.coords {
            let &[value] = from(q, coordinate);
            let state = from_mut::<_, COORD_STATE>(states, begin);
            if state[0] != value {
                *state = CoordState::new(value, trig).to_array();
            }
        }
    }

    /// The rates of all coordinates at q̇; those of the ground, which stand after them, stay zero.
    pub(super) fn set_rates(&self, qd: &[f64], rates: &mut [f64]) {
        rates[..self.ground as usize].copy_from_slice(qd);
    }
}

/// The N numbers that begin there (32 bits: the end does not overflow, so one check will do).
#[inline(always)]
fn from<T, const N: usize>(all: &[T], first: u32) -> &[T; N] {
    let own = &all[first as usize..first as usize + N];
    own.first_chunk().unwrap_or_else(|| unreachable!("a slice of that length"))
}

/// The same, to be written.
#[inline(always)]
fn from_mut<T, const N: usize>(all: &mut [T], first: u32) -> &mut [T; N] {
    let own = &mut all[first as usize..first as usize + N];
    own.first_chunk_mut().unwrap_or_else(|| unreachable!("a slice of that length"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::coordinates::{Coordinate, any_planar};

    #[test]
    fn one_coordinate_has_one_state_with_sine_if_anyone_asks() {
        let mut plan = StatePlan::new(3);
        let mut planned = Planned::new(3);
        let target = |trig| Target::Coord(Coordinate::Planar(any_planar(), 2), trig);
        let place = Place::Own { item: 0, first: 2 };
        for (trig, place) in
            [(Trig::Unused, place), (Trig::Unused, Place::Ground(1.0)), (Trig::Used, place)]
        {
            plan.argument(&target(trig), place, &mut planned);
        }
        assert_eq!(
            plan.arguments(),
            [[0, 2], [3, 3], [0, 2]].map(|[state, rates]| Offsets::new(state, rates))
        );
        let mut states = plan.origin().to_vec();
        plan.set_states(&[0.0, 0.0, 0.5], &mut states);
        let (half, one) =
            [0.5, 1.0].map(|value| CoordState::new(value, Trig::Used).to_array()).into();
        assert_eq!(states, [half, one].concat());
        let mut rates = plan.no_rates();
        plan.set_rates(&[0.0, 0.0, 7.0], &mut rates);
        assert_eq!(rates[..3], [0.0, 0.0, 7.0]);
        assert!(rates[3..].iter().all(|rate| *rate == 0.0) && rates.len() == 10);
    }

    #[test]
    fn an_angle_that_comes_back_has_its_own_sine_again() {
        let mut plan = StatePlan::new(3);
        plan.argument(
            &Target::Planar(any_planar()),
            Place::Own { item: 0, first: 0 },
            &mut Planned::new(3),
        );
        let mut states = plan.origin().to_vec();
        for theta in [0.0, 0.5, 0.5, -0.0, f64::NAN, f64::NAN, 0.5, 1e300] {
            plan.set_states(&[1.0, 2.0, theta], &mut states);
            let expected = PlanarState::new([1.0, 2.0, theta]).to_array();
            assert!(
                states.iter().zip(expected).all(|(a, b)| *a == b || (a.is_nan() && b.is_nan())),
                "{theta}: {states:?}"
            );
        }
    }
}
