//! Methods of body states.

use super::Call;
use crate::lower::value::Value;
use crate::lower::{Attachment, Read, Reader};
use kin_graph::Node;

impl Reader {
    pub(super) fn state_method(&mut self, slot: usize, n: usize, call: &Call) -> Read {
        let body = if n == 2 { "a planar body" } else { "a spatial body" };
        let name = call.name.as_str();
        if name == "a" {
            return Ok(match self.counted(0, call) {
                true => Value::Matrix(n, self.rotation(slot, n)),
                false => Value::Poison,
            });
        }
        if !matches!(name, "point" | "direction" | "local") {
            let cure = match self.state_field(slot, n, name) {
                Some(_) => format!(": write the field `{name}` without `()`"),
                None => ": the methods are `a()`, `point(u)`, `direction(h)`, `local(p)`".into(),
            };
            return Ok(self.unknown(call, &format!("the state of {body}"), &cure));
        }
        if !self.counted(1, call) {
            return Ok(Value::Poison);
        }
        let place = call.places[0];
        let value = match call.arguments[0].clone().referent() {
            Value::Vector(v) if v.len() != n => {
                let text = format!(
                    "`{name}` of {body} needs a Vec{n}, but the argument is a Vec{}",
                    v.len()
                );
                self.mistake(place, text)
            }
            value => value,
        };
        let v = self.convertible(value, n, place);
        if name != "local" {
            self.attach(slot, name == "point", &v);
        }
        Ok(Value::Vector(match name {
            "point" => self.point(slot, &v),
            "direction" => self.direction(slot, &v),
            _ => self.local(slot, &v),
        }))
    }

    /// Adds a local point or direction of a body, unless it depends on coordinates or time.
    fn attach(&mut self, slot: usize, is_point: bool, local: &[Node]) {
        let attachment = Attachment { slot, is_point, local: local.to_vec() };
        let moves = local.iter().any(|&node| self.graph.depends(node).varies());
        if !moves && !self.attachments.contains(&attachment) {
            self.attachments.push(attachment);
        }
    }
}
