//! Describes the ends of tables and sequences.

/// The range of arguments for which a law is defined, such as those of a table or of a sequence.
///
/// The field `beyond` says how the law continues outside the range. If a run leaves the range of a
/// table that continues as a straight line, the run reports
/// [`crate::results::EventKind::BeyondRange`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawRange {
    /// The smallest argument.
    pub from: f64,
    /// The largest argument.
    pub to: f64,
    /// The continuation of the law outside the range.
    pub beyond: Beyond,
}

/// The continuation of a law outside its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Beyond {
    /// The law continues as a straight line with the value and the slope of the end.
    Line,
    /// The law holds the value of the end.
    Held,
}

impl LawRange {
    /// Returns true if x is an end of the range.
    pub(crate) fn ends_at(&self, x: f64) -> bool {
        x == self.from || x == self.to
    }

    /// Returns the intersection of two ranges. A law without a range does not restrict the other
    /// law.
    pub(super) fn common(first: Option<LawRange>, second: Option<LawRange>) -> Option<LawRange> {
        let (Some(a), Some(b)) = (first, second) else { return first.or(second) };
        let beyond = if a.to < b.to { a.beyond } else { b.beyond };
        Some(LawRange { from: a.from.max(b.from), to: a.to.min(b.to), beyond })
    }

    /// Returns the arguments x for which c0 + c1 x is in the range.
    pub(super) fn before(self, c0: f64, c1: f64) -> LawRange {
        let [a, b] = [self.from, self.to].map(|y| (y - c0) / c1);
        LawRange { from: a.min(b), to: a.max(b), ..self }
    }
}
