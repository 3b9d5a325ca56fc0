//! Materials.

use proctor_kernel::laws::AnyLaw;

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier given in the scene.
    pub id: i64,
    /// Initial mass density \[kg/m³\].
    pub density: f64,
    /// Constitutive law.
    pub law: AnyLaw,
}
