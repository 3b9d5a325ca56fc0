//! Materials from their keys.

use super::build::Build;
use super::keys::RawScene;
use super::material_keys::RawMaterial;
use super::words::listed;
use proctor_kernel::number::Number;
use proctor_laws::{ALL, ConstantDefault, LawType, Rows};
use proctor_scene::Material;

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
        let words: Vec<(&str, &LawType)> = ALL.iter().map(|kind| (kind.name, kind)).collect();
        let kind = if let Some(word) = &raw.r#type {
            // Other solvers write `mohr-coulomb`.
            self.word(&format!("{path}.type"), &word.replace('-', "_"), &words)
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
        self.refuse_constants_of_others(path, kind_or_first, raw);
        let mut values: Vec<f64> = vec![];
        for constant in kind_or_first.constants {
            let before = kind_or_first.constants.iter().zip(&values);
            let given = raw.number(constant).or(match constant.given {
                ConstantDefault::Needed => None,
                ConstantDefault::Or(value) => Some(value),
                ConstantDefault::As(key) => before
                    .into_iter()
                    .find(|(earlier, _)| earlier.key == key)
                    .map(|(_, value)| *value),
            });
            let path = format!("{path}.{}", constant.key);
            values.push(self.number(&path, given, &constant.words()));
        }
        let density = self.number(
            &format!("{path}.density"),
            raw.density,
            "a number greater than 0 [kg/m³]",
        );
        self.refuse_curves_of_others(path, kind_or_first, raw);
        let curves: Vec<Rows> = (kind_or_first.curves.iter())
            .map(|curve| raw.curve(curve).cloned().unwrap_or_default())
            .collect();
        let law = (kind_or_first.read)(&values, &choices, &curves);
        // What a law has no use for, such as the residual of what does not soften, it does not keep; the check of the scene
        // sees what it keeps.
        for ((constant, kept), value) in law.constants().iter().zip(&values) {
            let is_kept = kept.to_bits() == value.to_bits();
            if !is_kept && !value.is_nan() && !constant.accepted.holds(*value) {
                self.add(
                    format!("{path}.{}", constant.key),
                    Number(*value).to_string(),
                    constant.words(),
                );
            }
        }
        Material {
            name,
            id: self.id(path, raw.id, i),
            density,
            law,
        }
    }

    /// A number that only another law has.
    fn refuse_constants_of_others(&mut self, path: &str, kind: &LawType, raw: &RawMaterial) {
        for constant in super::material_keys::constants() {
            let own = kind.constants.iter().any(|own| own.key == constant.key);
            if own || raw.number(constant).is_none() {
                continue;
            }
            let having = |other: &&LawType| other.constants.iter().any(|c| c.key == constant.key);
            self.refuse_key_of_others(path, constant.key, kind, ALL.iter().filter(having));
        }
    }

    /// A curve that only another law may be given.
    fn refuse_curves_of_others(&mut self, path: &str, kind: &LawType, raw: &RawMaterial) {
        for curve in super::material_keys::curves() {
            let own = kind.curves.iter().any(|own| own.key == curve.key);
            if own || raw.curve(curve).is_none() {
                continue;
            }
            let having = |other: &&LawType| other.curves.iter().any(|c| c.key == curve.key);
            self.refuse_key_of_others(path, curve.key, kind, ALL.iter().filter(having));
        }
    }

    fn refuse_key_of_others<'a>(
        &mut self,
        path: &str,
        key: &str,
        kind: &LawType,
        having: impl Iterator<Item = &'a LawType>,
    ) {
        self.add(
            format!("{path}.{key}"),
            format!("`{key}` of the material type {}, which has none", kind.name),
            not_given_or(key, having),
        );
    }

    /// A word that only another law may be given.
    fn refuse_choices_of_others(&mut self, path: &str, kind: &LawType, raw: &RawMaterial) {
        for choice in super::material_keys::choices() {
            let own = kind.choices.iter().any(|own| own.key == choice.key);
            if own || raw.word(choice).is_none() {
                continue;
            }
            let having = |other: &&LawType| other.choices.iter().any(|c| c.key == choice.key);
            self.add(
                format!("{path}.{}", choice.key),
                choice.elsewhere.replace("{law}", kind.name),
                not_given_or(choice.key, ALL.iter().filter(having)),
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

/// Accepted keys in the place of one that only other laws have.
fn not_given_or<'a>(key: &str, laws: impl Iterator<Item = &'a LawType>) -> String {
    let names: Vec<String> = laws.map(|law| format!("{:?}", law.name)).collect();
    format!("no `{key}`, or `type` {}", names.join(" or "))
}

/// Path of an entry: by name in an object, by number in a list.
pub(super) fn entry_path(key: &str, i: usize, name: Option<&str>) -> String {
    match name {
        Some(name) => format!("{key}.{name}"),
        None => format!("{key}[{i}]"),
    }
}
