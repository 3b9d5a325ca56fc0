//! Stress of a particle as a law updates it, and the names of its components.

use std::ops::{Index, IndexMut};

/// Component of a symmetric tensor, in the plane and in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Normal component along x.
    XX,
    /// Normal component along y.
    YY,
    /// Normal component along z.
    ZZ,
    /// Shear component of y and z, zero in the plane.
    YZ,
    /// Shear component of x and z, zero in the plane.
    XZ,
    /// Shear component of x and y, the only one in the plane.
    XY,
}

impl Component {
    /// All components, in the order of six numbers: xx, yy, zz, yz, xz, xy.
    pub const ALL: [Self; 6] = [Self::XX, Self::YY, Self::ZZ, Self::YZ, Self::XZ, Self::XY];

    /// Place in six numbers xx, yy, zz, yz, xz, xy, such as the stress of a particle.
    #[must_use]
    #[inline(always)]
    pub const fn place(self) -> usize {
        self as usize
    }

    /// True for xx, yy and zz.
    #[must_use]
    #[inline(always)]
    pub const fn is_normal(self) -> bool {
        self.place() < 3
    }

    /// Place in the memory of a stress: xy comes first of the shear components in the plane.
    #[inline(always)]
    const fn packed_place(self, axes: usize) -> usize {
        match (axes, self) {
            (2, Self::XY) => 3,
            (2, Self::YZ) => 4,
            (2, Self::XZ) => 5,
            _ => self.place(),
        }
    }
}

/// Cauchy stress of particles in lanes \[Pa\], in the plane (D = 2) or in space (D = 3).
///
/// `stress[Component::XY]` is the in-plane shear in both. The other two shear components are zero in the plane; a law may
/// write them, and no particle keeps them.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct Stress<L, const D: usize>([L; 6]);

impl<L, const D: usize> Stress<L, D> {
    /// A stress of its components in the order of memory: see [`Stress::packed`].
    #[must_use]
    #[inline(always)]
    pub const fn of_packed(packed: [L; 6]) -> Self {
        Self(packed)
    }

    /// The components in the order of memory, for the functions of [`tensor`](super::tensor): xx, yy, zz, yz, xz, xy in space; xx, yy, zz, xy
    /// and two without a use in the plane.
    #[must_use]
    #[inline(always)]
    pub const fn packed(&self) -> &[L; 6] {
        &self.0
    }

    /// The components in the order of memory, to be written: see [`Stress::packed`].
    #[must_use]
    #[inline(always)]
    pub const fn packed_mut(&mut self) -> &mut [L; 6] {
        &mut self.0
    }
}

impl<L, const D: usize> Index<Component> for Stress<L, D> {
    type Output = L;

    #[inline(always)]
    fn index(&self, component: Component) -> &L {
        &self.0[component.packed_place(D)]
    }
}

impl<L, const D: usize> IndexMut<Component> for Stress<L, D> {
    #[inline(always)]
    fn index_mut(&mut self, component: Component) -> &mut L {
        &mut self.0[component.packed_place(D)]
    }
}
