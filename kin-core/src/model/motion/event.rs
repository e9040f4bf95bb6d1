//! Events of a motion: each happens at one time, to something with a name.

use serde::{Deserialize, Serialize};

use super::Motion;
use crate::model::units::Units;
use crate::model::words::time;

/// Kinds of [`Event`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum EventKind {
    /// A joint's measure passes the end of its range: a stop, the end of a slot.
    Limit,
    /// A toggle: beyond it there is no position.
    TurningPoint,
    /// A change point: branches of the motion cross.
    Bifurcation,
    /// A kink of an equation: the condition of an `if` changes, or `abs`, `max` or `min` takes its
    /// other side. Derivatives there are those of one side. Of constraints on the dual route kinks
    /// are not known.
    Kink,
    /// The run goes on beyond the end of a table of a law, where the law is a straight line. A
    /// sequence that holds its last value is not reported.
    BeyondRange,
}

impl EventKind {
    /// True if the event is a warning: what comes after it may not be meant.
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

/// Something that happens at one time of a motion, between the times of the grid as a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Event {
    /// When it happens.   \[s\]
    pub t: f64,
    /// Names of the units of length and time; a motion to which the event is added knows them.
    #[serde(default, skip_serializing_if = "Units::is_default")]
    pub units: Units,
    /// Kind of the event.
    pub kind: EventKind,
    /// Name, as the user gave it, of the thing to which it happens, such as `slot.slide`.
    pub name: String,
    /// The event as a sentence.
    pub text: String,
}

impl std::fmt::Display for Event {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "t = {} {}: {}", time(self.t), self.units.time(), self.text)
    }
}

impl Motion {
    /// The events of the motion, in the order in which it was run through.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Puts an event where its time belongs: after those that a run in this direction meets before
    /// it.
    pub(crate) fn add_event(&mut self, mut event: Event) {
        event.units = self.layout.words.clone();
        let backwards = matches!(self.times[..], [first, .., last] if last < first);
        let later = |known: &Event| if backwards { known.t < event.t } else { known.t > event.t };
        let place = self.events.iter().position(later).unwrap_or(self.events.len());
        self.events.insert(place, event);
        self.warnings.take();
    }
}
