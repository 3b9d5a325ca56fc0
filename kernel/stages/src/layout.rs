//! The columns of a particle set.

/// An internal variable of a constitutive law, which each particle carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variable {
    /// Name, for frames, probes, plans and messages.
    pub name: &'static str,
    /// SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Number of components, each with a column: 1 for a scalar.
    pub components: usize,
    /// Value of every component at the start.
    pub initial: f64,
}

impl Variable {
    /// A scalar that begins at zero.
    #[must_use]
    pub const fn scalar(name: &'static str, unit: &'static str) -> Self {
        Self {
            name,
            unit,
            components: 1,
            initial: 0.0,
        }
    }

    /// Name of a component: that of the variable, with a number from 1 where there are several.
    #[must_use]
    #[inline]
    pub fn component(&self, i: usize) -> String {
        match self.components {
            1 => self.name.to_owned(),
            _ => format!("{} {}", self.name, i + 1),
        }
    }
}

/// Columns of a particle set, and their places. A column that the scene does not need does not exist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Number of axes, 2 or 3.
    pub axes: usize,
    /// True where the two axes are radius and height, so that particles are rings.
    pub axisymmetric: bool,
    /// First of the optional groups of columns, where present.
    pub displacement_origin: Option<usize>,
    /// Deformation gradient, row by row: 4 columns in 2D (F_zz = 1), 9 in 3D; 5 where it is axisymmetric, the hoop stretch last.
    pub deformation: Option<usize>,
    /// Affine velocity C, row by row: `axes`² columns.
    pub affine: Option<usize>,
    /// Half-lengths of the particle domain in cells: `axes` columns.
    pub half_length: Option<usize>,
    /// Initial half-lengths in cells, where the domain follows the deformation: `axes` columns.
    pub initial_half_length: Option<usize>,
    /// External force \[N\]: `axes` columns.
    pub force: Option<usize>,
    /// Pore water: `axes` columns of its velocity \[m/s\], then pore pressure \[Pa\].
    pub water: Option<usize>,
    /// Pore pressure that is held: 0 where it is, 1 where it changes, then the work that what holds it has done \[J\].
    pub held_pressure: Option<usize>,
    /// First column of the internal variables of the law.
    pub variables: usize,
    /// These variables; their components lie one after the other.
    pub law: &'static [Variable],
    /// Number of columns.
    pub columns: usize,
}

/// Choice of optional columns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Optional {
    /// Positions at the start, for displacements.
    pub displacement_origin: bool,
    /// Deformation gradient.
    pub deformation: bool,
    /// Affine velocity.
    pub affine: bool,
    /// Half-lengths per particle.
    pub half_length: bool,
    /// Initial half-lengths per particle.
    pub initial_half_length: bool,
    /// External force per particle.
    pub force: bool,
    /// The hoop stretch beside the deformation gradient: the scene is axisymmetric.
    pub axisymmetric: bool,
    /// Velocity of the pore water and pore pressure.
    pub water: bool,
    /// Some pore pressures are held.
    pub held_pressure: bool,
}

impl Layout {
    /// Column of the mass \[kg\].
    pub const MASS: usize = 0;
    /// Column of the volume \[m³\].
    pub const VOLUME: usize = 1;
    /// First column of the position relative to the mesh origin \[m\].
    pub const POSITION: usize = 2;

    /// Lays out the columns.
    #[must_use]
    pub fn new(axes: usize, wanted: Optional, law: &'static [Variable]) -> Self {
        let mut next = Self::POSITION + 2 * axes + Self::stress_components_of(axes);
        let mut group = |want: bool, width: usize| {
            want.then(|| {
                let first = next;
                next += width;
                first
            })
        };
        let displacement_origin = group(wanted.displacement_origin, axes);
        let deformation = group(
            wanted.deformation,
            axes * axes + usize::from(wanted.axisymmetric),
        );
        let affine = group(wanted.affine, axes * axes);
        let half_length = group(wanted.half_length, axes);
        let initial_half_length = group(wanted.initial_half_length, axes);
        let force = group(wanted.force, axes);
        let water = group(wanted.water, axes + 1);
        let held_pressure = group(wanted.held_pressure, 2);
        let variables = next;
        next += law
            .iter()
            .map(|variable| variable.components)
            .sum::<usize>();
        Self {
            axes,
            axisymmetric: wanted.axisymmetric,
            displacement_origin,
            deformation,
            affine,
            half_length,
            initial_half_length,
            force,
            water,
            held_pressure,
            variables,
            law,
            columns: next,
        }
    }

    /// Column of the hoop stretch F_tt, where there is one.
    #[inline(always)]
    #[must_use]
    pub fn hoop_stretch(&self) -> Option<usize> {
        let first = self.deformation.filter(|_| self.axisymmetric)?;
        Some(first + self.axes * self.axes)
    }

    /// Column of the pore pressure \[Pa\], where there is water.
    #[inline(always)]
    #[must_use]
    pub fn pore_pressure(&self) -> Option<usize> {
        Some(self.water? + self.axes)
    }

    /// Number of stress components in two or three dimensions.
    #[must_use]
    pub(crate) const fn stress_components_of(axes: usize) -> usize {
        if axes == 2 { 4 } else { 6 }
    }

    /// First column of the velocity \[m/s\].
    #[inline(always)]
    #[must_use]
    pub const fn velocity(axes: usize) -> usize {
        Self::POSITION + axes
    }

    /// First column of the Cauchy stress \[Pa\]: xx, yy, zz, xy in 2D; xx, yy, zz, yz, xz, xy in 3D.
    #[inline(always)]
    #[must_use]
    pub const fn stress(axes: usize) -> usize {
        Self::POSITION + 2 * axes
    }

    /// Number of stress components.
    #[must_use]
    #[inline]
    pub fn stress_components(&self) -> usize {
        Self::stress_components_of(self.axes)
    }

    /// The components of the internal variables: variable, component and column of each.
    #[inline]
    pub fn components(&self) -> impl Iterator<Item = (&'static Variable, usize, usize)> + use<> {
        let all =
            |variable: &'static Variable| (0..variable.components).map(move |i| (variable, i));
        let columns = self.variables..;
        (self.law.iter().flat_map(all))
            .zip(columns)
            .map(|((variable, i), column)| (variable, i, column))
    }

    /// The names of all columns, in their order; those of internal variables are their own.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let axes = self.axes;
        let mut names = vec!["mass".to_owned(), "volume".to_owned()];
        let mut add = |name: &str, width: usize| {
            names.extend((1..=width).map(|i| format!("{name} {i}")));
        };
        add("position", axes);
        add("velocity", axes);
        add("stress", self.stress_components());
        for (group, name, width) in [
            (self.displacement_origin, "start", axes),
            (self.deformation, "deformation gradient", axes * axes),
            (self.affine, "affine velocity", axes * axes),
            (self.half_length, "half-length", axes),
            (self.initial_half_length, "initial half-length", axes),
            (self.force, "force", axes),
            (self.water, "water velocity", axes),
            (self.water, "pore pressure", 1),
            (self.held_pressure, "pore pressure that changes", 1),
            (self.held_pressure, "work of held pore pressure", 1),
        ] {
            if group.is_some() {
                add(name, width);
            }
        }
        names.extend(
            self.components()
                .map(|(variable, i, _)| variable.component(i)),
        );
        names
    }

    /// Bytes of state per particle, identifier included.
    #[must_use]
    #[inline]
    pub fn bytes_per_particle(&self) -> usize {
        8 * (self.columns + 1)
    }
}
