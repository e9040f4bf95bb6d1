//! Reads and writes parameters as JSON values.

use std::marker::PhantomData;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::law::LawData;
use super::{Registry, read};
use crate::law::Law;
use crate::model::describer::Describer;
use crate::numbers::algebra::{Axis, EulerParameters, Mat2, Mat3, Vec2, Vec3};

/// A parameter that consists of numbers, or a law.
pub trait Datum: Sized {
    /// Returns the value as JSON.
    fn to_value(&self) -> Result<Value, String>;
    /// Reads the value from JSON; the registry creates laws.
    ///
    /// Errors: a sentence that describes the mistake.
    fn from_value(value: &Value, registry: &Registry) -> Result<Self, String>;
    /// Returns NaN, the substitute for a value that Kin could not read.
    fn absent() -> Self;
}

impl Datum for f64 {
    fn absent() -> Self {
        f64::NAN
    }

    fn to_value(&self) -> Result<Value, String> {
        serde_json::Number::from_f64(*self)
            .map(Value::Number)
            .ok_or_else(|| format!("{self} is no number of JSON"))
    }

    fn from_value(value: &Value, _: &Registry) -> Result<Self, String> {
        value.as_f64().ok_or_else(|| format!("{value} is not a number"))
    }
}

impl<T: Datum, const N: usize> Datum for [T; N] {
    fn absent() -> Self {
        std::array::from_fn(|_| T::absent())
    }

    fn to_value(&self) -> Result<Value, String> {
        self.iter().map(T::to_value).collect::<Result<Vec<_>, _>>().map(Value::Array)
    }

    fn from_value(value: &Value, registry: &Registry) -> Result<Self, String> {
        let parts = value
            .as_array()
            .filter(|parts| parts.len() == N)
            .ok_or_else(|| format!("{value} is not a list of {N}"))?;
        let parts = parts
            .iter()
            .map(|part| T::from_value(part, registry))
            .collect::<Result<Vec<T>, _>>()?;
        parts.try_into().map_err(|_| format!("{value} is not a list of {N}"))
    }
}

/// Implements a type with components as the list of them.
macro_rules! lists {
    ($($ty:ident($($c:ident),*);)*) => {$(
        impl Datum for $ty {
            fn absent() -> Self {
                $ty { $($c: Datum::absent()),* }
            }

            fn to_value(&self) -> Result<Value, String> {
                [$(self.$c),*].to_value()
            }

            fn from_value(value: &Value, registry: &Registry) -> Result<Self, String> {
                let [$($c),*] = Datum::from_value(value, registry)?;
                Ok($ty { $($c),* })
            }
        }
    )*};
}

lists! {
    Vec2(x, y);
    Vec3(x, y, z);
    EulerParameters(e0, e1, e2, e3);
    Mat2(m11, m12, m21, m22);
    Mat3(m11, m12, m13, m21, m22, m23, m31, m32, m33);
}

/// The vectors h, f and g. Reading also accepts h and f, or h alone.
impl Datum for Axis {
    fn absent() -> Self {
        Axis { h: Datum::absent(), f: Datum::absent(), g: Datum::absent() }
    }

    fn to_value(&self) -> Result<Value, String> {
        [self.h, self.f, self.g].to_value()
    }

    fn from_value(value: &Value, registry: &Registry) -> Result<Self, String> {
        match value.as_array().map(Vec::as_slice) {
            Some([Value::Array(_), Value::Array(_)]) => {
                let [h, f] = <[Vec3; 2]>::from_value(value, registry)?;
                Ok(Axis::new(h, f))
            }
            Some([Value::Array(_), ..]) | None => {
                let [h, f, g] = Datum::from_value(value, registry)?;
                Ok(Axis { h, f, g })
            }
            Some(_) => Ok(Axis::along(Vec3::from_value(value, registry)?)),
        }
    }
}

macro_rules! tuples {
    ($($n:literal ($($T:ident $i:tt),*);)*) => {$(
        impl<$($T: Datum),*> Datum for ($($T,)*) {
            fn absent() -> Self {
                ($($T::absent(),)*)
            }

            fn to_value(&self) -> Result<Value, String> {
                Ok(Value::Array(vec![$(self.$i.to_value()?),*]))
            }

            fn from_value(value: &Value, registry: &Registry) -> Result<Self, String> {
                let parts = value.as_array().filter(|parts| parts.len() == $n).ok_or_else(|| format!("{value} is not a list of {}", $n))?;
                Ok(($($T::from_value(&parts[$i], registry)?,)*))
            }
        }
    )*};
}

tuples! {
    1 (A 0);
    2 (A 0, B 1);
    3 (A 0, B 1, C 2);
    4 (A 0, B 1, C 2, D 3);
}

impl Datum for Law {
    fn absent() -> Self {
        Law::constant(f64::NAN)
    }

    fn to_value(&self) -> Result<Value, String> {
        serde_json::to_value(LawData::of(self)).map_err(|error| error.to_string())
    }

    fn from_value(value: &Value, registry: &Registry) -> Result<Self, String> {
        if !value.is_object() {
            return Err(format!(
                "{value} is not a law. Write an object, such as {{\"kind\": \"ramp\", \"numbers\": {{\"rate\": 1}}}}"
            ));
        }
        registry.law(&read::value(value)?)
    }
}

impl Describer {
    /// Records a parameter under its name.
    pub fn put(&mut self, name: &str, value: &impl Datum) {
        self.put_value(name, value.to_value());
    }
}

/// A parameter of any user-defined type, to be written with serde if the type supports serde.
pub struct Outgoing<'a, T>(pub &'a T);

