//! Choices of the method: weighting, stress scheme, transfer, time step, damping.

/// Choice of the time step. The critical step of the scheme is the ceiling in every case, unless `allow_unstable` lifts it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// A safe fraction of the scheme's own stability bound, chosen anew in each step.
    Automatic,
    /// `multiplier` times min(h) / max(c + |v|), the manual's `critical_time_step_multiplier`.
    Multiplier {
        /// Factor on min(h) / max(c + |v|), dimensionless, positive.
        multiplier: f64,
        /// Run even where the scheme's own bound says unstable.
        allow_unstable: bool,
    },
    /// A constant step.
    Fixed {
        /// Time step \[s\].
        dt: f64,
        /// Run even where the scheme's own bound says unstable.
        allow_unstable: bool,
    },
}

/// Weighting function `S_Ip` (technical manual, section 2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weighting {
    /// Linear hat `N_I` at the particle position (classical MPM).
    Linear,
    /// GIMP with a particle domain that keeps its initial size (uGIMP; what the manual's peer calls GIMP).
    UniformGimp,
    /// GIMP with a particle domain that follows the deformation (cpGIMP).
    ContiguousGimp(DomainUpdate),
    /// Quadratic B-spline.
    QuadraticBSpline,
}

/// Update of the half-lengths `l_p` of a cpGIMP particle domain from the deformation gradient F.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DomainUpdate {
    /// `l_p = l_p0 (det F)^(1/d)`.
    Determinant,
    /// `l_p,i = l_p0,i U_ii`, with U the right stretch tensor.
    Stretch,
    /// `l_p,i = l_p0,i V_ii`, with V the left stretch tensor.
    LeftStretch,
}

/// Stress scheme: the place of the stress update in the cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StressScheme {
    /// Update stress first.
    Usf,
    /// Update stress last.
    Usl,
    /// Modified update stress last.
    Musl,
}

/// Transfer of velocity between particles and nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transfer {
    /// Kind of transfer.
    pub kind: TransferKind,
    /// Share of the interpolated nodal velocity in the particle velocity, 0 (FLIP) to 1 (PIC).
    pub pic_fraction: f64,
}

/// Kind of velocity transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransferKind {
    /// Particle velocity alone is carried to the nodes.
    Flip,
    /// Affine particle-in-cell (Jiang et al. 2015): carries `B_p D_p^-1 (x_I - x_p)` as well.
    Apic,
    /// Taylor particle-in-cell: carries the velocity gradient.
    Tpic,
    /// Moving least squares (Hu et al. 2018): carries the affine velocity of APIC, which is the velocity gradient too; a node
    /// takes the force -V sigma `D_p^-1` (x_I - x_p) `S_Ip` in the place of -V sigma grad `S_Ip`.
    Mls,
}

/// Averaging of the volumetric part of strain and stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VolumetricStrain {
    /// Taken at the particle, as all other parts.
    Particle,
    /// Taken as the mean over the cells in which the particle domain lies: selective reduced integration, the B-bar of Hughes
    /// (1980) with the mean dilatation of Nagtegaal, Parks and Rice (1974). A cell then has one volumetric strain, whatever the
    /// number of its particles, and nearly incompressible material does not lock.
    CellAverage,
}

/// Numerical damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// None.
    None,
    /// Local damping, `f = -alpha |f_unb| sign(v)` per component (technical manual, section 8).
    Local {
        /// Factor, 0 to 1.
        alpha: f64,
    },
    /// Kinetic damping (dynamic relaxation): velocities are set to zero at each peak of kinetic energy.
    Kinetic,
    /// `f_I = -alpha m_I sqrt(E / (rho h²)) v_I` (Liang et al. 2024, eq. 20).
    Viscous {
        /// Factor, dimensionless, not negative.
        alpha: f64,
    },
}

impl Damping {
    /// True where velocities lose energy in each step, so that a body comes to rest: local or viscous damping with a factor.
    #[must_use]
    pub fn slows(&self) -> bool {
        matches!(*self, Self::Local { alpha } | Self::Viscous { alpha } if alpha != 0.0)
    }
}
