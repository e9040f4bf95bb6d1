//! The first room: names, the values behind them, and the frames around the present position. It
//! knows nothing of values: each of its types holds any `V`.

mod frames;
mod names;
mod places;
mod store;

pub use frames::{Exit, Frame, Frames, Guard, Kind};
pub use names::{Name, Scopes};
pub use places::{Place, Slot, Step};
pub use store::{Changes, Mark, Store};
