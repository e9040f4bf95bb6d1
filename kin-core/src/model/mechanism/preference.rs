//! Which of several assemblies is meant.

use super::{Mechanism, Refused, SpatialPose};
use crate::model::coordinates::{Coordinate, Link, PlanarBody, SpatialBody, SpatialLink, Target, Trig};
use crate::model::dimension::Dimension;
use crate::model::error::{Error, Result};
use crate::model::layout::Place;
use crate::numbers::algebra::{EulerParameters, Scalar};

/// Anything that can be preferred, and by which kind of value V: a bare coordinate, a planar body or link by
/// its angle θ, a spatial body or link by its Euler parameters or by its whole pose, a measure of a joint or
/// a coordinate by its name (`"A.angle"`).
pub trait Preferred<V> {
    /// The preference of `value` for it.
    #[doc(hidden)]
    fn wish(self, value: V) -> Wish;
}

/// A preference as it was told.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq)]
pub enum Wish {
    /// A coordinate near a value.
    Coordinate(Coordinate, f64),
    /// A spatial body turned like this.
    Turn(SpatialBody, EulerParameters),
    /// A spatial body where and turned like this.
    Pose(SpatialBody, SpatialPose),
    /// The thing of this name, near a value.
    Named(String, f64),
}

impl Preferred<f64> for Coordinate {
    fn wish(self, value: f64) -> Wish {
        Wish::Coordinate(self, value)
    }
}

impl Preferred<f64> for PlanarBody {
    fn wish(self, value: f64) -> Wish {
        Wish::Coordinate(self.theta(), value)
    }
}

impl<L: Scalar> Preferred<f64> for Link<L> {
    fn wish(self, value: f64) -> Wish {
        Wish::Coordinate(self.theta(), value)
    }
}

impl Preferred<EulerParameters> for SpatialBody {
    fn wish(self, value: EulerParameters) -> Wish {
        Wish::Turn(self, value)
    }
}

impl<L: Scalar> Preferred<EulerParameters> for SpatialLink<L> {
    fn wish(self, value: EulerParameters) -> Wish {
        Wish::Turn(self.body(), value)
    }
}

impl Preferred<SpatialPose> for SpatialBody {
    fn wish(self, value: SpatialPose) -> Wish {
        Wish::Pose(self, value)
    }
}

impl<L: Scalar> Preferred<SpatialPose> for SpatialLink<L> {
    fn wish(self, value: SpatialPose) -> Wish {
        Wish::Pose(self.body(), value)
    }
}

impl Preferred<f64> for &str {
    fn wish(self, value: f64) -> Wish {
        Wish::Named(self.to_string(), value)
    }
}

impl Preferred<f64> for String {
    fn wish(self, value: f64) -> Wish {
        Wish::Named(self, value)
    }
}

impl Preferred<f64> for &String {
    fn wish(self, value: f64) -> Wish {
        Wish::Named(self.clone(), value)
    }
}

impl Mechanism {
    /// Which of several assemblies: the one with this nearest the value: a coordinate; a planar body or link
    /// by its angle θ; a spatial body or link by its Euler parameters, or by its pose; the measure of a joint
    /// or a coordinate by its name, as `m.prefer("elbow.angle", deg(-60.0))`. Coordinates and bodies take it
    /// as their guess too. For a measure all assemblies are looked at
    /// ([`System::assemblies`](crate::System::assemblies)), unless the guess leads near the value; of angles
    /// whole turns do not count.   \[m or rad\]
    ///
    /// A value that is not finite, a body of another mechanism or a name that nothing has is told by
    /// [`Mechanism::build`].
    pub fn prefer<V>(&mut self, what: impl Preferred<V>, value: V) {
        let wish = what.wish(value);
        if self.note(wish.clone()).is_err() {
            self.refuse(Refused::Preference(wish));
        }
    }

    pub(super) fn note(&mut self, wish: Wish) -> Result<()> {
        match wish {
            Wish::Coordinate(coordinate, value) => {
                self.prefer_all(Target::Coord(coordinate, Trig::Unused), &[value], 0)
            }
            Wish::Pose(body, pose) => {
                self.prefer_all(Target::Spatial(body), &pose.coordinates().map(Dimension::value), 0)
            }
            Wish::Turn(body, p) => {
                let target = Target::Spatial(body);
                let first = self
                    .layout
                    .place(&target)
                    .and_then(|place| if let Place::Own { first, .. } = place { Some(first) } else { None });
                let at =
                    |k: usize| first.and_then(|first| self.initial.get(first + k)).copied().unwrap_or(0.0);
                let pose = SpatialPose::new((at(0), at(1), at(2)), p);
                self.prefer_all(target, &pose.coordinates().map(Dimension::value), 3)
            }
            Wish::Named(name, value) if value.is_finite() => {
                self.asked.retain(|(known, _)| *known != name);
                self.asked.push((name, value));
                Ok(())
            }
            Wish::Named(name, value) => {
                Err(Error::ParameterNotFinite { constraint: "prefer".to_string(), parameter: name, value })
            }
        }
    }

    /// Guesses these values of a body or coordinate, and prefers them from one of them on.
    fn prefer_all(&mut self, target: Target, values: &[f64], from: usize) -> Result<()> {
        let numbers: Vec<Dimension> = values.iter().map(|x| Dimension::from(*x)).collect();
        self.set_all("prefer", target, &numbers)?;
        if let Some(Place::Own { first, .. }) = self.layout.place(&target) {
            for (k, &value) in values.iter().enumerate().skip(from) {
                self.preferred.retain(|(known, _)| *known != first + k);
                self.preferred.push((first + k, value));
            }
        }
        Ok(())
    }
}
