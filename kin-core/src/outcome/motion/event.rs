//! Describes the events of a motion.
//!
//! An event happens at one time to a named part of the mechanism.

use serde::{Deserialize, Serialize};

use super::Motion;
use crate::coordinates::units::Units;
use crate::outcome::words::time;

/// The kind of an [`Event`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum EventKind {
    /// A measure passes an end of its range, such as a stop or the end of a slot.
    Limit,
    /// The motion reaches a toggle, beyond which no position exists.
    TurningPoint,
    /// The motion passes a change point, where branches cross.
    Bifurcation,
    /// An equation has a kink: the condition of an `if` changes, or `abs`, `max` or `min` changes
    /// its branch. The derivatives at this time are those of one branch. Kin does not find the
    /// kinks of constraints on the dual route.
    Kink,
    /// The run leaves the range of the table of a law, and the law continues as a straight line.
    /// Kin does not report a sequence that holds its last value.
    BeyondRange,
}

impl EventKind {
    /// Returns true if the event is a warning: the motion after the event may not be the motion
    /// that the user wants.
    pub fn is_warning(self) -> bool {
        matches!(self, EventKind::BeyondRange)
    }
}

impl std::fmt::Display for EventKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            EventKind::Limit => "limit",
            EventKind::TurningPoint => "turning point",
            EventKind::Bifurcation => "bifurcation",
            EventKind::Kink => "kink",
            EventKind::BeyondRange => "beyond range",
        })
    }
}

/// An event at one time of a motion, usually between two times of the grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Event {
    /// The time of the event. \[s\]
    pub t: f64,
    /// Names of the units of length and time. A motion that receives the event sets the names.
    #[serde(default, skip_serializing_if = "Units::is_default")]
    pub units: Units,
    /// The kind of the event.
    pub kind: EventKind,
    /// The user's name of the measure, constraint or body to which the event happens, such as
    /// `slot.slide`.
    pub name: String,
    /// A sentence that describes the event.
    pub text: String,
}

impl std::fmt::Display for Event {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "t = {} {}: {}", time(self.t), self.units.time(), self.text)
    }
}

impl Motion {
    /// Returns the events of the motion, in the order in which the run reached them.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Inserts an event by its time, in the direction of the run.
    pub(crate) fn add_event(&mut self, mut event: Event) {
        event.units = self.layout.words.clone();
        let backwards = matches!(self.times[..], [first, .., last] if last < first);
        let later = |known: &Event| if backwards { known.t < event.t } else { known.t > event.t };
        let place = self.events.iter().position(later).unwrap_or(self.events.len());
        self.events.insert(place, event);
        self.warnings.take();
    }
}
