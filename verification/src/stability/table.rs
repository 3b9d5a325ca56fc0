//! The table by which the kernel chooses its steps, made of the map.

use std::fmt::{self, Write as _};

use proctor_scene::{StressScheme, TransferKind, Weighting};

use super::block::Choice;
use super::map::{Entry, LEAST_SQUARES, PARTICLES, SCHEMES, TRANSFERS, WEIGHTINGS};
use crate::settings::Method;
use proctor_scene::plan::AUTOMATIC_SHARE;

/// A table entry may be this much smaller than what is found, relative.
pub const TOO_CAREFUL: f64 = 0.15;
/// Digits behind the point that the table keeps.
const DIGITS: f64 = 1e3;

/// A number of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Method; of the two GIMPs uGIMP, whose domains are those of cpGIMP at the start.
    pub method: Method,
    /// Particles per cell and axis; `None` where the kernel takes one number for all.
    pub particles_per_cell: Option<usize>,
    /// Smallest predicted Courant number of bodies that are more than a cell thick along all axes.
    pub thick: f64,
    /// Smallest Courant number at which any body becomes unstable: the prediction for those that are one particle thick and
    /// for single particles, and what was measured with particles on nodes.
    pub any: f64,
    /// Number that the kernel should take.
    pub number: f64,
    /// Number that it takes.
    pub held: f64,
}

/// Quality of the number that is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worth {
    /// The right number.
    Right,
    /// A body can be unstable with it.
    Unstable,
    /// More than [`TOO_CAREFUL`] below what is safe.
    TooCareful,
}

impl Number {
    /// The number of a method over the entries that belong to it. Where the kernel knows no safe step it is one number for
    /// all such methods, `filled`, with which bodies that fill their cells are stable.
    ///
    /// It is the largest with which bodies that are more than a cell thick are stable, and every body with the share of
    /// it that an automatic step takes.
    #[must_use]
    fn of(
        method: Method,
        particles_per_cell: Option<usize>,
        entries: &[&Entry],
        filled: f64,
    ) -> Self {
        let smallest = |of: &dyn Fn(&Entry) -> f64| {
            entries
                .iter()
                .map(|entry| of(entry))
                .fold(f64::INFINITY, f64::min)
        };
        let (thick, any) = if method.has_safe_step() {
            (smallest(&Entry::thick), smallest(&Entry::safe))
        } else {
            (filled, f64::INFINITY)
        };
        let most = particles_per_cell.unwrap_or(PARTICLES[0]);
        Self {
            method,
            particles_per_cell,
            thick,
            any,
            number: number(thick, any),
            held: method.stability_number(most),
        }
    }

    /// Quality of the number that is held, by a measure taken anew.
    #[must_use]
    pub fn worth(&self) -> Worth {
        if self.held > largest(self.thick, self.any) {
            Worth::Unstable
        } else if self.held < (1.0 - TOO_CAREFUL) * self.number {
            Worth::TooCareful
        } else {
            Worth::Right
        }
    }
}

impl Worth {
    /// Its words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Unstable => "unstable",
            Self::TooCareful => "too careful",
        }
    }
}

fn largest(thick: f64, any: f64) -> f64 {
    thick.min(any / AUTOMATIC_SHARE)
}

/// Rounded down.
fn number(thick: f64, any: f64) -> f64 {
    (largest(thick, any) * DIGITS).floor() / DIGITS
}

/// Weighting functions that have a line: cpGIMP shares that of uGIMP.
fn weightings() -> impl Iterator<Item = Weighting> {
    WEIGHTINGS
        .into_iter()
        .filter(|weighting| !matches!(weighting, Weighting::ContiguousGimp(_)))
}

/// True if the kernel has a number for each size of particles.
fn by_size(weighting: Weighting) -> bool {
    weighting == Weighting::UniformGimp
}

/// The choices of a full map that the table is made of.
#[must_use]
pub fn needs(choice: &Choice) -> bool {
    !matches!(choice.method.weighting, Weighting::ContiguousGimp(_))
}

