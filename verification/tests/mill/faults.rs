//! Seeded faults: each fails a gate of the problem that is to notice it, which holds without.

use proctor_kernel::layout::Variable;
use proctor_laws::tensor::{determinant, product};
use proctor_laws::{AnyLaw, Increment, Law, LinearElastic, NeoHookean, Particle, Stress, VonMises};
use proctor_scene::prelude::Lanes;
use proctor_scene::{StressScheme, TransferKind};
use proctor_verification::mill::expected::{self, Gate};
use proctor_verification::mill::judge;
use proctor_verification::mill::ladder::{Errors, Faults};
use proctor_verification::mill::material::Kind;
use proctor_verification::mill::problem::{Family, Problem};

use super::{method, problem};

/// The fault in the rate that a law gets.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wrong {
    Nothing,
    /// The velocity gradient is transposed.
    Transposed,
    /// Shear rates are left out.
    NoShear,
    /// The spin is left out.
    NoSpin,
    /// Stress per volume of the start: the volume is not updated.
    OldVolume,
}

/// A law of the kernel that is given a wrong rate.
#[derive(Debug, PartialEq)]
struct Faulty<M> {
    law: M,
    wrong: Wrong,
}

impl<M: Law> Law for Faulty<M> {
    const VARIABLES: &'static [Variable] = M::VARIABLES;

    fn name(&self) -> &'static str {
        "faulty"
    }
    fn young(&self) -> f64 {
        self.law.young()
    }
    fn wave_speed(&self, density: f64) -> f64 {
        self.law.wave_speed(density)
    }
    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L {
        let g = increment.gradient;
        let half = L::splat(0.5);
        let mut wrong = *increment;
        for i in 0..D {
            for j in 0..D {
                wrong.gradient[i][j] = match self.wrong {
                    Wrong::Transposed => g[j][i],
                    Wrong::NoShear if i != j => half * (g[i][j] - g[j][i]),
                    Wrong::NoSpin => half * (g[i][j] + g[j][i]),
                    _ => g[i][j],
                };
            }
        }
        if self.wrong != Wrong::OldVolume {
            return self.law.update::<L, D>(&wrong, stress, variables);
        }
        // Stress times V is what nodes feel: sigma V_0 for sigma V.
        let jacobian = wrong.volume / wrong.mass * L::splat(wrong.density);
        let before = jacobian / determinant::<L, D>(&one_plus::<L, D>(&g));
        for entry in stress.packed_mut() {
            *entry = *entry * before;
        }
        let speed = self.law.update::<L, D>(&wrong, stress, variables);
        for entry in stress.packed_mut() {
            *entry = *entry / jacobian;
        }
        speed
    }
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        self.law.energy(particle)
    }
}

#[inline(always)]
fn one_plus<L: Lanes, const D: usize>(g: &[[L; 3]; 3]) -> [[L; 3]; 3] {
    let mut f = *g;
    for i in 0..D {
        f[i][i] = f[i][i] + L::splat(1.0);
    }
    f
}

/// A neo-Hookean law that keeps F by itself, as f F, or wrongly as F f.
#[derive(Debug, PartialEq)]
struct OwnDeformation {
    law: NeoHookean,
    turned_over: bool,
}

impl Law for OwnDeformation {
    /// F - 1, row by row.
    const VARIABLES: &'static [Variable] = &[Variable {
        name: "deformation",
        unit: "",
        components: 9,
        initial: 0.0,
    }];

    fn name(&self) -> &'static str {
        "own deformation"
    }
    fn young(&self) -> f64 {
        Law::young(&self.law)
    }
    fn wave_speed(&self, density: f64) -> f64 {
        Law::wave_speed(&self.law, density)
    }
    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let mut f = [[zero; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                f[i][j] = variables[3 * i + j] + if i == j { one } else { zero };
            }
        }
        let relative = one_plus::<L, D>(&increment.gradient);
        let f = if self.turned_over {
            product::<L, D>(&f, &relative)
        } else {
            product::<L, D>(&relative, &f)
        };
        for i in 0..D {
            for j in 0..D {
                variables[3 * i + j] = f[i][j] - if i == j { one } else { zero };
            }
        }
        let increment = Increment {
            deformation: f,
            jacobian: determinant::<L, D>(&f),
            ..*increment
        };
        self.law.update::<L, D>(&increment, stress, &mut [])
    }
    fn energy(&self, _: &Particle<'_>) -> f64 {
        0.0
    }
}

const USL: proctor_verification::settings::Method = method(StressScheme::Usl, TransferKind::Apic);

