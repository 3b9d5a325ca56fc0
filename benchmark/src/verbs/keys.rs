//! `proctor keys`: what the keys of scene files mean.

use crate::exit::{Failure, Outcome};
use crate::show::keys::{BlockTable, EVERYWHERE, InFull};
use clap::Args;
use proctor_files::json::{Key, KeyBlock, blocks, elsewhere};
use std::io::Write;

/// Nearest names that are told where no key has the name.
const NEAREST: usize = 3;
/// Least likeness of a name to an unknown word, 0 to 1, for it to be among them.
const LIKENESS: f64 = 0.4;

/// Fewest letters of a word that is looked for inside of names.
const PART: usize = 3;

/// Explain the keys of scene files: all in a table, or one by its name.
///
/// Of each key: what it means, its unit, the values that it may have, what holds where it is missing, what else it needs,
/// an example. WORD is the name of a key, a part of one, a block such as `mesh`, or a value such as `cpGIMP`.
#[derive(Args)]
#[command(after_help = "Example: proctor keys\n\
    One key: proctor keys cells_dimension\n\
    In one block alone: proctor keys body.radius")]
pub struct Keys {
    /// Name of a key, a part of one, a block, or a value; without it, all keys
    word: Option<String>,
}

impl Keys {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let blocks = blocks();
        let Some(word) = &self.word else {
            return all(&blocks, out);
        };
        let named = named(word, &blocks);
        let others = if named.is_empty() {
            elsewhere(word)
        } else {
            vec![]
        };
        let found = if !named.is_empty() {
            named
        } else if others.is_empty() {
            matching(word, &blocks)
        } else {
            let keys = others.iter().flat_map(|other| other.keys);
            keys.flat_map(|name| self::named(name, &blocks)).collect()
        };
        if found.is_empty() && others.is_empty() {
            return Err(Failure::BadInput(unknown(word, &blocks)));
        }
        let mut told: Vec<(&str, &str)> = vec![];
        for (block, key) in found {
            let name = (block.path.as_str(), key.name.as_str());
            if told.contains(&name) {
                continue;
            }
            let gap = if told.is_empty() { "" } else { "\n" };
            told.push(name);
            let path = &block.path;
            write!(out, "{gap}{}", InFull { path, key })?;
        }
        for (i, other) in others.iter().enumerate() {
            let gap = if told.is_empty() || i > 0 { "" } else { "\n" };
            writeln!(out, "{gap}`{word}`: {}", other.answer)?;
        }
        let of_word = |block: &&KeyBlock| {
            let last = block.path.rsplit('.').next().unwrap_or("");
            is(word, &block.path) || is(word, last)
        };
        for block in blocks.iter().filter(of_word) {
            write!(out, "\n{}", BlockTable(block))?;
        }
        Ok(Outcome::Fine)
    }
}

fn all(blocks: &[KeyBlock], out: &mut dyn Write) -> Result<Outcome, Failure> {
    for block in blocks {
        writeln!(out, "{}", BlockTable(block))?;
    }
    writeln!(
        out,
        "Behind each key: its unit, its default, its meaning. (needed): where it means something.\n\
         `proctor keys WORD` explains a key in full, `proctor schema` is for editors."
    )?;
    Ok(Outcome::Fine)
}

/// The keys of scenes with their blocks; that which every object has once.
fn keys(blocks: &[KeyBlock]) -> impl Iterator<Item = (&KeyBlock, &Key)> {
    let all = blocks
        .iter()
        .flat_map(|block| block.keys.iter().map(move |key| (block, key)));
    all.filter(|(block, key)| block.path.is_empty() || key.name != EVERYWHERE)
}

/// The keys of that name, with their block or without.
fn named<'a>(word: &str, blocks: &'a [KeyBlock]) -> Vec<(&'a KeyBlock, &'a Key)> {
    // A key of the top has no block before it.
    let whole = |block: &KeyBlock, key: &Key| {
        is(
            word,
            format!("{}.{}", block.path, key.name).trim_start_matches('.'),
        )
    };
    let all: Vec<_> = keys(blocks)
        .filter(|(block, key)| is(word, &key.name) || whole(block, key))
        .collect();
    all
}

/// The keys that have the word as a value; else those with it in their name; else those with it in their meaning.
fn matching<'a>(word: &str, blocks: &'a [KeyBlock]) -> Vec<(&'a KeyBlock, &'a Key)> {
    let part = |(_, key): &(&KeyBlock, &Key)| {
        word.len() >= PART && key.name.to_lowercase().contains(&word.to_lowercase())
    };
    let meant = |(_, key): &(&KeyBlock, &Key)| {
        let mut words = key.meaning.split(|c: char| !c.is_alphanumeric());
        words.any(|known| is(word, known))
    };
    let valued = |(_, key): &(&KeyBlock, &Key)| {
        let mut words = key.words.iter().filter_map(|word| word.as_str());
        words.any(|known| is(word, known))
    };
    for search in [&valued as &dyn Fn(&(&KeyBlock, &Key)) -> bool, &part] {
        let found: Vec<_> = keys(blocks).filter(search).collect();
        if !found.is_empty() {
            return found;
        }
    }
    keys(blocks).filter(meant).collect()
}

/// True if a word is a name; upper and lower case are the same.
fn is(word: &str, name: &str) -> bool {
    word.eq_ignore_ascii_case(name)
}

/// Answer to a word that leads to no key.
fn unknown(word: &str, blocks: &[KeyBlock]) -> String {
    let mut names: Vec<&str> = blocks
        .iter()
        .flat_map(|block| block.keys.iter().map(|key| key.name.as_str()))
        .collect();
    names.sort_unstable();
    names.dedup();
    let lower = word.to_lowercase();
    let likeness = |name: &str| strsim::normalized_damerau_levenshtein(&lower, name);
    names.retain(|name| likeness(name) >= LIKENESS);
    names.sort_by(|a, b| likeness(b).total_cmp(&likeness(a)));
    names.truncate(NEAREST);
    let nearest: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    let hint = if nearest.is_empty() {
        String::new()
    } else {
        format!(" (did you mean {}?)", nearest.join(" or "))
    };
    format!(
        "found the key {word:?}, which is not known{hint}; accepted: a key of a scene, `proctor keys` lists them"
    )
}
