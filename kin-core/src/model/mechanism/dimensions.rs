//! Declares the named dimensions of a mechanism and finds the numbers that depend on them.

use kin_graph::{Input, Node, Op};

use super::Mechanism;
use crate::coordinates::layout::Kind;
use crate::dimensions::{
    Beside, Bound, Dimension, Distribution, Entry, Holder, Hung, IntoNumber, Of, Shared, Snapshot,
    text_of,
};
use crate::model::constraint::Constraint;
use crate::numbers::algebra::{Axis, Vec2};
use crate::outcome::DimensionError;
use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, Result};

impl Mechanism {
    /// Declares a named dimension with its nominal value: a length, an angle, a velocity.
    ///
    /// Other numbers of the mechanism can depend on the dimension.
    ///
    /// [`Dimension`] lists the supported arithmetic. If `value` is an expression of other
    /// dimensions, the call gives the expression a name.
    ///
    /// Errors: the name is empty or taken, the value is not finite, the expression uses dimensions
    /// of another mechanism.
    pub fn dimension(&mut self, name: &str, value: impl IntoNumber) -> Result<Dimension> {
        let number = value.into_number();
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "dimension" });
        }
        if !number.value().is_finite() {
            return Err(DimensionError::invalid(
                name,
                format!("the value is {}. Give a finite number", number.value()),
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

    /// Declares the clearance of a joint, a pin with radial play in its hole, as two dimensions.
    ///
    /// `radius` is the radial clearance. Both dimensions have the nominal value zero and vary
    /// uniformly in the disc of this radius. Add the result to a point of the joint:
    /// `revolute(crank, rod, crank.end() + gap, rod.start())`.
    ///
    /// Errors: those of [`Mechanism::dimension`] for `NAME.x` and `NAME.y`. [`Mechanism::build`]
    /// returns an error for a radius that is negative or not finite.
    pub fn clearance(&mut self, name: &str, radius: f64) -> Result<Vec2<Dimension>> {
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "clearance" });
        }
        let [x, y] = ["x", "y"].map(|axis| self.dimension(&format!("{name}.{axis}"), 0.0));
        let own = |part: Dimension| part.tolerance(radius).in_clearance(name);
        Ok(Vec2 { x: own(x?), y: own(y?) })
    }

    /// Returns an error, by name, unless a number is a constant or depends on dimensions of this
    /// mechanism.
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

    /// Records a number that depends on dimensions, and returns the value of any number.
    pub(crate) fn hang(&mut self, place: &str, at: Bound, number: Dimension) -> Result<f64> {
        self.check_origin(place, number)?;
        if let Of::Expression(_, node) = number.of() {
            self.hung.push(Hung { at, node });
        }
        Ok(number.value())
    }

    /// Declares a body or coordinate whose guess may depend on dimensions.
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

    /// Removes the dependence of these guesses on dimensions, because they get new values.
    pub(super) fn free_guesses(&mut self, columns: std::ops::Range<usize>) {
        self.hung.retain(|hung| match hung.at {
            Bound::Guess(column) => !columns.contains(&column),
            Bound::Between { first, .. } | Bound::Facing { first, .. } => {
                columns.end <= first || first + 7 <= columns.start
            }
            _ => true,
        });
    }

    /// Returns the parameters of a constraint that depend on dimensions, with their places.
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
                    let reason = format!(
                        "the constraint has no parameter `{name}` that a dimension can set"
                    );
                    return Err(DimensionError::invalid(place, reason));
                }
            };
            hung.extend(self.node_for(&at, number).map(|node| Hung { at, node }));
        }
        Ok(hung)
    }

    /// Returns the numbers of a mass or load that depend on dimensions, with their places.
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

    /// Records these numbers of a mass or load and replaces earlier records of it.
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

    /// Returns the expression of a number that must be recorded. All numbers of an axis or a pose
    /// are recorded, including constants.
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

    /// Records that the guess of a spatial body depends on the numbers of its drawing, if one of
    /// them depends on dimensions.
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

    /// Returns the dimensions for the system, or `None` if the mechanism has no dimensions.
    ///
    /// Errors, by name: an unused dimension, a name that a parameter or coordinate has, a range
    /// that excludes the value, an invalid tolerance, a range of an expression.
    pub(crate) fn dimensions(&self) -> Result<Option<Snapshot>> {
        let Some(shared) = &self.dimensions else { return Ok(None) };
        let store = shared.store();
        let preferred = |column: usize| self.preferred.iter().any(|(known, _)| *known == column);
        let mut hung = self.hung.clone();
        hung.retain(|hung| !matches!(hung.at, Bound::Guess(column) if preferred(column)));
        let snapshot = Snapshot::new(&store.graph, &store.entries, hung);
        if let Some(node) = store.misplaced {
            let text = text_of(&store.graph, &store.entries, node).unwrap_or_default();
            let reason = "an expression has no range, tolerance or unit. Give these to the dimensions of the expression";
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

    /// Returns an error if a parameter or coordinate has the name of the dimension.
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
                "a coordinate or parameter has the same name. Give the dimension another name",
            )),
            false => Ok(()),
        }
    }
}

/// Returns the axis of a constraint and the index of its component that a name such as `h_i.f.x`
/// means.
fn axis_part(of: &dyn Constraint, name: &str) -> Option<(String, usize)> {
    let axis = name.get(..name.len().checked_sub(4)?)?;
    let part = (0..9).find(|part| Axis::name_of(axis, *part) == name)?;
    of.clone_boxed().set_parameter(name, 1.0).then(|| (axis.to_string(), part))
}

impl Entry {
    /// Returns an error unless range and tolerance are valid.
    fn check(&self) -> Result<()> {
        let fail = |reason: String| Err(DimensionError::invalid(&self.name, reason));
        match (self.range, self.tolerance) {
            (Some([from, to]), _) if !(from <= self.value && self.value <= to) => {
                fail(format!("the range {from} … {to} excludes the value {}", self.value))
            }
            (_, Some(tolerance)) if !(tolerance >= 0.0 && tolerance.is_finite()) => fail(format!(
                "the tolerance is ± {tolerance}. Give a finite number that is not negative"
            )),
            _ => Ok(()),
        }
    }
    /// Returns an error unless a disc belongs to a clearance, which has two dimensions with one
    /// tolerance.
    fn check_clearance(&self, all: &[Entry]) -> Result<()> {
        let fail = |reason: String| Err(DimensionError::invalid(&self.name, reason));
        match (&self.clearance, self.distribution) {
            (None, Some(Distribution::Disc)) => fail(format!(
                "a disc is the distribution of a clearance. Make the clearance by {}",
                Surface::chosen().clearance()
            )),
            (None, _) => Ok(()),
            (Some(name), Some(Distribution::Disc)) => {
                let own: Vec<&Entry> =
                    all.iter().filter(|other| other.clearance == self.clearance).collect();
                match own[..] {
                    [a, b] if a.tolerance == b.tolerance && a.tolerance.is_some() => Ok(()),
                    _ => fail(format!(
                        "the clearance `{name}` has two dimensions. Give both dimensions the same tolerance"
                    )),
                }
            }
            (Some(name), _) => fail(format!(
                "the dimension belongs to the clearance `{name}`, which has a uniform distribution in a disc. Do not give the dimension another distribution"
            )),
        }
    }
}
