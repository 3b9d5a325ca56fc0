//! The explanations of the keys agree with what the reader does with them.

use std::ops::Bound;

use proctor_files::json::{Key, KeyBlock, KeyDefault, SceneSource, blocks, schema};
use serde_json::{Value, json};
use tempfile::TempDir;

mod bases;

use bases::{bases, block, folder};

/// The first object of a block in a scene.
fn object<'a>(scene: &'a mut Value, path: &str) -> Option<&'a mut Value> {
    let mut at = scene;
    for name in path.split('.').filter(|name| !name.is_empty()) {
        at = at.get_mut(name)?;
        if at.is_array() {
            at = at.get_mut(0)?;
        }
    }
    at.is_object().then_some(at)
}

/// The scene as the reader has it.
fn read(scene: &Value, folder: &TempDir) -> Result<String, String> {
    let text = scene.to_string();
    let source = SceneSource::stream("scene", folder.path(), text.as_bytes()).expect("a text");
    let stages = source.stages().map_err(|error| error.to_string())?;
    let scenes: Vec<_> = stages.into_iter().map(|stage| stage.scene).collect();
    Ok(format!("{scenes:?}"))
}

/// The scenes that have the block, with a value at the key, and whether it was there before.
fn put<'a>(
    block: &'a KeyBlock,
    key: &'a Key,
    value: &'a Value,
) -> impl Iterator<Item = (Value, Value, bool)> + 'a {
    bases().into_iter().filter_map(move |base| {
        let mut scene = base.clone();
        let object = object(&mut scene, &block.path)?;
        let was_there = object.get(&key.name).is_some();
        object[&key.name] = value.clone();
        Some((base, scene, was_there))
    })
}

fn all(check: impl Fn(&KeyBlock, &Key, &str)) {
    let blocks = blocks();
    for block in &blocks {
        for key in &block.keys {
            check(block, key, &format!("{}.{}", block.path, key.name));
        }
    }
}

#[test]
fn the_bases_are_sound() {
    let folder = folder();
    let mut unsound = 0;
    for base in bases() {
        if let Err(error) = read(&base, &folder) {
            // One lacks the value of its damping, so that both spellings of it can be put there.
            assert_eq!(base["damping"], json!({"type": "local"}), "{error}: {base}");
            unsound += 1;
        }
    }
    assert_eq!(unsound, 2);
}

#[test]
fn every_key_has_a_meaning_and_every_number_a_unit() {
    let mut count = 0;
    all(|_, key, path| {
        assert!(key.meaning.ends_with('.'), "{path}: {:?}", key.meaning);
        assert!(!key.examples.is_empty(), "{path} has no example");
        let is_real = key.kind.replace("whole number", "").contains("number");
        if is_real {
            assert!(key.unit.is_some(), "{path}, {}, has no unit", key.kind);
        }
    });
    for block in blocks() {
        assert!(!block.meaning.is_empty(), "{}", block.path);
        count += block.keys.len();
    }
    assert!(count > 130, "{count} keys");
}

/// A key of the schema that the glossary does not have would be explained nowhere.
#[test]
fn the_glossary_has_every_key_of_the_schema() {
    let schema = schema();
    let definitions = schema["$defs"].as_object().expect("definitions");
    let blocks = blocks();
    for object in definitions.values().chain([&schema]) {
        for (name, property) in object["properties"].as_object().into_iter().flatten() {
            let key = (blocks.iter().flat_map(|block| &block.keys)).find(|key| &key.name == name);
            assert!(key.is_some(), "{name}");
            let description = property["description"].as_str().expect("a description");
            let says_when_missing = ["Default: ", "Needed.", "Another spelling"]
                .iter()
                .any(|words| description.contains(words));
            assert!(says_when_missing, "{name}: {description}");
        }
    }
}