/// Writes a type with serde.
pub trait OutgoingBySerde {
    /// Records the parameter under its name.
    fn put(&self, name: &str, to: &mut Describer);
}

/// Handles a type without serde.
pub trait OutgoingRefused {
    /// Records that the parameter cannot be written or read.
    fn put(&self, name: &str, to: &mut Describer);
}

impl<T: Serialize + DeserializeOwned> OutgoingBySerde for Outgoing<'_, T> {
    fn put(&self, name: &str, to: &mut Describer) {
        to.put_value(name, serde_json::to_value(self.0).map_err(|error| error.to_string()));
    }
}

impl<T> OutgoingRefused for &Outgoing<'_, T> {
    fn put(&self, name: &str, to: &mut Describer) {
        to.refuse(without_serde::<T>(name));
    }
}

/// A constant that an equation uses, to be written in the text of the equation.
pub trait OutgoingConstant {
    /// Records the constant under its name.
    fn constant(&self, name: &str, to: &mut Describer);
}

/// A constant of a type that has no text.
pub trait RefusedConstant {
    /// Records that the file cannot contain the constant.
    fn constant(&self, name: &str, to: &mut Describer);
}

/// A value that can be written as Rust code: a number, a vector, or a table of numbers or vectors.
pub trait Literal {
    /// Returns the type of the value as Rust code.
    fn type_text() -> String;
    /// Returns the value as Rust code.
    ///
    /// Errors: a number that is not finite; the error is this number.
    fn text(&self) -> Result<String, f64>;
}

impl Literal for f64 {
    fn type_text() -> String {
        "f64".to_string()
    }

    fn text(&self) -> Result<String, f64> {
        if self.is_finite() { Ok(format!("{self:?}")) } else { Err(*self) }
    }
}

macro_rules! plain_literals {
    ($($ty:ident)*) => {$(
        impl Literal for $ty {
            fn type_text() -> String {
                stringify!($ty).to_string()
            }

            fn text(&self) -> Result<String, f64> {
                Ok(self.to_string())
            }
        }
    )*};
}

plain_literals!(bool u8 u16 u32 u64 usize i8 i16 i32 i64 isize);

impl<T: Literal, const N: usize> Literal for [T; N] {
    fn type_text() -> String {
        format!("[{}; {N}]", T::type_text())
    }

    fn text(&self) -> Result<String, f64> {
        let parts = self.iter().map(T::text).collect::<Result<Vec<String>, f64>>()?;
        Ok(format!("[{}]", parts.join(", ")))
    }
}

macro_rules! literals_of_parts {
    ($($ty:ty: $($generic:ident)*, $text:expr, |$x:ident| $form:literal $($part:expr)*;)*) => {$(
        impl<$($generic: Literal),*> Literal for $ty {
            fn type_text() -> String {
                $text
            }

            fn text(&self) -> Result<String, f64> {
                let $x = self;
                Ok(format!($form, $($part.text()?),*))
            }
        }
    )*};
}

literals_of_parts! {
    (A, B): A B,
        format!("({}, {})", A::type_text(), B::type_text()),
        |x| "({}, {})" x.0 x.1;
    (A, B, C): A B C,
        format!("({}, {}, {})", A::type_text(), B::type_text(), C::type_text()),
        |x| "({}, {}, {})" x.0 x.1 x.2;
    Vec2:, "Vec2".to_string(), |v| "Vec2 {{ x: {}, y: {} }}" v.x v.y;
    Vec3:, "Vec3".to_string(), |v| "Vec3 {{ x: {}, y: {}, z: {} }}" v.x v.y v.z;
}

impl<T: Literal> OutgoingConstant for Outgoing<'_, T> {
    fn constant(&self, name: &str, to: &mut Describer) {
        match self.0.text() {
            Ok(text) => to.put_beside(&format!("const {name}: {} = {text};", T::type_text())),
            Err(number) => to.lacks(&format!("`{name}`, which is {number}")),
        }
    }
}

impl<T> RefusedConstant for &Outgoing<'_, T> {
    fn constant(&self, name: &str, to: &mut Describer) {
        to.lacks(&format!("`{name}`, of the type `{}`", std::any::type_name::<T>()));
    }
}

/// A parameter of any user-defined type, to be read from data.
pub struct Incoming<T>(PhantomData<T>);

impl<T> Incoming<T> {
    #[allow(clippy::new_without_default)]
    #[allow(missing_docs)]
    pub fn new() -> Self {
        Incoming(PhantomData)
    }
}

/// Reads a type with serde.
pub trait IncomingBySerde<T> {
    /// Returns the parameter with this name.
    fn get(&self, name: &str, from: &mut super::Reader<'_>) -> Option<T>;
}

/// Handles a type without serde.
pub trait IncomingRefused<T> {
    /// Records that the parameter cannot be written or read.
    fn get(&self, name: &str, from: &mut super::Reader<'_>) -> Option<T>;
}

impl<T: Serialize + DeserializeOwned> IncomingBySerde<T> for Incoming<T> {
    fn get(&self, name: &str, from: &mut super::Reader<'_>) -> Option<T> {
        from.value(name, &mut |value| read::value(value))
    }
}

impl<T> IncomingRefused<T> for &Incoming<T> {
    fn get(&self, name: &str, from: &mut super::Reader<'_>) -> Option<T> {
        from.noted(Err(without_serde::<T>(name)))
    }
}

fn without_serde<T>(name: &str) -> String {
    format!(
        "its parameter `{name}` is of the type `{}`, which needs serde's `Serialize` and `Deserialize`",
        std::any::type_name::<T>()
    )
}
