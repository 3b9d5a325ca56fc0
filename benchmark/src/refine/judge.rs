//! The judgement of runs on several meshes: a value with its bar for each quantity, and the gates of the scene.

use super::quantity::{Quantity, QuantityTime, nearest};
use super::run::MeshRun;
use proctor_verification::refine::field::{Field, compared};
use proctor_verification::refine::series::{Gate, Histories};
use proctor_verification::refine::{Estimate, Rule, Verdict};

/// Changes below this part of the largest of their unit are zero by symmetry.
const BY_SYMMETRY: f64 = 1e-6;
/// The same of an extent, which stands at a wall.
const STANDS: f64 = 1e-3;
/// Columns that differ by less than this part of their size are one.
const SAME_COLUMN: f64 = 1e-9;

/// A scene on its meshes, judged.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneBars {
    /// Name of the scene.
    pub scene: String,
    /// The finest three cell sizes, coarse to fine \[m\].
    pub cells: [f64; 3],
    /// Output times that are judged \[s\].
    pub times: Vec<f64>,
    /// Kinetic and strain energy over time.
    pub gates: [Gate; 2],
    /// The quantities.
    pub judged: Vec<QuantityBar>,
    /// Fields of the particles that the user named.
    pub fields: Vec<FieldBar>,
}

/// A field of the particles, compared between meshes.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldBar {
    /// The field.
    pub field: Field,
    /// Its root mean square on the finest mesh, in its unit.
    pub size: f64,
    /// The bar of the root mean square of its error.
    pub estimate: Estimate,
    /// True where the bar is claimed.
    pub claimed: bool,
}

/// A quantity, judged.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityBar {
    /// The quantity.
    pub quantity: Quantity,
    /// Values on all meshes, coarse to fine, in the unit of the quantity.
    pub values: Vec<f64>,
    /// Largest change of its column in time, on the finest mesh.
    pub change: f64,
    /// The bar around the value on the finest mesh.
    pub estimate: Estimate,
    /// Bars of its column at each output time.
    pub curve: Vec<Estimate>,
    /// Bar of the largest error of its column in time.
    pub norm: Estimate,
    /// Range over the places of the mesh, on the middle mesh.
    pub offset_range: Option<f64>,
    /// Difference of the coarser pair that the range is measured by.
    pub coarse_difference: f64,
    /// Values of the moved meshes.
    pub moved: Vec<f64>,
    /// The claim of the bar, or the reason why there is none.
    pub claim: Claim,
}

/// The claim of a bar, or the reason why there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// It holds the answer of an infinitely fine mesh in 95 of 100 cases.
    Bar,
    /// The values do not settle.
    DoesNotSettle,
    /// The energies of the scene do not.
    SceneDoesNotSettle,
    /// The place of the mesh changes it by more than the mesh does.
    Place,
}

impl QuantityBar {
    /// Value on the finest mesh.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.values.last().copied().unwrap_or(f64::NAN)
    }

    /// Range over the places of the mesh over the difference of the coarser pair.
    #[must_use]
    pub fn place_ratio(&self) -> Option<f64> {
        Some(self.offset_range? / self.coarse_difference).filter(|ratio| ratio.is_finite())
    }

    /// The extrapolated value, where the order allows one.
    #[must_use]
    pub fn extrapolated(&self) -> Option<f64> {
        Some(self.value() + self.estimate.to_limit?)
    }

    /// Half-width of the bar, where it is claimed.
    #[must_use]
    pub fn bar(&self) -> Option<f64> {
        (self.claim == Claim::Bar).then_some(self.estimate.width)
    }

    /// Cell size \[m\] for an error of 1 % of the change, foretold from the finest cell size `h` \[m\].
    #[must_use]
    pub fn cell_for_one_percent(&self, h: f64) -> Option<f64> {
        self.bar()?;
        self.estimate.cell_for(h, 0.01 * self.change)
    }

    /// The verdict in words.
    #[must_use]
    pub fn verdict(&self) -> &'static str {
        match self.claim {
            Claim::Bar | Claim::DoesNotSettle => self.estimate.verdict.word(),
            Claim::SceneDoesNotSettle => "scene does not settle",
            Claim::Place => "depends on the place",
        }
    }
}

