//! Blocks of particles have the same bits for all lanes, and internal variables follow their particles.

use proctor_kernel::lanes::{LaneChoice, Lanes, SelectedLanes};
use proctor_kernel::layout::{Layout, Optional, Variable};
use proctor_kernel::particles::ParticleSet;
use proctor_laws::tensor::Configuration;
use proctor_laws::{
    Block, BlockStrain, ConeMatch, DruckerPrager, Gradients, Hencky, Increment, Law, LinearElastic,
    MohrCoulomb, NeoHookean, Particle, Residual, Softening, Stress, Tresca, VonMises,
};

const PARTICLES: usize = 43;
const DT: f64 = 1.0e-3;

/// Elasticity that counts the steps and adds up the volume strain.
#[derive(Debug, PartialEq)]
struct StepCounter(LinearElastic);

impl Law for StepCounter {
    const VARIABLES: &'static [Variable] = &[
        Variable {
            initial: 2.0,
            ..Variable::scalar("steps", "")
        },
        Variable {
            components: 2,
            ..Variable::scalar("strain", "")
        },
    ];

    fn name(&self) -> &'static str {
        "counting"
    }
    fn young(&self) -> f64 {
        self.0.young()
    }
    fn wave_speed(&self, density: f64) -> f64 {
        self.0.wave_speed(density)
    }
    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L {
        variables[0] = variables[0] + L::splat(1.0);
        for (axis, strain) in variables[1..].iter_mut().enumerate() {
            *strain = *strain + increment.gradient[axis][axis];
        }
        self.0.update::<L, D>(increment, stress, &mut [])
    }
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        self.0.energy(particle)
    }
}

fn bits(set: &ParticleSet) -> Vec<Vec<u64>> {
    let of = |column: &Vec<f64>| column.iter().map(|x| x.to_bits()).collect();
    set.columns.iter().map(of).collect()
}

/// Particles with numbers, and the velocity gradients of those from `first` on.
fn particles<M: Law>(axes: usize) -> (ParticleSet, Gradients) {
    let wanted = Optional {
        deformation: M::NEEDS_DEFORMATION,
        ..Optional::default()
    };
    let layout = Layout::new(axes, wanted, M::VARIABLES);
    let mut set = ParticleSet::zeros(layout, 0, PARTICLES);
    let number = |i: usize| libm::sin(i as f64 * 1.7 + 0.3);
    for p in 0..PARTICLES {
        set.columns[Layout::MASS][p] = 2.0 + number(p);
        set.columns[Layout::VOLUME][p] = 0.02 + 0.01 * number(p + 5);
        for i in 0..layout.stress_components() {
            set.columns[Layout::stress(axes) + i][p] = number(7 * p + i);
        }
        for (a, b) in (0..axes).flat_map(|a| (0..axes).map(move |b| (a, b))) {
            if let Some(first) = layout.deformation {
                let one = if a == b { 1.0 } else { 0.0 };
                set.columns[first + axes * a + b][p] = one + 0.1 * number(p + 3 * a + b);
            }
        }
    }
    // Of what may part some particles have, and of what softens each has softened as far as no other.
    for (variable, _, column) in layout.components() {
        let largest = match variable.name {
            "gap" => 1e-3,
            "plastic strain" => 0.1,
            _ => continue,
        };
        set.columns[column] = (0..PARTICLES)
            .map(|p| (largest * number(p)).max(0.0))
            .collect();
    }
    let mut gradients = Gradients::zero();
    for (c, column) in gradients.0.iter_mut().enumerate() {
        for (i, value) in column.iter_mut().enumerate() {
            *value = 50.0 * number(11 * i + c);
        }
    }
    (set, gradients)
}

