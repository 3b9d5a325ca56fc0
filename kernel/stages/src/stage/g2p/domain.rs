//! The particle domains of cpGIMP after a strain increment.

use crate::lanes::{Backend, Kernel, Lanes, SelectedLanes, functions, load, store};
use crate::laws::tensor::{Matrix, determinant, left_stretch_diagonal, stretch_diagonal};
use crate::layout::Layout;
use crate::model::DomainUpdate;
use std::ops::Range;

/// Mean stress over the size of the normal stresses that is none: at the end of a yield surface that bears no tension the sum of a
/// deviator is left, whose sign is round-off.
const NO_MEAN: f64 = 1e-10;

/// Half-lengths of the domains of some particles after their deformation gradient; the largest, in cells. Where the law parts
/// (`parts`), the domain of a particle without pressure does not grow: what opens there is a gap.
pub(super) fn follow(
    lanes: SelectedLanes,
    update: DomainUpdate,
    parts: bool,
    columns: &mut [&mut [f64]],
    layout: &Layout,
    range: Range<usize>,
) -> f64 {
    let (Some(deformation), Some(half_length), Some(initial)) = (
        layout.deformation,
        layout.half_length,
        layout.initial_half_length,
    ) else {
        return 0.0;
    };
    let first = DomainColumns {
        deformation,
        half_length,
        initial,
        stress: parts.then(|| Layout::stress(layout.axes)),
    };
    if layout.axes == 2 {
        lanes.run(DomainFollow::<2>(update, columns, first, range))
    } else {
        lanes.run(DomainFollow::<3>(update, columns, first, range))
    }
}

/// First columns.
struct DomainColumns {
    deformation: usize,
    half_length: usize,
    initial: usize,
    /// Column of the stress, where it matters.
    stress: Option<usize>,
}

struct DomainFollow<'a, 'b, const D: usize>(
    DomainUpdate,
    &'a mut [&'b mut [f64]],
    DomainColumns,
    Range<usize>,
);

impl<const D: usize> Kernel for DomainFollow<'_, '_, D> {
    type Output = f64;

    #[inline(always)]
    fn run<B: Backend>(self) -> f64 {
        let Self(update, columns, first, range) = self;
        let zero = B::Native::splat(0.0);
        let mut most = zero;
        let mut at = range.start;
        while at < range.end {
            let count = (range.end - at).min(B::Native::WIDTH);
            let mut f = [[zero; 3]; 3];
            for a in 0..D {
                for b in 0..D {
                    f[a][b] = load(columns[first.deformation + a * D + b], at, count);
                }
            }
            let factor = factors::<B::Native, D>(update, &f);
            for axis in 0..D {
                let mut l =
                    factor[axis] * load::<B::Native>(columns[first.initial + axis], at, count);
                if let Some(stress) = first.stress {
                    let mut sum: B::Native = load(columns[stress], at, count);
                    let mut size = sum.abs();
                    for normal in 1..3 {
                        let own: B::Native = load(columns[stress + normal], at, count);
                        sum = sum + own;
                        size = size + own.abs();
                    }
                    let before = load(columns[first.half_length + axis], at, count);
                    let pressed = sum.lt(B::Native::splat(-NO_MEAN) * size);
                    l = B::Native::select(pressed, l, l.min(before));
                }
                store(l, columns[first.half_length + axis], at, count);
                most = most.max(B::Native::select(B::Native::first(count), l, zero));
            }
            at += count;
        }
        most.largest()
    }
}

/// Factor of the half-lengths at the start.
#[inline(always)]
fn factors<L: Lanes, const D: usize>(update: DomainUpdate, f: &Matrix<L>) -> [L; 3] {
    match update {
        DomainUpdate::Stretch => stretch_diagonal::<L, D>(f),
        DomainUpdate::LeftStretch => left_stretch_diagonal::<L, D>(f),
        DomainUpdate::Determinant if D == 2 => [determinant::<L, D>(f).sqrt(); 3],
        DomainUpdate::Determinant => [functions::cbrt(determinant::<L, D>(f)); 3],
    }
}
