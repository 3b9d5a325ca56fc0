//! Orders and errors of many problems by family and method, against what theory expects.

use proctor_verification::mill::Answer;
use proctor_verification::mill::expected::{
    LEAST_MEDIAN, ORDER_OF_DISPLACEMENT, ORDER_OF_STRESS, of,
};
use proctor_verification::mill::ladder::order;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::Write;

/// Problems of a family that a median speaks for.
const FEWEST: usize = 10;
/// Bounds of the bars of the histogram.
const BARS: [f64; 6] = [1.25, 1.5, 1.75, 2.0, 2.25, 2.5];

/// Results of a family with a method.
#[derive(Clone, Debug, Default)]
struct Row {
    problems: usize,
    misses: usize,
    /// Orders of displacement and stress.
    orders: [Vec<f64>; 2],
    /// Errors of displacement and stress on the finest mesh.
    errors: [Vec<f64>; 2],
}

/// Rows by family and method.
#[derive(Clone, Debug, Default)]
pub struct Table {
    rows: BTreeMap<(String, String), Row>,
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NAN, f64::min)
}

impl Table {
    /// Counts an answer.
    pub fn add(&mut self, answer: &Answer) {
        let problem = &answer.problem;
        let key = (problem.family.word().to_owned(), problem.method.to_string());
        let row = self.rows.entry(key).or_default();
        row.problems += 1;
        row.misses += usize::from(answer.misses());
        let Ok([.., coarse, fine]) = answer.found.as_deref() else {
            return;
        };
        let [.., a, b] = problem.ladder[..] else {
            return;
        };
        row.errors[0].push(fine.displacement);
        row.errors[1].push(fine.stress);
        if of(problem).displacement.is_some() {
            row.orders[0].push(order([coarse.displacement, fine.displacement], [a, b]));
            row.orders[1].push(order([coarse.stress, fine.stress], [a, b]));
        }
    }

    /// Orders of the displacement of a family.
    fn orders(&self, family: &str) -> Vec<f64> {
        let rows = self.rows.iter().filter(|((of, _), _)| of == family);
        rows.flat_map(|(_, row)| row.orders[0].iter().copied())
            .collect()
    }

    /// Families whose median order is too low.
    pub fn failed(&self) -> Vec<String> {
        let mut families: Vec<&String> = self.rows.keys().map(|(family, _)| family).collect();
        families.dedup();
        let failed = |family: &String| {
            let orders = self.orders(family);
            let median = median(&orders);
            (orders.len() >= FEWEST && (median.is_nan() || median < LEAST_MEDIAN)).then(|| {
                format!("{family}: median order of L2(u) {median:.2}, at least {LEAST_MEDIAN}")
            })
        };
        families.into_iter().filter_map(failed).collect()
    }

    /// A line for each row, and a histogram of all orders.
    pub fn write(&self, out: &mut dyn Write) -> std::io::Result<()> {
        writeln!(
            out,
            "{:<9} {:<20} {:>8} {:>6}  {:<17} {:<17} {:<19}",
            "family",
            "method",
            "problems",
            "misses",
            "order of L2(u)",
            "of L2(stress)",
            "median errors"
        )?;
        writeln!(
            out,
            "{:<9} {:<20} {:>8} {:>6}  {:<17} {:<17} {:<19}",
            "", "", "", "", "median (least)", "median (least)", "of u and stress"
        )?;
        let orders = |orders: &[f64]| {
            if orders.is_empty() {
                return "-".to_owned();
            }
            format!("{:.2} ({:.2})", median(orders), least(orders))
        };
        for ((family, method), row) in &self.rows {
            writeln!(
                out,
                "{family:<9} {method:<20} {:>8} {:>6}  {:<17} {:<17} {:.1e} {:.1e}",
                row.problems,
                row.misses,
                orders(&row.orders[0]),
                orders(&row.orders[1]),
                median(&row.errors[0]),
                median(&row.errors[1]),
            )?;
        }
        let all: Vec<f64> = (self.rows.values())
            .flat_map(|row| row.orders[0].iter().copied())
            .collect();
        writeln!(
            out,
            "expected by theory: {ORDER_OF_DISPLACEMENT} of the displacement, {ORDER_OF_STRESS} of the stress"
        )?;
        write!(out, "orders of L2(u):")?;
        let mut low = f64::NEG_INFINITY;
        for high in BARS.into_iter().chain([f64::INFINITY]) {
            let count = all
                .iter()
                .filter(|order| (low..high).contains(*order))
                .count();
            match (low.is_finite(), high.is_finite()) {
                (false, _) => write!(out, " below {high}: {count}")?,
                (_, false) => write!(out, ", from {low}: {count}")?,
                _ => write!(out, ", to {high}: {count}")?,
            }
            low = high;
        }
        writeln!(out)
    }

    /// The same as JSON.
    pub fn json(&self) -> Vec<Value> {
        let row = |((family, method), row): (&(String, String), &Row)| {
            json!({
                "family": family, "method": method, "problems": row.problems, "misses": row.misses,
                "order_of_displacement": { "median": median(&row.orders[0]), "least": least(&row.orders[0]) },
                "order_of_stress": { "median": median(&row.orders[1]), "least": least(&row.orders[1]) },
                "error_of_displacement": median(&row.errors[0]),
                "error_of_stress": median(&row.errors[1]),
            })
        };
        self.rows.iter().map(row).collect()
    }
}
