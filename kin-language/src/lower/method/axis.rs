//! `h.axis()` and `h.axis_near(f)`: an axis along a direction that does not move.

use super::Call;
use crate::lower::value::Value;
use crate::lower::{Read, Reader};
use syn::{ItemFn, parse_quote};

impl Reader {
    pub(super) fn axis_of(&mut self, h: &[kin_graph::Node], call: &Call) -> Read {
        let near = call.name == "axis_near";
        if !self.counted(usize::from(near), call) {
            return Ok(Value::Poison);
        }
        let mut vectors = vec![Value::Vector(h.to_vec())];
        vectors.extend(call.arguments.first().map(|f| f.clone().referent()));
        if vectors.iter().any(|vector| self.value_varies(vector)) {
            return Ok(self.no_derivative(&call.name, &call.whole.method));
        }
        let function = if near { axis_near() } else { axis() };
        let value = self.apply_inner(&function, 0, (vectors, &call.places), None, call.whole)?;
        let Value::Array(all) = value else { return Ok(Value::Poison) };
        let mut parts = all.into_iter().map(|part| match part {
            Value::Vector(v) => v,
            _ => vec![],
        });
        let mut next = || parts.next().unwrap_or_default();
        Ok(Value::Axis([next(), next(), next()]))
    }
}

/// Returns the steps of `Axis::along`.
fn axis() -> ItemFn {
    parse_quote! {
        fn axis(h: Vec3) -> [Vec3; 3] {
            fn unit(v: Vec3) -> Vec3 {
                let v = v / v.x.abs().max(v.y.abs()).max(v.z.abs());
                v / v.norm()
            }
            let h = unit(h);
            let x = h.x.abs();
            let y = h.y.abs();
            let z = h.z.abs();
            let f = if x > y && !(z >= x) {
                vec3(0.0, 1.0, 0.0)
            } else if !(x > y) && y > z {
                vec3(0.0, 0.0, 1.0)
            } else {
                vec3(1.0, 0.0, 0.0)
            };
            let f = unit(f - h * h.dot(f));
            [h, f, h.cross(f)]
        }
    }
}

/// Returns the steps of `Axis::new`, and those of `Axis::along` where f is along h.
fn axis_near() -> ItemFn {
    let along = axis();
    parse_quote! {
        fn axis_near(h: Vec3, f: Vec3) -> [Vec3; 3] {
            #along
            fn unit(v: Vec3) -> Vec3 {
                let v = v / v.x.abs().max(v.y.abs()).max(v.z.abs());
                v / v.norm()
            }
            let [own, other, _] = axis(h);
            let f = unit(f);
            let part = f - own * own.dot(f);
            let f = if part.norm() > 1e-9 { unit(part) } else { other };
            [own, f, own.cross(f)]
        }
    }
}
