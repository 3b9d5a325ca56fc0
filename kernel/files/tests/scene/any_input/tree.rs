//! JSON as text in the shape of a tree: it can hold what no value can, 1e400 for one, and keys twice.

use serde_json::Value;

/// A value as it is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Tree {
    /// A number, a word or anything else, letter by letter.
    Text(String),
    /// A list.
    List(Vec<Tree>),
    /// An object.
    Object(Vec<(String, Tree)>),
}

impl Tree {
    pub(crate) fn parse(text: &str) -> Self {
        fn tree(value: &Value) -> Tree {
            match value {
                Value::Array(list) => Tree::List(list.iter().map(tree).collect()),
                Value::Object(map) => {
                    Tree::Object(map.iter().map(|(k, v)| (k.clone(), tree(v))).collect())
                }
                other => Tree::Text(other.to_string()),
            }
        }
        tree(&serde_json::from_str(text).expect("JSON"))
    }

    pub(crate) fn text(&self) -> String {
        let joined = |parts: Vec<String>| parts.join(", ");
        match self {
            Self::Text(text) => text.clone(),
            Self::List(list) => format!("[{}]", joined(list.iter().map(Self::text).collect())),
            Self::Object(map) => {
                let entry = |(key, value): &(String, Self)| format!("{key:?}: {}", value.text());
                format!("{{{}}}", joined(map.iter().map(entry).collect()))
            }
        }
    }

    /// Number of values in it, itself included.
    pub(crate) fn count(&self) -> usize {
        1 + match self {
            Self::Text(_) => 0,
            Self::List(list) => list.iter().map(Self::count).sum(),
            Self::Object(map) => map.iter().map(|(_, value)| value.count()).sum(),
        }
    }

    /// Calls `act` on the list or object that holds value number `at`, counted in the order of the text from 1, with the
    /// place of the value in it.
    pub(crate) fn at(&mut self, at: usize, act: &mut dyn FnMut(&mut Self, usize)) {
        let counts: Vec<usize> = match self {
            Self::Text(_) => return,
            Self::List(list) => list.iter().map(Self::count).collect(),
            Self::Object(map) => map.iter().map(|(_, value)| value.count()).collect(),
        };
        let mut before = 0;
        for (i, count) in counts.into_iter().enumerate() {
            if at == before + 1 {
                return act(self, i);
            }
            if at <= before + count {
                return match self {
                    Self::Text(_) => {}
                    Self::List(list) => list[i].at(at - before - 1, act),
                    Self::Object(map) => map[i].1.at(at - before - 1, act),
                };
            }
            before += count;
        }
    }
}
