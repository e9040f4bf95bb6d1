//! Named dimensions of a mechanism, and the numbers that hang on them.

use kin_graph::{Input, Node, Op};

use super::Mechanism;
use crate::model::constraint::Constraint;
use crate::model::dimension::{
    Beside, Bound, Dimension, DimensionError, Distribution, Entry, Holder, Hung, IntoNumber, Of,
    Shared, Snapshot, text_of,
};
use crate::model::error::{Error, Result};
use crate::model::layout::Kind;
use crate::numbers::algebra::{Axis, Vec2};

impl Mechanism {
    /// A named number that others hang on, with its nominal value: a length, an angle, a rate. See
    /// [`Dimension`] for what can be made of it. Given an expression of others, it is a name for
    /// that.
    ///
    /// Errors: name empty or taken, value not finite, an expression of another mechanism's
    /// dimensions.
    pub fn dimension(&mut self, name: &str, value: impl IntoNumber) -> Result<Dimension> {
        let number = value.into_number();
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "dimension" });
        }
        if !number.value().is_finite() {
            return Err(DimensionError::invalid(
                name,
                format!("it is {}; give a finite number", number.value()),
            ));
        }
        self.check_origin(name, number)?;
        let mechanism = self.layout.mechanism;
        let shared = self.dimensions.get_or_insert_with(|| Shared::new(mechanism));
        let mut store = shared.store();
        if store.entries.iter().any(|entry| entry.name == name) {
            return Err(Error::DuplicateName { what: "dimensions", name: name.to_string() });
        }
        let (node, is_derived) = match number.of() {
            Of::Expression(_, node) => (node, true),
            _ => {
                let k = store.entries.len();
                (store.graph.raw(Op::Input(Input::Parameter(k))), false)
            }
        };
        let value = number.value();
        let unit = String::new();
        let entry = Entry {
            name: name.to_string(),
            node,
            is_derived,
            value,
            unit,
            range: None,
            tolerance: None,
            distribution: None,
            clearance: None,
        };
        store.entries.push(entry);
        Ok(Dimension::new(value, mechanism, node))
    }

    /// The clearance of a joint, a dimension of two numbers: where its pin is in its hole, which is
    /// wider by `radius` on every side. Both are zero, and may be off, uniformly in the disc of
    /// that radius. It is added to a point of the joint:
    /// `revolute(crank, rod, crank.end() + gap, rod.start())`.
    ///
    /// Errors: those of [`Mechanism::dimension`] for `NAME.x` and `NAME.y`; a radius that is
    /// negative or not finite is told when the mechanism is built.
    pub fn clearance(&mut self, name: &str, radius: f64) -> Result<Vec2<Dimension>> {
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "clearance" });
        }
        let [x, y] = ["x", "y"].map(|axis| self.dimension(&format!("{name}.{axis}"), 0.0));
        let own = |part: Dimension| part.tolerance(radius).in_clearance(name);
        Ok(Vec2 { x: own(x?), y: own(y?) })
    }

    /// An error by name unless a number is a constant or of this mechanism's dimensions.
    pub(super) fn check_origin(&self, place: &str, number: Dimension) -> Result<()> {
        match number.of() {
            Of::Nothing => Ok(()),
            Of::Expression(mechanism, _) if mechanism == self.layout.mechanism => Ok(()),
            _ => {
                let mechanism = self.name.clone();
                let place = place.to_string();
                Err(Box::new(DimensionError::Foreign { mechanism, place }).into())
            }
        }
    }

    /// Notes that a number hangs on dimensions, if it does, and gives its value.
    pub(crate) fn hang(&mut self, place: &str, at: Bound, number: Dimension) -> Result<f64> {
        self.check_origin(place, number)?;
        if let Of::Expression(_, node) = number.of() {
            self.hung.push(Hung { at, node });
        }
        Ok(number.value())
    }

    /// Declares a body or coordinate whose guess may hang on dimensions.
    pub(crate) fn declare_hung(
        &mut self,
        name: &str,
        kind: Kind,
        guess: &[Dimension],
    ) -> Result<usize> {
        guess.iter().try_for_each(|number| self.check_origin(name, *number))?;
        let values: Vec<f64> = guess.iter().map(|number| number.value()).collect();
        let index = self.declare(name, kind, &values)?;
        for (column, number) in (self.layout.items[index].first..).zip(guess) {
            self.hang(name, Bound::Guess(column), *number)?;
        }
        Ok(index)
    }

    /// The guesses of these coordinates are given anew, and no longer hang on dimensions.
    pub(super) fn free_guesses(&mut self, columns: std::ops::Range<usize>) {
        self.hung.retain(|hung| match hung.at {
            Bound::Guess(column) => !columns.contains(&column),
            Bound::Between { first, .. } | Bound::Facing { first, .. } => {
                columns.end <= first || first + 7 <= columns.start
            }
            _ => true,
        });
    }

    /// The parameters of a constraint that hang on dimensions, with their places.
    pub(super) fn hung_parameters(
        &self,
        place: &str,
        holder: Holder,
        bound: Vec<(String, Dimension)>,
        of: &dyn Constraint,
    ) -> Result<Vec<Hung>> {
        if bound.is_empty() {
            return Ok(Vec::new());
        }
        let mut names = Vec::new();
        of.parameters(&mut |name, _| names.push(name.to_string()));
        let mut hung = Vec::new();
        for (name, number) in bound {
            self.check_origin(place, number)?;
            let at = match (names.iter().position(|known| *known == name), axis_part(of, &name)) {
                (Some(index), _) => Bound::Parameter { of: holder, index, name },
                (None, Some((name, part))) => Bound::Axis { of: holder, name, part },
                (None, None) => {
                    let reason = format!("it has no parameter `{name}` that can be set");
                    return Err(DimensionError::invalid(place, reason));
                }
            };
            hung.extend(self.node_for(&at, number).map(|node| Hung { at, node }));
        }
        Ok(hung)
    }

    /// The numbers of what has mass or acts that hang on dimensions, with their places.
    pub(super) fn hung_beside(
        &self,
        place: &str,
        of: &Beside,
        bound: Vec<(String, Dimension)>,
    ) -> Result<Vec<Hung>> {
        let mut hung = Vec::new();
        for (name, number) in bound {
            self.check_origin(place, number)?;
            let at = Bound::Beside { of: of.clone(), name };
            hung.extend(self.node_for(&at, number).map(|node| Hung { at, node }));
        }
        Ok(hung)
    }

    /// Notes the same, in place of what was noted of it before.
    pub(super) fn hang_beside(
        &mut self,
        place: &str,
        of: Beside,
        bound: Vec<(String, Dimension)>,
    ) -> Result<()> {
        let hung = self.hung_beside(place, &of, bound)?;
        self.hung
            .retain(|known| !matches!(&known.at, Bound::Beside { of: known, .. } if *known == of));
        self.hung.extend(hung);
        Ok(())
    }

    /// The expression of a number, if it is to be noted: all numbers of an axis or a pose are, also
    /// those that are constants.
    fn node_for(&self, at: &Bound, number: Dimension) -> Option<Node> {
        match (number.of(), at) {
            (Of::Expression(_, node), _) => Some(node),
            (_, at) if at.is_of_several() => {
                let shared = self.dimensions.as_ref()?;
                Some(shared.store().graph.raw(Op::Constant(number.value().to_bits())))
            }
            _ => None,
        }
    }

    /// Notes that the guess of a spatial body hangs on the numbers that it is drawn by, if any of
    /// them hangs on dimensions.
    pub(crate) fn hang_pose(
        &mut self,
        place: &str,
        numbers: &[Dimension],
        at: impl Fn(usize) -> Bound,
    ) -> Result<()> {
        numbers.iter().try_for_each(|number| self.check_origin(place, *number))?;
        if numbers.iter().all(|number| number.of() == Of::Nothing) {
            return Ok(());
        }
        for (part, number) in numbers.iter().enumerate() {
            let at = at(part);
            if let Some(node) = self.node_for(&at, *number) {
                self.hung.push(Hung { at, node });
            }
        }
        Ok(())
    }

    /// The dimensions as the system needs them; `None` of a mechanism that has none.
    ///
    /// Errors, by name: a dimension on which nothing hangs, with the name of a parameter or
    /// coordinate, with a range that excludes its value or a tolerance that makes no sense; a range
    /// of an expression.
    pub(crate) fn dimensions(&self) -> Result<Option<Snapshot>> {
        let Some(shared) = &self.dimensions else { return Ok(None) };
        let store = shared.store();
        let preferred = |column: usize| self.preferred.iter().any(|(known, _)| *known == column);
        let mut hung = self.hung.clone();
        hung.retain(|hung| !matches!(hung.at, Bound::Guess(column) if preferred(column)));
        let snapshot = Snapshot::new(&store.graph, &store.entries, hung);
        if let Some(node) = store.misplaced {
            let text = text_of(&store.graph, &store.entries, node).unwrap_or_default();
            let reason =
                "it is an expression; give range, tolerance and unit to the dimensions in it";
            return Err(DimensionError::invalid(&text, reason));
        }
        for (k, entry) in store.entries.iter().enumerate() {
            entry.check()?;
            entry.check_clearance(&store.entries)?;
            self.check_name(&entry.name)?;
            if !entry.is_derived && snapshot.on(k).next().is_none() {
                return Err(Box::new(DimensionError::Unused { name: entry.name.clone() }).into());
            }
        }
        Ok(Some(snapshot))
    }

    /// An error unless a dimension can be told from parameters and coordinates by its name.
    fn check_name(&self, name: &str) -> Result<()> {
        let mut taken = self.layout.names.iter().any(|known| known == name);
        for (constraint, own) in &self.constraints {
            let Some(local) =
                name.strip_prefix(constraint.as_str()).and_then(|rest| rest.strip_prefix('.'))
            else {
                continue;
            };
            own.parameters(&mut |known, _| taken |= known == local);
        }
        match taken {
            true => Err(DimensionError::invalid(
                name,
                "a coordinate or parameter has that name; give another",
            )),
            false => Ok(()),
        }
    }
}