/// Each default that is a value changes nothing where it is written down, and its example does.
#[test]
fn defaults_are_those_of_the_reader() {
    let folder = folder();
    all(|block, key, path| {
        let KeyDefault::Value(default) = &key.default else {
            return;
        };
        let mut compared = 0;
        for (base, scene, was_there) in put(block, key, default) {
            if was_there {
                continue;
            }
            if let (Ok(silent), Ok(said)) = (read(&base, &folder), read(&scene, &folder)) {
                assert_eq!(silent, said, "{path} with {default} in {base}");
                compared += 1;
            }
        }
        assert!(compared > 0, "{path} = {default} was compared nowhere");
        let other = key.examples.iter().filter(|example| *example != default);
        for example in other {
            let changes = put(block, key, example).any(|(mut base, scene, _)| {
                let object = object(&mut base, &block.path).expect("it was there");
                object.as_object_mut().expect("keys").remove(&key.name);
                let (silent, said) = (read(&base, &folder), read(&scene, &folder));
                said.is_ok() && silent != said
            });
            assert!(changes, "{path} = {example} changes nothing");
        }
    });
}

#[test]
fn every_example_is_read() {
    let folder = folder();
    all(|block, key, path| {
        for example in &key.examples {
            let mut refused = vec![];
            let is_read =
                put(block, key, example).any(|(_, scene, _)| match read(&scene, &folder) {
                    Ok(_) => true,
                    Err(error) => {
                        refused.push(error);
                        false
                    }
                });
            assert!(is_read, "{path} = {example}: {refused:#?}");
        }
    });
}

/// A number beyond the range that is said is refused wherever one within it is read.
#[test]
fn ranges_are_those_of_the_reader() {
    let folder = folder();
    let tried = std::cell::Cell::new(0);
    all(|block, key, path| {
        let beyond = [
            match key.range.low {
                Bound::Included(low) => Some(low - 1.0),
                Bound::Excluded(low) => Some(low),
                Bound::Unbounded => None,
            },
            match key.range.high {
                Bound::Included(high) => Some(high + 1.0),
                Bound::Excluded(high) => Some(high),
                Bound::Unbounded => None,
            },
        ];
        for beyond in beyond.into_iter().flatten() {
            // Whole numbers are written as such.
            let beyond = if key.kind.contains("whole") {
                json!(beyond as i64)
            } else {
                json!(beyond)
            };
            for example in &key.examples {
                let mut value = beyond.clone();
                if let Some(list) = example.as_array() {
                    let mut list = list.clone();
                    list[0] = beyond.clone();
                    value = list.into();
                }
                for (base, scene, _) in put(block, key, example) {
                    if read(&scene, &folder).is_err() {
                        continue;
                    }
                    let mut wrong = base.clone();
                    let object = object(&mut wrong, &block.path).expect("it was there");
                    object[&key.name] = value.clone();
                    let error = read(&wrong, &folder);
                    assert!(error.is_err(), "{path} = {value} is read in {wrong}");
                    tried.set(tried.get() + 1);
                }
            }
        }
    });
    assert!(tried.get() > 50, "{}", tried.get());
}

#[test]
fn words_for_people_are_read_everywhere_and_mean_nothing() {
    let folder = folder();
    for comment in [json!("a word"), json!(["two", "lines"])] {
        for block in blocks() {
            let key = (block.keys.iter()).find(|key| key.name == "comment");
            let key = key.unwrap_or_else(|| panic!("{} has no comment", block.path));
            let mut read_once = false;
            for (base, scene, _) in put(&block, key, &comment) {
                if let Ok(silent) = read(&base, &folder) {
                    assert_eq!(read(&scene, &folder), Ok(silent), "{}", block.path);
                    read_once = true;
                }
            }
            assert!(read_once, "{}", block.path);
        }
    }
    let mut scene = block(3);
    scene["comment"] = json!(3);
    let error = read(&scene, &folder).expect_err("a number is no text");
    assert!(
        error.contains("a text in quotes, or a list of them"),
        "{error}"
    );
}
