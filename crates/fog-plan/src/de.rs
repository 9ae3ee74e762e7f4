//! A serde deserializer over the tree: types of the schema come out, errors keep path and position.

use serde::de::{
    self, DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, MapAccess, SeqAccess, VariantAccess,
    Visitor,
};

use crate::{
    de_error::DeError,
    node::{Entry, Node, Value},
};

/// Reads `node`, the value of `key` (which names its unit).
#[derive(Clone, Copy)]
pub(crate) struct NodeReader<'de> {
    node: &'de Node,
    key: &'de str,
}

impl<'de> NodeReader<'de> {
    pub(crate) fn new(root: &'de Node) -> Self {
        Self { node: root, key: "" }
    }

    fn whole<V: TryFrom<i128>>(self, expected: &str) -> Result<V, DeError> {
        let number = match self.node.value {
            Value::Int(n) => Some(n),
            // Axes compute in floating point: 64.0 is a whole number.
            Value::Float(x) if f64::abs(x) < 9_007_199_254_740_992.0 && x == f64::trunc(x) => Some(x as i128),
            _ => None,
        };
        let number = number.and_then(|n| V::try_from(n).ok());
        number.ok_or_else(|| DeError::wrong_number(self.node, self.key, expected))
    }

    fn map<V: Visitor<'de>>(self, entries: &'de [Entry], visitor: V) -> Result<V::Value, DeError> {
        visitor.visit_map(Entries { rest: entries, value: None }).map_err(|e| e.at(self.node))
    }

    fn list<V: Visitor<'de>>(self, items: &'de [Node], visitor: V) -> Result<V::Value, DeError> {
        visitor
            .visit_seq(Items { rest: items.iter().enumerate(), key: self.key })
            .map_err(|e| e.at(self.node))
    }
}

impl<'de> Deserializer<'de> for NodeReader<'de> {
    type Error = DeError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        let value = match &self.node.value {
            Value::Null => visitor.visit_unit(),
            Value::Bool(b) => visitor.visit_bool(*b),
            Value::Int(n) => match i64::try_from(*n) {
                Ok(n) => visitor.visit_i64(n),
                Err(_) => visitor.visit_f64(*n as f64),
            },
            Value::Float(x) => visitor.visit_f64(*x),
            Value::Text(text) => visitor.visit_borrowed_str(text),
            Value::List(items) => self.list(items, visitor),
            Value::Map(entries) => self.map(entries, visitor),
        };
        value.map_err(|e| e.at(self.node))
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        match self.node.value {
            Value::Bool(b) => visitor.visit_bool(b),
            _ => Err(DeError::wrong_type(self.node, "true or false")),
        }
    }

    fn deserialize_i64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        visitor.visit_i64(self.whole("a whole number")?)
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        visitor.visit_u64(self.whole("a whole number from 0 to 18446744073709551615")?)
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        match self.node.value {
            Value::Int(n) => visitor.visit_f64(n as f64),
            Value::Float(x) => visitor.visit_f64(x),
            _ => Err(DeError::wrong_number(self.node, self.key, "a number")),
        }
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        match &self.node.value {
            Value::Text(text) => visitor.visit_borrowed_str(text),
            _ => Err(DeError::wrong_type(self.node, "text")),
        }
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        self.deserialize_str(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        match self.node.value {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        match &self.node.value {
            Value::List(items) => self.list(items, visitor),
            _ => Err(DeError::wrong_type(self.node, "a list")),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value, DeError> {
        match &self.node.value {
            Value::List(items) if items.len() == len => self.list(items, visitor),
            _ => Err(DeError::wrong_number(self.node, self.key, &format!("a list of {len} numbers"))),
        }
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        match &self.node.value {
            Value::Map(entries) => self.map(entries, visitor),
            _ => Err(DeError::wrong_type(self.node, "a map")),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DeError> {
        match &self.node.value {
            Value::Map(entries) => self.map(entries, visitor),
            _ => Err(DeError::wrong_type(self.node, format!("a map with keys {}", fields.join(", ")))),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DeError> {
        let variant = match &self.node.value {
            Value::Text(text) => Variant { name: text, reader: self, value: None },
            Value::Map(entries) if entries.len() == 1 => {
                Variant { name: &entries[0].key, reader: self, value: Some(&entries[0].node) }
            }
            _ => return Err(DeError::wrong_type(self.node, format!("one of {}", variants.join(", ")))),
        };
        visitor.visit_enum(variant).map_err(|e| e.at(self.node))
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        visitor.visit_unit()
    }

    serde::forward_to_deserialize_any! {
        i8 i16 i32 i128 u8 u16 u32 u128 f32 char bytes byte_buf unit unit_struct newtype_struct tuple_struct
        identifier
    }
}

/// The entries of a map that are still to be read.
struct Entries<'de> {
    rest: &'de [Entry],
    value: Option<&'de Entry>,
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = DeError;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, DeError> {
        let Some((entry, rest)) = self.rest.split_first() else { return Ok(None) };
        self.rest = rest;
        self.value = Some(entry);
        let key = de::value::BorrowedStrDeserializer::new(&entry.key);
        seed.deserialize(key).map(Some).map_err(|e: DeError| e.at_key(&entry.key_origin))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, DeError> {
        let entry = self
            .value
            .take()
            .ok_or_else(|| <DeError as de::Error>::custom("a value was asked for before its key"))?;
        let reader = NodeReader { node: &entry.node, key: &entry.key };
        seed.deserialize(reader).map_err(|e| e.at(&entry.node).within(&entry.key))
    }
}

/// The items of a list that are still to be read.
struct Items<'de> {
    rest: std::iter::Enumerate<std::slice::Iter<'de, Node>>,
    key: &'de str,
}

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = DeError;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, DeError> {
        let Some((index, node)) = self.rest.next() else { return Ok(None) };
        let reader = NodeReader { node, key: self.key };
        seed.deserialize(reader).map(Some).map_err(|e| e.at(node).within(&index.to_string()))
    }
}

/// `name`, or `{name: value}`.
struct Variant<'de> {
    name: &'de str,
    reader: NodeReader<'de>,
    value: Option<&'de Node>,
}

impl<'de> EnumAccess<'de> for Variant<'de> {
    type Error = DeError;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), DeError> {
        let name = seed.deserialize(IntoDeserializer::<DeError>::into_deserializer(self.name))?;
        Ok((name, self))
    }
}

impl<'de> VariantAccess<'de> for Variant<'de> {
    type Error = DeError;

    fn unit_variant(self) -> Result<(), DeError> {
        match self.value {
            None => Ok(()),
            Some(_) => Err(de::Error::custom(format!("`{}` takes no value", self.name))),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, DeError> {
        let Some(node) = self.value else { return seed.deserialize(Absent(self.name)) };
        seed.deserialize(NodeReader { node, key: self.name }).map_err(|e| e.at(node).within(self.name))
    }

    fn tuple_variant<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value, DeError> {
        NodeReader { node: self.value.unwrap_or(self.reader.node), key: self.name }
            .deserialize_tuple(len, visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DeError> {
        let node = self.value.unwrap_or(self.reader.node);
        NodeReader { node, key: self.name }.deserialize_struct("", fields, visitor)
    }
}

/// The value of a variant that was written as its name alone: none, and an error for every type that needs one.
struct Absent<'de>(&'de str);

impl<'de> Deserializer<'de> for Absent<'de> {
    type Error = DeError;

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, DeError> {
        Err(de::Error::custom(format!("`{0}` needs a value: {{{0}: …}}", self.0)))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DeError> {
        visitor.visit_none()
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct
        newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}
