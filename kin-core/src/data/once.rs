//! Reads objects in which each key may occur only once.
//!
//! The maps of serde and `serde_json` keep only the last value of a repeated key. Such a map would
//! lose the other value of a file without a message, so this module reads the maps of Kin's
//! formats. Structs need no such reader, because serde refuses a repeated field.

use std::collections::BTreeSet;
use std::fmt;
use std::marker::PhantomData;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};

/// Reads a map with values of type `V`.
///
/// Errors: a repeated key, by name; a value that is no `V`.
pub(super) fn map<'de, D, V, M>(from: D) -> Result<M, D::Error>
where
    D: Deserializer<'de>,
    V: Deserialize<'de>,
    M: FromIterator<(String, V)>,
{
    from.deserialize_map(Keys(PhantomData::<fn() -> (V, M)>))
}

/// Reads an object of any values.
///
/// Errors: a repeated key at any depth, by its name and by the keys that lead to it.
pub(super) fn object<'de, D: Deserializer<'de>>(from: D) -> Result<Map<String, Value>, D::Error> {
    from.deserialize_map(Object(&KeyPath::ROOT))
}

/// Reads an object of any values that may be left out. Errors: those of [`object`].
pub(super) fn some_object<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<Option<Map<String, Value>>, D::Error> {
    object(from).map(Some)
}

/// Reads any value. Errors: those of [`object`].
pub(super) fn value<'de, D: Deserializer<'de>>(from: D) -> Result<Value, D::Error> {
    AnyValue(&KeyPath::ROOT).deserialize(from)
}

/// Reads a list of three values, or none. Errors: those of [`object`].
pub(super) fn three<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<Option<Box<[Value; 3]>>, D::Error> {
    #[derive(Deserialize)]
    struct One(#[serde(deserialize_with = "value")] Value);
    let read = Option::<[One; 3]>::deserialize(from)?;
    Ok(read.map(|three| Box::new(three.map(|One(value)| value))))
}

fn twice<E: Error>(place: &KeyPath<'_>, key: &str) -> E {
    let holder = if place.is_root() { String::new() } else { format!(" in `{place}`") };
    E::custom(format!("the key `{key}` appears twice{holder}. Remove one of the two values"))
}

/// The keys and indices that lead to a value.
struct KeyPath<'a> {
    outer: Option<(&'a KeyPath<'a>, Step<'a>)>,
}

enum Step<'a> {
    Key(&'a str),
    Number(usize),
}

impl KeyPath<'_> {
    const ROOT: KeyPath<'static> = KeyPath { outer: None };

    fn is_root(&self) -> bool {
        self.outer.is_none()
    }
}

impl fmt::Display for KeyPath<'_> {
    /// Writes "law.numbers", "parts\[2\]".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.outer {
            None => Ok(()),
            Some((outer, Step::Number(k))) => write!(f, "{outer}[{k}]"),
            Some((outer, Step::Key(key))) if outer.is_root() => f.write_str(key),
            Some((outer, Step::Key(key))) => write!(f, "{outer}.{key}"),
        }
    }
}

/// Reads a map of values of one type.
struct Keys<V, M>(PhantomData<fn() -> (V, M)>);

impl<'de, V: Deserialize<'de>, M: FromIterator<(String, V)>> Visitor<'de> for Keys<V, M> {
    type Value = M;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut from: A) -> Result<M, A::Error> {
        let mut seen = BTreeSet::new();
        let mut all = Vec::new();
        while let Some(key) = from.next_key::<String>()? {
            if !seen.insert(key.clone()) {
                return Err(twice(&KeyPath::ROOT, &key));
            }
            all.push((key, from.next_value()?));
        }
        Ok(all.into_iter().collect())
    }
}

/// Reads an object at a path.
struct Object<'a>(&'a KeyPath<'a>);

impl<'de> Visitor<'de> for Object<'_> {
    type Value = Map<String, Value>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut from: A) -> Result<Self::Value, A::Error> {
        let mut all = Map::new();
        while let Some(key) = from.next_key::<String>()? {
            if all.contains_key(&key) {
                return Err(twice(self.0, &key));
            }
            let value = from
                .next_value_seed(AnyValue(&KeyPath { outer: Some((self.0, Step::Key(&key))) }))?;
            all.insert(key, value);
        }
        Ok(all)
    }
}

/// Reads any value at a path.
struct AnyValue<'a>(&'a KeyPath<'a>);

impl<'de> DeserializeSeed<'de> for AnyValue<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Value, D::Error> {
        from.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for AnyValue<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value of JSON")
    }

    fn visit_bool<E>(self, x: bool) -> Result<Value, E> {
        Ok(x.into())
    }

    fn visit_i64<E>(self, x: i64) -> Result<Value, E> {
        Ok(x.into())
    }

    fn visit_u64<E>(self, x: u64) -> Result<Value, E> {
        Ok(x.into())
    }

    fn visit_f64<E>(self, x: f64) -> Result<Value, E> {
        Ok(x.into())
    }

    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(text.into())
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_none<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_some<D: Deserializer<'de>>(self, from: D) -> Result<Value, D::Error> {
        self.deserialize(from)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut from: A) -> Result<Value, A::Error> {
        let mut all = Vec::new();
        loop {
            let place = KeyPath { outer: Some((self.0, Step::Number(all.len()))) };
            match from.next_element_seed(AnyValue(&place))? {
                Some(value) => all.push(value),
                None => return Ok(Value::Array(all)),
            }
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, from: A) -> Result<Value, A::Error> {
        Object(self.0).visit_map(from).map(Value::Object)
    }
}
