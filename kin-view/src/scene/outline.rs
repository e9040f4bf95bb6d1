//! Defines the shapes of bodies that the user gives.

use std::f64::consts::TAU;

use kin::{Vec2, Vec3, vec2};

use super::Point;

/// A shape that is fixed in a body, in the frame of the body. \[m\]
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    pub(crate) points: Vec<Vec3>,
    pub(crate) kind: OutlineKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OutlineKind {
    Filled,
    /// A bar along the points.
    Line,
    /// A thin line along the edge of a shape.
    Edge,
}

impl Outline {
    /// Creates a filled polygon with these corners.
    pub fn polygon<P: Into<Point>>(corners: impl IntoIterator<Item = P>) -> Outline {
        Outline {
            points: corners.into_iter().map(|p| p.into().0).collect(),
            kind: OutlineKind::Filled,
        }
    }

    /// Creates an open line through these points.
    pub fn line<P: Into<Point>>(points: impl IntoIterator<Item = P>) -> Outline {
        Outline { kind: OutlineKind::Line, ..Outline::polygon(points) }
    }

    /// Creates a disc in the plane from its centre and radius. \[m\]
    pub fn disc(center: impl Into<Vec2>, radius: f64) -> Outline {
        Outline::polygon(circle(center.into(), radius, 96))
    }

    /// Draws only the edge of the shape, as a thin line.
    pub fn hollow(mut self) -> Outline {
        if self.kind == OutlineKind::Filled {
            self.points.extend(self.points.first().copied());
            self.kind = OutlineKind::Edge;
        }
        self
    }

    /// Rotates the shape about the z-axis of its body. \[rad\]
    pub fn turned(mut self, angle: f64) -> Outline {
        let (sin, cos) = angle.sin_cos();
        for p in &mut self.points {
            *p = Vec3::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z);
        }
        self
    }

    /// Creates a spur gear in the plane from its pitch radius \[m\] and number of teeth.
    ///
    /// The centre of the gear is the origin of the body, and one tooth is on the x-axis.
    pub fn gear(radius: f64, teeth: usize) -> Outline {
        let module = 2.0 * radius / teeth.max(3) as f64;
        let flank = |tooth: usize| {
            // Half a tooth is a quarter of the pitch wide on the pitch circle, less at the top,
            // more at the root.
            [(-0.36, -1.1), (-0.14, 0.9), (0.14, 0.9), (0.36, -1.1)].map(|(turn, height)| {
                polar(radius + height * module, TAU * (tooth as f64 + turn) / teeth.max(3) as f64)
            })
        };
        Outline::polygon((0..teeth.max(3)).flat_map(flank))
    }
}

/// n points on a circle.
pub(crate) fn circle(center: Vec2, radius: f64, n: usize) -> Vec<Vec2> {
    (0..n).map(|k| center + polar(radius, TAU * k as f64 / n as f64)).collect()
}

pub(super) fn polar(radius: f64, angle: f64) -> Vec2 {
    vec2(radius * angle.cos(), radius * angle.sin())
}
