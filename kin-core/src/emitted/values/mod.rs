//! How values cross between the user's program and emitted code: arguments, parameters, numbers
//! inside of what only the program knows.

mod argument;
mod cast;
mod foreign;
mod lift;
mod numbers;
mod parameter;
mod probe;

pub use argument::{IntoConstant, IntoField, IntoJet, IntoPlain, IntoReference, Jet, Nothing};
pub use argument::{constant_argument, plain_argument, reference_argument};
pub use cast::{Cast, Whole, cast, whole};
pub use foreign::{
    Foreign, LiftAny, LiftNumbers, LowerAny, LowerReal, ReceiveAny, ReceiveNumbers,
    ReceiveReference, Returned, returned,
};
pub use lift::{Absent, Constants, Lift, Lower, absent, constants, lowered};
pub use numbers::{Numbers, set, set_at, set_law, visit};
pub use parameter::{Named, Own, Parameter, held, is_parameter};
pub use probe::{AsIs, Converted, Probe, Same, TakesAsIs, TakesConverted, of};