impl SceneBars {
    /// Adds fields of the particles, at the end of the judged time. Those that cannot be compared are left out.
    #[must_use]
    pub fn with_fields(mut self, fields: &[Field], runs: &[MeshRun]) -> Self {
        let [.., coarse, middle, fine] = runs else {
            return self;
        };
        let [Some(a), Some(b), Some(c)] = [coarse, middle, fine].map(|run| run.snapshot.as_ref())
        else {
            return self;
        };
        let settles = self.until().is_none();
        let bar = |field: &Field| {
            let (size, estimate) = compared(*field, self.cells, [a, b, c])?;
            Some(FieldBar {
                field: *field,
                size,
                estimate,
                claimed: settles && field.claims() && estimate.verdict.claims(),
            })
        };
        self.fields = fields.iter().filter_map(bar).collect();
        self
    }

    /// The time until which both energies settle \[s\]; `None` where they do to the end.
    #[must_use]
    pub fn until(&self) -> Option<f64> {
        let until = self.gates.iter().filter_map(|gate| gate.until);
        until.reduce(f64::min)
    }

    /// Judges runs on meshes, coarse to fine, and on moved copies of the middle one, up to a time \[s\]. Quantities that are
    /// zero by symmetry are dropped where the user did not name them.
    ///
    /// # Errors
    /// The reason why nothing can be judged, such as a mesh on which the run failed.
    pub fn new(
        scene: &str,
        runs: &[MeshRun],
        moved: &[MeshRun],
        named: &[Quantity],
        until: Option<f64>,
    ) -> Result<Self, String> {
        for run in runs {
            if let Some(fault) = &run.fault {
                return Err(format!(
                    "the run on cells of {} m failed: {fault}",
                    run.cell
                ));
            }
        }
        let [.., coarse, middle, fine] = runs else {
            return Err("fewer than three meshes were run".to_owned());
        };
        let three = [coarse, middle, fine];
        let end = until.unwrap_or(f64::INFINITY) * (1.0 + 1e-9);
        let reached = three.iter().map(|run| run.times.len()).min().unwrap_or(0);
        let count = fine.times[..reached].partition_point(|time| *time <= end);
        if count < 2 {
            return Err("the judged time holds no output".to_owned());
        }
        let view = View {
            three,
            moved,
            count,
        };
        let energies = ["energy_kinetic", "strain_energy"].map(|column| view.histories(column));
        let [Some(kinetic), Some(strain)] = energies else {
            return Err("the history holds no energies".to_owned());
        };
        let scale = kinetic.size().max(strain.size());
        let gates = [kinetic, strain].map(|energy| energy.gate(scale));
        let settles = gates.iter().all(Gate::passed);
        let quantities = if named.is_empty() {
            view.without_symmetric(&super::quantity::usual(fine))
        } else {
            named.to_vec()
        };
        let judged = quantities
            .into_iter()
            .filter_map(|q| view.judge(q, runs, settles));
        Ok(Self {
            scene: scene.to_owned(),
            cells: three.map(|run| run.cell),
            times: fine.times[..count].to_vec(),
            gates,
            judged: judged.collect(),
            fields: vec![],
        })
    }
}

/// The finest three meshes and the moved ones, up to a time.
struct View<'a> {
    three: [&'a MeshRun; 3],
    moved: &'a [MeshRun],
    count: usize,
}

