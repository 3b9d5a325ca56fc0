//! Materials from their keys.

use super::build::Build;
use super::keys::RawScene;
use super::material_keys::RawMaterial;
use super::words::listed;
use proctor_kernel::laws::{ALL, Kind};
use proctor_kernel::scene::Material;

impl Build<'_> {
    pub(super) fn materials(&mut self, raw: &RawScene) -> Vec<Material> {
        let given = self.either(
            "",
            ("material", raw.material.as_ref()),
            ("materials", raw.materials.as_ref()),
        );
        let Some((key, entries)) = given else {
            self.missing("material", "a list or an object of materials");
            self.spelt("materials", "material");
            return Vec::new();
        };
        self.spelt("materials", key);
        let mut materials = Vec::new();
        for (i, (name, raw)) in entries.0.iter().enumerate() {
            let path = entry_path(key, i, name.as_deref());
            self.spelt(format!("materials[{i}]"), path.clone());
            let name = name.clone().unwrap_or_else(|| path.clone());
            materials.push(self.material(&path, name, i, raw));
        }
        materials
    }

    fn material(&mut self, path: &str, name: String, i: usize, raw: &RawMaterial) -> Material {
        let words: Vec<(&str, &Kind)> = ALL.iter().map(|kind| (kind.name, kind)).collect();
        let kind = if let Some(word) = &raw.r#type {
            self.word(&format!("{path}.type"), word, &words)
        } else {
            let words = listed(words.iter().map(|m| m.0));
            self.missing(format!("{path}.type"), words);
            None
        };
        // A law that is not known has its place taken by the first.
        let kind_or_first = kind.unwrap_or(&ALL[0]);
        self.refuse_choices_of_others(path, kind_or_first, raw);
        let choices: Vec<usize> = (kind_or_first.choices.iter())
            .map(|choice| {
                let words: Vec<(&str, usize)> = (choice.words.iter().copied()).zip(0..).collect();
                self.word_or(
                    &format!("{path}.{}", choice.key),
                    raw.word(choice),
                    &words,
                    0,
                )
            })
            .collect();
        let values: Vec<f64> = (kind_or_first.constants.iter())
            .map(|constant| {
                let path = format!("{path}.{}", constant.key);
                self.number(&path, raw.number(constant), &constant.words())
            })
            .collect();
        let density = self.number(
            &format!("{path}.density"),
            raw.density,
            "a number greater than 0 [kg/m³]",
        );
        Material {
            name,
            id: self.id(path, raw.id, i),
            density,
            law: (kind_or_first.read)(&values, &choices),
        }
    }

    /// A word that only another law may be given.
    fn refuse_choices_of_others(&mut self, path: &str, kind: &Kind, raw: &RawMaterial) {
        for choice in super::material_keys::choices() {
            let own = kind.choices.iter().any(|own| own.key == choice.key);
            if own || raw.word(choice).is_none() {
                continue;
            }
            let others = (ALL.iter())
                .filter(|other| other.choices.iter().any(|c| c.key == choice.key))
                .map(|other| format!("{:?}", other.name));
            self.add(
                format!("{path}.{}", choice.key),
                choice.elsewhere.replace("{law}", kind.name),
                format!(
                    "no `{}`, or `type` {}",
                    choice.key,
                    others.collect::<Vec<_>>().join(" or ")
                ),
            );
        }
    }

    /// An identifier that must be there; one that nobody would give stands in for it.
    pub(super) fn id(&mut self, path: &str, id: Option<i64>, i: usize) -> i64 {
        id.unwrap_or_else(|| {
            self.missing(format!("{path}.id"), "a whole number");
            i64::MIN + i as i64
        })
    }
}

/// Path of an entry: by name in an object, by number in a list.
pub(super) fn entry_path(key: &str, i: usize, name: Option<&str>) -> String {
    match name {
        Some(name) => format!("{key}.{name}"),
        None => format!("{key}[{i}]"),
    }
}
