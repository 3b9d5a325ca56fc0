//! Choices of the method and of what is written, from their keys.

use super::build::Build;
use super::keys::{RawDamping, RawScene};
use super::words::{
    DAMPINGS, DampingKind, FIELDS, NODAL_FIELDS, ON_IMBALANCE, OUTSIDES, SCHEMES,
    VOLUMETRIC_STRAINS, domain_updates, shape_functions, transfers,
};
use proctor_scene::{Damping, Scene, TimeStep, Transfer, Weighting};

impl Build<'_> {
    /// Time step, gravity, weighting, scheme, transfer, damping.
    pub(super) fn method(&mut self, raw: &RawScene, scene: &mut Scene) {
        scene.time_step = self.time_step(raw);
        scene.gravity = self.vector_or_zero("gravity", raw.gravity.as_ref());
        scene.weighting = self.weighting(raw);
        scene.scheme = self.word_or(
            "stress_scheme_update",
            raw.stress_scheme_update.as_ref(),
            SCHEMES,
            scene.scheme,
        );
        let kind = self.word_or(
            "transfer",
            raw.transfer.as_ref(),
            &transfers(),
            scene.transfer.kind,
        );
        scene.transfer = Transfer::new(kind);
        if let Some(fraction) = raw.pic_fraction {
            scene.transfer.pic_fraction = fraction;
        }
        scene.volumetric_strain = self.word_or(
            "volumetric_strain",
            raw.volumetric_strain.as_ref(),
            VOLUMETRIC_STRAINS,
            scene.volumetric_strain,
        );
        scene.damping = raw
            .damping
            .as_ref()
            .map_or(Damping::None, |raw| self.damping(raw));
        scene.outside = self.word_or("outside", raw.outside.as_ref(), OUTSIDES, scene.outside);
        scene.on_imbalance = self.word_or(
            "on_imbalance",
            raw.on_imbalance.as_ref(),
            ON_IMBALANCE,
            scene.on_imbalance,
        );
    }

    fn time_step(&mut self, raw: &RawScene) -> TimeStep {
        let multiplier = self.either(
            "",
            (
                "critical_time_step_multiplier",
                raw.critical_time_step_multiplier.as_ref(),
            ),
            ("time_step_multiplier", raw.time_step_multiplier.as_ref()),
        );
        let allow_unstable = raw.allow_unstable.unwrap_or(false);
        match (raw.time_step, multiplier) {
            (Some(_), Some((key, _))) => {
                self.add(
                    key,
                    format!("`time_step` and `{key}` together"),
                    "one of them: a constant step, or a factor on the critical one",
                );
                TimeStep::Automatic
            }
            (Some(dt), None) => TimeStep::Fixed { dt, allow_unstable },
            (None, Some((key, &multiplier))) => {
                self.spelt("critical_time_step_multiplier", key);
                TimeStep::Multiplier {
                    multiplier,
                    allow_unstable,
                }
            }
            (None, None) => {
                if allow_unstable {
                    self.add(
                        "allow_unstable",
                        "true with an automatic time step, which is stable",
                        "false; or true with `time_step` or `critical_time_step_multiplier`",
                    );
                }
                TimeStep::Automatic
            }
        }
    }

    fn weighting(&mut self, raw: &RawScene) -> Weighting {
        let function = self.word_or(
            "shape_function",
            raw.shape_function.as_ref(),
            &shape_functions(),
            Weighting::UniformGimp,
        );
        let Some(word) = &raw.domain_update else {
            return function;
        };
        let updated = self.word_or("domain_update", Some(word), &domain_updates(), function);
        if function.domain_update().is_none() {
            self.add(
                "domain_update",
                "a domain update without cpGIMP",
                "no `domain_update`, or `shape_function` \"cpGIMP\"",
            );
        }
        updated
    }

    fn damping(&mut self, raw: &RawDamping) -> Damping {
        let value = self.either(
            "damping",
            ("value", raw.value.as_ref()),
            ("alpha", raw.alpha.as_ref()),
        );
        if let Some((key, _)) = value {
            self.spelt("damping.alpha", format!("damping.{key}"));
        } else {
            self.spelt("damping.alpha", "damping.value");
        }
        let Some(word) = &raw.r#type else {
            self.missing(
                "damping.type",
                super::words::listed(DAMPINGS.iter().map(|d| d.0)),
            );
            return Damping::None;
        };
        let Some(kind) = self.word("damping.type", word, DAMPINGS) else {
            return Damping::None;
        };
        if matches!(kind, DampingKind::None | DampingKind::Kinetic) {
            if let Some((key, value)) = value {
                self.add(
                    format!("damping.{key}"),
                    format!("{value} for {word} damping"),
                    "no value: only local and viscous damping have one",
                );
            }
            return match kind {
                DampingKind::Kinetic => Damping::Kinetic,
                _ => Damping::None,
            };
        }
        let value = value.map(|(_, value)| *value);
        if kind == DampingKind::Local {
            let alpha = self.number("damping.value", value, "a number from 0 to 1");
            Damping::Local { alpha }
        } else {
            let alpha = self.number("damping.value", value, "a number, 0 or greater");
            Damping::Viscous { alpha }
        }
    }

    /// Results: outputs, fields, probes.
    pub(super) fn results(&mut self, raw: &RawScene, scene: &mut Scene) {
        if let Some(results) = &raw.results {
            if let Some(print) = results.print {
                scene.results.print = print;
            }
            scene.results.history_interval = results.history_interval;
            scene.results.checkpoint = results.checkpoint.unwrap_or(true);
            let fields = self.either(
                "results",
                ("fields", results.fields.as_ref()),
                (
                    "material_point_results",
                    results.material_point_results.as_ref(),
                ),
            );
            if let Some((key, words)) = fields {
                scene.results.fields.clear();
                for (i, word) in words.iter().enumerate() {
                    let meant = self.word(&format!("results.{key}[{i}]"), word, FIELDS);
                    for field in meant.unwrap_or_default() {
                        // Asking twice for a field does no harm, writing it twice would.
                        if !scene.results.fields.contains(field) {
                            scene.results.fields.push(*field);
                        }
                    }
                }
            }
        }
        let nodal = raw
            .results
            .as_ref()
            .and_then(|r| r.grid_nodal_results.as_ref());
        for (i, word) in nodal.into_iter().flatten().enumerate() {
            let path = format!("results.grid_nodal_results[{i}]");
            for field in self.word(&path, word, NODAL_FIELDS).unwrap_or_default() {
                if !scene.results.nodal_fields.contains(field) {
                    scene.results.nodal_fields.push(*field);
                }
            }
        }
        self.probes(raw, scene);
    }
}