/// The numbers of a map.
#[must_use]
pub fn numbers(map: &[Entry]) -> Vec<Number> {
    let warned = map
        .iter()
        .filter(|entry| !entry.choice.method.has_safe_step());
    let full = warned.flat_map(|entry| entry.sites.iter().filter(|site| !site.word.is_empty()));
    let filled = { full }
        .filter_map(|site| site.predicted)
        .fold(f64::INFINITY, f64::min);
    let mut all = vec![];
    let every = weightings().flat_map(|weighting| TRANSFERS.map(|transfer| (weighting, transfer)));
    let mut pairs: Vec<_> = every.collect();
    pairs.push(LEAST_SQUARES);
    for of_weighting in pairs.chunk_by(|one, other| one.0 == other.0) {
        for scheme in SCHEMES {
            for &(weighting, transfer) in of_weighting {
                let method = Method {
                    weighting,
                    scheme,
                    transfer,
                };
                let of = |particles: Option<usize>| -> Vec<&Entry> {
                    let belongs = |entry: &&Entry| {
                        entry.choice.method == method
                            && particles.is_none_or(|n| n == entry.choice.particles_per_cell)
                    };
                    map.iter().filter(belongs).collect()
                };
                let sizes: Vec<Option<usize>> = if by_size(weighting) {
                    PARTICLES.iter().map(|&n| Some(n)).collect()
                } else {
                    vec![None]
                };
                for size in sizes {
                    let entries = of(size);
                    if !entries.is_empty() {
                        all.push(Number::of(method, size, &entries, filled));
                    }
                }
            }
        }
    }
    all
}

/// The numbers as the source of the kernel's table, `kernel/src/plan/stability/table.rs`.
#[must_use]
pub fn source(numbers: &[Number], date: &str) -> String {
    let mut text = format!(
        "//! Largest stable C = (c + |v|) dt / min(h), as `proctor stability --table` printed it on {date}. Not edited by hand.\n\n"
    );
    let cell = |weighting: Weighting, scheme: StressScheme, transfer: TransferKind, particles| {
        let found = numbers.iter().find(|n| {
            n.method
                == Method {
                    weighting,
                    scheme,
                    transfer,
                }
                && n.particles_per_cell == particles
        });
        found.map_or(f64::NAN, |n| n.number)
    };
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "/// GIMP by scheme (USL, USF, MUSL), transfer (FLIP, APIC, TPIC) and half-length of a particle domain in cells\n\
         /// (1/2, 1/4, 1/8: one, two, four particles per cell and axis).\n\
         pub(super) const GIMP: [[[f64; 3]; 3]; 3] = ["
    );
    for scheme in SCHEMES {
        let _ = writeln!(text, "    [");
        for transfer in TRANSFERS {
            let row = PARTICLES.map(|n| cell(Weighting::UniformGimp, scheme, transfer, Some(n)));
            let _ = writeln!(text, "        {},", List(&row));
        }
        let _ = writeln!(text, "    ],");
    }
    let _ = writeln!(text, "];");
    for (name, words, weighting) in [
        (
            "B_SPLINE",
            "Quadratic B-splines by scheme and transfer.",
            Weighting::QuadraticBSpline,
        ),
        (
            "LINEAR",
            "Linear functions by scheme and transfer. USL, APIC and TPIC have none that is safe for every body; theirs is for bodies\n/// that fill their cells.",
            Weighting::Linear,
        ),
    ] {
        let _ = writeln!(
            text,
            "\n/// {words}\npub(super) const {name}: [[f64; 3]; 3] = ["
        );
        for scheme in SCHEMES {
            let row = TRANSFERS.map(|transfer| cell(weighting, scheme, transfer, None));
            let _ = writeln!(text, "    {},", List(&row));
        }
        let _ = writeln!(text, "];");
    }
    let (weighting, transfer) = LEAST_SQUARES;
    let row = SCHEMES.map(|scheme| cell(weighting, scheme, transfer, None));
    let _ = writeln!(
        text,
        "\n/// Quadratic B-splines with MLS by scheme.\npub(super) const LEAST_SQUARES: [f64; 3] = {};",
        List(&row)
    );
    text
}

/// Numbers as an array of the language.
struct List<'a>(&'a [f64]);

impl fmt::Display for List<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all: Vec<String> = self.0.iter().map(|x| format!("{x:.3}")).collect();
        write!(f, "[{}]", all.join(", "))
    }
}
