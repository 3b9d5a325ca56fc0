//! Laws of a given stiffness, and the same in other units.

use proctor_laws::{
    self, AnyLaw, Bingham, ConeMatch, DruckerPrager, LinearElastic, MohrCoulomb, NeoHookean,
    Newtonian, Tresca, VonMises,
};

use super::dice::Dice;
use super::units::Units;

/// A law of any kind with about this Young's modulus \[Pa\], for a density \[kg/m³\] and cells of that size \[m\].
pub fn any(dice: &mut Dice, young: f64, density: f64, cell: f64) -> AnyLaw {
    let poisson = dice.between(0.0, 0.45);
    // Strength at strains of 0.1 % to 10 %: what collides yields or does not.
    let strength = young * dice.decades(1e-3, 0.1);
    // Dynamic viscosity whose diffusion takes a cell in some steps.
    let viscosity = dice.between(0.0, 0.1) * cell * (young * density).sqrt();
    let angles = [dice.between(5.0, 40.0), strength, dice.between(0.0, 5.0)];
    match dice.whole(0, 9) {
        0 => VonMises::new(young, poisson, strength, dice.pick(&[0.0, 0.1]) * young).into(),
        1 => Tresca::new(young, poisson, strength).into(),
        2 => MohrCoulomb::new(young, poisson, angles).into(),
        3 => {
            let matched = dice.pick(&[ConeMatch::PlaneStrain, ConeMatch::Outer, ConeMatch::Inner]);
            DruckerPrager::new(young, poisson, angles, matched).into()
        }
        4 => Newtonian::new(young, viscosity).into(),
        5 => Bingham::new(young, viscosity, strength, 0.3 * young).into(),
        6 | 7 => NeoHookean::new(young, poisson).into(),
        _ => LinearElastic::new(young, poisson).into(),
    }
}

/// An elastic law with this Young's modulus \[Pa\].
pub fn elastic(dice: &mut Dice, young: f64) -> AnyLaw {
    let poisson = dice.between(0.0, 0.45);
    if dice.chance(0.5) {
        NeoHookean::new(young, poisson).into()
    } else {
        LinearElastic::new(young, poisson).into()
    }
}

/// The same law in other units.
///
/// # Panics
/// Of a law that scene files do not name: no scene here has one.
pub fn scaled(law: &AnyLaw, units: &Units) -> AnyLaw {
    let constants = law.constants();
    let values: Vec<f64> = constants.iter().map(|(_, value)| *value).collect();
    let scaled = constants.iter().map(|(constant, value)| {
        value
            * match constant.unit {
                "Pa" => units.stress(),
                "Pa s" => units.stress() * units.time,
                "s" => units.time,
                "m" => units.length,
                _ => 1.0,
            }
    });
    let scaled: Vec<f64> = scaled.collect();
    for kind in proctor_laws::ALL {
        // Words: three of each choice are more than any has here.
        for word in 0..3 {
            let words = vec![word; kind.choices.len()];
            let known = kind.choices.iter().all(|choice| word < choice.words.len());
            if known
                && kind.constants.len() == values.len()
                && (kind.read)(&values, &words, &[]) == *law
            {
                return (kind.read)(&scaled, &words, &[]);
            }
        }
    }
    unreachable!("a law without a name: {law:?}")
}
