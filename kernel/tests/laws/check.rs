//! `check_law` accepts the laws of the list, and names the property that a wrong law lacks.

use proctor_kernel::lanes::Lanes;
use proctor_laws::{
    AnyLaw, Bingham, CamClay, Component, ConeMatch, DruckerPrager, Hencky, Increment, Law,
    LawFault, LawProperty, LinearElastic, MohrCoulomb, NeoHookean, Newtonian, Particle, Stress,
    Tresca, VonMises, check_law,
};

const ELASTIC: LinearElastic = LinearElastic::new(1e6, 0.25);
const DENSITY: f64 = 1e3;

/// A mistake of an author.
#[derive(Debug, PartialEq, Clone, Copy)]
enum Mistake {
    /// Writes the shear in the plane where it is in space.
    PlaceInPlane,
    /// A stiffness along x alone.
    AlongX,
    /// Doubles the stress for each radian of spin.
    Spin,
    /// Forgets the volume.
    EnergyDensity,
    /// Stores twice the energy.
    Energy,
    /// A wave speed that is too small.
    WaveSpeed,
}

#[derive(Debug, PartialEq)]
struct Wrong(Mistake);

impl Law for Wrong {
    fn name(&self) -> &'static str {
        "wrong"
    }
    fn young(&self) -> f64 {
        ELASTIC.young()
    }
    fn wave_speed(&self, density: f64) -> f64 {
        let factor = if self.0 == Mistake::WaveSpeed {
            0.9
        } else {
            1.0
        };
        factor * ELASTIC.wave_speed(density)
    }
    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        _: &mut [L],
    ) -> L {
        let before = *stress;
        let speed = ELASTIC.update(increment, stress, &mut []);
        let g = &increment.gradient;
        match self.0 {
            Mistake::PlaceInPlane => {
                let packed = stress.packed_mut();
                if D == 2 {
                    packed[5] = packed[3];
                    packed[3] = before[Component::XY];
                }
            }
            Mistake::AlongX => {
                let xx = &mut stress[Component::XX];
                *xx = g[0][0].mul_add(L::splat(1e5), *xx);
            }
            Mistake::Spin => {
                let spin = g[0][1] - g[1][0];
                let factor = (spin * spin).mul_add(L::splat(1.0), L::splat(1.0));
                for component in Component::ALL {
                    stress[component] = stress[component] * factor;
                }
            }
            _ => {}
        }
        speed
    }
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        match self.0 {
            Mistake::EnergyDensity => ELASTIC.energy(particle) / particle.volume,
            Mistake::Energy => 2.0 * ELASTIC.energy(particle),
            _ => ELASTIC.energy(particle),
        }
    }
}

#[test]
fn laws_of_the_list_hold_what_every_law_must() {
    let laws: [AnyLaw; 10] = [
        ELASTIC.into(),
        NeoHookean::new(1e6, 0.25).into(),
        Hencky::new(1e6, 0.25).into(),
        VonMises::new(1e6, 0.25, 300.0, 1e4).into(),
        Tresca::new(1e6, 0.25, 200.0).into(),
        MohrCoulomb::new(1e6, 0.25, [30.0, 100.0, 10.0]).into(),
        DruckerPrager::new(1e6, 0.25, [30.0, 100.0, 10.0], ConeMatch::Outer).into(),
        CamClay::new(1.2, 0.1, 0.02, 0.25)
            .overconsolidated(1.1)
            .into(),
        Newtonian::new(1e6, 1.0).into(),
        Bingham::new(1e6, 1.0, 100.0, 1e4).into(),
    ];
    for law in laws {
        assert_eq!(check_law(law, DENSITY), Ok(()));
    }
}

#[test]
fn a_mistake_is_named_by_the_property_that_it_breaks() {
    let expected = [
        (Mistake::PlaceInPlane, LawProperty::Plane),
        (Mistake::AlongX, LawProperty::Axes),
        (Mistake::EnergyDensity, LawProperty::Volume),
        (Mistake::Energy, LawProperty::Energy),
        (Mistake::WaveSpeed, LawProperty::WaveSpeed),
    ];
    for (mistake, property) in expected {
        match check_law(Wrong(mistake), DENSITY) {
            Err(LawFault::Property {
                property: found, ..
            }) => assert_eq!(found, property),
            other => panic!("{mistake:?}: {other:?}"),
        }
    }
    assert!(check_law(Wrong(Mistake::Spin), DENSITY).is_err());
}

#[test]
fn the_message_names_law_property_and_error() {
    let fault = check_law(Wrong(Mistake::WaveSpeed), DENSITY).expect_err("too slow");
    assert_eq!(
        fault.to_string(),
        "law `wrong`: its waves are faster than its wave speed: relative error 1.1e-1; accepted: 1e-3"
    );
}
