//! Computes the states of bodies and scalar coordinates once for each iterate, for all constraints.

use crate::coordinates::layout::Place;
use crate::coordinates::{Target, Trig};
use crate::model::state::{
    COORD_STATE, CoordState, Offsets, PLANAR_STATE, PlanarState, SPATIAL_STATE, SpatialState,
};

/// The places of states, the coordinates that they consist of, and the states that each constraint
/// reads.
#[derive(Clone, Debug, Default)]
pub(crate) struct StatePlan {
    /// For each planar body its first coordinate, and the place of its state.
    planar: Vec<[u32; 2]>,
    spatial: Vec<[u32; 2]>,
    coords: Vec<Coord>,
    /// The states with all coordinates at zero; the states of the ground in it are final.
    origin: Vec<f64>,
    /// For each argument of each constraint, the places of its state and of its velocities.
    arguments: Vec<Offsets>,
    /// The place of the velocities of the ground: after those of all coordinates.
    ground: u32,
}

/// A scalar coordinate.
#[derive(Clone, Copy, Debug)]
struct Coord {
    coordinate: u32,
    begin: u32,
    /// `Used` if some constraint reads its sine or cosine.
    trig: Trig,
}

/// The places of coordinates, while the arguments are laid out.
pub(super) struct Planned {
    /// For each coordinate the place of the state of the body that begins with it; `None`
    /// otherwise.
    bodies: Vec<Option<u32>>,
    /// For each coordinate its index among the scalar coordinates; `None` otherwise.
    coords: Vec<Option<u32>>,
    /// The coordinate of each column of the present constraint; `None` for the ground.
    pub columns: Vec<Option<usize>>,
}

impl Planned {
    /// Creates an empty plan of n coordinates.
    pub(super) fn new(n: usize) -> Self {
        Planned { bodies: vec![None; n], coords: vec![None; n], columns: Vec::new() }
    }
}

impl StatePlan {
    /// Creates a plan for n coordinates.
    pub(super) fn new(n: usize) -> Self {
        StatePlan { ground: n as u32, ..StatePlan::default() }
    }

    /// Adds one argument to the plan.
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

    /// Returns the place of the state of an argument whose coordinates begin at `first`.
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

    /// Returns the place of the state of an argument that is the ground, or a coordinate of the
    /// ground with this value.
    fn fixed(&mut self, target: &Target, value: f64) -> u32 {
        let next = self.origin.len() as u32;
        match target {
            Target::Planar(_) => self.origin.extend(PlanarState::ground().to_array()),
            Target::Spatial(_) => self.origin.extend(SpatialState::ground().to_array()),
            Target::Coord(..) => self.origin.extend(CoordState::new(value, Trig::Used).to_array()),
        }
        next
    }

    /// Returns, for every argument in the plan, the places of its state and of its velocities.
    pub(crate) fn arguments(&self) -> &[Offsets] {
        &self.arguments
    }

    /// Returns the states with all coordinates at zero; the states of the ground in it are final.
    pub(super) fn origin(&self) -> &[f64] {
        &self.origin
    }

    /// Returns zero velocities of all coordinates and of the ground.
    pub(super) fn no_rates(&self) -> Vec<f64> {
        vec![0.0; self.ground as usize + SPATIAL_STATE]
    }

    /// Computes the states at coordinates q.
    pub(super) fn set_states(&self, q: &[f64], states: &mut [f64]) {
        for &[first, begin] in &self.planar {
            let &[x, y, theta] = from(q, first);
            let state = from_mut::<_, PLANAR_STATE>(states, begin);
            let [_, _, known, sin, cos] = *state;
            // An unchanged angle, such as a driven one in Newton's last step, keeps its sine and
            // cosine.
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

    /// Writes the velocities q̇ of all coordinates. Those of the ground, which follow them, stay
    /// zero.
    pub(super) fn set_rates(&self, qd: &[f64], rates: &mut [f64]) {
        rates[..self.ground as usize].copy_from_slice(qd);
    }
}

/// Returns the N numbers from index `first` on. `first` has 32 bits, so the end does not overflow
/// and one check suffices.
#[inline(always)]
fn from<T, const N: usize>(all: &[T], first: u32) -> &[T; N] {
    let own = &all[first as usize..first as usize + N];
    own.first_chunk().unwrap_or_else(|| unreachable!("a slice of that length"))
}

/// Returns the N numbers from index `first` on, mutable.
#[inline(always)]
fn from_mut<T, const N: usize>(all: &mut [T], first: u32) -> &mut [T; N] {
    let own = &mut all[first as usize..first as usize + N];
    own.first_chunk_mut().unwrap_or_else(|| unreachable!("a slice of that length"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coordinates::{Coordinate, any_planar};

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
