//! The page of a case.

use super::errors::Errors;
use super::{BookFile, WRITTEN, sketch};
use crate::record::Record;
use crate::record::details::GateDetail;
use crate::record::gate::GateRow;
use crate::report::gates;
use crate::show::summary;
use proctor_scene::Scene;
use proctor_verification::case::{Case, Rung, Size};
use std::fmt::Write as _;

/// Gates of one bound and one reason from which on the page has the nearest of them alone.
const MANY: usize = 4;

/// A case with the record that its page is made of.
pub struct Page<'a> {
    case: &'static Case,
    record: &'a Record,
    size: Size,
    gates: Vec<GateDetail>,
}

impl<'a> Page<'a> {
    pub fn new(case: &'static Case, record: &'a Record) -> Self {
        let size = match record.ladder() {
            Some("full") => Size::Full,
            _ => Size::Quick,
        };
        // Bounds and reasons need no run.
        let judged = case.judge(size, &[]).gates;
        let reason = |name: &str| {
            let gate = judged.iter().find(|gate| gate.name == name);
            gate.map_or_else(String::new, |gate| gate.reason.to_owned())
        };
        let detail = |gate: GateRow<'_>| GateDetail {
            name: gate.name.to_owned(),
            value: gate.value,
            relation: gate.side.to_owned(),
            bound: gate.bound.unwrap_or(f64::NAN),
            reason: reason(gate.name),
            passed: gate.holds(),
        };
        let gates = record.gate_rows().filter(|gate| gate.case == case.name());
        Self {
            case,
            record,
            size,
            gates: gates.map(detail).collect(),
        }
    }

    /// Words such as `3 of 3`.
    pub fn held(&self) -> String {
        let held = self.gates.iter().filter(|gate| gate.passed).count();
        format!("{held} of {}", self.gates.len())
    }

    /// The share of its bound of the gate that uses up most.
    pub fn nearest(&self) -> String {
        let used = self.gates.iter().map(GateDetail::used);
        summary::share(used.fold(0.0, f64::max))
    }

    /// The page and its pictures.
    pub fn files(&self) -> Vec<BookFile> {
        let name = self.case.name();
        let errors = Errors::of(self.case, self.record);
        let mut files = vec![];
        let mut text = format!(
            "{WRITTEN}# {name}\n\n**{}**\n\n## Set-up\n\n",
            self.case.question()
        );
        text.push_str(&self.description());
        if let Some((scene, rung)) = self.coarsest()
            && let Some(picture) = sketch::svg(&scene)
        {
            let path = format!("{name}-set-up.svg");
            let _ = write!(
                text,
                "\n![The bodies on their mesh]({path})\n\n{}\n",
                sketch::caption(&scene, &rung.label)
            );
            files.push(BookFile {
                path,
                text: picture,
            });
        }
        text.push_str(&self.method());
        text.push_str(&self.gate_table());
        text.push_str(&errors.table());
        if let Some(chart) = errors.chart() {
            let path = format!("{name}-errors.svg");
            let _ = write!(
                text,
                "\n![{}]({path})\n\nWork is the number of particles times the number of steps; the run time is proportional to \
                 it.\n",
                chart.title
            );
            files.push(BookFile {
                path,
                text: chart.to_svg(),
            });
        }
        text.push_str(&self.repeat());
        files.insert(
            0,
            BookFile {
                path: format!("{name}.md"),
                text,
            },
        );
        files
    }

    /// The head of the file of the case without the question and the command, which the page has elsewhere.
    fn description(&self) -> String {
        let head = self.case.description();
        let (_, mut text) = head
            .split_once("\n\n")
            .map_or(("", String::new()), |(a, b)| (a, b.to_owned()));
        while let Some(at) = text.find("`proctor verify") {
            let end = text[at + 1..]
                .find('`')
                .map_or(text.len(), |end| at + end + 2);
            let end = end + usize::from(text[end..].starts_with(['.', ';']));
            text.replace_range(at..end, "");
        }
        let text = text.replace("[`", "`").replace("`]", "`");
        let text = text.replace("\\[", "[").replace("\\]", "]");
        let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
        format!("{}\n", lines.join("\n").trim_end())
    }

    /// The coarsest rung of the ladder that has a scene, with it.
    fn coarsest(&self) -> Option<(Scene, Rung)> {
        let rung = self.case.rungs(self.size).into_iter().next()?;
        let scene = self.case.scene_of(&rung).ok()?;
        Some((scene, rung))
    }

    /// The methods of the rungs, each once with its runs.
    fn method(&self) -> String {
        let mut methods: Vec<(String, Vec<&'static str>)> = vec![];
        for rung in self.case.rungs(self.size) {
            if self.case.scene_of(&rung).is_err() {
                continue;
            }
            let method = self.case.own_settings(&rung).method.to_string();
            match methods.iter_mut().find(|(known, _)| *known == method) {
                Some((_, variants)) if variants.contains(&rung.variant) => {}
                Some((_, variants)) => variants.push(rung.variant),
                None => methods.push((method, vec![rung.variant])),
            }
        }
        let line = match methods.as_slice() {
            [] => {
                return "\nNo grid takes part, or each run sets up scenes of its own.\n".to_owned();
            }
            [(method, _)] => format!("Method: {method}."),
            several => {
                let each = several
                    .iter()
                    .map(|(method, variants)| format!("{method} ({})", variants.join(", ")));
                format!("Methods: {}.", each.collect::<Vec<_>>().join("; "))
            }
        };
        format!("\n{line}\n")
    }

    /// The gates. Of many with one bound and one reason the nearest to its bound stands for all.
    fn gate_table(&self) -> String {
        let mut groups: Vec<Vec<&GateDetail>> = vec![];
        for gate in &self.gates {
            let alike = |other: &GateDetail| {
                other.bound.to_bits() == gate.bound.to_bits()
                    && other.relation == gate.relation
                    && other.reason == gate.reason
            };
            match groups.iter_mut().find(|group| alike(group[0])) {
                Some(group) => group.push(gate),
                None => groups.push(vec![gate]),
            }
        }
        let ladder = match self.size {
            Size::Full => "full",
            Size::Quick => "short",
        };
        let mut text = format!(
            "\n## Gates\n\n{} gates of the {ladder} ladder hold.\n\n| gate | found | bound | why this bound |\n|---|--:|--:|---|\n",
            self.held()
        );
        for group in groups {
            if group.len() < MANY {
                for gate in &group {
                    text.push_str(&row(gate, ""));
                }
                continue;
            }
            let nearest = |a: &&&GateDetail, b: &&&GateDetail| a.used().total_cmp(&b.used());
            if let Some(gate) = group.iter().max_by(nearest) {
                let more = format!(" (the nearest to its bound of {} alike)", group.len());
                text.push_str(&row(gate, &more));
            }
        }
        text
    }

    /// Commands that repeat the case, and what else can be done with it.
    fn repeat(&self) -> String {
        let name = self.case.name();
        let short = match self.size {
            Size::Full => "",
            Size::Quick => " --quick",
        };
        let mut text = format!(
            "\n## Repeat it\n\n    proctor verify {name}{short}\n\nThe source is `verification/src/cases/{}`.\n",
            self.case.file()
        );
        match self.case.studied() {
            Ok(studies) => {
                for study in studies {
                    let _ = write!(
                        text,
                        "\nError against run time with every method:\n\n    proctor precision {}\n",
                        study.name()
                    );
                }
            }
            Err(reason) => {
                let _ = writeln!(
                    text,
                    "\nThere is no study of error against run time: {reason}."
                );
            }
        }
        if let Some(reason) = self.case.closed_to_guests() {
            let _ = writeln!(text, "\nNo other solver runs it: {reason}.");
        }
        text
    }
}

/// A gate as a line of the table.
fn row(gate: &GateDetail, more: &str) -> String {
    let [found, bound] = gates::of_case(gate);
    let cell = |text: &str| text.replace('|', "\\|");
    format!(
        "| {}{more} | {found} | {bound} | {} |\n",
        cell(&gates::short_name(&gate.name)),
        cell(&gate.reason)
    )
}
