//! Domains of particles that begin deformed.

use proctor_kernel::model::DomainUpdate;
use proctor_kernel::particles::ParticleSet;

/// Deforms the domain of one particle where domains follow the deformation; returns its largest half-length in
/// cells.
pub(super) fn start_domain(
    set: &mut ParticleSet,
    update: Option<DomainUpdate>,
    f: &nalgebra::Matrix3<f64>,
    p: usize,
) -> f64 {
    let axes = set.layout.axes;
    let (Some(update), Some(first), Some(initial)) = (
        update,
        set.layout.half_length,
        set.layout.initial_half_length,
    ) else {
        return 0.0;
    };
    let factor = match update {
        DomainUpdate::Determinant => {
            // In the plane the domain has no third side.
            let ratio = if axes == 2 {
                f.determinant() / f[(2, 2)]
            } else {
                f.determinant()
            };
            nalgebra::Vector3::repeat(libm::pow(ratio, 1.0 / axes as f64))
        }
        DomainUpdate::Stretch => root_diagonal(f.transpose() * f),
        DomainUpdate::LeftStretch => root_diagonal(f * f.transpose()),
    };
    let mut widest = 0.0_f64;
    for axis in 0..axes {
        let l = factor[axis] * set.columns[initial + axis][p];
        set.columns[first + axis][p] = l;
        widest = widest.max(l);
    }
    widest
}

/// Diagonal of the square root of a symmetric matrix.
fn root_diagonal(square: nalgebra::Matrix3<f64>) -> nalgebra::Vector3<f64> {
    let mut square = square.symmetric_eigen();
    square.eigenvalues.apply(|x| *x = x.sqrt());
    square.recompose().diagonal()
}
