//! A particle where it is stored.

use super::{Particle, UNDEFORMED};
use crate::layout::Layout;
use crate::particles::Variables;

/// One particle of a set, of which a law is asked.
#[derive(Clone, Copy, Debug)]
pub struct Stored<'a> {
    /// Columns of the set.
    pub columns: &'a [Vec<f64>],
    /// Where the columns are.
    pub layout: &'a Layout,
    /// Initial density of its material \[kg/m³\].
    pub density: f64,
    /// Its place in the set.
    pub p: usize,
}

impl Stored<'_> {
    /// Asks of the particle: what is not asked for need not be read where the question is known to the compiler.
    #[inline(always)]
    pub fn ask<T>(&self, question: impl FnOnce(&Particle<'_>) -> T) -> T {
        let &Self {
            columns,
            layout,
            density,
            p,
        } = self;
        let axes = layout.axes;
        let s = |i: usize| columns[Layout::stress(axes) + i][p];
        let mut deformation = UNDEFORMED;
        if let Some(first) = layout.deformation {
            for a in 0..axes {
                for b in 0..axes {
                    deformation[a][b] = columns[first + a * axes + b][p];
                }
            }
        }
        let mut variables = Variables::new();
        if !layout.law.is_empty() {
            variables.extend(columns[layout.variables..].iter().map(|column| column[p]));
        }
        question(&Particle {
            mass: columns[Layout::MASS][p],
            volume: columns[Layout::VOLUME][p],
            density,
            stress: if axes == 2 {
                [s(0), s(1), s(2), 0.0, 0.0, s(3)]
            } else {
                [s(0), s(1), s(2), s(3), s(4), s(5)]
            },
            deformation,
            variables: &variables,
        })
    }
}
