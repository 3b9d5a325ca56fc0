//! Names of keys and words in other programs and books, each with the key here that does the same.

mod cb_geo;
mod geomechanics;
mod soil;
mod usual;
mod words;

/// A key or a word of another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignWord {
    /// The block of the scene in which it is meant so; empty for any.
    pub within: &'static str,
    /// Spellings; upper and lower case, `_` and `-` make no difference.
    pub words: &'static [&'static str],
    /// The keys here, with their blocks.
    pub keys: &'static [&'static str],
    /// The key here, or that there is none.
    pub answer: &'static str,
}

/// Keys, by where they come from.
const KEYS: [&[ForeignWord]; 4] = [usual::ALL, geomechanics::ALL, cb_geo::ALL, soil::ALL];

/// Everything that is known of other programs and books.
pub fn all_elsewhere() -> impl Iterator<Item = &'static ForeignWord> {
    KEYS.into_iter().flatten().chain(words::ALL)
}

/// Entries of a word of another program.
#[must_use]
pub fn elsewhere(word: &str) -> Vec<&'static ForeignWord> {
    all_elsewhere().filter(|other| other.is(word)).collect()
}

/// The entry of a key that the object at a path does not have; the path ends with the key.
pub(super) fn of_key(path: &str, key: &str) -> Option<&'static ForeignWord> {
    at(&KEYS.into_iter().flatten(), path, key)
}

/// The entry of a word that the key at a path does not accept.
pub(super) fn of_word(path: &str, word: &str) -> Option<&'static ForeignWord> {
    at(&words::ALL.iter(), path, word)
}

/// The entry that is meant at a path: one of its block, or of any.
fn at(
    all: &(impl Iterator<Item = &'static ForeignWord> + Clone),
    path: &str,
    word: &str,
) -> Option<&'static ForeignWord> {
    let block = match path.split(['.', '[']).next().unwrap_or("") {
        "bodies" => "body",
        "materials" => "material",
        "terrain_contact" => "contact",
        other => other,
    };
    let mut of_block = all.clone();
    of_block
        .find(|other| other.within == block && other.is(word))
        .or_else(|| {
            all.clone()
                .find(|other| other.within.is_empty() && other.is(word))
        })
}

impl ForeignWord {
    fn is(&self, word: &str) -> bool {
        let plain = |word: &str| word.replace(['_', '-', ' '], "").to_lowercase();
        let word = plain(word);
        self.words.iter().any(|own| plain(own) == word)
    }
}

const fn entry(
    within: &'static str,
    words: &'static [&'static str],
    keys: &'static [&'static str],
    answer: &'static str,
) -> ForeignWord {
    ForeignWord {
        within,
        words,
        keys,
        answer,
    }
}
