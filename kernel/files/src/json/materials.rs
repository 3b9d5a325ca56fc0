//! Materials from their keys.

use super::build::Build;
use super::keys::{RawMaterial, RawScene};
use super::words::{MATERIALS, MaterialKind, RATES, listed};
use proctor_kernel::scene::{Law, Material, ObjectiveRate};

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
        let kind = if let Some(word) = &raw.r#type {
            self.word(&format!("{path}.type"), word, MATERIALS)
        } else {
            let words = listed(MATERIALS.iter().map(|m| m.0));
            self.missing(format!("{path}.type"), words);
            None
        };
        let rate = raw.objective_rate.as_ref();
        if kind == Some(MaterialKind::NeoHookean) && rate.is_some() {
            self.add(
                format!("{path}.objective_rate"),
                "an objective rate for a neo_hookean material, which is no rate law",
                "no `objective_rate`, or `type` \"elastic\"",
            );
        }
        let rate = self.word_or(
            &format!("{path}.objective_rate"),
            rate,
            RATES,
            ObjectiveRate::HughesWinget,
        );
        let young = self.number(
            &format!("{path}.young"),
            raw.young,
            "a number greater than 0 [Pa]",
        );
        let poisson = self.number(
            &format!("{path}.poisson"),
            raw.poisson,
            "a number greater than -1 and less than 0.5",
        );
        let density = self.number(
            &format!("{path}.density"),
            raw.density,
            "a number greater than 0 [kg/m³]",
        );
        Material {
            name,
            id: self.id(path, raw.id, i),
            density,
            law: match kind {
                Some(MaterialKind::NeoHookean) => Law::NeoHookean { young, poisson },
                Some(MaterialKind::Elastic) | None => Law::LinearElastic {
                    young,
                    poisson,
                    rate,
                },
            },
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
