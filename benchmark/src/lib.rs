//! Measurements, records and their judge, tables, charts and the page, and the `proctor` command over all of it.
//!
//! ```text
//! cases ──suite───────┐                  ┌──judge──► better, worse, the same
//! methods ──precision─┤                  ├──show───► tables and charts on a terminal
//! scenes ──bench──────┼──► one record ───┼──report─► a page of its own
//! limits ──stability──┤     (JSON)       ├──history► numbers over commits
//! solvers ──arena─────┘                  └──export─► JUnit, badges, other tools
//! ```
//!
//! ```
//! use proctor_benchmark::statistics::Summary;
//!
//! let times = Summary::of(&[2.0, 1.0, 4.0]).expect("at least one time");
//! assert_eq!(times.median, 2.0);
//! ```
#![forbid(unsafe_code)]

pub mod arena;
pub mod bench;
pub mod book;
mod exit;
pub mod forecast;
pub mod frames;
pub mod history;
mod interrupt;
pub mod judge;
pub mod measure;
pub mod precision;
pub mod progress;
pub mod record;
pub mod refine;
pub mod report;
pub mod runs;
mod say;
pub mod show;
pub mod side_by_side;
pub mod stability;
pub mod statistics;
pub mod suite;
mod verbs;

use clap::{CommandFactory, Parser};
use exit::{Failure, Outcome};
use proctor_kernel::ranks::Ranks;
use say::say;
use std::io::{BufWriter, Write};
use std::process::ExitCode;
use std::sync::Arc;
use suite::Against;
use verbs::{Amount, Verb};

/// Verifies and measures an explicit material point method (MPM/GIMP) kernel.
///
/// Without a verb: the main job on the built-in set, errors and run times side by side.
#[derive(Parser)]
#[command(name = "proctor", version, max_term_width = 100, after_help = EXIT_CODES, args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(subcommand)]
    verb: Option<Verb>,
    #[command(flatten)]
    amount: Amount,
    /// Also judge the cases themselves: each gate must react to the number that it names, and each wrong reference must break its
    /// gates
    #[arg(long)]
    wrong_references: bool,
}

const EXIT_CODES: &str = "\
Exit codes: 0 fine, 1 a check or a run failed or something got worse, 2 bad input or nothing that
can be compared, 130 interrupted by Ctrl-C, 143 by SIGTERM.
Units are SI everywhere. `proctor VERB -h` explains a verb with an example.";

/// Names of the verbs, for whoever checks what documents say of them.
#[must_use]
pub fn verbs() -> Vec<String> {
    let command = Cli::command();
    let names = command.get_subcommands().map(clap::Command::get_name);
    names.map(str::to_owned).collect()
}

/// Checks that the command takes these arguments. Nothing is run and no file is looked for.
///
/// # Errors
/// If they have a fault, in words for the user.
pub fn takes(arguments: &[&str]) -> Result<(), String> {
    let all = std::iter::once("proctor").chain(arguments.iter().copied());
    Cli::try_parse_from(all)
        .map(|_| ())
        .map_err(|error| error.to_string())
}

/// Runs the command on the arguments of this process.
#[must_use]
pub fn command() -> ExitCode {
    let cli = Cli::parse();
    // One writer for everything that goes to standard output: a reader that closes the pipe is then an error
    // value here, not a panic in some print.
    let mut out = BufWriter::new(std::io::stdout().lock());
    let against = if cli.wrong_references {
        Against::Wrong
    } else {
        Against::Correct
    };
    let result = verbs::run(cli.verb.as_ref(), cli.amount, against, &mut out)
        .and_then(|outcome| out.flush().map(|()| outcome).map_err(Failure::from));
    let ending = Ending::of(result);
    if let Some(message) = ending.message {
        // What was printed before the message belongs in front of it.
        let _ = out.flush();
        say!("{message}");
    }
    ExitCode::from(ending.code)
}

/// Runs the command of this process on ranks that share the run of a scene, and gives its exit code. The first rank speaks; an
/// error that the first has not is printed by the rank that has it.
#[must_use]
pub fn command_on(ranks: &Arc<dyn Ranks>) -> u8 {
    let first = ranks.rank() == 0;
    if !first {
        say::be_quiet();
    }
    let mut out: Box<dyn Write> = if first {
        Box::new(BufWriter::new(std::io::stdout().lock()))
    } else {
        Box::new(std::io::sink())
    };
    let result = verbs::run_on_ranks(Cli::try_parse().map(|cli| cli.verb), ranks, &mut out)
        .and_then(|outcome| out.flush().map(|()| outcome).map_err(Failure::from));
    let ending = Ending::of(result);
    let codes = ranks.all_gather(&[ending.code.into()]);
    let told_by_first = !first && codes[0] != [0];
    if let Some(message) = ending.message.filter(|_| !told_by_first) {
        let _ = out.flush();
        say::always(&message);
    }
    ending.code
}

/// The ending of a command: its exit code, and what there is to say.
struct Ending {
    code: u8,
    message: Option<String>,
}

impl Ending {
    fn of(result: Result<Outcome, Failure>) -> Self {
        let (code, message) = match result {
            Ok(Outcome::Fine) => (0, None),
            Ok(Outcome::Failed) => (1, None),
            Ok(Outcome::CannotCompare) => (2, None),
            Ok(Outcome::Interrupted(code)) => (code, None),
            Err(Failure::BadInput(message)) => (2, Some(message)),
            Err(Failure::Print(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => {
                (0, None)
            }
            Err(Failure::Print(error)) => {
                (1, Some(format!("cannot write to standard output: {error}")))
            }
        };
        Self { code, message }
    }
}