/// True where all gates hold.
fn holds(problem: &Problem, faults: &Faults) -> bool {
    let (found, gates) = judge(problem, faults).expect("a solution");
    found.is_ok() && !gates.is_empty() && gates.iter().all(Gate::holds)
}

fn with_law(law: impl Into<AnyLaw>) -> Faults {
    Faults {
        law: Some(law.into()),
        ..Faults::default()
    }
}

#[test]
fn wrong_rates_of_an_elastic_law_fail() {
    let floating = problem(Family::Floating, Kind::Elastic, USL);
    let law = LinearElastic::new(floating.material.young, floating.material.poisson);
    let of = |wrong| with_law(Faulty { law, wrong });
    assert!(holds(&floating, &of(Wrong::Nothing)));
    for wrong in [Wrong::Transposed, Wrong::NoShear, Wrong::OldVolume] {
        assert!(!holds(&floating, &of(wrong)), "{wrong:?}");
    }
}

#[test]
#[ignore = "takes 12 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn wrong_rates_of_a_yielding_law_fail() {
    let frame = problem(Family::Frame, Kind::VonMises, USL);
    let law: VonMises = frame.material.von_mises();
    let of = |wrong| with_law(Faulty { law, wrong });
    assert!(holds(&frame, &of(Wrong::Nothing)));
    for wrong in [Wrong::Transposed, Wrong::NoSpin] {
        assert!(!holds(&frame, &of(wrong)), "{wrong:?}");
    }
}

#[test]
fn a_deformation_that_is_multiplied_from_the_wrong_side_fails() {
    let floating = problem(Family::Floating, Kind::NeoHookean, USL);
    let law = NeoHookean::new(floating.material.young, floating.material.poisson);
    let of = |turned_over| with_law(OwnDeformation { law, turned_over });
    assert!(holds(&floating, &of(false)));
    assert!(!holds(&floating, &of(true)));
}

/// Nodes of a frame at the positions of the next step: half a step too late on average, an error of first order.
#[test]
fn a_boundary_at_another_time_level_fails() {
    let frame = problem(Family::Frame, Kind::NeoHookean, USL);
    assert!(holds(&frame, &Faults::default()));
    let late = Faults {
        late: 0.5,
        ..Faults::default()
    };
    assert!(!holds(&frame, &late));
}

/// A reference whose field, or frame where there is no field, is off by a tenth fails in every family.
#[test]
#[ignore = "takes 13 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn a_wrong_reference_fails() {
    for (family, kind) in [
        (Family::Box, Kind::NeoHookean),
        (Family::Floating, Kind::Hencky),
        (Family::Frame, Kind::VonMises),
        (Family::Affine, Kind::Elastic),
    ] {
        let right = problem(family, kind, USL);
        let mut wrong = right.clone();
        let field = wrong.motion.field.polynomials.iter_mut().flatten();
        let frame = wrong.motion.stretch.iter_mut().flatten();
        field.chain(frame).for_each(|number| *number *= 1.1);
        let faults = Faults {
            judged_by: Some(wrong),
            ..Faults::default()
        };
        assert!(holds(&right, &Faults::default()), "{family:?}");
        assert!(!holds(&right, &faults), "{family:?}");
    }
}

/// Each gate of a problem fails with errors that it is about, and none with errors that fall as theory says.
#[test]
fn each_gate_reacts() {
    let frame = problem(Family::Frame, Kind::VonMises, USL);
    let errors = |displacement, stress, variable| Errors {
        displacement,
        stress,
        variable: Some(variable),
    };
    let failed = |coarse, fine| {
        let gates = expected::gates(&frame, &[coarse, fine]);
        assert_eq!(gates.len(), 5);
        let failed = gates.into_iter().filter(|gate| !gate.holds());
        failed.map(|gate| gate.what).collect::<Vec<_>>()
    };
    let right = errors(1e-3, 1e-3, 1e-3);
    assert!(failed(errors(4e-3, 2e-3, 2e-3), right).is_empty());
    for (coarse, fine, what) in [
        (errors(2e-3, 2e-3, 2e-3), right, "order of L2(u)"),
        (errors(4e-3, 1e-3, 2e-3), right, "order of L2(stress)"),
        (
            errors(4e-3, 2e-3, 1e-3),
            right,
            "order of L2(plastic strain)",
        ),
        (errors(4.0, 2e-3, 2e-3), errors(1.0, 1e-3, 1e-3), "L2(u)"),
        (
            errors(4e-3, 2.0, 2e-3),
            errors(1e-3, 1.0, 1e-3),
            "L2(stress)",
        ),
        (errors(f64::NAN, 2e-3, 2e-3), right, "order of L2(u)"),
    ] {
        assert_eq!(failed(coarse, fine), [what]);
    }
}
