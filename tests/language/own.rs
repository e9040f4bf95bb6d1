//! The user's own items: constants, parameter types, generic functions, laws.

use kin::check::{any_coord as c, any_planar as p, any_spatial as s};
use kin::extend::Parameters;
use kin::prelude::*;

use crate::{reads, twice};

const OFFSET: Vec2 = Vec2::new(0.1, 0.2);
static LIFT: f64 = 0.3;

#[constraint]
fn constants(b: Planar, a: Coord) -> (Vec2, f64) {
    (b.r + OFFSET * 2.0 - b.direction(OFFSET) * a + OFFSET / 2.0, LIFT * a - LIFT)
}
reads!(constants_of_the_module, Symbolic, constants(p(), c()), at [0.0, 0.0, 0.0, 1.0], 0.0 => [0.15, 0.3, 0.0]);

#[constraint]
fn placed(b: Planar) -> Vec2 {
    let v: Vec2 = OFFSET;
    b.point(OFFSET) - v
}
reads!(a_constant_in_a_vectors_place, Symbolic, placed(p()), at [1.0, 2.0, 0.0], 0.0 => [1.0, 2.0]);

#[derive(Clone)]
struct Table {
    rows: Vec<f64>,
    origin: Vec2,
    gain: f64,
}

impl Table {
    fn first(&self) -> f64 {
        self.rows[0]
    }

    fn horner<D: Dual>(&self, x: Real<D>) -> Real<D> {
        self.rows.iter().rev().fold(Real::from(0.0), |sum, row| sum * x + *row)
    }
}

#[constraint]
fn of_a_table(b: Planar, table: Table) -> (Vec2, f64) {
    let origin: Vec2 = table.origin;
    (
        b.r - origin,
        table.horner(b.theta) * table.first() + table.gain * b.theta + table.rows[1]
            - table.rows.len() as f64,
    )
}
fn table() -> Table {
    Table { rows: vec![2.0, 1.0, 3.0], origin: vec2(1.0, 2.0), gain: 0.5 }
}
reads!(fields_and_methods_of_a_parameter, Symbolic, of_a_table(p(), table()), at [0.0, 0.0, 1.0], 0.0 => [-1.0, -2.0, 12.0 + 0.5 + 1.0 - 3.0]);

fn polynomial<D: Dual>(x: Real<D>) -> Real<D> {
    x * x * 2.0 - x + 1.0
}

fn mixed<D: Dual>(x: Real<D>, y: Real<D>, z: Real<D>) -> Real<D> {
    (x * y).sin() + z * y
}

fn turned<D: Dual>(p: Vec2<Real<D>>, angle: Real<D>) -> Vec2<Real<D>> {
    let (sin, cos) = angle.sin_cos();
    vec2(p.x * cos - p.y * sin, p.x * sin + p.y * cos)
}

fn plain(k: f64) -> f64 {
    if k > 1.0 { k } else { 1.0 / k }
}

#[constraint]
fn one_leaf(a: Coord, b: Coord, k: f64) -> f64 {
    polynomial(a * b) * polynomial(a) + plain(k) * b + plain(2.0)
}
reads!(generic_functions_of_ones_own, Symbolic, one_leaf(c(), c(), 2.0), at [1.0, 2.0], 0.0 => [7.0 * 2.0 + 4.0 + 2.0]);

#[constraint]
fn several_arguments(a: Coord, k: f64, t: Time) -> f64 {
    mixed(a, t, k) + mixed(2.0 * a, a, 1.0) - polynomial(t)
}
reads!(a_leaf_of_coordinate_time_and_parameter, Symbolic, several_arguments(c(), 3.0), at [0.0], 2.0 => [6.0 - 7.0]);

#[constraint]
fn vector_leaf(b: Planar, u: Vec2) -> Vec2 {
    let v: Vec2 = turned(b.point(u), b.theta);
    v - turned(u, 2.0 * b.theta)
}
reads!(a_leaf_of_vectors, Symbolic, vector_leaf(p(), vec2(1.0, 2.0)), at [3.0, 4.0, 0.0], 0.0 => [3.0, 4.0]);

