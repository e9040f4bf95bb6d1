//! Where a derivative of a law jumps, and where a table or a sequence ends.

/// Where a derivative of a law jumps. At the break itself the law has the derivatives of its right
/// side, at the end of its range ([`LawRange`]) those of its left side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Break {
    /// The argument at which the law jumps.
    pub x: f64,
    /// The lowest derivative that jumps: 0 the value itself, 1 the slope, 2 the second, 3 the
    /// third. A law with breaks of order 2 is C¹.
    pub order: usize,
}

/// The arguments that a law is made for: those of a table, of the parts of a sequence. Beyond them
/// the law goes on as `beyond` says. A run that goes beyond a table, where the law is a straight
/// line, reports so ([`crate::results::EventKind::BeyondRange`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawRange {
    /// The first argument.
    pub from: f64,
    /// The last argument.
    pub to: f64,
    /// The law beyond them.
    pub beyond: Beyond,
}

/// The course of a law beyond its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Beyond {
    /// The straight line with the value and the slope of the end.
    Line,
    /// The value of the end.
    Held,
}

impl LawRange {
    /// True if x is one of the ends.
    pub(crate) fn ends_at(&self, x: f64) -> bool {
        x == self.from || x == self.to
    }

    /// The arguments in both ranges; those of one law alone if the other has no range.
    pub(super) fn common(first: Option<LawRange>, second: Option<LawRange>) -> Option<LawRange> {
        let (Some(a), Some(b)) = (first, second) else { return first.or(second) };
        let beyond = if a.to < b.to { a.beyond } else { b.beyond };
        Some(LawRange { from: a.from.max(b.from), to: a.to.min(b.to), beyond })
    }

    /// The arguments x for which c0 + c1 x is in the range.
    pub(super) fn before(self, c0: f64, c1: f64) -> LawRange {
        let [a, b] = [self.from, self.to].map(|y| (y - c0) / c1);
        LawRange { from: a.min(b), to: a.max(b), ..self }
    }
}
