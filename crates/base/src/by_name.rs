//! Values by name, in their own order.

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::marker::PhantomData;

/// Values by name, no two names alike, in the order in which the names came first. Serde writes and reads them as one
/// object.
#[derive(Debug, Clone, PartialEq)]
pub struct ByName<T>(Vec<(String, T)>);

impl<T> ByName<T> {
    /// Returns the value of a name; `None` where there is no such name.
    pub fn get(&self, name: &str) -> Option<&T> {
        self.0.iter().find(|(own, _)| own == name).map(|(_, value)| value)
    }

    /// Sets the value of a name, which stays in its place where it is there already.
    pub fn set(&mut self, name: impl Into<String>, value: T) {
        let name = name.into();
        match self.0.iter_mut().find(|(own, _)| *own == name) {
            Some((_, old)) => *old = value,
            None => self.0.push((name, value)),
        }
    }

    /// Returns names and values in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, &T)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// Returns whether there is no name.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T> Default for ByName<T> {
    fn default() -> Self {
        Self(vec![])
    }
}

impl<N: Into<String>, T> FromIterator<(N, T)> for ByName<T> {
    fn from_iter<I: IntoIterator<Item = (N, T)>>(pairs: I) -> Self {
        let mut all = Self::default();
        pairs.into_iter().for_each(|(name, value)| all.set(name, value));
        all
    }
}

impl<T: Serialize> Serialize for ByName<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for ByName<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Pairs(PhantomData))
    }
}

/// Reads the names and values of an object.
struct Pairs<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Pairs<T> {
    type Value = ByName<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of values by name")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<ByName<T>, A::Error> {
        let mut all = ByName::default();
        while let Some((name, value)) = object.next_entry::<String, T>()? {
            all.set(name, value);
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::ByName;

    #[test]
    fn a_name_keeps_its_place_and_has_its_last_value_also_when_it_is_read_back() {
        let found: ByName<u32> = [("green", 1), ("below", 2), ("green", 3)].into_iter().collect();
        let text = serde_json::to_string(&found).unwrap();
        assert_eq!(text, r#"{"green":3,"below":2}"#);
        assert_eq!(serde_json::from_str::<ByName<u32>>(&text).unwrap(), found);
        assert_eq!((found.get("below"), found.get("red"), found.is_empty()), (Some(&2), None, false));
    }
}