fn strained<M: Law>(
    axes: usize,
    run: &dyn Fn(Block<'_, '_>) -> BlockStrain,
) -> (Vec<Vec<u64>>, BlockStrain) {
    let (mut set, gradients) = particles::<M>(axes);
    let layout = set.layout;
    let found = {
        let mut columns: Vec<&mut [f64]> = set.columns.iter_mut().map(Vec::as_mut_slice).collect();
        run(Block {
            columns: &mut columns,
            layout: &layout,
            range: 3..PARTICLES,
            gradients: &gradients,
            dt: DT,
            configuration: Configuration::End,
            density: 100.0,
            volume_of_deformation: false,
        })
    };
    (bits(&set), found)
}

fn check<M: Law>(law: &M) {
    use proctor_laws::Strain;
    for axes in [2, 3] {
        let whole = strained::<M>(axes, &|block| law.strain(SelectedLanes::plain(), block));
        assert!(whole.1.fault.is_none() && whole.1.speed_squared > 0.0);
        for choice in [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar] {
            let Ok(lanes) = SelectedLanes::new(choice) else {
                continue;
            };
            let found = strained::<M>(axes, &|block| law.strain(lanes, block));
            assert_eq!(
                found,
                whole,
                "{law:?} in {axes}D with {} lanes",
                lanes.name()
            );
        }
    }
}

#[test]
fn blocks_have_the_same_bits_for_all_lanes() {
    check(&LinearElastic::new(1.0e3, 0.3));
    check(&NeoHookean::new(1.0e3, 0.3));
    check(&Hencky::new(1.0e3, 0.3));
    check(&StepCounter(LinearElastic::new(1.0e3, 0.3)));
    // Particles of the block are stressed up to 1 Pa: some of them yield, some do not.
    check(&VonMises::new(1.0e3, 0.3, 1.0, 3.0).saturating(0.5, 20.0));
    check(&VonMises::new(1.0e3, 0.3, 1.0, 3.0).along(&[[1e-5, 1.1], [2e-5, 1.05], [1e-4, 1.2]]));
    check(&Tresca::new(1.0e3, 0.3, 0.5));
    check(&DruckerPrager::new(
        1.0e3,
        0.3,
        [25.0, 0.5, 10.0],
        ConeMatch::PlaneStrain,
    ));
    check(&DruckerPrager::new(
        1.0e3,
        0.3,
        [25.0, 0.0, 10.0],
        ConeMatch::Outer,
    ));
    check(&MohrCoulomb::new(1.0e3, 0.3, [30.0, 0.0, 0.0]));
    let residual = Residual {
        friction: Some(15.0),
        cohesion: Some(0.1),
        ..Residual::default()
    };
    check(
        &MohrCoulomb::new(1.0e3, 0.3, [30.0, 0.5, 10.0])
            .with_tensile(0.3)
            .softening(Softening::Exponential { eta: 3.0 }, residual)
            .relaxing(1e-3),
    );
}

#[test]
fn internal_variables_begin_and_go_on_as_their_law_says() {
    use proctor_laws::Strain;
    let law = StepCounter(LinearElastic::new(1.0e3, 0.3));
    let (mut set, gradients) = particles::<StepCounter>(2);
    assert_eq!(set.column("steps"), Some(&[2.0; PARTICLES][..]));
    assert_eq!(set.column("strain 2"), Some(&[0.0; PARTICLES][..]));
    assert_eq!(set.column("strain"), None);
    let layout = set.layout;
    let mut columns: Vec<&mut [f64]> = set.columns.iter_mut().map(Vec::as_mut_slice).collect();
    law.strain(
        SelectedLanes::any(),
        Block {
            columns: &mut columns,
            layout: &layout,
            range: 3..PARTICLES,
            gradients: &gradients,
            dt: DT,
            configuration: Configuration::Beginning,
            density: 100.0,
            volume_of_deformation: false,
        },
    );
    let steps = set.column("steps").expect("a variable of the law");
    assert_eq!((steps[2], steps[3], steps[42]), (2.0, 3.0, 3.0));
    for p in 3..PARTICLES {
        let expected = [3.0, DT * gradients.0[0][p - 3], DT * gradients.0[3][p - 3]];
        assert_eq!(set.variables(p)[..], expected, "particle {p}");
    }
}
