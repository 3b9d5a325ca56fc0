//! Two runs of one scene: how far each column of their histories is apart, and when most.

use super::RunFolder;

/// Columns of the clock, in which runs of one scene may differ.
const CLOCK: [&str; 3] = ["step", "velocity_time", "nominal_time"];

/// A column of two histories.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnDifference {
    /// Its name.
    pub name: String,
    /// Largest difference, second less first, by its size.
    pub most: f64,
    /// Time of it \[s\].
    pub time: f64,
    /// Its size over the largest value of the column, or of any component of its vector, in the first run; infinite where that
    /// is zero.
    pub share: f64,
    /// Values at the last common time.
    pub ends: [f64; 2],
}

/// Two runs beside each other.
#[derive(Clone, Debug, PartialEq)]
pub struct RunComparison {
    /// Columns of both, those that differ most first.
    pub columns: Vec<ColumnDifference>,
    /// Columns of the first alone, and of the second alone.
    pub alone: [Vec<String>; 2],
    /// Times of the first run at which both have values \[s\].
    pub times: Vec<f64>,
    /// True where the second run has rows at other times, so that its values are between two rows.
    pub is_interpolated: bool,
}

impl RunComparison {
    /// Compares the history of a run with that of another at the times of the first.
    #[must_use]
    pub fn new(first: &RunFolder, second: &RunFolder) -> Self {
        let (a, b) = (&first.history, &second.history);
        let [from, to] = [b.times.first(), b.times.last()].map(Option::<&f64>::copied);
        let (from, to) = (
            from.unwrap_or(f64::INFINITY),
            to.unwrap_or(f64::NEG_INFINITY),
        );
        let common: Vec<usize> = (0..a.times.len())
            .filter(|i| (from..=to).contains(&a.times[*i]))
            .collect();
        let largest = |name: &str| {
            let of_vector = a
                .columns
                .iter()
                .filter(|(own, _)| vector(own) == vector(name));
            let values = of_vector.flat_map(|(_, values)| common.iter().map(|i| values[*i].abs()));
            values.filter(|v| v.is_finite()).fold(0.0, f64::max)
        };
        let mut columns = vec![];
        for (name, values) in &a.columns {
            let Some(others) = b.column(name) else {
                continue;
            };
            if CLOCK.contains(&name.as_str()) {
                continue;
            }
            let mut found = ColumnDifference {
                name: name.clone(),
                most: 0.0,
                time: a.times.first().copied().unwrap_or(0.0),
                share: 0.0,
                ends: [f64::NAN; 2],
            };
            for &i in &common {
                let (time, own) = (a.times[i], values[i]);
                let Some(other) = b.at(others, time) else {
                    continue;
                };
                if (other - own).abs() > found.most.abs() {
                    (found.most, found.time) = (other - own, time);
                }
                found.ends = [own, other];
            }
            if found.most != 0.0 {
                found.share = found.most.abs() / largest(name);
            }
            columns.push(found);
        }
        // Of equal shares in the order of the file.
        columns.sort_by(|one, other| other.share.total_cmp(&one.share));
        let alone = [(a, b), (b, a)].map(|(own, other)| {
            let names = own.columns.iter().map(|(name, _)| name);
            let only = names.filter(|name| other.column(name).is_none());
            only.cloned().collect()
        });
        Self {
            columns,
            alone,
            is_interpolated: common.iter().any(|i| {
                let known = b
                    .times
                    .binary_search_by(|time| time.total_cmp(&a.times[*i]));
                known.is_err()
            }),
            times: common.iter().map(|i| a.times[*i]).collect(),
        }
    }

    /// Columns that differ at any common time.
    pub fn differing(&self) -> impl Iterator<Item = &ColumnDifference> {
        self.columns.iter().filter(|column| column.most != 0.0)
    }
}

/// The name of a column without its axes: that of the vector, or tensor, of which it is a component.
fn vector(name: &str) -> &str {
    name.trim_end_matches(['x', 'y', 'z'])
}
