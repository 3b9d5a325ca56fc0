//! Pore water and water that stands beside bodies, shared among ranks.

use super::{compare, strip};
use crate::common::{APIC, FLIP, elastic, material};
use proctor_kernel::simulation::StepErrorKind;
use proctor_scene::{
    Dimension, DomainUpdate, HeldPressure, History, Permeability, PlaneCondition, PoreWater, Scene,
    StandingWater, StressScheme, Transfer, TransferKind, VolumetricStrain, Weighting,
};

/// The strip with water in its pores, drained at its top.
pub(super) fn wet(dimension: Dimension) -> Scene {
    let mut scene = strip(dimension);
    let water = |porosity: f64, k: f64| {
        Some(PoreWater {
            porosity,
            grain_density: 2650.0,
            density: 1000.0,
            bulk: 1e4,
            conductivity: [k, 2.0 * k, k],
            permeability: Permeability::Constant,
            conductivity_gravity: 10.0,
        })
    };
    scene.pore_water = vec![water(0.4, 1e-2), water(0.3, 1e-3)];
    scene.materials[0] = material(elastic(1e5, 0.3));
    scene.materials[1] = scene.materials[0].clone();
    for material in &mut scene.materials {
        material.density = 2650.0;
    }
    scene.water_planes = scene.mesh.planes;
    scene.water_planes[1][1] = PlaneCondition::Free;
    scene
}

pub(super) fn standing() -> StandingWater {
    StandingWater {
        level: History {
            times: vec![0.0, 0.05],
            values: vec![[0.3, 0.0, 0.0], [0.36, 0.0, 0.0]],
        },
        density: 1000.0,
        bodies: vec![],
        shore: None,
    }
}

#[test]
fn ranks_share_pore_water() {
    let domains = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    let pic = Transfer {
        kind: TransferKind::Flip,
        pic_fraction: 0.05,
    };
    for dimension in [Dimension::Two, Dimension::Three] {
        for (weighting, transfer, scheme) in [
            (Weighting::UniformGimp, FLIP, StressScheme::Usl),
            (Weighting::UniformGimp, pic, StressScheme::Musl),
            (domains, APIC, StressScheme::Usl),
            (domains, pic, StressScheme::Usl),
        ] {
            let mut scene = wet(dimension);
            (scene.weighting, scene.transfer, scene.scheme) = (weighting, transfer, scheme);
            if scheme == StressScheme::Usl {
                scene.volumetric_strain = VolumetricStrain::CellAverage;
            }
            if transfer == pic {
                scene.held_pressures = vec![HeldPressure {
                    p1: [0.0; 3],
                    p2: [0.6, 1.0, 1.0],
                    pressure: 20.0,
                }];
            }
            let end = compare(&scene, 45, 8.0);
            assert!(end.error.is_none(), "{:?}", end.error);
            assert!(end.sorts >= 3, "{} sorts", end.sorts);
        }
    }
}

/// Water stands beside dry bodies and beside wet ones, and its level rises.
#[test]
fn ranks_share_standing_water() {
    for dimension in [Dimension::Two, Dimension::Three] {
        for mut scene in [strip(dimension), wet(dimension)] {
            scene.gravity = [0.0; 3];
            scene.gravity[dimension.axes() - 1] = -10.0;
            scene.standing_waters = vec![standing()];
            let end = compare(&scene, 60, 8.0);
            assert!(end.error.is_none(), "{:?}", end.error);
            assert!(end.sorts >= 3, "{} sorts", end.sorts);
        }
    }
}

/// Soil whose pores close stops all ranks for the same particle.
#[test]
fn ranks_stop_for_the_same_porosity() {
    let mut scene = wet(Dimension::Two);
    for water in scene.pore_water.iter_mut().flatten() {
        water.porosity = 0.0102;
        water.bulk = 1.0;
    }
    // Soft enough to be pressed into its pores.
    scene.materials[1] = material(elastic(1e3, 0.3));
    scene.materials[1].density = 2650.0;
    let end = compare(&scene, 200, 8.0);
    let error = end.error.expect("the pores close");
    assert!(
        matches!(error.kind, StepErrorKind::Porosity { .. }),
        "{error}"
    );
}
