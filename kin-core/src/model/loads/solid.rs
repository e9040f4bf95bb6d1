//! Computes mass, centre of mass and inertia of a body, from numbers or from shapes and a density.

use crate::coordinates::{Link, PlanarBody, SpatialBody, SpatialLink};
use crate::model::body::Body;
use crate::numbers::algebra::{EulerParameters, Mat3, Scalar, Vec2, Vec3};

/// Mass, centre of mass and inertia of a body.
///
/// Create a shape from its sizes and its density. [`Solid::at`] and [`Solid::turned`] place a
/// shape; [`Solid::and`] and [`Solid::without`] combine shapes:
///
/// ```
/// use kin::loads::Solid;
///
/// let rod = Solid::bar(0.4, 0.02, 0.01, Solid::STEEL);
/// let eye = Solid::disc(0.02, 0.01, Solid::STEEL).at((0.2, 0.0, 0.0));
/// let hole = Solid::disc(0.005, 0.01, Solid::STEEL).at((0.2, 0.0, 0.0));
/// let whole = rod.and(eye).without(hole);
/// assert!((whole.mass - (rod.mass + eye.mass - hole.mass)).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// The mass m. \[kg\]
    pub mass: f64,
    /// The centre of mass c̄ in the frame of the body; a planar body ignores z. \[m\]
    pub centre: Vec3,
    /// The inertia J = ∫ (r² I − r rᵀ) dm about the centre of mass, in the axes of the body. A
    /// planar body uses only J_zz. \[kg m²\]
    pub inertia: Mat3,
}

impl Solid {
    /// The density of steel, for kilograms and metres. \[kg/m³\]
    pub const STEEL: f64 = 7850.0;
    /// The density of aluminium, for kilograms and metres. \[kg/m³\]
    pub const ALUMINIUM: f64 = 2700.0;

    /// Creates a box with these sizes along x, y and z and its centre at the origin: J_xx = m (b² +
    /// c²)/12. \[m, kg/m³\]
    pub fn cuboid(a: f64, b: f64, c: f64, density: f64) -> Solid {
        let mass = density * a * b * c;
        let share = mass / 12.0;
        Solid::diagonal(
            mass,
            [share * (b * b + c * c), share * (a * a + c * c), share * (a * a + b * b)],
        )
    }

    /// Creates a bar along x with its centre at the origin, like the frame of a link. \[m, kg/m³\]
    ///
    /// `length` is along x, `height` along y, `width` along z.
    pub fn bar(length: f64, height: f64, width: f64, density: f64) -> Solid {
        Solid::cuboid(length, height, width, density)
    }

    /// Creates a cylinder along x with its centre at the origin: J_xx = m r²/2, J_yy = J_zz = m (3
    /// r² + l²)/12. \[m, kg/m³\]
    pub fn cylinder(radius: f64, length: f64, density: f64) -> Solid {
        let mass = density * std::f64::consts::PI * radius * radius * length;
        let across = mass * (3.0 * radius * radius + length * length) / 12.0;
        Solid::diagonal(mass, [0.5 * mass * radius * radius, across, across])
    }

    /// Creates a disc in the xy-plane with its axis along z and its centre at the origin. \[m,
    /// kg/m³\]
    pub fn disc(radius: f64, thickness: f64, density: f64) -> Solid {
        let Solid { mass, inertia, .. } = Solid::cylinder(radius, thickness, density);
        Solid::diagonal(mass, [inertia.m22, inertia.m22, inertia.m11])
    }

    /// Creates a ball with its centre at the origin: J = 2/5 m r². \[m, kg/m³\]
    pub fn sphere(radius: f64, density: f64) -> Solid {
        let mass = density * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
        Solid::diagonal(mass, [0.4 * mass * radius * radius; 3])
    }

    /// Creates a plate with a polygon as its outline in the xy-plane and z = 0 in its middle. \[m,
    /// kg/m³\]
    ///
    /// `corners` are the corners of the polygon in order, in either direction. Kin sums area,
    /// centre and second moments over the edges.
    pub fn plate(corners: &[Vec2], thickness: f64, density: f64) -> Solid {
        let mut area = 0.0;
        let mut first = [0.0; 2];
        let mut second = [0.0; 3];
        for (k, a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            let cross = a.x * b.y - b.x * a.y;
            area += cross / 2.0;
            first[0] += cross * (a.x + b.x) / 6.0;
            first[1] += cross * (a.y + b.y) / 6.0;
            second[0] += cross * (a.x * a.x + a.x * b.x + b.x * b.x) / 12.0;
            second[1] += cross * (a.y * a.y + a.y * b.y + b.y * b.y) / 12.0;
            second[2] += cross * (a.x * b.y + 2.0 * a.x * a.y + 2.0 * b.x * b.y + b.x * a.y) / 24.0;
        }
        let per_area = density * thickness * area.signum();
        let mass = per_area * area;
        let x = first[0] / area;
        let y = first[1] / area;
        let [xx, yy, xy] = second.map(|moment| per_area * moment);
        let xx = xx - mass * x * x;
        let yy = yy - mass * y * y;
        let xy = xy - mass * x * y;
        let thick = mass * thickness * thickness / 12.0;
        let inertia =
            Mat3::from([[yy + thick, -xy, 0.0], [-xy, xx + thick, 0.0], [0.0, 0.0, xx + yy]]);
        Solid { mass, centre: Vec3::new(x, y, 0.0), inertia }
    }

