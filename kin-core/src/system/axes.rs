//! Stores axes whose components a program sets one by one.
//!
//! A constraint stores unit vectors, but this module stores the directions as the user gave them.
//! So an axis does not depend on the order of the set components, nor on their earlier values.

use super::System;
use crate::model::describer::Describer;
use crate::numbers::algebra::Axis;

/// An axis of a constraint, with the given directions along it and across it.
#[derive(Clone, Debug)]
pub(crate) struct Given {
    block: usize,
    name: String,
    directions: [f64; 6],
}

impl Given {
    fn is(&self, block: usize, name: &str) -> bool {
        self.block == block && self.name == name
    }
}

impl System {
    /// Returns the axis and the index of its component for a parameter such as `h_i.x`, or `None`
    /// if the parameter is no component.
    pub(super) fn component(&self, block: usize, parameter: &str) -> Option<(String, usize)> {
        let (axis, component) = parameter.rsplit_once('.')?;
        let k = ["x", "y", "z"].iter().position(|known| *known == component)?;
        self.directions(block, axis).map(|_| (axis.to_string(), k))
    }

    /// Returns the component of an axis as it was given, if it was given.
    pub(super) fn given_component(&self, block: usize, parameter: &str) -> Option<f64> {
        let (axis, component) = parameter.rsplit_once('.')?;
        let k = ["x", "y", "z"].iter().position(|known| *known == component)?;
        self.axes.iter().find(|given| given.is(block, axis)).map(|given| given.directions[k])
    }

    /// Sets component k of the axis that contains parameter `index` of a constraint. Returns false
    /// if it cannot be set.
    pub(super) fn put_numbered(
        &mut self,
        block: usize,
        index: usize,
        k: usize,
        value: f64,
    ) -> bool {
        let mut count = 0;
        let mut axis = String::new();
        if let Some(block) = self.equations.blocks.get(block) {
            block.constraint.parameters(&mut |name, _| {
                if count == index {
                    axis = name.rsplit_once('.').map_or("", |(axis, _)| axis).to_string();
                }
                count += 1;
            });
        }
        self.put_component(block, (&axis, k), value)
    }

    /// Returns the given directions along an axis and across it, or `None` if there is no axis with
    /// this name.
    pub(super) fn directions(&self, block: usize, name: &str) -> Option<[f64; 6]> {
        let given = self.axes.iter().find(|given| given.is(block, name));
        given.map(|given| given.directions).or_else(|| self.directions_now(block, name))
    }

    /// Returns the unit vectors that the constraint stores.
    fn directions_now(&self, block: usize, name: &str) -> Option<[f64; 6]> {
        let constraint = &self.equations.blocks.get(block)?.constraint;
        if !constraint.clone_boxed().set_parameter(&Axis::name_of(name, 0), 1.0) {
            return None;
        }
        let mut described = Describer::default();
        constraint.describe(&mut described);
        let mut numbers =
            described.parameters.get(name)?.as_array()?.iter().flat_map(|v| v.as_array());
        let [h, f] = [numbers.next()?, numbers.next()?];
        let mut all = h.iter().chain(f).filter_map(|x| x.as_f64());
        let mut directions = [f64::NAN; 6];
        directions.iter_mut().for_each(|to| *to = all.next().unwrap_or(f64::NAN));
        Some(directions)
    }

    /// Sets a component of the direction along an axis. Returns false if it cannot be set.
    pub(super) fn put_component(
        &mut self,
        block: usize,
        (name, k): (&str, usize),
        value: f64,
    ) -> bool {
        let Some(mut directions) = self.directions(block, name) else { return false };
        directions[k] = value;
        self.forget_axis(block, name);
        self.axes.push(Given { block, name: name.to_string(), directions });
        // If the axis now lies along the old direction across it, any other direction across
        // serves.
        let chosen = Axis::given(&directions);
        let axis = if chosen.is_sound() { chosen } else { Axis::given(&directions[..3]) };
        let constraint = &mut self.equations.blocks[block].constraint;
        let mut parts = (0..).zip(axis.numbers());
        parts.all(|(part, value)| constraint.set_parameter(&Axis::name_of(name, part), value))
    }

    /// Discards the given directions, because the axis has changed.
    pub(super) fn forget_axis(&mut self, block: usize, name: &str) {
        self.axes.retain(|given| !given.is(block, name));
    }
}