impl View<'_> {
    /// A column on the three meshes.
    fn histories(&self, column: &str) -> Option<Histories<'_>> {
        let [a, b, c] = self.three.map(|run| run.columns.get(column));
        Some(Histories {
            cells: self.three.map(|run| run.cell),
            times: &self.three[2].times[..self.count],
            values: [a?, b?, c?].map(|values| &values[..self.count]),
        })
    }

    /// Largest less smallest value of a column on the finest mesh.
    fn change(&self, column: &str) -> f64 {
        let values = self.three[2].columns.get(column);
        let values = values.map_or(&[][..], |values| &values[..self.count]);
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        high - low
    }

    /// The quantities that say something: their column changes, measured by the others of their unit, their value is not
    /// zero on all meshes, and their column is not another one or its mirror image.
    fn without_symmetric(&self, quantities: &[Quantity]) -> Vec<Quantity> {
        let change = |quantity: &Quantity| self.change(&quantity.column);
        let largest = |unit: &str| {
            let same = quantities.iter().filter(|other| other.unit() == unit);
            same.map(change).fold(0.0, f64::max)
        };
        let mut kept: Vec<Quantity> = vec![];
        for quantity in quantities {
            let least = if quantity.is_extent() {
                STANDS
            } else {
                BY_SYMMETRY
            };
            let changes = change(quantity) > least * largest(quantity.unit());
            let counts = self
                .three
                .iter()
                .any(|run| quantity.value(run, self.count) != 0.0);
            let again = kept.iter().any(|other| {
                other.when == quantity.when && self.are_mirrored(&other.column, &quantity.column)
            });
            if changes && counts && !again {
                kept.push(quantity.clone());
            }
        }
        kept
    }

    /// True if two columns of the finest mesh have the same values or opposite ones.
    fn are_mirrored(&self, a: &str, b: &str) -> bool {
        let of = |column: &str| self.three[2].columns.get(column);
        let (Some(a), Some(b)) = (of(a), of(b)) else {
            return false;
        };
        let size = a.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
        [-1.0, 1.0].iter().any(|sign| {
            let mut pairs = a.iter().zip(b);
            pairs.all(|(a, b)| (a - sign * b).abs() <= SAME_COLUMN * size)
        })
    }

    /// A quantity with its bar; `None` where a value is not a number.
    fn judge(&self, quantity: Quantity, runs: &[MeshRun], settles: bool) -> Option<QuantityBar> {
        let histories = self.histories(&quantity.column)?;
        let values: Vec<f64> = runs
            .iter()
            .map(|run| quantity.value(run, self.count))
            .collect();
        let [.., a, b, c] = values[..] else {
            return None;
        };
        if [a, b, c].iter().any(|value| !value.is_finite()) {
            return None;
        }
        let curve = histories.by_time();
        let place = match quantity.when {
            QuantityTime::At(time) => nearest(histories.times, time),
            _ => self.count - 1,
        };
        let scale = values
            .iter()
            .fold(0.0, |size: f64, value| size.max(value.abs()));
        let estimate = if quantity.when.is_local() {
            curve[place]
        } else {
            Rule::VALUE.estimate(histories.cells, [a - b, b - c], scale)
        };
        // What a window extrapolates is a size without a sign: the value itself has one.
        let estimate = if quantity.when.is_local() {
            let own = Rule::VALUE.estimate(histories.cells, [a - b, b - c], scale);
            Estimate {
                to_limit: own.to_limit,
                ..estimate
            }
        } else {
            estimate
        };
        let (coarse_difference, range) = self.place(&quantity, histories, place);
        let depends = range
            .is_some_and(|range| estimate.verdict != Verdict::Same && range > coarse_difference);
        let claim = if !settles {
            Claim::SceneDoesNotSettle
        } else if depends {
            Claim::Place
        } else if estimate.verdict.claims() {
            Claim::Bar
        } else {
            Claim::DoesNotSettle
        };
        let moved = self.moved.iter().map(|run| quantity.value(run, self.count));
        Some(QuantityBar {
            change: self.change(&quantity.column),
            norm: histories.norm(),
            moved: moved.collect(),
            values,
            estimate,
            curve,
            offset_range: range,
            coarse_difference,
            claim,
            quantity,
        })
    }

    /// The difference of the coarser pair, and the range over the places of the middle mesh: within a tenth of the time
    /// around the value where it is read at a time, else of the value alone.
    fn place(
        &self,
        quantity: &Quantity,
        histories: Histories<'_>,
        place: usize,
    ) -> (f64, Option<f64>) {
        let [coarse, middle, _] = self.three;
        if !quantity.when.is_local() {
            let of = |run: &MeshRun| quantity.value(run, self.count);
            let all = self.moved.iter().chain([middle]).map(of);
            let range = range(all);
            let difference = (of(coarse) - of(middle)).abs();
            return (difference, (!self.moved.is_empty()).then_some(range));
        }
        let window = histories.window(place);
        let [of_coarse, of_middle, _] = histories.values;
        let differences = window.clone().map(|k| (of_coarse[k] - of_middle[k]).abs());
        let difference = differences.fold(0.0, f64::max);
        let at = |k: usize| {
            let moved = self.moved.iter();
            let moved = moved.filter_map(move |run| run.columns.get(&quantity.column)?.get(k));
            range(moved.copied().chain([of_middle[k]]))
        };
        let largest = window.map(at).fold(0.0, f64::max);
        (difference, (!self.moved.is_empty()).then_some(largest))
    }
}

/// Largest less smallest.
fn range(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    high - low
}
