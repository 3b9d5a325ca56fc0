//! The constitutive laws that scene files name.
//!
//! Each is a type with the trait [`Law`] of the kernel, in the file of its name, and stands in
//! one list, [`ALL`]. A law of a program's own does the same outside of this package, and is handed to a scene.
//!
//! The trait and its types are handed on under the same names, so that a program names one package.
//!
//! ```
//! use proctor_laws::{Point, VonMises};
//!
//! // A material point of steel is stretched by 1 % and yields: sqrt(3 J_2) stays at the yield stress.
//! let steel = VonMises::new(2e11, 0.3, 2.5e8, 0.0).into();
//! let mut point = Point::new(&steel, 7850.0, [0.0; 6]);
//! for _ in 0..100 {
//!     point.strain(&[1e-4, 0.0, 0.0, 0.0, 0.0, 0.0], 1e-6)?;
//! }
//! let [x, y, ..] = point.stress();
//! assert!(((x - y) / 2.5e8 - 1.0).abs() < 1e-9);
//! # Ok::<(), proctor_laws::PointFault>(())
//! ```

#![deny(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

mod band;
mod check;
mod elasticity;
pub mod functions;
mod gap;
mod law_type;
mod marks;
pub mod plastic;
mod point;
mod pressurized_fluid;
pub mod principal;
mod state;
mod strength;
pub mod tensor;

pub use band::Band;
pub use cam_clay::PRECONSOLIDATION;
pub use check::{LawFault, LawProperty, check_law};
pub use drucker_prager::ConeMatch;
pub use elasticity::Isotropic;
pub use gap::{GAP, TensionApex};
pub use law_type::{Choice, LawType, Readable};
pub use linear_elastic::ObjectiveRate;
pub use mohr_coulomb::{Residual, Softening};
pub use plastic::{ReturnedStress, YieldSurface};
pub use point::{Point, PointFault};
pub use pressurized_fluid::PressurizedFluid;
pub use proctor_kernel::laws::{
    AnyLaw, BLOCK, Block, BlockStrain, Component, Constant, ConstantDefault, ConstantRange, Curve,
    Gradients, Increment, InvalidConstant, Law, Particle, Rows, StoredParticle, Strain,
    StrainRange, Stress, UNDEFORMED, UNPRESSED,
};
pub use state::EquationOfState;

// Of the macro `yielding_law`, for programs that do not name the kernel.
#[doc(hidden)]
pub use proctor_kernel as kernel;

use elasticity::{POISSON, YOUNG};

/// The part of an `impl Law` by which the law is compiled for all lanes in its own package alone, and not again in each program that makes
/// one: see [`Law::into_any`].
#[macro_export]
macro_rules! compiled_here {
    () => {
        #[inline(never)]
        fn into_any(self) -> $crate::AnyLaw {
            $crate::AnyLaw::new(self)
        }
    };
}

/// Laws, each in the file of that name, in the order in which messages list them.
macro_rules! list {
    ($($file:ident: $law:ident,)*) => {
        $(
            pub mod $file;
            pub use $file::$law;
        )*

        /// The laws that scene files name.
        pub static ALL: &[LawType] = &[$(LawType::of::<$law>()),*];
    };
}

list! {
    linear_elastic: LinearElastic,
    neo_hookean: NeoHookean,
    hencky: Hencky,
    von_mises: VonMises,
    tresca: Tresca,
    undrained_clay: UndrainedClay,
    mohr_coulomb: MohrCoulomb,
    drucker_prager: DruckerPrager,
    cam_clay: CamClay,
    granular_flow: GranularFlow,
    newtonian: Newtonian,
    bingham: Bingham,
}
