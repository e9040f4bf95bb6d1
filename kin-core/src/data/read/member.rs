//! Reads a value of JSON member by member, and notes the path to a mistake.

use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Error, MapAccess, SeqAccess,
    Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_json::{Map, Value};

use super::mistake::{Mistake, Step};

/// Reads data. Errors: the first mistake.
pub(super) fn read<T: DeserializeOwned>(from: &Value) -> Result<T, Mistake> {
    T::deserialize(Member(from))
}

/// A value of JSON that is read.
struct Member<'a>(&'a Value);

impl<'de> Deserializer<'de> for Member<'_> {
    type Error = Mistake;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        match self.0 {
            Value::Null => visitor.visit_unit(),
            Value::Bool(x) => visitor.visit_bool(*x),
            Value::String(text) => visitor.visit_str(text),
            Value::Array(all) => items(all, visitor),
            Value::Object(all) => members(all, visitor),
            Value::Number(x) => match (x.as_u64(), x.as_i64(), x.as_f64()) {
                (Some(x), ..) => visitor.visit_u64(x),
                (_, Some(x), _) => visitor.visit_i64(x),
                (.., Some(x)) => visitor.visit_f64(x),
                _ => Err(Mistake::custom(format!("{x} is no number that a computer has"))),
            },
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        match self.0 {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        let (word, value) = match self.0 {
            Value::String(word) => (word, None),
            Value::Object(all) => match Vec::from_iter(all)[..] {
                [(word, value)] => (word, Some(value)),
                _ => return Err(Mistake::invalid_length(all.len(), &"one key")),
            },
            _ => return self.deserialize_any(visitor),
        };
        visitor.visit_enum(Chosen { word, value })
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit
        unit_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}

fn items<'de, V: Visitor<'de>>(all: &[Value], visitor: V) -> Result<V::Value, Mistake> {
    let mut items = Items { all, next: 0 };
    // The error of a list that is too long needs what the visitor expects.
    let read = visitor.visit_seq(&mut items)?;
    let done = items.next;
    let wanted = format!("a list of {done} items");
    if done < all.len() {
        return Err(Mistake::invalid_length(all.len(), &wanted.as_str()));
    }
    Ok(read)
}

fn members<'de, V: Visitor<'de>>(
    all: &Map<String, Value>,
    visitor: V,
) -> Result<V::Value, Mistake> {
    let members = Members { rest: all.iter(), value: None };
    visitor.visit_map(members).map_err(|mistake| mistake.with_keys(all.keys()))
}

struct Items<'a> {
    all: &'a [Value],
    next: usize,
}

impl<'de> SeqAccess<'de> for &mut Items<'_> {
    type Error = Mistake;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Mistake> {
        let Some(value) = self.all.get(self.next) else { return Ok(None) };
        let step = Step::Item(self.next);
        self.next += 1;
        seed.deserialize(Member(value)).map(Some).map_err(|mistake| mistake.inside(step))
    }
}

struct Members<'a> {
    rest: serde_json::map::Iter<'a>,
    /// The value of the key that was read last.
    value: Option<(&'a String, &'a Value)>,
}

impl<'de> MapAccess<'de> for Members<'_> {
    type Error = Mistake;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Mistake> {
        self.value = self.rest.next();
        let Some((key, _)) = self.value else { return Ok(None) };
        seed.deserialize(StrDeserializer::new(key)).map(Some)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Mistake> {
        let Some((key, value)) = self.value.take() else {
            return Err(Mistake::custom("a key has no value"));
        };
        let within = |mistake: Mistake| mistake.inside(Step::Key(key.clone()));
        seed.deserialize(Member(value)).map_err(within)
    }
}

/// A word of an enumeration, with its value if it stands in an object.
struct Chosen<'a> {
    word: &'a String,
    value: Option<&'a Value>,
}

impl<'de> EnumAccess<'de> for Chosen<'_> {
    type Error = Mistake;
    type Variant = Self;

    fn variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<(T::Value, Self), Mistake> {
        let word = seed.deserialize(StrDeserializer::new(self.word))?;
        Ok((word, self))
    }
}

impl Chosen<'_> {
    /// Reads the value of the word. Errors: it has none.
    fn with_value<T>(
        self,
        read: impl FnOnce(Member<'_>) -> Result<T, Mistake>,
    ) -> Result<T, Mistake> {
        let Some(value) = self.value else {
            let wanted = format!("{{\"{}\": …}}", self.word);
            return Err(Mistake::invalid_type(Unexpected::UnitVariant, &wanted.as_str()));
        };
        read(Member(value)).map_err(|mistake| mistake.inside(Step::Key(self.word.clone())))
    }
}

impl<'de> VariantAccess<'de> for Chosen<'_> {
    type Error = Mistake;

    fn unit_variant(self) -> Result<(), Mistake> {
        match self.value {
            None | Some(Value::Null) => Ok(()),
            Some(_) => {
                let wanted = format!("\"{}\"", self.word);
                Err(Mistake::invalid_type(Unexpected::NewtypeVariant, &wanted.as_str()))
            }
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Mistake> {
        self.with_value(|value| seed.deserialize(value))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Mistake> {
        self.with_value(|value| value.deserialize_any(visitor))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        self.with_value(|value| value.deserialize_any(visitor))
    }
}