    fn diagonal(mass: f64, [x, y, z]: [f64; 3]) -> Solid {
        let inertia = Mat3::from([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]);
        Solid { mass, centre: Vec3::zeros(), inertia }
    }

    /// Moves the solid so that its centre of mass is at `centre` in the frame of the body. \[m\]
    #[must_use]
    pub fn at(self, centre: impl Into<Vec3>) -> Solid {
        Solid { centre: centre.into(), ..self }
    }

    /// Rotates the solid about the origin of the body: c̄ → A c̄, J → A J Aᵀ.
    #[must_use]
    pub fn turned(self, p: EulerParameters) -> Solid {
        let a = p.normalize().rotation();
        Solid { centre: a * self.centre, inertia: a * self.inertia * a.transpose(), ..self }
    }

    /// Joins two solids to one solid, by the parallel axis theorem: J + m (d² I − d dᵀ) about the
    /// common centre.
    #[must_use]
    pub fn and(self, other: Solid) -> Solid {
        let mass = self.mass + other.mass;
        let centre = (self.centre * self.mass + other.centre * other.mass) / mass;
        let inertia = self.about(centre) + other.about(centre);
        Solid { mass, centre, inertia }
    }

    /// Cuts the solid `hole` out of this solid.
    #[must_use]
    pub fn without(self, hole: Solid) -> Solid {
        self.and(Solid { mass: -hole.mass, inertia: hole.inertia * -1.0, ..hole })
    }

    /// Returns J about another point of the body, in the same axes.
    fn about(self, point: Vec3) -> Mat3 {
        let d = Mat3::skew(self.centre - point);
        self.inertia - d * d * self.mass
    }
}

/// A body that can have a mass.
pub trait HasMass: Body {
    /// The inertia about the centre: a number in the plane, a tensor in the axes of the body in
    /// space.
    type Inertia;

    /// Converts the numbers to a [`Solid`].
    #[doc(hidden)]
    fn solid(mass: f64, centre: Vec3, inertia: Self::Inertia) -> Solid;
}

/// A planar body has a number as its inertia.
macro_rules! planar {
    ($($body:ident $(<$of:ident>)?),*) => {$(
        impl$(<$of: Scalar>)? HasMass for $body$(<$of>)? {
            type Inertia = f64;

            fn solid(mass: f64, centre: Vec3, inertia: f64) -> Solid {
                let zero = 0.0;
                let rows = [[inertia, zero, zero], [zero, inertia, zero], [zero, zero, inertia]];
                Solid { mass, centre, inertia: Mat3::from(rows) }
            }
        }
    )*};
}

/// A spatial body has a tensor as its inertia.
macro_rules! spatial {
    ($($body:ident $(<$of:ident>)?),*) => {$(
        impl$(<$of: Scalar>)? HasMass for $body$(<$of>)? {
            type Inertia = Mat3;

            fn solid(mass: f64, centre: Vec3, inertia: Mat3) -> Solid {
                Solid { mass, centre, inertia }
            }
        }
    )*};
}

