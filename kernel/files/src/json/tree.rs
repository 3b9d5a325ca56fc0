//! A JSON value as it stands in the text: members in order, repeated ones too.
//!
//! Raw keys are read from it where the text has a fault, once for each fault, with what is at fault taken out. It is strict
//! where the parser is lenient, an object is no list of its values, and lenient where the parser is strict, 20.0 is a whole
//! number.

use std::fmt;

use serde::de::value::{MapDeserializer, SeqDeserializer};
use serde::de::{
    Deserializer, Error as _, IntoDeserializer, MapAccess, SeqAccess, Unexpected, Visitor,
};
use serde::{Deserialize, forward_to_deserialize_any};
use serde_json::Error;
use serde_path_to_error::Segment;

/// Whole numbers up to this magnitude are exact as floating-point ones.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// A JSON value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Tree {
    Null,
    Bool(bool),
    Whole(u64),
    Negative(i64),
    Number(f64),
    Text(String),
    List(Vec<Self>),
    Object(Vec<(String, Self)>),
}

impl Tree {
    /// The value at a path; of members with one name the last.
    pub(super) fn at<'a>(
        &mut self,
        path: impl IntoIterator<Item = &'a Segment>,
    ) -> Option<&mut Self> {
        let mut at = self;
        for segment in path {
            at = match (segment, at) {
                (Segment::Seq { index }, Self::List(list)) => list.get_mut(*index)?,
                (Segment::Map { key }, Self::Object(members)) => {
                    let member = members.iter_mut().rev().find(|(name, _)| name == key)?;
                    &mut member.1
                }
                _ => return None,
            };
        }
        Some(at)
    }

    /// Takes a member out of an object; of several with one name all but the last where `repeated`.
    pub(super) fn take_out(&mut self, key: &str, repeated: bool) {
        if let Self::Object(members) = self {
            let last = members.iter().rposition(|(name, _)| name == key);
            let mut place = 0;
            members.retain(|(name, _)| {
                let kept = name != key || (repeated && Some(place) == last);
                place += 1;
                kept
            });
        }
    }
}

struct TreeSeed;

impl<'de> Visitor<'de> for TreeSeed {
    type Value = Tree;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_unit<E>(self) -> Result<Tree, E> {
        Ok(Tree::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Tree, E> {
        Ok(Tree::Bool(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Tree, E> {
        Ok(Tree::Whole(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Tree, E> {
        Ok(Tree::Negative(value))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Tree, E> {
        Ok(Tree::Number(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Tree, E> {
        Ok(Tree::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Tree, A::Error> {
        let mut values = vec![];
        while let Some(value) = list.next_element()? {
            values.push(value);
        }
        Ok(Tree::List(values))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Tree, A::Error> {
        let mut members = vec![];
        while let Some(member) = map.next_entry()? {
            members.push(member);
        }
        Ok(Tree::Object(members))
    }
}

impl<'de> Deserialize<'de> for Tree {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TreeSeed)
    }
}

impl<'de> IntoDeserializer<'de, Error> for &'de Tree {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for &'de Tree {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self {
            Tree::Null => visitor.visit_unit(),
            Tree::Bool(value) => visitor.visit_bool(*value),
            Tree::Whole(value) => visitor.visit_u64(*value),
            Tree::Negative(value) => visitor.visit_i64(*value),
            Tree::Number(value) => visitor.visit_f64(*value),
            Tree::Text(value) => visitor.visit_borrowed_str(value),
            Tree::List(values) => {
                let mut list = SeqDeserializer::new(values.iter());
                let value = visitor.visit_seq(&mut list)?;
                list.end()?;
                Ok(value)
            }
            Tree::Object(members) => {
                let members = members.iter().map(|(name, value)| (name.as_str(), value));
                let mut map = MapDeserializer::new(members);
                let value = visitor.visit_map(&mut map)?;
                map.end()?;
                Ok(value)
            }
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self {
            Tree::Null => visitor.visit_none(),
            value => visitor.visit_some(value),
        }
    }

    /// An object alone: the parser would take a list of its values, too.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        match self {
            Tree::List(_) => Err(Error::invalid_type(Unexpected::Seq, &visitor)),
            value => value.deserialize_any(visitor),
        }
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.whole(visitor)
    }

    fn deserialize_i64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.whole(visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Error> {
        visitor.visit_newtype_struct(self)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i128 u8 u16 u32 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map enum identifier ignored_any
    }
}

impl<'de> Tree {
    /// A number where a whole one is meant: 20.0 and 2e1 are one.
    fn whole<V: Visitor<'de>>(&'de self, visitor: V) -> Result<V::Value, Error> {
        match self {
            Self::Number(value) if value.fract() == 0.0 && value.abs() <= EXACT => {
                if *value >= 0.0 {
                    visitor.visit_u64(*value as u64)
                } else {
                    visitor.visit_i64(*value as i64)
                }
            }
            value => value.deserialize_any(visitor),
        }
    }
}

/// A value that is read as often as there are faults in it.
pub(super) fn read<'de, T: Deserialize<'de>>(
    tree: &'de Tree,
) -> Result<T, serde_path_to_error::Error<Error>> {
    serde_path_to_error::deserialize(tree)
}
