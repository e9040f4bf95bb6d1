//! Parameters as JSON values.

use std::marker::PhantomData;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::Registry;
use super::law::LawData;
use crate::model::describer::Describer;
use crate::model::law::Law;
use crate::numbers::algebra::{Axis, EulerParameters, Mat2, Mat3, Vec2, Vec3};

/// A parameter made of numbers, or a law.
pub trait Datum: Sized {
    /// The value as JSON.
    fn to_value(&self) -> Result<Value, String>;
    /// From JSON; the registry knows laws. Errors: what is wrong with it.
    fn from_value(value: &Value, registry: &Registry) -> Result<Self, String>;
    /// The stand-in for a value that could not be read: not a number.
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
        let parts = parts.iter().map(|part| T::from_value(part, registry)).collect::<Result<Vec<T>, _>>()?;
        parts.try_into().map_err(|_| format!("{value} is not a list of {N}"))
    }
}

/// A type with components, as the list of them.
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
    Axis(h, f, g);
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
        let data: LawData = serde_json::from_value(value.clone())
            .map_err(|error| format!("{value} is not a law: {error}"))?;
        registry.law(&data)
    }
}

impl Describer {
    /// A parameter under its name.
    pub fn put(&mut self, name: &str, value: &impl Datum) {
        self.put_value(name, value.to_value());
    }
}

/// A parameter of any type of the user's, on its way out: by serde if its type can.
pub struct Outgoing<'a, T>(pub &'a T);

/// With serde.
pub trait OutgoingBySerde {
    /// Puts the parameter under its name.
    fn put(&self, name: &str, to: &mut Describer);
}

/// Without it.
pub trait OutgoingRefused {
    /// Refuses.
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

/// A constant beside an equation, on its way into the equation's text.
pub trait OutgoingConstant {
    /// Puts the constant under its name.
    fn constant(&self, name: &str, to: &mut Describer);
}

/// One of another type than f64.
pub trait RefusedConstant {
    /// Tells that it is lacking.
    fn constant(&self, name: &str, to: &mut Describer);
}

impl OutgoingConstant for Outgoing<'_, f64> {
    fn constant(&self, name: &str, to: &mut Describer) {
        match self.0.is_finite() {
            true => to.put_beside(&format!("const {name}: f64 = {:?};", self.0)),
            false => to.lacks(&format!("`{name}`, which is {}", self.0)),
        }
    }
}

impl<T> RefusedConstant for &Outgoing<'_, T> {
    fn constant(&self, name: &str, to: &mut Describer) {
        to.lacks(&format!("`{name}`, of the type `{}`", std::any::type_name::<T>()));
    }
}

/// A parameter of any type of the user's, on its way in.
pub struct Incoming<T>(PhantomData<T>);

impl<T> Incoming<T> {
    #[allow(clippy::new_without_default)]
    #[allow(missing_docs)]
    pub fn new() -> Self {
        Incoming(PhantomData)
    }
}

/// With serde.
pub trait IncomingBySerde<T> {
    /// The parameter of that name.
    fn get(&self, name: &str, from: &mut super::Reader<'_>) -> Option<T>;
}

/// Without it.
pub trait IncomingRefused<T> {
    /// Refuses.
    fn get(&self, name: &str, from: &mut super::Reader<'_>) -> Option<T>;
}

impl<T: Serialize + DeserializeOwned> IncomingBySerde<T> for Incoming<T> {
    fn get(&self, name: &str, from: &mut super::Reader<'_>) -> Option<T> {
        from.value(name, &mut |value| {
            serde_json::from_value(value.clone()).map_err(|error| error.to_string())
        })
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