planar!(PlanarBody, Link<L>);
spatial!(SpatialBody, SpatialLink<L>);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::algebra::vec2;

    fn near(a: Solid, b: Solid) {
        let scale = 1.0 + a.mass.abs();
        assert!((a.mass - b.mass).abs() < 1e-13 * scale, "{a:?} {b:?}");
        assert!((a.centre - b.centre).norm() < 1e-13, "{a:?} {b:?}");
        for k in 0..3 {
            assert!((a.inertia.row(k) - b.inertia.row(k)).norm() < 1e-13 * scale, "{a:?} {b:?}");
        }
    }

    #[test]
    fn a_plate_is_the_box_of_its_outline_either_way_round_and_wherever_it_is() {
        let corners = [vec2(-1.0, -0.5), vec2(1.0, -0.5), vec2(1.0, 0.5), vec2(-1.0, 0.5)];
        let cuboid = Solid::cuboid(2.0, 1.0, 0.1, 3.0);
        near(Solid::plate(&corners, 0.1, 3.0), cuboid);
        let back: Vec<Vec2> =
            corners.iter().rev().map(|corner| *corner + vec2(0.3, -0.7)).collect();
        near(Solid::plate(&back, 0.1, 3.0), cuboid.at((0.3, -0.7, 0.0)));
    }

    #[test]
    fn the_products_of_a_plate_are_those_of_its_halves() {
        let triangle = |a, b, c| Solid::plate(&[a, b, c], 0.2, 5.0);
        let a = vec2(0.0, 0.0);
        let b = vec2(3.0, 0.5);
        let c = vec2(2.0, 2.0);
        let d = vec2(-1.0, 1.0);
        near(triangle(a, b, c).and(triangle(a, c, d)), Solid::plate(&[a, b, c, d], 0.2, 5.0));
    }

    /// Masses and moments equal the formulas of textbooks (Meriam and Kraige, table D/4), for sizes
    /// with round results.
    #[test]
    fn shapes_have_the_mass_and_inertia_of_textbooks() {
        let of = |mass: f64, [x, y, z]: [f64; 3]| Solid::diagonal(mass, [x, y, z]);
        let pi = std::f64::consts::PI;
        // A bar of steel 400 × 30 × 20 mm: 7850 · 0.4 · 0.03 · 0.02 = 1.884 kg.
        let bar = [1.884 * 1.3e-3 / 12.0, 1.884 * 0.1604 / 12.0, 1.884 * 0.1609 / 12.0];
        near(Solid::bar(0.4, 0.03, 0.02, Solid::STEEL), of(1.884, bar));
        // A box 1 × 2 × 3 of density 5: 30 kg; 30/12 (4 + 9), 30/12 (1 + 9), 30/12 (1 + 4).
        near(Solid::cuboid(1.0, 2.0, 3.0, 5.0), of(30.0, [32.5, 25.0, 12.5]));
        // A disc of radius 2 and thickness 1/π of density 3: 12 kg; ½ m r² and ¼ m r² + m t²/12.
        let across = 12.0 + 1.0 / (pi * pi);
        near(Solid::disc(2.0, 1.0 / pi, 3.0), of(12.0, [across, across, 24.0]));
        // A cylinder of radius 1 and length 6 along x of density 1/π: 6 kg; ½ m r² and m (r²/4 +
        // l²/12).
        near(Solid::cylinder(1.0, 6.0, 1.0 / pi), of(6.0, [3.0, 19.5, 19.5]));
        // A ball of radius 3 of density 1/(4 π): 9 kg; 2/5 m r² = 32.4.
        near(Solid::sphere(3.0, 0.25 / pi), of(9.0, [32.4; 3]));
        // A thin plate with a right angle, legs 3 and 6 along the axes: 2 · 9 · 0.001 = 0.018 kg,
        // its centre at a third, moments m h²/18, J_xy = −∫ x y dm = m b h/36.
        let m = 0.018;
        let thick = 0.018 * 1e-6 / 12.0;
        let [x, y, xy] = [m * 36.0 / 18.0, m * 9.0 / 18.0, m * 18.0 / 36.0];
        let rows = [[x + thick, xy, 0.0], [xy, y + thick, 0.0], [0.0, 0.0, x + y]];
        let triangle =
            Solid { mass: m, centre: Vec3::new(1.0, 2.0, 0.0), inertia: Mat3::from(rows) };
        near(Solid::plate(&[vec2(0.0, 0.0), vec2(3.0, 0.0), vec2(0.0, 6.0)], 0.001, 2.0), triangle);
        // A bar as an outline is the bar.
        let corners = [vec2(-0.2, -0.015), vec2(0.2, -0.015), vec2(0.2, 0.015), vec2(-0.2, 0.015)];
        near(Solid::plate(&corners, 0.02, Solid::STEEL), of(1.884, bar));
    }

    #[test]
    fn two_halves_make_the_whole_and_what_is_cut_out_is_gone() {
        let half = Solid::cuboid(1.0, 0.4, 0.3, 2.0);
        let whole = half.at((-0.5, 0.0, 0.0)).and(half.at((0.5, 0.0, 0.0)));
        near(whole, Solid::cuboid(2.0, 0.4, 0.3, 2.0));
        near(whole.without(half.at((0.5, 0.0, 0.0))), half.at((-0.5, 0.0, 0.0)));
    }

    #[test]
    fn a_cylinder_turned_by_a_quarter_is_a_disc() {
        let turn =
            EulerParameters::from_axis_angle(Vec3::new(0.0, 1.0, 0.0), std::f64::consts::FRAC_PI_2);
        near(Solid::cylinder(0.2, 0.7, 3.0).turned(turn), Solid::disc(0.2, 0.7, 3.0));
        assert!((Solid::sphere(1.0, 1.0).mass - 4.0 * std::f64::consts::PI / 3.0).abs() < 1e-14);
    }
}
