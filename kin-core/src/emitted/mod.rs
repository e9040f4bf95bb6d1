//! Support for emitted code. Programs do not use it directly: no item here is part of the public
//! interface.

mod columns;
mod editor;
mod ended;
pub mod graph;
mod kernel;
pub mod math;
mod refused;
mod rows;
mod sound;
mod timed;
mod values;

pub use crate::data::{
    Described, Describer, Incoming, IncomingBySerde, IncomingRefused, Outgoing, OutgoingBySerde,
    OutgoingConstant, OutgoingRefused, Reader, RefusedConstant,
};
use crate::dimensions::{self, Name};

pub use crate::coordinates::{
    Argument, IntoCoordinate, IntoPlanarBody, IntoSpatialBody, Target, Trig,
};
pub use crate::dimensions::{Bindings, IntoAxis, IntoNumber, IntoParameter};
pub use crate::law::LawFunction;
pub use crate::model::blame::{Asked, Blame, Source};
pub use crate::model::constraint::{
    Attached, Attachment, Dependence, Entry, Facts, Measured, Parameters, Parts, Written,
};
pub use crate::model::dual_route::{ArgumentKind, Equation};
pub use crate::model::state::{At, Offsets, PlanarState, Rates, SpatialState};
pub use crate::numbers::algebra::{Axis, Components, EulerParameters, Mat2, Mat3, Vec2, Vec3};
pub use crate::numbers::real::{Dual, Dual2_64, Dual3_64, Dual64, Real};

pub use crate::{
    __inside_editor as inside_editor, __outside_editor as outside_editor, __stand_in as stand_in,
};
pub use columns::Columns;
pub use ended::ended;
pub use kernel::{first, fma, put};
pub use refused::{Refuses, refusal, refused};
pub use rows::{Rows, rows};
pub use sound::{If, Sound, Then, callee};
pub use timed::timed;
pub use values::*;

/// Returns \[f, f′, f″, f‴\] of a function that takes dual numbers of any kind.
pub fn jet_by_dual(x: f64, f: impl FnOnce(Real<Dual3_64>) -> Real<Dual3_64>) -> [f64; 4] {
    let y = f(Real(Dual3_64::new(x, 1.0, 0.0, 0.0))).0;
    [y.re, y.v1, y.v2, y.v3]
}

/// Creates a local point of an argument.
pub fn point(argument: usize, [x, y, z]: [f64; 3]) -> Attachment {
    Attachment { argument, what: Attached::Point(Vec3::new(x, y, z)) }
}

/// Creates a local direction of an argument.
pub fn direction(argument: usize, [x, y, z]: [f64; 3]) -> Attachment {
    Attachment { argument, what: Attached::Direction(Vec3::new(x, y, z)) }
}

/// Returns the points and directions of a constraint.
pub fn attachments(all: &[Attachment]) -> Vec<Attachment> {
    all.to_vec()
}

/// Converts the argument of a constructor to a vector, and records the components that depend on
/// dimensions.
pub fn vector<V: From<[f64; N]>, const N: usize>(
    components: impl Components<N, Scalar: IntoNumber>,
    name: &str,
    bindings: &mut Bindings,
) -> V {
    dimensions::vector(components, &Name::Own(name), bindings)
}

/// Converts the argument of a constructor to a parameter, and records the numbers that depend on
/// dimensions.
pub fn parameter<T>(given: impl IntoParameter<T>, name: &str, bindings: &mut Bindings) -> T {
    given.into_parameter(&Name::Own(name), bindings)
}

/// Converts the argument of a constructor to an axis, and records the directions that depend on
/// dimensions.
pub fn axis(given: impl IntoAxis, name: &str, bindings: &mut Bindings) -> Axis {
    given.into_axis(name, bindings)
}

/// Returns the arguments of a constraint.
pub fn arguments(all: &[Argument]) -> Vec<Argument> {
    all.to_vec()
}

/// Writes −C_t of a constraint without time: zeros.
pub fn no_velocity(rhs: &mut [f64], rows: usize) {
    rhs.iter_mut().take(rows).for_each(|value| *value = 0.0);
}