#[constraint]
fn leaf_of_a_constant(a: Coord, k: f64) -> f64 {
    a * polynomial(k) + polynomial(0.5)
}
reads!(a_generic_function_of_a_constant, Symbolic, leaf_of_a_constant(c(), 1.0), at [3.0], 0.0 => [7.0]);

#[constraint]
fn laws(a: Coord, f: Law, g: Law, t: Time) -> (f64, f64) {
    (f.at(g.at(a)) - f.at(2.0 * t), g.at(0.5) * a + f.at(a) * f.at(a))
}
reads!(laws_of_laws, Symbolic, laws(c(), Law::polynomial(&[0.0, 0.0, 1.0]), Law::linear(1.0, 2.0)), at [1.0], 1.0 => [9.0 - 4.0, 2.0 + 1.0]);

/// A smooth bump.
#[law]
fn bump(x: f64, height: f64) -> f64 {
    let w = 0.5 * (1.0 - x.cos());
    if height > 0.0 { height * w * w } else { 0.0 }
}

#[constraint]
fn on_cam(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 {
    let p = cam.local(follower.point(tip));
    p.norm() - 1.0 - profile.at(p.y.atan2(p.x))
}
reads!(a_cam_with_a_law_of_ones_own, Symbolic, on_cam(p(), p(), vec2(0.0, -0.5), bump(0.4)), at [0.0, 0.0, 0.0, -2.0, 0.5, 0.0], 0.0 => [1.0 - 0.4]);

#[constraint]
fn optional(a: Coord, k: Option<f64>) -> f64 {
    if let Some(k) = k { a * k } else { a.sin() }
}
reads!(an_optional_parameter_in_both_cases, Symbolic, optional(c(), Some(2.0)), at [3.0], 0.0 => [6.0]);

#[constraint]
fn of_a_list(a: Coord, list: Vec<f64>) -> (f64, f64) {
    let sum = list.iter().map(|x| x * a.sin()).sum::<f64>();
    (sum, list.iter().rev().fold(0.0, |s, x| s * a + x))
}
reads!(iterators_over_a_list_are_dual, Dual, of_a_list(c(), vec![1.0, 2.0, 3.0]), at [0.0], 0.0 => [0.0, 1.0]);

#[constraint]
fn plain_sum(a: Coord, list: Vec<f64>) -> f64 {
    list.iter().sum::<f64>() * a
}
reads!(a_sum_of_parameters_is_one_number, Symbolic, plain_sum(c(), vec![1.0, 2.0, 3.0]), at [2.0], 0.0 => [12.0]);

#[constraint]
fn whole_frame(i: Spatial, j: Spatial, axes: Mat3) -> [f64; 3] {
    let a = i.a().transpose() * j.a() * axes;
    [a.m32 - a.m23, a.m13 - a.m31, a.m21 - a.m12]
}
reads!(a_relative_rotation, Symbolic, whole_frame(s(), s(), Mat3::identity()),
    at [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], 0.0 => [0.0, 0.0, 0.0]);

mod elsewhere {
    use kin::prelude::*;

    /// Visible from outside of its module.
    #[constraint(symbolic)]
    pub(crate) fn hidden(a: Coord, scale: super::Scale) -> f64 {
        a.sin() * scale.0 - super::LIFT
    }
}

#[derive(Clone)]
pub(crate) struct Scale(pub f64);
reads!(a_constraint_in_a_module, Symbolic, elsewhere::hidden(c(), Scale(2.0)), at [0.0], 0.0 => [-0.3]);

#[law]
fn law_of_y(y: f64, x: f64, t: f64) -> f64 {
    y * y * x + t
}

#[test]
fn a_parameter_of_a_law_may_be_called_x() {
    assert_eq!(law_of_y(2.0, 1.0).jet(3.0), [19.0, 12.0, 4.0, 0.0]);
}

#[constraint]
pub fn generic_inside(a: Coord, k: f64) -> f64 {
    fn square<D: Dual>(x: Real<D>) -> Real<D> {
        x * x
    }
    square(a) - square(k)
}

#[test]
fn a_generic_function_inside_the_body() {
    assert_eq!(kin::extend::terms(&generic_inside(c(), 2.0), &[3.0], &[], 0.0).c[0], 5.0);
    kin::check::derivatives(generic_inside(c(), 2.0));
}

#[constraint]
#[require(k > 0.0)]
#[require(axis.h.z >= 0.0, "the axis points upwards")]
#[branch(b.direction(axis.h).z > 0.0, "it stands on its head")]
fn demanding(b: Spatial, axis: Axis, k: f64) -> (f64, f64) {
    let f = b.direction(axis.f);
    let g = b.direction(axis.g);
    (k * f.z, g.dot(vec3(0.0, 0.0, k)) + axis.h.cross(axis.f).dot(axis.g) - 1.0)
}
reads!(an_axis_with_its_directions, Symbolic, demanding(s(), vec3(0.0, 0.0, 3.0), 2.0),
    at [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], 0.0 => [0.0, 0.0]);

#[constraint(dual)]
#[require(k > 0.0)]
fn demanding_by_dual(b: Spatial, axis: Axis, k: f64, profile: Law) -> f64 {
    b.direction(axis.f).z * k + profile.slope(b.r.x)
}
reads!(an_axis_and_a_slope_by_dual_numbers, Dual, demanding_by_dual(s(), vec3(0.0, 0.0, 1.0), 2.0, Law::polynomial(&[0.0, 0.0, 1.0])),
    at [3.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], 0.0 => [6.0]);

#[constraint]
fn tangent(a: Coord, b: Coord, curve: Law) -> f64 {
    b * curve.slope(a) - curve.slope(2.0 * b) + curve.at(a)
}
reads!(the_slope_of_a_law, Symbolic, tangent(c(), c(), Law::polynomial(&[0.0, 1.0, 0.0, 1.0])), at [1.0, 2.0], 0.0 => [8.0 - 49.0 + 2.0]);

#[test]
fn what_is_demanded_is_said_with_its_numbers() {
    let up = vec3(0.0, 0.0, 1.0);
    assert_eq!(demanding(s(), up, 2.0).refusal(), None);
    assert_eq!(
        demanding(s(), up, -2.0).refusal().as_deref(),
        Some("`k > 0.0` does not hold (k = -2)")
    );
    assert_eq!(
        demanding(s(), vec3(0.0, 0.0, -1.0), 2.0).refusal().as_deref(),
        Some("the axis points upwards (axis.x = 0, axis.y = 0, axis.z = -1)")
    );
    assert!(demanding_by_dual(s(), up, 0.0, Law::ramp(1.0)).refusal().is_some());
    assert!(
        demanding(s(), vec3(0.0, 0.0, 0.0), 2.0)
            .refusal()
            .expect("no direction")
            .starts_with("axis: the axis has no direction")
    );
}

#[test]
fn the_words_of_the_documentation_come_with_the_constraint() {
    let bump = bump(1.0);
    assert_eq!(bump.description(), "A smooth bump.");
    assert_eq!(
        elsewhere::hidden(c(), Scale(1.0)).facts().description,
        "Visible from outside of its module."
    );
}

// `+=` reads and writes the place that `index_mut` gives, which is another one than that of `index`
// here.
twice! { Symbolic places_that_index_mut_gives(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    struct Turned {
        cells: [f64; 4],
    }
    impl std::ops::Index<usize> for Turned {
        type Output = f64;
        fn index(&self, k: usize) -> &f64 {
            &self.cells[k]
        }
    }
    impl std::ops::IndexMut<usize> for Turned {
        fn index_mut(&mut self, k: usize) -> &mut f64 {
            &mut self.cells[3 - k]
        }
    }
    let mut turned = Turned { cells: [1.0, a, b, 2.0] };
    turned[0] += a * b;
    turned[1] *= a;
    turned[0] * turned[3] - turned[1] * turned[2]
} }
