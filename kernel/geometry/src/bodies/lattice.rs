//! The lattice of sub-cells of the mesh, and the particles that a shape takes from it.

use super::error::{FillError, mesh_range};
use super::{EVERYWHERE, FilledBody, FilledSlice, HalfLength, MemoryRoom};
use crate::mesh::Mesh;
use crate::shape::{Dimension, Vector};
use std::iter::repeat_n;
use std::ops::Range;

/// Sub-cells of the mesh: each cell cut into `ppc` equal parts per axis. Coordinates are relative to the
/// origin of the mesh \[m\]; sub-cell `k` of an axis has its centre at (k + 1/2) h / ppc.
pub(super) struct Lattice {
    /// Number of axes that count, 2 or 3.
    pub axes: usize,
    /// Upper corner of the mesh \[m\].
    pub extent: Vector,
    /// Per axis, the distance below which two coordinates are the same \[m\]: 1e-9 h, but no less than four
    /// ulp of the absolute coordinates (0.5 for the origin, 0.5 for the coordinate, the rest for how they
    /// were computed). At 1e6 m an ulp is 1.2e-10 m.
    pub tolerance: Vector,
    cell: Vector,
    ppc: [i64; 3],
    range: [[f64; 2]; 3],
    /// Number of sub-cells per axis.
    sub_cells: [i64; 3],
    room: MemoryRoom,
    /// First coordinates of the particles that are filled, the end excluded \[m\].
    wanted: [f64; 2],
    /// True where the first axis is a radius that begins at zero.
    pub begins_on_axis: bool,
}

/// Sub-cells along the last axis, in a row given by the indices of the other axes.
struct Row {
    outer: [i64; 2],
    run: Range<i64>,
}

impl Lattice {
    /// # Errors
    ///
    /// A cell or a number of particles per cell that is not positive.
    pub fn new(
        mesh: &Mesh,
        ppc: [usize; 3],
        dimension: Dimension,
        room: MemoryRoom,
    ) -> Result<Self, FillError> {
        let range = mesh_range(mesh);
        let axes = dimension.axes();
        for axis in 0..axes {
            FillError::require_positive("particle count per cell", None, ppc[axis] as f64)?;
            FillError::require_positive("edge of a cell", None, mesh.cell[axis])?;
            FillError::require_finite("lower corner of the mesh", None, range[axis][0])?;
            FillError::require_finite("upper corner of the mesh", None, range[axis][1])?;
            // Integers up to 2^53 are exact as floats, and centres count in halves.
            let sub_cells = mesh.cells[axis] as f64 * ppc[axis] as f64;
            if sub_cells > 1e15 {
                return Err(FillError::TooMany {
                    particles: sub_cells,
                });
            }
        }
        Ok(Self {
            axes,
            extent: std::array::from_fn(|axis| mesh.cells[axis] as f64 * mesh.cell[axis]),
            tolerance: std::array::from_fn(|axis| {
                let far = range[axis][0].abs().max(range[axis][1].abs());
                (1e-9 * mesh.cell[axis]).max(4.0 * f64::EPSILON * far)
            }),
            cell: mesh.cell,
            ppc: ppc.map(|n| n as i64),
            range,
            sub_cells: std::array::from_fn(|axis| {
                if axis < axes {
                    (mesh.cells[axis] * ppc[axis]) as i64
                } else {
                    1
                }
            }),
            room,
            wanted: EVERYWHERE,
            begins_on_axis: mesh.axisymmetric && mesh.origin[0] == 0.0,
        })
    }

    /// The same lattice for the particles whose first coordinate lies in a range, its end excluded \[m\].
    pub fn within(mut self, range: [f64; 2]) -> Self {
        self.wanted = range;
        self
    }

    /// True for a first coordinate whose particles are filled.
    pub fn wants(&self, x: f64) -> bool {
        self.wanted[0] <= x && x < self.wanted[1]
    }

    /// Checks that there is room for so many particles, and for `more` bytes beside them.
    ///
    /// # Errors
    /// [`FillError::Memory`].
    pub fn require_room(&self, particles: f64, more: f64) -> Result<(), FillError> {
        let needed = particles * self.room.per_particle + more;
        // Five digits: an estimate has no more, and a count of particles is seldom longer.
        let what = if particles < 1e5 {
            format!("{particles:.0} particles")
        } else {
            format!("{particles:.4e} particles")
        };
        self.room
            .memory
            .require(what, needed)
            .map_err(FillError::Memory)
    }

    /// Relative coordinates of a point of the scene \[m\]; the third is zero in two dimensions.
    pub fn relative(&self, point: Vector) -> Vector {
        std::array::from_fn(|axis| {
            if axis < self.axes {
                point[axis] - self.range[axis][0]
            } else {
                0.0
            }
        })
    }