/// The axis of a constraint that a name stands for a number of (`h_i.f.x`), and the number of that.
fn axis_part(of: &dyn Constraint, name: &str) -> Option<(String, usize)> {
    let axis = name.get(..name.len().checked_sub(4)?)?;
    let part = (0..9).find(|part| Axis::name_of(axis, *part) == name)?;
    of.clone_boxed().set_parameter(name, 1.0).then(|| (axis.to_string(), part))
}

impl Entry {
    /// An error unless range and tolerance make sense.
    fn check(&self) -> Result<()> {
        let fail = |reason: String| Err(DimensionError::invalid(&self.name, reason));
        match (self.range, self.tolerance) {
            (Some([from, to]), _) if !(from <= self.value && self.value <= to) => {
                fail(format!("its range {from} … {to} excludes its value {}", self.value))
            }
            (_, Some(tolerance)) if !(tolerance >= 0.0 && tolerance.is_finite()) => fail(format!(
                "its tolerance is ± {tolerance}; give a finite number that is not negative"
            )),
            _ => Ok(()),
        }
    }
    /// An error unless a disc is that of a clearance, which has two dimensions with one tolerance.
    fn check_clearance(&self, all: &[Entry]) -> Result<()> {
        let fail = |reason: String| Err(DimensionError::invalid(&self.name, reason));
        match (&self.clearance, self.distribution) {
            (None, Some(Distribution::Disc)) => fail(
                "a disc is the distribution of a clearance: make it by `m.clearance(…)`"
                    .to_string(),
            ),
            (None, _) => Ok(()),
            (Some(name), Some(Distribution::Disc)) => {
                let own: Vec<&Entry> =
                    all.iter().filter(|other| other.clearance == self.clearance).collect();
                match own[..] {
                    [a, b] if a.tolerance == b.tolerance && a.tolerance.is_some() => Ok(()),
                    _ => fail(format!(
                        "the clearance `{name}` has two dimensions, and one tolerance for both of them"
                    )),
                }
            }
            (Some(name), _) => {
                fail(format!("it is one of the clearance `{name}`, which is uniform in its disc"))
            }
        }
    }
}
