//! Stores the poses of bodies and the positions of points over time.

use kin::extend::state::{PlanarState, SpatialState};
use kin::{Coordinate, Mat3, Motion, Result, Vec3};

use crate::scene::{Body, Kind};

/// A body or a point that moves as one.
pub(crate) enum Track {
    /// It stands still: the ground.
    Ground,
    /// R_x, R_y, θ over time.
    Planar([Vec<f64>; 3]),
    /// R, e0, e1, e2, e3 over time.
    Spatial([Vec<f64>; 7]),
    /// x, y, z over time; the frame does not turn.
    Point([Vec<f64>; 3]),
}

/// Position and rotation of a track at one time.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    pub r: Vec3,
    pub a: Mat3,
}

impl Frame {
    /// Returns R + A ū.
    pub fn point(&self, u: Vec3) -> Vec3 {
        self.r + self.a * u
    }

    /// Returns Aᵀ (p − R).
    pub fn local(&self, p: Vec3) -> Vec3 {
        self.a.transpose() * (p - self.r)
    }
}

impl Track {
    /// Creates the track of a body.
    ///
    /// Errors: the body belongs to another mechanism.
    pub fn of(motion: &Motion, body: Body) -> Result<Track> {
        if body.is_ground() {
            return Ok(Track::Ground);
        }
        let column = |coordinate: Coordinate| {
            motion.coordinate(coordinate).map(|c| c.value.values().to_vec())
        };
        Ok(match body.0 {
            Kind::Planar(body) => Track::Planar([
                column(Coordinate::Planar(body, 0))?,
                column(Coordinate::Planar(body, 1))?,
                column(Coordinate::Planar(body, 2))?,
            ]),
            Kind::Spatial(body) => {
                let columns: Vec<Vec<f64>> =
                    (0..7).map(|k| column(Coordinate::Spatial(body, k))).collect::<Result<_>>()?;
                columns.try_into().map_or(Track::Ground, Track::Spatial)
            }
        })
    }

    /// Creates the track of a point from one position for each time, or from a single position.
    pub fn of_point(positions: &[Vec3], times: usize) -> Track {
        let at = |k: usize| positions.get(k).or(positions.last().filter(|_| positions.len() == 1));
        let column =
            |pick: fn(&Vec3) -> f64| (0..times).map(|k| at(k).map_or(f64::NAN, pick)).collect();
        Track::Point([column(|p| p.x), column(|p| p.y), column(|p| p.z)])
    }

    /// Returns the frame at time k, or NaN if the frame is unknown.
    pub fn frame(&self, k: usize) -> Frame {
        let at = |column: &Vec<f64>| column.get(k).copied().unwrap_or(f64::NAN);
        match self {
            Track::Ground => Frame { r: Vec3::new(0.0, 0.0, 0.0), a: Mat3::identity() },
            Track::Planar([x, y, theta]) => {
                let a = PlanarState::new([0.0, 0.0, at(theta)]).a();
                Frame {
                    r: Vec3::new(at(x), at(y), 0.0),
                    a: Mat3::new(a.m11, a.m12, 0.0, a.m21, a.m22, 0.0, 0.0, 0.0, 1.0),
                }
            }
            Track::Spatial(columns) => {
                let state = SpatialState::new(std::array::from_fn(|c| at(&columns[c])));
                Frame { r: state.r, a: state.a() }
            }
            Track::Point([x, y, z]) => {
                Frame { r: Vec3::new(at(x), at(y), at(z)), a: Mat3::identity() }
            }
        }
    }

    /// Returns the columns in the form for the page.
    pub fn columns(&self) -> &[Vec<f64>] {
        match self {
            Track::Ground => &[],
            Track::Planar(columns) | Track::Point(columns) => columns,
            Track::Spatial(columns) => columns,
        }
    }

    /// Returns true if the track is not a planar body, or a planar body that does not rotate.
    pub fn keeps_its_angle(&self) -> bool {
        let Track::Planar([.., theta]) = self else { return true };
        theta.iter().all(|angle| (angle - theta[0]).abs() < 0.05)
    }

    /// Returns true if the track never moves by more than the length `least` and never rotates.
    pub fn is_still(&self, least: f64) -> bool {
        let rotations = if let Track::Point(_) = self {
            usize::MAX
        } else if let Track::Planar(_) = self {
            2
        } else {
            3
        };
        self.columns().iter().enumerate().all(|(k, column)| {
            let (low, high) = column
                .iter()
                .fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
            high - low <= if k < rotations { least } else { 1e-9 }
        })
    }
}
