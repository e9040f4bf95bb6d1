//! Selects one of several assemblies.

use super::{Drawn, IntoSpatialPose, Mechanism, Refused, SpatialPose};
use crate::coordinates::layout::Place;
use crate::coordinates::{Coordinate, Link, PlanarBody, SpatialBody, SpatialLink, Target, Trig};
use crate::dimensions::{Bound, Dimension, IntoNumber};
use crate::numbers::algebra::{EulerParameters, Scalar};
use crate::outcome::error::{Error, Result};

/// A quantity whose preferred value [`Mechanism::prefer`] sets, with a value of type V.
///
/// The quantity is a scalar coordinate, a planar body or link (its angle θ), a spatial body or link
/// (its Euler parameters or its pose), or the name of a measure of a joint or of a coordinate
/// (`"A.angle"`).
pub trait Preferred<V> {
    /// Returns the preference for this value.
    #[doc(hidden)]
    fn wish(self, value: V) -> Wish;
}

/// A preference that a mechanism has recorded.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq)]
pub enum Wish {
    /// The coordinate is near a value.
    Coordinate(Coordinate, Dimension),
    /// The orientation of a spatial body is near a value.
    Turn(SpatialBody, EulerParameters<Dimension>),
    /// The position and orientation of a spatial body are near a pose.
    Pose(SpatialBody, Drawn),
    /// The measure or coordinate with this name is near a value.
    Named(String, Dimension),
}

impl<S: IntoNumber> Preferred<S> for Coordinate {
    fn wish(self, value: S) -> Wish {
        Wish::Coordinate(self, value.into_number())
    }
}

impl<S: IntoNumber> Preferred<S> for PlanarBody {
    fn wish(self, value: S) -> Wish {
        Wish::Coordinate(self.theta(), value.into_number())
    }
}

impl<S: IntoNumber, L: Scalar> Preferred<S> for Link<L> {
    fn wish(self, value: S) -> Wish {
        Wish::Coordinate(self.theta(), value.into_number())
    }
}

impl<S: IntoNumber> Preferred<EulerParameters<S>> for SpatialBody {
    fn wish(self, value: EulerParameters<S>) -> Wish {
        Wish::Turn(self, value.map(IntoNumber::into_number))
    }
}

impl<S: IntoNumber, L: Scalar> Preferred<EulerParameters<S>> for SpatialLink<L> {
    fn wish(self, value: EulerParameters<S>) -> Wish {
        self.body().wish(value)
    }
}

impl<R: IntoNumber, P: IntoNumber> Preferred<SpatialPose<R, P>> for SpatialBody {
    fn wish(self, value: SpatialPose<R, P>) -> Wish {
        Wish::Pose(self, value.drawn())
    }
}

impl<R: IntoNumber, P: IntoNumber, L: Scalar> Preferred<SpatialPose<R, P>> for SpatialLink<L> {
    fn wish(self, value: SpatialPose<R, P>) -> Wish {
        self.body().wish(value)
    }
}

impl<S: IntoNumber> Preferred<S> for &str {
    fn wish(self, value: S) -> Wish {
        Wish::Named(self.to_string(), value.into_number())
    }
}

impl<S: IntoNumber> Preferred<S> for String {
    fn wish(self, value: S) -> Wish {
        Wish::Named(self, value.into_number())
    }
}

impl<S: IntoNumber> Preferred<S> for &String {
    fn wish(self, value: S) -> Wish {
        Wish::Named(self.clone(), value.into_number())
    }
}

impl Mechanism {
    /// Selects the assembly in which a quantity is nearest to a value. \[m or rad\]
    ///
    /// The quantity is a coordinate, a planar body or link (its angle θ), a spatial body or link
    /// (its Euler parameters or its pose), or a measure by its name:
    /// `m.prefer("elbow.angle", deg(-60.0))`. For a coordinate or body Kin also uses the value as
    /// the guess. For a measure Kin searches all assemblies
    /// ([`System::assemblies`](crate::System::assemblies)), unless the guess already leads near the
    /// value. Kin ignores full revolutions of an angle. The value may be a [`Dimension`].
    ///
    /// [`Mechanism::build`] returns an error if the value is not finite, if the body belongs to
    /// another mechanism, or if no measure or coordinate has the name.
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
            Wish::Pose(body, pose) => self.prefer_all(Target::Spatial(body), &pose.coordinates, 0),
            Wish::Turn(body, p) => {
                let target = Target::Spatial(body);
                let first = self.layout.place(&target).and_then(|place| {
                    if let Place::Own { first, .. } = place { Some(first) } else { None }
                });
                let at = |k: usize| {
                    first.and_then(|first| self.initial.get(first + k)).copied().unwrap_or(0.0)
                };
                let pose = SpatialPose::new((at(0), at(1), at(2)), p);
                self.prefer_all(target, &pose.coordinates(), 3)
            }
            Wish::Named(name, value) if value.value().is_finite() => {
                self.check_origin("prefer", value)?;
                self.hung.retain(
                    |hung| !matches!(&hung.at, Bound::PreferredMeasure(known) if *known == name),
                );
                let number = self.hang("prefer", Bound::PreferredMeasure(name.clone()), value)?;
                self.asked.retain(|(known, _)| *known != name);
                self.asked.push((name, number));
                Ok(())
            }
            Wish::Named(name, value) => {
                let value = value.value();
                Err(Error::ParameterNotFinite {
                    constraint: "prefer".to_string(),
                    parameter: name,
                    value,
                })
            }
        }
    }

    /// Sets these guesses of a body or coordinate, and prefers them from index `from` on.
    fn prefer_all(&mut self, target: Target, numbers: &[Dimension], from: usize) -> Result<()> {
        self.set_all("prefer", target, numbers)?;
        if let Some(Place::Own { first, .. }) = self.layout.place(&target) {
            for (k, number) in numbers.iter().enumerate().skip(from) {
                self.prefer_one(first + k, *number)?;
            }
        }
        Ok(())
    }

    /// Prefers this value of a coordinate.
    pub(crate) fn prefer_one(&mut self, column: usize, number: Dimension) -> Result<()> {
        self.hung.retain(|hung| hung.at != Bound::Preferred(column));
        let value = self.hang("prefer", Bound::Preferred(column), number)?;
        self.preferred.retain(|(known, _)| *known != column);
        self.preferred.push((column, value));
        Ok(())
    }
}
