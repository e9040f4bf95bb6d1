//! Numeric parameters by name.

use crate::law::Law;
use crate::numbers::algebra::{Axis, EulerParameters, Mat2, Mat3, Vec2, Vec3};

/// A parameter made of numbers, each with a name: `k`, `u.x`, `c[2]`, `profile.rate`.
pub trait Numbers {
    /// Shows each number with its name.
    fn visit(&self, name: &str, visit: &mut dyn FnMut(&str, f64));
    /// Sets the number called `wanted`; false if it is not one of these.
    fn set(&mut self, name: &str, wanted: &str, value: f64) -> bool;
    /// Sets the number that `index` others come before; false if there are not as many, and those
    /// are taken from `index`.
    fn set_at(&mut self, index: &mut usize, value: f64) -> bool;
}

/// Replaces the law called `wanted` among them; false if there is none.
pub fn set_law(laws: &mut [(&str, &mut Law)], wanted: &str, law: &Law) -> bool {
    let Some((_, place)) = laws.iter_mut().find(|(name, _)| *name == wanted) else { return false };
    **place = law.clone();
    true
}

/// Shows the numbers of some parameters.
pub fn visit(parameters: &[(&str, &dyn Numbers)], visit: &mut dyn FnMut(&str, f64)) {
    parameters.iter().for_each(|(name, parameter)| parameter.visit(name, visit));
}

/// Sets the number called `wanted` among them; false if there is none.
pub fn set(parameters: &mut [(&str, &mut dyn Numbers)], wanted: &str, value: f64) -> bool {
    parameters.iter_mut().any(|(name, parameter)| parameter.set(name, wanted, value))
}

/// Sets the number that `index` others come before; false if there are not as many.
pub fn set_at(parameters: &mut [&mut dyn Numbers], mut index: usize, value: f64) -> bool {
    parameters.iter_mut().any(|parameter| parameter.set_at(&mut index, value))
}

impl Numbers for f64 {
    fn visit(&self, name: &str, visit: &mut dyn FnMut(&str, f64)) {
        visit(name, *self);
    }

    fn set(&mut self, name: &str, wanted: &str, value: f64) -> bool {
        if name == wanted {
            *self = value;
        }
        name == wanted
    }

    fn set_at(&mut self, index: &mut usize, value: f64) -> bool {
        let found = *index == 0;
        if found {
            *self = value;
        }
        *index = index.wrapping_sub(1);
        found
    }
}

impl Numbers for Law {
    fn visit(&self, name: &str, visit: &mut dyn FnMut(&str, f64)) {
        self.parameters(&mut |part, value| visit(&format!("{name}.{part}"), value));
    }

    fn set(&mut self, name: &str, wanted: &str, value: f64) -> bool {
        wanted
            .strip_prefix(name)
            .and_then(|rest| rest.strip_prefix('.'))
            .is_some_and(|part| self.set_parameter(part, value))
    }

    /// Laws are shared and go by name.
    fn set_at(&mut self, index: &mut usize, value: f64) -> bool {
        let mut count = 0;
        let mut wanted = None;
        self.parameters(&mut |part, _| {
            if count == *index {
                wanted = Some(part.to_string());
            }
            count += 1;
        });
        *index = index.wrapping_sub(count);
        wanted.is_some_and(|part| self.set_parameter(&part, value))
    }
}

/// The components of h. With one of them changed f and g are worked out anew, f as near to the old
/// one as may be. Its nine numbers can be set as they are, too, under the names `NAME.h.x`, …,
/// `NAME.g.z`.
impl Numbers for Axis {
    fn visit(&self, name: &str, visit: &mut dyn FnMut(&str, f64)) {
        self.h.visit(name, visit);
    }

    fn set(&mut self, name: &str, wanted: &str, value: f64) -> bool {
        let mut h = self.h;
        let found = h.set(name, wanted, value);
        if found {
            let chosen = Axis::new(h, self.f);
            *self = if chosen.is_sound() { chosen } else { Axis::along(h) };
        }
        let own = |vector: &mut Vec3, of: &str| vector.set(&format!("{name}.{of}"), wanted, value);
        found || own(&mut self.h, "h") || own(&mut self.f, "f") || own(&mut self.g, "g")
    }

    fn set_at(&mut self, index: &mut usize, value: f64) -> bool {
        let name = ["x", "y", "z"].get(*index);
        *index = index.wrapping_sub(3);
        name.is_some_and(|name| self.set("", &format!(".{name}"), value))
    }
}

impl<T: Numbers, const N: usize> Numbers for [T; N] {
    fn visit(&self, name: &str, visit: &mut dyn FnMut(&str, f64)) {
        self.iter().enumerate().for_each(|(k, part)| part.visit(&format!("{name}[{k}]"), visit));
    }

    fn set(&mut self, name: &str, wanted: &str, value: f64) -> bool {
        self.iter_mut()
            .enumerate()
            .any(|(k, part)| part.set(&format!("{name}[{k}]"), wanted, value))
    }

    fn set_at(&mut self, index: &mut usize, value: f64) -> bool {
        self.iter_mut().any(|part| part.set_at(index, value))
    }
}

macro_rules! fields {
    ($($ty:ty { $($c:tt),* } $([$($t:ident),*])?;)*) => {$(
        impl $(<$($t: Numbers),*>)? Numbers for $ty {
            fn visit(&self, name: &str, visit: &mut dyn FnMut(&str, f64)) {
                $(self.$c.visit(&format!("{name}.{}", stringify!($c)), visit);)*
            }

            fn set(&mut self, name: &str, wanted: &str, value: f64) -> bool {
                $(self.$c.set(&format!("{name}.{}", stringify!($c)), wanted, value))||*
            }

            fn set_at(&mut self, index: &mut usize, value: f64) -> bool {
                $(self.$c.set_at(index, value))||*
            }
        }
    )*};
}

fields! {
    Vec2 { x, y };
    Vec3 { x, y, z };
    EulerParameters { e0, e1, e2, e3 };
    Mat2 { m11, m12, m21, m22 };
    Mat3 { m11, m12, m13, m21, m22, m23, m31, m32, m33 };
    (A,) { 0 } [A];
    (A, B) { 0, 1 } [A, B];
    (A, B, C) { 0, 1, 2 } [A, B, C];
    (A, B, C, D) { 0, 1, 2, 3 } [A, B, C, D];
}