    /// Edge h / ppc of a sub-cell \[m\].
    pub fn spacing(&self, axis: usize) -> f64 {
        self.cell[axis] / self.ppc[axis] as f64
    }

    /// Lower line k h / ppc of a sub-cell \[m\]: two roundings, however large `k` is.
    pub fn line(&self, axis: usize, k: i64) -> f64 {
        k as f64 * self.cell[axis] / self.ppc[axis] as f64
    }

    /// Centre (k + 1/2) h / ppc of a sub-cell \[m\], formed from integers: two roundings.
    pub fn centre(&self, axis: usize, k: i64) -> f64 {
        (2 * k + 1) as f64 * self.cell[axis] / (2 * self.ppc[axis]) as f64
    }

    /// The largest tolerance of the axes \[m\], for distances that mix axes.
    pub fn distance_tolerance(&self) -> f64 {
        self.tolerance[..self.axes]
            .iter()
            .copied()
            .fold(0.0, f64::max)
    }

    /// The smallest spacing of the axes \[m\].
    pub fn smallest_spacing(&self) -> f64 {
        (0..self.axes)
            .map(|axis| self.spacing(axis))
            .fold(f64::INFINITY, f64::min)
    }

    /// Axis along which particles follow each other.
    pub fn last(&self) -> usize {
        self.axes - 1
    }

    /// Sub-cells whose centre c has `lower` < c < `upper`. Looks no further than two sub-cells beyond the
    /// mesh, where [`Self::reach`] lets no body go.
    pub fn between(&self, axis: usize, lower: f64, upper: f64) -> Range<i64> {
        let d = self.spacing(axis);
        let lower = lower.max(-2.0 * d);
        let upper = upper.min(self.extent[axis] + 2.0 * d);
        // The quotient is good to an index or so; the comparison with the centre itself decides.
        let mut first = (lower / d - 0.5).floor() as i64 - 1;
        while self.centre(axis, first) <= lower {
            first += 1;
        }
        let mut end = (upper / d - 0.5).ceil() as i64 + 2;
        while end > first && self.centre(axis, end - 1) >= upper {
            end -= 1;
        }
        first..end.max(first)
    }

    /// Sub-cells with their centre strictly within the bounds of a body, per axis.
    ///
    /// # Errors
    ///
    /// Bounds that are not finite, or that leave the mesh by more than one sub-cell. This also keeps the work
    /// below the size of the mesh, whatever the size of the body.
    pub fn reach(&self, bounds: &[[f64; 2]; 3]) -> Result<[Range<i64>; 3], FillError> {
        for axis in 0..self.axes {
            let [lower, upper] = bounds[axis];
            FillError::require_finite("lower end of the body", None, lower)?;
            FillError::require_finite("upper end of the body", None, upper)?;
            let d = self.spacing(axis);
            if lower < -d || upper > self.extent[axis] + d {
                let origin = self.range[axis][0];
                return Err(FillError::BodyOutside {
                    axis,
                    body: [origin + lower, origin + upper],
                    mesh: self.range[axis],
                });
            }
        }
        Ok(std::array::from_fn(|axis| {
            if axis < self.axes {
                self.between(axis, bounds[axis][0], bounds[axis][1])
            } else {
                0..1
            }
        }))
    }

