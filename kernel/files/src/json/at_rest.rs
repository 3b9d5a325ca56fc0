//! Stress of ground at rest below a surface, from its keys.

use std::sync::Arc;

use super::build::Build;
use super::keys::RawBody;
use super::layers::{Zone, layer};
use super::sheets::RawSheet;
use proctor_kernel::sheet::Sheet;
use proctor_kernel::stratum::Stratum;
use proctor_scene::{Material, Mesh, Overburden, Shape, Vector};

impl Build<'_> {
    /// Stress at rest of the parts, if that is what the body has.
    pub(super) fn at_rest(
        &mut self,
        path: &str,
        raw: &RawBody,
        whole: &Stratum,
        (bases, layers, zones): (&[Sheet], &[usize], &[Zone<'_>]),
        materials: &[Material],
    ) -> Option<Overburden> {
        let given = (raw.initial_stress.as_ref())
            .filter(|given| given.r#type.as_deref() == Some("at_rest"));
        let Some(given) = given else {
            let of_layer = raw
                .layers
                .iter()
                .flatten()
                .position(|layer| layer.ratio.is_some());
            if let Some(k) = of_layer {
                self.add(
                    format!("{path}.layers[{k}].ratio"),
                    "`ratio` without `initial_stress` of the type \"at_rest\"",
                    "no `ratio`, or such an initial stress",
                );
            }
            return None;
        };
        let surface = match &given.level {
            None => whole.upper().first()?.clone(),
            Some(level) => self.sheet(
                &format!("{path}.initial_stress.level"),
                level,
                whole.range(),
            )?,
        };
        let ground = Stratum::new(
            whole.axes(),
            *whole.range(),
            whole.lower().first()?.clone(),
            surface.clone(),
        );
        let zones: Vec<&Zone<'_>> = zones
            .iter()
            .filter(|zone| zone.material.is_some())
            .collect();
        let boxes: Vec<[Vector; 2]> = zones.iter().map(|zone| zone.corners).collect();
        let density = |material: usize| Some(materials.get(material)?.density);
        let mut strata = vec![];
        for (k, material) in layers.iter().enumerate() {
            strata.push((layer(&ground, bases, k, None, &boxes), density(*material)?));
        }
        for (z, zone) in zones.iter().enumerate() {
            let part = ground.part(&[], &[], Some(&zone.corners), &boxes[z + 1..]);
            strata.push((part, density(zone.material?)?));
        }
        Some(Overburden {
            ratio: given.ratio?,
            surcharge: given.surcharge.unwrap_or(0.0),
            surface,
            ground: Arc::new(strata),
        })
    }

    /// Stress at rest of a body of one material below a line or a file, whatever its shape.
    pub(super) fn rest_below(
        &mut self,
        path: &str,
        raw: &RawBody,
        mesh: &Mesh,
        shape: &Shape,
        density: Option<f64>,
    ) -> Option<Overburden> {
        let given = raw.initial_stress.as_ref()?;
        if given.r#type.as_deref() != Some("at_rest") {
            return None;
        }
        let key = format!("{path}.initial_stress.level");
        let level = match &given.level {
            Some(RawSheet::Level(_)) => return None,
            Some(level) => level,
            None => {
                self.missing(
                    key,
                    "the surface of the ground: a level [m], a line or a file",
                );
                return None;
            }
        };
        let range = self.plan_range(path, None, mesh)?;
        let surface = self.sheet(&key, level, &range)?;
        let axes = self.dimension.axes();
        let lower = Sheet::Level(shape.bounds()?[0][axes - 1]);
        let ground = Stratum::new(axes, range, lower, surface.clone());
        Some(Overburden {
            ratio: given.ratio?,
            surcharge: given.surcharge.unwrap_or(0.0),
            surface,
            ground: Arc::new(vec![(ground, density?)]),
        })
    }
}