    /// Particles of a shape: `rows` appends the runs of sub-cells inside the shape along the last axis, in
    /// ascending order, for the row with the indices it is given (the second means nothing in two
    /// dimensions). `volume` is the exact volume \[m³\].
    ///
    /// # Errors
    ///
    /// As [`super::fill`].
    pub fn sweep(
        &self,
        bounds: &[[f64; 2]; 3],
        volume: f64,
        mut rows: impl FnMut([i64; 2], &mut Vec<Range<i64>>),
    ) -> Result<FilledBody, FillError> {
        FillError::require_positive("volume of the body", None, volume)?;
        let reach = self.reach(bounds)?;
        let middle = if self.axes == 3 {
            reach[1].clone()
        } else {
            0..1
        };
        // What the body would hold if it were all whole sub-cells, and its rows, of which each is visited.
        let mut estimate = volume;
        for axis in 0..self.axes {
            estimate /= self.spacing(axis);
        }
        let length = |range: &Range<i64>| (range.end - range.start) as f64;
        let rows_visited = length(&reach[0]) * length(&middle);
        let expected = if self.wanted == EVERYWHERE {
            estimate
        } else {
            // Known once the slices are counted.
            0.0
        };
        self.require_room(expected, rows_visited * size_of::<Row>() as f64)?;
        let mut taken = Vec::new();
        let mut runs = Vec::new();
        let mut slices = Vec::new();
        let (mut count, mut kept) = (0, 0);
        for i in reach[0].clone() {
            let (x, before) = (self.centre(0, i), count);
            let wanted = self.wants(x);
            for j in middle.clone() {
                rows([i, j], &mut runs);
                for run in runs.drain(..).filter(|run| !run.is_empty()) {
                    let row = Row { outer: [i, j], run };
                    self.require_inside(&row, count)?;
                    count += (row.run.end - row.run.start) as usize;
                    if wanted {
                        taken.push(row);
                    }
                }
            }
            if count > before {
                let own = count - before;
                slices.push(FilledSlice {
                    x,
                    count: own as u64,
                });
                kept += if wanted { own } else { 0 };
            }
        }
        if count == 0 {
            return Err(FillError::Empty {
                size: bounds.map(|[lower, upper]| upper - lower),
                spacing: [0, 1, 2].map(|axis| self.spacing(axis)),
                axes: self.axes,
            });
        }
        let mut particles = self.allocate(
            kept as f64,
            (volume, count as f64),
            [0, 1, 2].map(|axis| self.spacing(axis)),
        )?;
        particles.slices = slices;
        for row in &taken {
            let run = row.run.clone();
            let length = (run.end - run.start) as usize;
            for axis in 0..self.last() {
                particles.x[axis].extend(repeat_n(self.centre(axis, row.outer[axis]), length));
            }
            particles.x[self.last()].extend(run.map(|k| self.centre(self.last(), k)));
        }
        Ok(particles)
    }

    /// Fails for the first particle of the row that is outside the mesh; `before` particles precede the row.
    fn require_inside(&self, row: &Row, before: usize) -> Result<(), FillError> {
        let inside = |axis: usize, k: i64| 0 <= k && k < self.sub_cells[axis];
        let last = self.last();
        let limit = self.sub_cells[last];
        let outside = if (0..last).any(|axis| !inside(axis, row.outer[axis])) || row.run.start < 0 {
            row.run.start
        } else if row.run.end > limit {
            limit.max(row.run.start)
        } else {
            return Ok(());
        };
        let mut x = [0.0; 3];
        for axis in 0..last {
            x[axis] = self.centre(axis, row.outer[axis]);
        }
        x[last] = self.centre(last, outside);
        Err(self.outside(before + (outside - row.run.start) as usize, x))
    }

    /// The error of a particle at relative position `x` outside the mesh.
    pub fn outside(&self, index: usize, x: Vector) -> FillError {
        FillError::ParticleOutside {
            index,
            position: std::array::from_fn(|axis| self.range[axis][0] + x[axis]),
            mesh: self.range,
            axes: self.axes,
        }
    }

    /// Checks that a body of so many slices with so many particles each can be counted, and that there is room for all of it where
    /// all is filled.
    ///
    /// # Errors
    /// [`FillError::TooMany`], [`FillError::Memory`].
    pub fn require_countable(&self, slices: f64, in_slice: f64) -> Result<(), FillError> {
        let particles = slices * in_slice;
        // Above 2^53 a float is no exact count, and no memory holds it.
        if particles > 9e15 {
            return Err(FillError::TooMany { particles });
        }
        if self.wanted == EVERYWHERE {
            return self.require_room(particles, 0.0);
        }
        self.require_room(0.0, slices * size_of::<FilledSlice>() as f64)
    }

    /// `count` particles of a body of which the whole has a volume and a number of particles, of equal volumes and of domains with
    /// the edges `spacing`, with room for the coordinates of the axes that count and with the others in place.
    ///
    /// # Errors
    ///
    /// [`FillError::TooMany`].
    pub fn allocate(
        &self,
        count: f64,
        (volume, whole): (f64, f64),
        spacing: Vector,
    ) -> Result<FilledBody, FillError> {
        let too_many = || FillError::TooMany { particles: count };
        // Above 2^53 a float is no exact count, and no memory holds it.
        if count > 9e15 {
            return Err(too_many());
        }
        self.require_room(count, 0.0)?;
        let n = count as usize;
        let room = || {
            let mut values = Vec::new();
            values.try_reserve_exact(n).map_err(|_| too_many())?;
            Ok(values)
        };
        let mut x = [room()?, room()?, room()?];
        for values in &mut x[self.axes..] {
            values.resize(n, 0.0);
        }
        let mut volumes: Vec<f64> = room()?;
        volumes.resize(n, volume / whole);
        let half = |axis| {
            if axis < self.axes {
                0.5 * spacing[axis]
            } else {
                0.5
            }
        };
        Ok(FilledBody {
            x,
            volume: volumes,
            half_length: HalfLength::Uniform([half(0), half(1), half(2)]),
            exact_volume: volume,
            slices: vec![],
        })
    }
}
